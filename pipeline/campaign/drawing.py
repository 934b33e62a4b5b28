"""Figures of a campaign: strengths on Weibull axes, and every quantity over every varied key."""

import math

import numpy
from matplotlib.ticker import NullFormatter

import sample
import weibull
from figure import LINES, pyplot, save
from outcome import present
from summary import by_point, records, split

MOST_CURVES = len(LINES)
SHARES = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 0.8, 0.9, 0.99)


def weibull_scale(share):
    return math.log(-math.log1p(-share))


def label(plan, point):
    return ", ".join(f"{key.split('.')[-1]} = {value}{f' {plan.unit(key)}' if plan.unit(key) else ''}" for key, value in point.items()) or plan.name


def strengths(plan, rows, quantity, out):
    """Share of broken granules against stress; a Weibull distribution is a straight line. Band: of every share by itself."""
    figure, axes = pyplot.subplots(figsize=(4.8, 3.6), layout="constrained")
    drawn = 0
    for point, of in by_point(plan, rows):
        values, above, _, _ = split(of, quantity)
        values = sorted(value for value in values if value < min(above, default=math.inf))
        if len(values) < 3 or drawn == MOST_CURVES:
            continue
        colour, line = LINES[drawn]
        drawn += 1
        n = len(values) + len(above)
        middle = [weibull_scale((k - 0.3) / (n + 0.4)) for k in range(1, len(values) + 1)]  # median rank (Benard)
        band = sample.share_band(n)[:len(values)]
        axes.plot(values, middle, "o", color=colour, markersize=2.5, label=f"{label(plan, point)}, {n} granules")
        axes.fill_between(values, [weibull_scale(low) for low, _ in band], [weibull_scale(high) for _, high in band], color=colour, alpha=0.15, linewidth=0)
        try:
            fit = weibull.fit(values, above)
        except weibull.Refusal:
            continue
        ends = numpy.array([values[0], values[-1]])
        axes.plot(ends, fit.modulus * numpy.log(ends / fit.scale), line, color=colour, linewidth=1,
                  label=f"modulus {fit.modulus:.2g} ({fit.modulus_interval[0]:.2g} to {fit.modulus_interval[1]:.2g})")
    if not drawn:
        pyplot.close(figure)
        return False
    axes.set_yticks([weibull_scale(share) for share in SHARES], [f"{100 * share:g} %" for share in SHARES])
    axes.set(xscale="log", xlabel=f"{quantity.name.replace('_', ' ')}, {quantity.unit}", ylabel="granules that break below")
    axes.xaxis.set_minor_formatter(NullFormatter())
    low, high = axes.get_xlim()
    ticks = [tick for power in range(-3, 9) for tick in (10.0**power * step for step in ((1, 2, 3, 4, 5, 7) if high < 4 * low else (1, 2, 5))) if low <= tick <= high]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.legend(frameon=False, fontsize=7, loc="lower right")
    save(figure, out)
    return True


def responses(plan, rows, out):
    """Means with intervals over each key that has numbers; points that differ in other keys share a panel."""
    keys = [key for key in plan.varied if len({point[key] for point, _ in plan.points if isinstance(point.get(key), (int, float))}) > 1]
    quantities = [quantity for quantity in present(rows) if not quantity.name.startswith("n_max")]
    if not keys or not quantities:
        return False
    figure, panels = pyplot.subplots(len(quantities), len(keys), figsize=(3.4 * len(keys), 2.1 * len(quantities)), squeeze=False, sharex="col",
                                     layout="constrained")
    table = records(plan, rows)
    for column, key in enumerate(keys):
        heading = f"{key} [{plan.unit(key) or '1'}]"
        places = sorted({one[heading] for one in table if isinstance(one[heading], (int, float))})
        for line, quantity in enumerate(quantities):
            axes = panels[line][column]
            for one in table:
                if one["quantity"] != quantity.name or one["mean"] is None or not isinstance(one[heading], (int, float)):
                    continue
                if one["granules"] == 2:
                    axes.plot([one[heading]] * 2, [one["lowest"], one["highest"]], "o-", color=LINES[2][0], markersize=3, fillstyle="none", linewidth=0.6)
                elif one["mean_low"] is None:
                    axes.plot(one[heading], one["mean"], "o", color=LINES[2][0], markersize=3, fillstyle="none")
                else:
                    axes.errorbar(one[heading], one["mean"], [[max(0, one["mean"] - one["mean_low"])], [max(0, one["mean_high"] - one["mean"])]], fmt="o",
                                  color=LINES[2][0], capsize=2, markersize=3)
            axes.set(ylabel=f"{quantity.name.replace('_', ' ')}{f', {quantity.unit}' if quantity.unit != '1' else ''}", ylim=(0, None))
            axes.yaxis.label.set_fontsize(7)
            if places[0] > 0 and places[-1] > 5 * places[0]:
                axes.set_xscale("log")
        panels[-1][column].set_xlabel(f"{key.split('.', 1)[1]}{f', {plan.unit(key)}' if plan.unit(key) else ''}")
    figure.suptitle("filled: mean, bar: its 95 % interval by bootstrap; open: a mean of too few granules for one, or two granules", fontsize=7)
    save(figure, out)
    return True
