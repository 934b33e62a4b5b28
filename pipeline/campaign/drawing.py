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


def _heading(plan, key):
    return f"{key} [{plan.unit(key) or '1'}]"


def _telling(plan, keys):
    """Those of the keys that tell points apart best: with several values, or else set at some points and not at others."""
    values = {key: {point.get(key) for point, _ in plan.points} for key in keys}
    return ([key for key in keys if len(values[key] - {None}) > 1] or [key for key in keys if len(values[key]) > 1])


def _choice(plan, row, keys):
    return ", ".join(f"{key.split('.')[-1]} = {row[_heading(plan, key)]:g} {plan.unit(key) or ''}".strip() if isinstance(row[_heading(plan, key)], (int, float))
                     else f"{key.split('.')[-1]} = {row[_heading(plan, key)]}" for key in keys if row[_heading(plan, key)] is not None) or "without"


def _draw_means(axes, places, rows, colour, line, name):
    known = [(x, one) for x, one in zip(places, rows) if one["mean"] is not None]
    axes.plot([x for x, _ in known], [one["mean"] for _, one in known], line, color=colour, linewidth=0.8, label=name)
    for x, one in known:
        if one["granules"] == 2:
            axes.plot([x] * 2, [one["lowest"], one["highest"]], "o-", color=colour, markersize=3, fillstyle="none", linewidth=0.6)
        elif one["mean_low"] is None:
            axes.plot(x, one["mean"], "o", color=colour, markersize=3, fillstyle="none")
        else:
            axes.errorbar(x, one["mean"], [[max(0, one["mean"] - one["mean_low"])], [max(0, one["mean_high"] - one["mean"])]], fmt="o",
                          color=colour, capsize=2, markersize=3)


def _column(plan, table, key, panels, quantities):
    """A panel for each quantity over this key, a line for each choice of the others; without a key the choices stand side by side."""
    others = _telling(plan, [one for one in plan.varied if one != key])
    choices = list(dict.fromkeys(_choice(plan, one, others) for one in table))
    for axes, quantity in zip(panels, quantities):
        of = [one for one in table if one["quantity"] == quantity.name]
        if key is None:
            _draw_means(axes, [choices.index(_choice(plan, one, others)) for one in of], of, LINES[2][0], "none", None)
            axes.set_xticks(range(len(choices)), [choice.replace(", ", "\n") for choice in choices], fontsize=6)
            axes.set_xlim(-0.5, len(choices) - 0.5)
        else:
            for number, choice in enumerate(choices):
                mine = sorted((one for one in of if _choice(plan, one, others) == choice and isinstance(one[_heading(plan, key)], (int, float))),
                              key=lambda one: one[_heading(plan, key)])
                colour, line = LINES[number % len(LINES)] if len(choices) > 1 else (LINES[2][0], "none")
                if mine:
                    _draw_means(axes, [one[_heading(plan, key)] for one in mine], mine, colour, line if len(choices) <= MOST_CURVES else "none", choice)
            places = sorted({one[_heading(plan, key)] for one in table if isinstance(one[_heading(plan, key)], (int, float))})
            if places[0] > 0 and places[-1] > 5 * places[0]:
                axes.set_xscale("log")
        axes.set(ylabel=f"{quantity.name.replace('_', ' ')}{f', {quantity.unit}' if quantity.unit != '1' else ''}", ylim=(0, None))
        axes.yaxis.label.set_fontsize(7)
    if key is not None:
        if 1 < len(choices) <= MOST_CURVES:
            panels[0].legend(fontsize=6)
        panels[-1].set_xlabel(f"{key.split('.', 1)[1]}{f', {plan.unit(key)}' if plan.unit(key) else ''}")


def responses(plan, rows, out):
    """Means with intervals over each key that has several numbers; without such a key point beside point."""
    keys = [key for key in plan.varied if len({point[key] for point, _ in plan.points if isinstance(point.get(key), (int, float))}) > 1]
    quantities = [quantity for quantity in present(rows) if not quantity.name.startswith("n_max")]
    if len(plan.points) < 2 or not quantities:
        return False
    figure, panels = pyplot.subplots(len(quantities), max(1, len(keys)), figsize=(3.4 * max(1, len(keys)), 2.1 * len(quantities)), squeeze=False, sharex="col",
                                     layout="constrained")
    table = records(plan, rows)
    for column, key in enumerate(keys or [None]):
        _column(plan, table, key, panels[:, column], quantities)
    figure.suptitle("filled: mean, bar: its 95 % interval by bootstrap; open: a mean of too few granules for one, or two granules", fontsize=7)
    save(figure, out)
    return True
