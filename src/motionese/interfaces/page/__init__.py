"""The page on which a person teaches the simulated robot."""
