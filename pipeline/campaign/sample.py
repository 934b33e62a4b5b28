"""What a sample says about the population it comes from: means, spreads and quantiles with 95 % intervals."""

import hashlib
import math
import statistics

import numpy

LEVEL = 0.95
NORMAL = statistics.NormalDist()
RESAMPLES = 4000
FEWEST = 5  # values; of fewer a bootstrap says nothing


def generator(name):
    """Random numbers that depend on a name alone: the same table gives the same digits everywhere."""
    return numpy.random.Generator(numpy.random.Philox(int(hashlib.sha256(name.encode()).hexdigest()[:16], 16)))


def bootstrap(values, statistic, name="", level=LEVEL, resamples=RESAMPLES):
    """Interval of statistic(values), bias-corrected and accelerated (Efron 1987, J. Am. Stat. Assoc. 82, 171).

    statistic: of the last axis of an array. Nothing for fewer than five values, or where all are equal.
    """
    values = numpy.asarray(values, float)
    n = len(values)
    if n < FEWEST or numpy.all(values == values[0]):
        return None
    drawn = statistic(values[generator(name).integers(0, n, (resamples, n))])
    centre = float(statistic(values))
    below = numpy.clip((numpy.count_nonzero(drawn < centre) + 0.5 * numpy.count_nonzero(drawn == centre)) / resamples, 0.5 / resamples,
                       1 - 0.5 / resamples)
    bias = NORMAL.inv_cdf(float(below))
    without = statistic(values[(numpy.arange(n)[:, None] + numpy.arange(1, n)) % n])  # each left out once
    off = without.mean() - without
    acceleration = float((off**3).sum() / (6 * (off**2).sum() ** 1.5)) if (off**2).sum() > 0 else 0.0
    shares = []
    for tail in ((1 - level) / 2, (1 + level) / 2):
        z = bias + NORMAL.inv_cdf(tail)
        shares.append(NORMAL.cdf(bias + z / (1 - acceleration * z)))
    low, high = numpy.quantile(drawn, shares)
    return float(low), float(high)


def mean(values):
    return numpy.mean(values, axis=-1)


def spread(values):
    """Standard deviation in the population."""
    return numpy.std(values, axis=-1, ddof=1)


def binomial(n, p):
    """Probabilities of 0 ... n successes."""
    if p <= 0 or p >= 1:
        return [1.0 * (k == (n if p >= 1 else 0)) for k in range(n + 1)]
    logs = [math.lgamma(n + 1) - math.lgamma(k + 1) - math.lgamma(n - k + 1) + k * math.log(p) + (n - k) * math.log1p(-p) for k in range(n + 1)]
    return [math.exp(one) for one in logs]


def quantile_ranks(n, p, level=LEVEL):
    """Ranks (1 ... n) of the order statistics between which the quantile p of any population lies with at least this
    probability; None for a side on which a sample of n has no such value (David & Nagaraja 2003, 7.1)."""
    below = numpy.cumsum(binomial(n, p))  # P(at most k values lie below the quantile)
    tail = (1 - level) / 2
    low = int(numpy.searchsorted(below, tail, side="right"))       # P(values below < low) <= tail
    high = int(numpy.searchsorted(below, 1 - tail, side="left")) + 1
    return (low or None), (high if high <= n else None)


def quantile(values, p):
    """Of the sample; infinite where it lies among values that are only known to be larger."""
    ordered = numpy.sort(numpy.asarray(values, float))
    place = p * (len(ordered) - 1)
    low = int(place)
    high = min(low + 1, len(ordered) - 1)
    if low == high or place == low:
        return float(ordered[low])
    return float(ordered[low] + (place - low) * (ordered[high] - ordered[low])) if math.isfinite(ordered[high]) else math.inf


def quantile_interval(values, p, level=LEVEL):
    """(low, high); None on a side: the sample is too small to bound it there."""
    ordered = sorted(values)
    low, high = quantile_ranks(len(ordered), p, level)
    take = lambda rank: None if rank is None or math.isinf(ordered[rank - 1]) else float(ordered[rank - 1])
    return take(low), take(high)


def share_band(n, level=LEVEL):
    """Of the share of a population below the k-th of n ordered values: its interval for k = 1 ... n (quantiles of the beta
    distribution k, n - k + 1, found from the binomial one)."""
    def bound(k, tail):  # p with P(at least k of n values lie below) = tail
        low, high = 0.0, 1.0
        for _ in range(50):
            p = 0.5 * (low + high)
            low, high = (p, high) if sum(binomial(n, p)[k:]) < tail else (low, p)
        return 0.5 * (low + high)
    return [(bound(k, (1 - level) / 2), bound(k, (1 + level) / 2)) for k in range(1, n + 1)]
