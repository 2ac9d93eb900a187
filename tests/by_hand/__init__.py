"""The equations once more, in plain loops over float64 numbers; shares no code with the package.

One motion at a time, without padding: arrays are [T, D] or [T, N] for units i = 0 … N − 1, the D
units of IO first. What stands here is slow and short, so that it can be checked by reading.
"""
