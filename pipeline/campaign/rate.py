"""How often granules break along histories: first exits of a population over the ratio of the flow's rms stress to the strength.

rigidstress counts for every granule, by level (sigma_rms/sigma_cr) and by time since the start, tracks that saw their first exit and the time that all
were at risk. Loaded beyond their strength at the very start: counted apart, for this says where granules were put. The first RELAXATION
strain times are left out of the rate: there those break that sit almost at their strength. After them the rate is exits over time at risk.
"""

import dataclasses
import math

import numpy

import sample

RELAXATION = 2.0     # 1/sqrt(<2 E:E>)
FEWEST_EXITS = 20    # of a level, below which its rate is not used
LARGEST_MISFIT = 0.2 # of ln rate within the range of a fit
SMALLEST_SPAN = 2.0  # of that range, largest over smallest level
RESAMPLES = 1000
KUSTERS = math.sqrt(4 / (15 * math.pi))


class Refusal(Exception):
    """Why the data do not bear a rate."""


@dataclasses.dataclass
class Level:
    ratio: float         # sigma_rms/sigma_cr
    exits: int           # after the relaxation
    exposure: float      # in 1/sqrt(<2 E:E>)
    born: int
    early: int           # within the relaxation
    tracks: int
    rate: float          # times 1/sqrt(<2 E:E>); 0: no exit
    low: float
    high: float


@dataclasses.dataclass
class PowerLaw:
    """rate = factor (sigma_rms/sigma_cr)^exponent sqrt(<2 E:E>)."""
    exponent: float
    factor: float
    exponent_interval: tuple
    factor_interval: tuple
    lowest: float        # range of sigma_rms/sigma_cr
    highest: float
    misfit: float        # largest |ln(rate/law)| in it
    levels: int


def counts(reports):
    """(levels, exits, exposure, born, early, tracks) of granules x levels; exposure in 1/sqrt(<2 E:E>)."""
    all_exits, all_exposure, born, early, tracks = [], [], [], [], []
    levels = None
    for report in reports:
        found = report["results"]["tracks"]
        if levels is None:
            levels = found["level"]
        elif found["level"] != levels:
            raise Refusal("granules were followed at different levels")
        edges = numpy.array(found["time_s"]) * found["rms_rate_per_s"]
        shape = (len(levels), len(edges) - 1)
        exits, exposure = (numpy.reshape(found[key], shape) for key in ("exits", "exposure_s"))
        late = edges[:-1] >= RELAXATION * (1 - 1e-9)
        if not late.any():
            raise Refusal(f"the tracks are shorter than {RELAXATION:g} strain times: nothing is left after the relaxation")
        all_exits.append(exits[:, late].sum(1))
        all_exposure.append(exposure[:, late].sum(1) * found["rms_rate_per_s"])
        early.append(exits[:, ~late].sum(1))
        born.append(found["born_above"])
        tracks.append(found["count"])
    return numpy.array(levels), numpy.array(all_exits), numpy.array(all_exposure), numpy.array(born), numpy.array(early), tracks


def table(found):
    """A Level for each; intervals by resampling granules (all see the same tracks, whose own sampling error is not in them)."""
    levels, exits, exposure, born, early, tracks = found
    draw = sample.generator("rate").integers(0, len(tracks), (RESAMPLES, len(tracks)))
    rows = []
    for k, ratio in enumerate(levels):
        at_risk = exposure[:, k].sum()
        rate = exits[:, k].sum() / at_risk if at_risk > 0 else math.nan
        with numpy.errstate(invalid="ignore", divide="ignore"):
            drawn = exits[draw, k].sum(1) / exposure[draw, k].sum(1)
        low, high = numpy.nanquantile(drawn, (0.025, 0.975)) if at_risk > 0 and len(tracks) > 1 else (math.nan, math.nan)
        rows.append(Level(float(ratio), int(exits[:, k].sum()), float(at_risk), int(born[:, k].sum()), int(early[:, k].sum()), int(sum(tracks)), float(rate),
                          float(low), float(high)))
    return rows


def _poisson_line(x, events, exposure):
    """ln rate = a + b x by maximum likelihood of counts (iteratively reweighted least squares); rows of events x levels."""
    a, b = numpy.log(events.sum(-1) / exposure.sum(-1)), numpy.zeros(len(events))
    for _ in range(100):
        mean = exposure * numpy.exp(a[:, None] + b[:, None] * x)
        total, first, second = mean.sum(-1), (mean * x).sum(-1), (mean * x * x).sum(-1)
        u, v = (events - mean).sum(-1), ((events - mean) * x).sum(-1)
        det = total * second - first**2
        da, db = (second * u - first * v) / det, (total * v - first * u) / det
        size = numpy.maximum(1, numpy.maximum(abs(da), abs(db)) / 2)  # never a jump of more than e^2
        a, b = a + da / size, b + db / size
        if max(abs(da).max(), abs(db).max()) < 1e-10:
            break
    return a, b


def fit(found):
    """The widest range of levels over which a power law holds within LARGEST_MISFIT."""
    levels, exits, exposure, *_ = found
    total, at_risk = exits.sum(0), exposure.sum(0)
    usable = [k for k in range(len(levels)) if total[k] >= FEWEST_EXITS and at_risk[k] > 0]
    if len(usable) < 3:
        raise Refusal(f"{len(usable)} levels with {FEWEST_EXITS} exits or more after the relaxation; a law needs 3")
    x = numpy.log(levels)
    best = None
    for i in range(len(usable)):
        for j in range(i + 2, len(usable)):
            window = list(range(usable[i], usable[j] + 1))
            if not set(window) <= set(usable):
                continue
            a, b = (float(one[0]) for one in _poisson_line(x[window], total[None, window], at_risk[None, window]))
            misfit = float(abs(numpy.log(total[window] / at_risk[window]) - a - b * x[window]).max())
            span = levels[usable[j]] / levels[usable[i]]
            if misfit <= LARGEST_MISFIT and (best is None or span > best[0]):
                best = (span, window, a, b, misfit)
    if best is None or best[0] < SMALLEST_SPAN * (1 - 1e-9):
        raise Refusal(f"no power law within {100 * math.expm1(LARGEST_MISFIT):.0f} % over a factor of {SMALLEST_SPAN:g} of sigma_rms/sigma_cr"
                      + (f"; the widest range spans {best[0]:.2g}" if best else ""))
    _, window, a, b, misfit = best
    draw = sample.generator("rate law").integers(0, len(exits), (RESAMPLES, len(exits)))
    intercepts, slopes = _poisson_line(x[window], exits[draw][:, :, window].sum(1), exposure[draw][:, :, window].sum(1))
    factors = numpy.exp(intercepts)
    quantiles = lambda values: tuple(map(float, numpy.quantile(values, (0.025, 0.975)))) if len(exits) > 1 else (math.nan, math.nan)
    return PowerLaw(b, math.exp(a), quantiles(slopes), quantiles(factors), float(levels[window[0]]), float(levels[window[-1]]), misfit, len(window))


def kusters_misfit(found):
    """Largest |ln(rate/Kusters)| over levels with enough exits, and their range: Kusters (1991) sets rate = sqrt(4/(15 pi))
    exp(-(sigma_cr/sigma_rms)^2) sqrt(epsilon/nu), with no free number. None: no such level."""
    levels, exits, exposure, *_ = found
    total, at_risk = exits.sum(0), exposure.sum(0)
    usable = (total >= FEWEST_EXITS) & (at_risk > 0)
    if not usable.any():
        return None
    off = numpy.log(total[usable] / at_risk[usable]) - math.log(KUSTERS) + levels[usable] ** -2.0
    return float(abs(off).max()), float(levels[usable].min()), float(levels[usable].max())
