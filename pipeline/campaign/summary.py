"""What a campaign says at each of its points: mean, spread and quantiles with 95 % intervals, and what did not work."""

import math

import sample
import weibull
import whole
from outcome import present
from scene_text import canonical
from table import markdown, write_records

QUANTILES = (0.1, 0.5, 0.9)


def by_point(plan, rows):
    """[(point, its rows)] in the order of the file."""
    found = {canonical(point): (point, []) for point, _ in plan.points}
    for row in rows:
        found[canonical(row.point)][1].append(row)
    return list(found.values())


def split(rows, quantity):
    """(values, largest stresses that granules bore, numbers without a value and of failures)."""
    values = [row.values[quantity.name] for row in rows if row.values.get(quantity.name) is not None]
    above = [row.above[quantity.name] for row in rows if quantity.name in row.above]
    without = sum(quantity.name in row.values and row.values[quantity.name] is None and quantity.name not in row.above for row in rows)
    failed = sum(row.failure is not None and quantity.name not in row.values for row in rows)
    return values, above, without, failed


def of_sample(values, above, name):
    """Statistics of one sample; a mean only where every value is known."""
    found = {"mean": None, "mean_low": None, "mean_high": None, "spread": None, "spread_low": None, "spread_high": None,
             "lowest": min(values, default=None), "highest": max(values, default=None)}
    if values and not above:
        found["mean"] = float(sample.mean(values))
        if len(values) > 1:
            found["spread"] = float(sample.spread(values))
        for of, statistic in (("mean", sample.mean), ("spread", sample.spread)):
            if interval := sample.bootstrap(values, statistic, f"{name} {of}"):
                found[f"{of}_low"], found[f"{of}_high"] = interval
    # Among values that are only known to be larger than some limit a quantile is known below the lowest of these limits.
    known = [*values, *[math.inf] * len(above)]
    limit = min(above, default=math.inf)
    for p in QUANTILES:
        q = f"q{100 * p:.0f}"
        value = sample.quantile(known, p) if known else math.inf
        low, high = sample.quantile_interval(known, p) if known else (None, None)
        found[q] = value if value < limit else None
        found[f"{q}_low"], found[f"{q}_high"] = (None if one is None or one >= limit else one for one in (low, high))
    return found


def record(plan, point, rows, quantity):
    values, above, without, failed = split(rows, quantity)
    errors = [row.errors[quantity.name] for row in rows if quantity.name in row.errors and row.values.get(quantity.name) is not None]
    found = {**{f"{key} [{plan.unit(key) or '1'}]": point.get(key) for key in plan.varied}, "quantity": quantity.name, "unit": quantity.unit,
             "granules": len(values), "censored": len(above), "without_value": without, "failed": failed,
             **of_sample(values, above, f"{canonical(point)} {quantity.name}")}
    # The errors of runs may all be of one sign: their mean, not that over the root of their number.
    found["numerical_error_relative"] = float(sample.mean(errors)) if errors else None
    found["sampling_error_relative"] = None
    if found["mean_low"] is not None and found["mean"]:
        found["sampling_error_relative"] = 0.5 * (found["mean_high"] - found["mean_low"]) / abs(found["mean"])
    return found


def records(plan, rows):
    return [record(plan, point, of, quantity) for point, of in by_point(plan, rows) for quantity in present(rows)
            if any(quantity.name in row.values for row in of)]


def short(value):
    return "-" if value is None else f"{value:.4g}" if abs(value) < 1e4 else f"{value:.0f}"


def with_interval(found, name):
    if found["granules"] == 2 and not found["censored"]:  # a mean of two is less than the two
        return f"{short(found['lowest'])} to {short(found['highest'])}" if name == "mean" else "-"
    if found[name] is None:
        return "-"
    low, high = found[f"{name}_low"], found[f"{name}_high"]
    if low is None and high is None:
        return short(found[name])
    return f"{short(found[name])} ({short(low) if low is not None else '?'} to {short(high) if high is not None else '?'})"


def percent(value):
    return "-" if value is None else f"{100 * value:.2g} %"


def weibull_lines(plan, rows, quantities):
    """A fit of every critical stress at every point, or why there is none."""
    for quantity in quantities:
        if not quantity.name.startswith("critical_stress"):
            continue
        for point, of in by_point(plan, rows):
            values, above, _, _ = split(of, quantity)
            if not values:
                continue
            where = "".join(f", {key} = {value}" for key, value in point.items())
            try:
                fit = weibull.fit(values, above)
            except weibull.Refusal as why:
                yield f"- {quantity.name}{where}: no Weibull fit: {why}."
            else:
                yield (f"- {quantity.name}{where}: Weibull modulus {fit.modulus:.3g} ({fit.modulus_interval[0]:.3g} to {fit.modulus_interval[1]:.3g}), "
                       f"scale {fit.scale:.4g} ({fit.scale_interval[0]:.4g} to {fit.scale_interval[1]:.4g}) {quantity.unit}, for stresses of "
                       f"{fit.lowest:.4g} to {fit.highest:.4g} {quantity.unit}; largest distance {fit.distance:.2g}, which {100 * fit.p:.0f} % of Weibull samples exceed.")


def text(plan, rows, made):
    """Markdown. made: by which commits, in words."""
    table = records(plan, rows)
    failures = [row for row in rows if row.failure]
    lines = [f"# {plan.name}", "", f"{len(rows)} granules at {len(plan.points)} point{'s' * (len(plan.points) != 1)} of {plan.path.name}; {made}", ""]
    heading = [*(f"{key.split('.', 1)[1]}{f', {unit}' if (unit := plan.unit(key)) else ''}" for key in plan.varied), "quantity", "granules", "mean", "spread",
               "10 %", "50 %", "90 %", "sampling error", "numerical error", "censored", "without", "failed"]
    lines.append(markdown(heading, [
        [*(str(one[f"{key} [{plan.unit(key) or '1'}]"] if one[f"{key} [{plan.unit(key) or '1'}]"] is not None else "-") for key in plan.varied),
         f"{one['quantity']}, {one['unit']}" if one["unit"] != "1" else one["quantity"], str(one["granules"]), with_interval(one, "mean"), with_interval(one, "spread"),
         *(with_interval(one, f"q{100 * p:.0f}") for p in QUANTILES), percent(one["sampling_error_relative"]), percent(one["numerical_error_relative"]),
         str(one["censored"]), str(one["without_value"]), str(one["failed"])] for one in table]))
    lines += ["", "In brackets: 95 % intervals, by bootstrap of mean and spread (standard deviation), from ordered values of quantiles; ?: too few granules "
              "to bound it on that side. Two granules stand as lowest to highest. Sampling error: half of the interval of the mean. Numerical error: mean of what the runs state. Censored: nothing broke up to "
              "the largest stress tried. Without: no value, such as a granule that settles nowhere. Failed: the run ended with an error.", ""]
    lines += weibull_lines(plan, rows, present(rows))
    if failures:
        lines += ["", "Failed:", "", *(f"- {row.id}, {row.failure.stage}, exit code {row.failure.code}: {row.failure.words}" for row in failures)]
    return "\n".join(lines) + "\n"


def write(folder, plan, rows, made):
    table = records(plan, rows)
    if table:
        write_records(folder / "summary.csv", table)
    whole.write_text(folder / "summary.md", text(plan, rows, made))
    return table
