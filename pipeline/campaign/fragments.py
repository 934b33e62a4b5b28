"""What granules break into: numbers, masses over that of the parent, moments, and distributions fitted to them."""

import dataclasses
import math

import numpy

MOMENTS = range(9)       # of L^k, L in proportion to the cube root of the mass
EROSION = 0.05           # a piece below this share of the parent counts as eroded
FEWEST = 30              # fragments; of fewer no distribution is fitted
LARGEST_DISTANCE = 0.15  # of a fitted distribution, Kolmogorov-Smirnov


class Refusal(Exception):
    """Why the data do not bear a distribution."""


@dataclasses.dataclass
class Breakage:
    parents: int
    count: float             # fragments a breakup
    erosion_share: float     # of the mass
    moments: list            # b_k = sum (m_i/M)^(k/3), mean over breakups
    shares: list             # m_i/M of all fragments


def gather(sizes):
    """sizes: particles of each fragment, a list a breakup."""
    broken = [numpy.array(one, float) / sum(one) for one in sizes if len(one) > 1]
    if not broken:
        raise Refusal("no granule broke")
    return Breakage(len(broken), float(numpy.mean([len(one) for one in broken])), float(numpy.mean([one[one < EROSION].sum() for one in broken])),
                    [float(numpy.mean([(one ** (k / 3)).sum() for one in broken])) for k in MOMENTS], sorted(float(x) for one in broken for x in one))


# b_k of the daughters that population-balance codes have by name: k -> sum of (m/M)^(k/3).
NAMED = {"symmetricFragmentation": lambda k: 2 * 0.5 ** (k / 3), "oneQuarterMassRatio": lambda k: 0.2 ** (k / 3) + 0.8 ** (k / 3), "uniform": lambda k: 6 / (k + 3)}


def nearest_named(breakage):
    """(name, largest |b_k/b_k of ours - 1|): nearest by moments."""
    off = {name: max(abs(moment(k) / breakage.moments[k] - 1) for k in MOMENTS) for name, moment in NAMED.items()}
    name = min(off, key=off.get)
    return name, off[name]


def _beta_cdf(x, a, b):
    grid = (numpy.arange(4000) + 0.5) / 4000
    density = numpy.exp((a - 1) * numpy.log(grid) + (b - 1) * numpy.log1p(-grid))
    whole = numpy.concatenate([[0], density.cumsum()])
    return numpy.interp(x, numpy.linspace(0, 1, 4001), whole / whole[-1])


def _gamma_cdf(x, shape, mean):
    grid = (numpy.arange(4000) + 0.5) / 4000
    density = numpy.exp((shape - 1) * numpy.log(grid) - shape * grid / mean)
    whole = numpy.concatenate([[0], density.cumsum()])
    return numpy.interp(x, numpy.linspace(0, 1, 4001), whole / whole[-1])


def _erosive_cdf(x, share):
    return share * numpy.minimum(x / EROSION, 1) + (1 - share) * (3 * x**2 - 2 * x**3)


def _distance(shares, cdf):
    n, at = len(shares), cdf(shares)
    k = numpy.arange(1, n + 1)
    return float(max(abs(at - k / n).max(), abs(at - (k - 1) / n).max()))


def fits(breakage):
    """{name: {parameters, distance}} by number: beta with the mean 1/count (mass is conserved), Schulz-Zimm with the same mean (Schulz 1939; Zimm 1948),
    and erosion beside a quadratic 6 x (1 - x). Those farther than LARGEST_DISTANCE are {"refused": why}."""
    if len(breakage.shares) < FEWEST:
        raise Refusal(f"{len(breakage.shares)} fragments; a distribution needs {FEWEST}")
    x = numpy.clip(numpy.array(breakage.shares), 1e-6, 1 - 1e-6)
    mean = float(x.mean())
    scan = numpy.exp(numpy.linspace(math.log(0.05), math.log(50), 400))
    beta = [((a - 1) * numpy.log(x) + (a * (1 / mean - 1) - 1) * numpy.log1p(-x)).sum() - len(x) * (math.lgamma(a) + math.lgamma(a * (1 / mean - 1)) - math.lgamma(a / mean))
            for a in scan]
    gamma = [(k * math.log(k / mean) - math.lgamma(k)) * len(x) + ((k - 1) * numpy.log(x) - k * x / mean).sum() for k in scan]
    a, k = float(scan[int(numpy.argmax(beta))]), float(scan[int(numpy.argmax(gamma))])
    eroded = float((x < EROSION).mean())
    found = {"beta": {"a": a, "b": a * (1 / mean - 1), "distance": _distance(x, lambda at: _beta_cdf(at, a, a * (1 / mean - 1)))},
             "schulz_zimm": {"shape": k, "mean": mean, "distance": _distance(x, lambda at: _gamma_cdf(at, k, mean))},
             "erosive_quadratic": {"eroded_share_by_number": eroded, "distance": _distance(x, lambda at: _erosive_cdf(at, eroded))}}
    for name, fit in found.items():
        if fit["distance"] > LARGEST_DISTANCE:
            found[name] = {"refused": f"distance {fit['distance']:.2g} from the data, more than {LARGEST_DISTANCE}"}
    return found
