"""Weibull distribution of strengths, F(s) = 1 - exp(-(s/scale)^modulus) (Weibull 1951, J. Appl. Mech. 18, 293).

Fit by maximum likelihood, right-censored values among them (Cohen 1965, Technometrics 7, 579). Fitted modulus over true one, and
fitted modulus times ln(fitted scale over true one), have distributions that depend on the numbers of values alone (Thoman, Bain &
Antle 1969, Technometrics 11, 445): intervals from samples drawn at modulus = scale = 1 are exact, but for the number drawn, where no
value is censored or all above the r-th are. The same holds for the largest distance of the sample's shares from the fitted curve
(Lilliefors), which says whether the data bear the fit.
"""

import dataclasses
import functools

import numpy

from sample import LEVEL, generator

DRAWN = 4000
FEWEST = 20           # broken granules; the modulus of fewer is not known to 35 %
FALSE_ALARMS = 0.01   # share of samples that are Weibull and refused all the same


@dataclasses.dataclass
class Fit:
    modulus: float
    scale: float              # unit of the values
    modulus_interval: tuple
    scale_interval: tuple
    covariance: list          # of (ln modulus, ln scale), from the drawn samples
    distance: float           # largest, of shares
    p: float                  # share of Weibull samples that lie farther from their fits
    broken: int
    censored: int
    lowest: float             # range of the data
    highest: float


class Refusal(Exception):
    """Why the data do not bear a fit."""


def solve(values, broken):
    """Modulus and scale of each row. values: sorted along the last axis; broken: the first so many of a row broke, the others
    were given up at their values."""
    values = numpy.atleast_2d(numpy.asarray(values, float))
    logs = numpy.log(values)
    top = logs.max(axis=-1, keepdims=True)
    x = logs - top  # <= 0
    mean = x[:, :broken].mean(axis=-1)
    # Start: the standard deviation of ln s is pi/(sqrt(6) modulus).
    modulus = 1.28 / numpy.maximum(x[:, :broken].std(axis=-1), 1e-9)
    low, high = numpy.zeros_like(modulus), numpy.full_like(modulus, numpy.inf)
    for _ in range(100):
        weight = numpy.exp(modulus[:, None] * x)
        s0, s1, s2 = weight.sum(-1), (weight * x).sum(-1), (weight * x * x).sum(-1)
        f = s1 / s0 - 1 / modulus - mean  # rises with the modulus
        low, high = numpy.where(f < 0, modulus, low), numpy.where(f < 0, high, modulus)
        step = f / (s2 / s0 - (s1 / s0) ** 2 + 1 / modulus**2)
        better = modulus - step
        inside = (better > low) & (better < high)
        better = numpy.where(inside, better, numpy.where(numpy.isfinite(high), 0.5 * (low + high), 2 * modulus))
        if numpy.all(numpy.abs(better - modulus) <= 1e-12 * modulus):
            break
        modulus = better
    scale = numpy.exp(top[:, 0] + numpy.log(numpy.exp(modulus[:, None] * x).sum(-1) / broken) / modulus)
    return modulus, scale


def shares(values, modulus, scale):
    return -numpy.expm1(-(values / scale) ** modulus)


def distance(values, broken, modulus, scale):
    """Largest difference of the sample's shares, over the values that broke, from the curve."""
    n = values.shape[-1]
    curve = shares(values[..., :broken], numpy.asarray(modulus)[..., None], numpy.asarray(scale)[..., None])
    k = numpy.arange(1, broken + 1)
    return numpy.maximum(numpy.abs(curve - k / n), numpy.abs(curve - (k - 1) / n)).max(axis=-1)


@functools.lru_cache
def drawn(n, broken):
    """Fits and distances of samples of modulus 1 and scale 1, of which all above the broken-th are known to be larger."""
    samples = numpy.sort(-numpy.log(generator(f"weibull {n} {broken}").random((DRAWN, n))), axis=-1)
    samples[:, broken:] = samples[:, broken - 1:broken]
    modulus, scale = solve(samples, broken)
    return modulus, modulus * numpy.log(scale), numpy.sort(distance(samples, broken, modulus, scale))


def fit(values, above=(), level=LEVEL):
    """values: at which granules broke; above: up to which others bore. Raises Refusal."""
    values, above = numpy.sort(numpy.asarray(values, float)), numpy.sort(numpy.asarray(above, float))
    broken, n = len(values), len(values) + len(above)
    if broken < FEWEST:
        raise Refusal(f"{broken} granules broke; a Weibull modulus needs {FEWEST}")
    if values[0] == values[-1]:
        raise Refusal("all values are equal")
    together = numpy.concatenate([values, above])
    modulus, scale = (float(one[0]) for one in solve(together, broken))
    ratio, shift, distances = drawn(n, broken)
    tails = ((1 - level) / 2, (1 + level) / 2)
    of_modulus = tuple(float(modulus / q) for q in numpy.quantile(ratio, tails[::-1]))
    of_scale = tuple(float(scale * numpy.exp(-q / modulus)) for q in numpy.quantile(shift, tails[::-1]))
    d = float(distance(together[None], broken, [modulus], [scale])[0])
    p = float(1 - numpy.searchsorted(distances, d) / len(distances))
    if p < FALSE_ALARMS:
        raise Refusal(f"not Weibull: a Weibull sample lies as far from its fit as {d:.2g} in {100 * p:.2g} % of cases")
    covariance = numpy.cov(numpy.log(ratio), shift / ratio / modulus)
    return Fit(modulus, scale, of_modulus, of_scale, covariance.tolist(), d, p, broken, len(above), float(values[0]), float(values[-1]))
