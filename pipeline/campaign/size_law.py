"""Strength over size, stress = factor (radius)^-exponent, from the size classes of a campaign."""

import dataclasses
import math

import numpy

import sample

FEWEST_CLASSES, FEWEST_GRANULES = 3, 5   # of each class
SMALLEST_SPAN = 1.5                      # largest over smallest radius
FALSE_ALARMS = 0.01
WIDEST = 0.25, 0.15                      # half of the interval of the exponent, absolute and of the exponent, above both of which it says nothing
RESAMPLES = 2000


class Refusal(Exception):
    """Why the data do not bear the law."""


@dataclasses.dataclass
class SizeLaw:
    exponent: float
    factor: float               # Pa m^exponent
    exponent_interval: tuple
    covariance: list            # of (exponent, ln factor)
    smallest: float             # m, range of radii
    largest: float
    misfit: float               # largest of any class, |ln(mean/law)|
    p: float                    # share of samples that obey the law and lie farther from it
    classes: int


def chi_square_tail(value, freedom):
    """P(chi^2 > value) for a whole number of degrees of freedom (Abramowitz & Stegun 26.4.4, 26.4.5)."""
    half = 0.5 * value
    if freedom % 2 == 0:
        term, total = math.exp(-half), 0.0
        for k in range(freedom // 2):
            total += term
            term *= half / (k + 1)
        return total
    term, total = math.sqrt(2 * value / math.pi) * math.exp(-half), math.erfc(math.sqrt(half))
    for k in range(1, freedom // 2 + 1):
        total += term
        term *= value / (2 * k + 1)
    return total


def _line(x, y, weight):
    """Weighted least squares y = a + b x of the last axis: (a, b)."""
    total = weight.sum(-1, keepdims=True)
    xm, ym = (weight * x).sum(-1, keepdims=True) / total, (weight * y).sum(-1, keepdims=True) / total
    b = (weight * (x - xm) * (y - ym)).sum(-1) / (weight * (x - xm) ** 2).sum(-1)
    return ym[..., 0] - b * xm[..., 0], b


def fit(classes):
    """classes: [(radius of each granule, stress of each granule)], a pair of lists a class. Means of logarithms, each class
    with the weight of its standard error; intervals by resampling granules within their classes."""
    classes = [(numpy.log(numpy.asarray(r, float)), numpy.log(numpy.asarray(s, float))) for r, s in classes if len(s) >= FEWEST_GRANULES]
    if len(classes) < FEWEST_CLASSES:
        raise Refusal(f"{len(classes)} size class{'es' * (len(classes) != 1)} of {FEWEST_GRANULES} granules or more; an exponent needs {FEWEST_CLASSES}")
    x = numpy.array([r.mean() for r, _ in classes])
    span = math.exp(x.max() - x.min())
    if span < SMALLEST_SPAN:
        raise Refusal(f"sizes differ by a factor of {span:.2g}; an exponent needs {SMALLEST_SPAN}")
    y = numpy.array([s.mean() for _, s in classes])
    error = numpy.array([s.std(ddof=1) / math.sqrt(len(s)) for _, s in classes])
    weight = 1 / error**2
    a, b = _line(x, y, weight)
    residual = y - a - b * x
    p = chi_square_tail(float((residual**2 * weight).sum()), len(classes) - 2)
    if p < FALSE_ALARMS:
        raise Refusal(f"no power law: classes that obey one lie as far from it in {100 * p:.2g} % of cases; largest deviation {100 * numpy.expm1(abs(residual).max()):.2g} %")
    draw = sample.generator(f"size law {len(classes)}")
    drawn = []
    for r, s in classes:
        chosen = draw.integers(0, len(s), (RESAMPLES, len(s)))
        drawn.append((r[chosen].mean(-1), s[chosen].mean(-1)))
    intercepts, slopes = _line(numpy.array([r for r, _ in drawn]).T, numpy.array([s for _, s in drawn]).T, weight)
    low, high = numpy.quantile(-slopes, (0.025, 0.975))
    if 0.5 * (high - low) > max(WIDEST[0], WIDEST[1] * abs(b)):
        raise Refusal(f"the exponent is {-b:.2g} with an interval from {low:.2g} to {high:.2g}: too wide (more than ± {WIDEST[0]} and ± {100 * WIDEST[1]:.0f} %)")
    return SizeLaw(float(-b), float(math.exp(a)), (float(low), float(high)), numpy.cov(-slopes, intercepts).tolist(), float(math.exp(x.min())),
                   float(math.exp(x.max())), float(abs(residual).max()), p, len(classes))
