"""The equations once more, in plain loops over float64 numbers; shares no code with the package.

One motion at a time, without padding: arrays are [T, D] or [T, N] for units i = 0 … N − 1, the D
units of IO first. What stands here is slow and short, so that it can be checked by reading.

`role_networks` is of another kind: networks of the package, with weights that a hand has written.
"""
