"""The experiment: settings, conditions, the imitation loop, runs that resume, many runs at once."""
