"""A polynomial at every row, fitted to the rows nearest to it, one by one with NumPy's polyfit."""

import numpy as np


def fitted_one_by_one(times, values, at, window, degree):
    """Return coefficients [R, degree + 1] of (s − at)^k of one column of samples."""
    result = []
    for place in at:
        nearest = int(np.abs(times - place).argmin())
        first = min(max(nearest - window // 2, 0), len(times) - window)
        near = slice(first, first + window)
        result.append(np.polyfit(times[near] - place, values[near], degree)[::-1])
    return np.array(result)
