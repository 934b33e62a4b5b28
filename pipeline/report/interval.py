"""95 % intervals of means by Student's t."""

import math
import statistics

# Two-sided 95 % quantile by degrees of freedom; between two entries the lower, so intervals are rather too wide.
T95 = {1: 12.71, 2: 4.30, 3: 3.18, 4: 2.78, 5: 2.57, 6: 2.45, 7: 2.36, 8: 2.31, 9: 2.26, 10: 2.23, 11: 2.20, 12: 2.18,
       13: 2.16, 14: 2.14, 15: 2.13, 16: 2.12, 17: 2.11, 18: 2.10, 19: 2.09, 24: 2.06, 29: 2.05, 59: 2.00}


def t95(freedom):
    return T95[max(k for k in T95 if k <= freedom)]


def half_width(values):
    """Half of the interval of the mean of at least two values."""
    return t95(len(values) - 1) * statistics.stdev(values) / math.sqrt(len(values))


def difference(values, reference):
    """Difference of two means and half of its interval (Welch 1947)."""
    parts = [statistics.variance(v) / len(v) for v in (values, reference)]
    freedom = sum(parts) ** 2 / sum(p * p / (len(v) - 1) for p, v in zip(parts, (values, reference)))
    return (statistics.fmean(values) - statistics.fmean(reference), t95(freedom) * math.sqrt(sum(parts)))
