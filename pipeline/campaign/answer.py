"""What a campaign says in a formulator's words: at which shear rate, in which liquid and device, how many granules break, and into what;
and the other way round, how to make them so that half break at a given stress."""

import dataclasses
import math
import re

import fragments
import sample
from outcome import BY_NAME, within
from scene_text import Fault
from summary import by_point, of_sample, short, split
from table import markdown

QUANTILES = (("q10", "10 %"), ("q50", "half"), ("q90", "90 %"))
# Quantity -> where the report names the device, and the flow in words.
FLOWS = {"critical_stress_elongation": ("elongation.device_settled", "planar elongation"), "critical_stress_shear": ("shear.device", "shear"),
         "critical_stress_worst": ("elongation.device_worst", "turbulence"), "critical_stress_uniaxial": ("uniaxial.device_settled", "uniaxial extension"),
         "critical_stress_biaxial": ("biaxial.device_settled", "biaxial extension"), "critical_stress_flexible": ("", "flexible, in the flow of its scene")}


@dataclasses.dataclass
class Liquid:
    name: str
    viscosity: float  # Pa s
    density: float    # kg/m^3

    def rate(self, stress):
        return stress / self.viscosity

    def dissipation(self, stress):
        """W/kg at which sqrt(epsilon/nu) is the rate of this stress (Tennekes & Lumley 1972, 3.2)."""
        return self.viscosity / self.density * self.rate(stress) ** 2

    def eddies(self, stress):
        """Kolmogorov length there, m."""
        return math.sqrt(self.viscosity / self.density / self.rate(stress))


# Above some 100 1/s blood is nearly Newtonian (Merrill 1969, Physiol. Rev. 49, 863).
BLOOD = Liquid("blood", 3.5e-3, 1060)


def liquid(text):
    """"syrup 0.1 Pa s 1200 kg/m3"."""
    match = re.fullmatch(r"\s*(.+?)\s+([-+0-9.eE]+)\s*Pa s\s+([-+0-9.eE]+)\s*kg/m3\s*", text)
    try:
        made = Liquid(match[1], float(match[2]), float(match[3]))
        if not (made.viscosity > 0 and made.density > 0):
            raise ValueError
    except (TypeError, ValueError):
        raise Fault(f"--liquid '{text}': must be a name, a viscosity and a density, as in \"syrup 0.1 Pa s 1200 kg/m3\"") from None
    return made


def _range(low, high, form):
    return f" ({form(low) if low is not None else '?'} to {form(high) if high is not None else '?'})"


def _cell(found, name, form=short):
    return "-" if found[name] is None else form(found[name]) + _range(found[f"{name}_low"], found[f"{name}_high"], form)


def _two(value):
    return f"{value:.2g}"


def _liquids(rows, more):
    fluid = within(rows[0].reports.get("stress", {}), "inputs.fluid")[0]
    return [*([Liquid("the liquid of the scene", fluid["viscosity"], fluid["density"])] if fluid else []), BLOOD, *more]


def _point(plan, point, rows, more):
    title = ", ".join(f"{key.split('.', 1)[1]} = {value}{f' {plan.unit(key)}' if plan.unit(key) else ''}" for key, value in point.items()) or "all granules"
    yield f"## {title}"
    yield ""
    for name, (place, words) in FLOWS.items():
        values, above, without, _ = split(rows, BY_NAME[name])
        if not values:
            continue
        found = of_sample(values, above, f"answer {point} {name}")
        loaded = [row for row in rows if row.values.get(name) is not None]
        device = within(loaded[0].reports[BY_NAME[name].stage]["results"], place)[0] if place else None
        diameter = max(1e-9 * row.values["d_c"] * (within(row.reports.get("stress", {}), "results.scaled_by")[0] or 1) for row in loaded)
        yield f"**{words.capitalize()}**{f', as in: {device}' if device else ''}. Of {len(values) + len(above)} granules{f', {without} more without a value,' if without else ''}" \
              f" the stress that breaks them, in Pa, is: 10 % below {_cell(found, 'q10')}, half below {_cell(found, 'q50')}, 90 % below {_cell(found, 'q90')}."
        yield ""
        lines = []
        for one in _liquids(loaded, more):
            line = [f"{one.name} ({one.viscosity:g} Pa s)"]
            for quantile, _ in QUANTILES:
                line.append(_cell(found, quantile, lambda stress: _two(one.rate(stress))))
            for quantile, _ in QUANTILES if words == "turbulence" else ():
                text = _cell(found, quantile, lambda stress: _two(one.dissipation(stress)))
                line.append(text + (" *" if found[quantile] is not None and one.eddies(found[quantile]) < diameter else ""))
            lines.append(line)
        heading = ["liquid", *(f"{words_of} break below, 1/s" for _, words_of in QUANTILES)]
        if words == "turbulence":
            heading += [f"{words_of} break below, W/kg" for _, words_of in QUANTILES]
        yield markdown(heading, lines)
        if any("*" in cell for line in lines for cell in line):
            yield f"\n\\*: the smallest eddies there are smaller than the largest granule ({1e6 * diameter:.2g} um): the flow is not linear about it, and this does not hold."
        yield ""
    yield from _pieces(rows)


def _pieces(rows):
    sizes = [one for row in rows if (one := within(row.reports.get("breakup", {}), "results.fragments")[0])]
    try:
        found = fragments.gather(sizes)
    except fragments.Refusal:
        return
    largest = [max(one) / sum(one) for one in sizes if len(one) > 1]
    interval = sample.bootstrap(largest, sample.mean, "largest piece")
    yield (f"Into what: {found.count:.2g} pieces on average of {found.parents} breakups; the largest has {100 * sum(largest) / len(largest):.2g} % of the mass"
           f"{'' if interval is None else f' (mean; {100 * interval[0]:.2g} to {100 * interval[1]:.2g} %)'}, pieces below a twentieth of the granule together {100 * found.erosion_share:.2g} %.")
    yield ""


def text(plan, rows, more=()):
    lines = [f"# At which shear rate granules of {plan.name} break", "", "In brackets: 95 % intervals of the sample; ?: too few granules to bound it there. The numerical errors stand in summary.md. All stresses and rates are in "
             "proportion to the surface energy of the particles.", ""]
    for point, of in by_point(plan, rows):
        lines += _point(plan, point, of, more)
    return "\n".join(lines).rstrip() + "\n"


def how_to_make(plan, rows, wanted):
    """Between which values of the one varied key half of the granules break at this stress (Pa): lines of text."""
    if len(plan.varied) != 1 or not all(isinstance(point.get(plan.varied[0]), (int, float)) for point, _ in plan.points):
        raise Fault(f"{plan.path}: --break-at needs a campaign that varies one key with numbers")
    (key,) = plan.varied
    quantity = next((BY_NAME[name] for name in FLOWS if any(row.values.get(name) is not None for row in rows)), None)
    if quantity is None:
        raise Fault(f"{plan.path}: --break-at: no granule has a critical stress")
    known = []
    for point, of in by_point(plan, rows):
        found = of_sample(*split(of, quantity)[:2], f"make {point}")
        if found["q50"] is not None:
            known.append((point[key], found))
    known.sort(key=lambda one: one[0])
    unit = f" {plan.unit(key)}" if plan.unit(key) else ""

    def crossings(name):
        for (x, a), (y, b) in zip(known, known[1:]):
            if a[name] is None or b[name] is None or (a[name] - wanted) * (b[name] - wanted) > 0 or a[name] == b[name]:
                continue
            part = math.log(wanted / a[name]) / math.log(b[name] / a[name])
            yield math.exp(math.log(x) + part * math.log(y / x)) if x > 0 else x + part * (y - x)
    found = list(crossings("q50"))
    span = f"medians of {quantity.name} lie from {short(min(one['q50'] for _, one in known))} to {short(max(one['q50'] for _, one in known))} Pa" if known else "no medians are known"
    if not found:
        return f"No {key.split('.', 1)[1]} of the campaign makes granules of which half break at {wanted:g} Pa: {span}.\n"
    bounds = sorted([*crossings("q50_low"), *crossings("q50_high")])
    sure = f"; from the 95 % intervals of the medians {_two(bounds[0])} to {_two(bounds[-1])}{unit}" if len(bounds) > 1 else "; the intervals of the medians do not bound it: more granules"
    several = " It does so more than once: the stress does not follow this key alone." if len(found) > 1 else ""
    return f"Half of the granules break at {wanted:g} Pa ({quantity.name}) at {key.split('.', 1)[1]} = {' and '.join(map(_two, found))}{unit}{sure}.{several}\n"
