"""From the granules of a campaign to a breakage kernel: a folder with tables, kernel.json and sections for population-balance codes.

What the data do not bear is not stated; kernel.json then says why.
"""

import json

import dictionaries
import fragments
import kernel_schema
import rate
import sample
import size_law
import weibull
import whole
from outcome import BY_NAME, commits, within
from runs import sha256
from summary import by_point, of_sample, split
from table import write_csv

STRENGTH = "critical_stress_worst"
LIMITS = [
    "granules are smaller than the Kolmogorov length: the flow is linear about each",
    "no inertia of particles and liquid, no collisions, no walls: a dilute suspension",
    "rigid until the first contact gives way (but for fragments and flexible_over_rigid)",
    "in turbulence the strength of the worst orientation is taken where no tracks were followed",
]


class Granules:
    """The rows of one class with their sizes when loaded."""

    def __init__(self, point, rows):
        self.point, self.rows = point, rows
        self.loaded = [row for row in rows if "stress" in row.reports and row.values.get(STRENGTH)]
        self.stress = [row.values[STRENGTH] for row in self.loaded]
        self.particles = [within(row.reports["stress"], "results.particles")[0] for row in self.loaded]
        self.scale = [within(row.reports["stress"], "results.scaled_by")[0] or 1 for row in self.loaded]
        self.radius = [0.5e-9 * scale * row.values["d_c"] for row, scale in zip(self.loaded, self.scale)]
        self.gyration = [1e-9 * scale * row.values.get("radius_of_gyration", 0) for row, scale in zip(self.loaded, self.scale)]


def _mean(values):
    return float(sample.mean(values))


def _class(granules):
    values, above, without, failed = split(granules.rows, BY_NAME[STRENGTH])
    found = of_sample(values, above, f"kernel {granules.point}")
    known = {"point": granules.point, "granules": len(values), "censored": len(above), "without_value": without, "failed": failed,
             "particles": _mean(granules.particles), "radius_of_gyration": _mean(granules.gyration), "radius": _mean(granules.radius),
             "coordination": _mean([row.values["coordination"] for row in granules.loaded]), "mean": found["mean"],
             "mean_interval": [found["mean_low"], found["mean_high"]],
             "quantiles": {share: {"value": found[name], "interval": [found[f"{name}_low"], found[f"{name}_high"]]}
                           for share, name in (("0.1", "q10"), ("0.5", "q50"), ("0.9", "q90"))}}
    try:
        fit = weibull.fit(values, above)
        known["weibull"] = {"modulus": fit.modulus, "modulus_interval": list(fit.modulus_interval), "scale": fit.scale, "scale_interval": list(fit.scale_interval),
                            "covariance": fit.covariance, "range": [fit.lowest, fit.highest], "distance": fit.distance, "p": fit.p}
    except weibull.Refusal as why:
        known["weibull"] = {"refused": str(why)}
    return known


def _size_law(classes):
    try:
        law = size_law.fit([(one.radius, one.stress) for one in classes])
    except size_law.Refusal as why:
        return None, {"refused": str(why)}
    return law, {"exponent": law.exponent, "exponent_interval": list(law.exponent_interval), "factor": law.factor, "covariance": law.covariance,
                 "range": [law.smallest, law.largest], "misfit": law.misfit}


def _rate_law(rows):
    """(counts, law, kernel.json's part)."""
    reports = [row.reports["stress"] for row in rows if within(row.reports.get("stress", {}), "results.tracks")[1]]
    if not reports:
        return None, None, {"refused": "the campaign has no tracks: flow.history of [stress] names none"}
    try:
        counts = rate.counts(reports)
        law = rate.fit(counts)
    except rate.Refusal as why:
        return (counts if "counts" in locals() else None), None, {"refused": str(why)}
    return counts, law, {"exponent": law.exponent, "exponent_interval": list(law.exponent_interval), "factor": law.factor, "factor_interval": list(law.factor_interval),
                         "range": [law.lowest, law.highest], "misfit": law.misfit}


def _fragments(rows):
    sizes = [within(row.reports.get("breakup", {}), "results.fragments")[0] for row in rows]
    sizes = [one for one in sizes if one]
    if not sizes:
        return None, {"refused": "the campaign has no [breakup]"}
    try:
        breakage = fragments.gather(sizes)
    except fragments.Refusal as why:
        return None, {"refused": str(why)}
    known = {"parents": breakage.parents, "count": breakage.count, "erosion_share": breakage.erosion_share, "moments": breakage.moments}
    try:
        known["fits"] = fragments.fits(breakage)
    except fragments.Refusal as why:
        known["refused"] = str(why)
    return breakage, known


def _ratio(rows):
    pairs = [row.values["critical_stress_flexible"] / row.values["critical_stress_elongation"] for row in rows
             if row.values.get("critical_stress_flexible") and row.values.get("critical_stress_elongation")]
    interval = sample.bootstrap(pairs, sample.mean, "flexible over rigid") if pairs else None
    if interval is None:
        return {"granules": len(pairs), "refused": f"{len(pairs)} granules with both, of {sample.FEWEST} that an interval needs"}
    return {"granules": len(pairs), "mean": _mean(pairs), "interval": list(interval)}


def _openfoam(law, refused, classes, counts, radius, liquid, breakage):
    if law is None:
        raise dictionaries.Refusal(f"no size law: {refused}")
    found = dictionaries.kusters(law, [(one.radius, one.stress, one.particles) for one in classes if len(one.stress) >= size_law.FEWEST_GRANULES], radius, liquid)
    words = [f"Kusters' rate for sigma_cr of {LIMITS[-1].split(' of ')[1].split(' is ')[0]}; sigma_cr goes as R^-{law.exponent:.3g} ({law.exponent_interval[0]:.3g} to {law.exponent_interval[1]:.3g})",
             f"range: R_c from {1e6 * law.smallest:.3g} to {1e6 * law.largest:.3g} um; misfit of sigma_cr: {100 * found.misfit:.2g} % at most",
             f"liquid: {liquid.viscosity:g} Pa s, {liquid.density:g} kg/m3"]
    off = rate.kusters_misfit(counts) if counts else None
    words.append("its exponential was not compared with histories: there are no tracks" if off is None else
                 f"beside first exits along the tracks of the campaign the rate is off by a factor of up to {2.718281828 ** off[0]:.3g}, for sigma_rms/sigma_cr from {off[1]:.2g} to {off[2]:.2g}")
    words.append(_daughter_words(breakage, "uniform"))
    return dictionaries.openfoam(found, words)


def _openqbmm(law, refused, power, rate_refused, liquid, breakage):
    if law is None:
        raise dictionaries.Refusal(f"no size law: {refused}")
    if power is None:
        raise dictionaries.Refusal(f"no rate law: {rate_refused}")
    name = fragments.nearest_named(breakage)[0] if breakage else "uniform"
    found = dictionaries.power_kernel(law, power, liquid)
    words = [f"rate = {power.factor:.4g} (sigma_rms/sigma_cr)^{power.exponent:.4g} sqrt(epsilon/nu), sigma_cr = {law.factor:.4g} R^-{law.exponent:.4g}",
             f"range: sigma_rms/sigma_cr from {power.lowest:.3g} to {power.highest:.3g}, R from {1e6 * law.smallest:.3g} to {1e6 * law.largest:.3g} um",
             f"misfit: {100 * (2.718281828 ** power.misfit - 1):.2g} % of the rate, {100 * law.misfit:.2g} % of sigma_cr, at most", f"liquid: {liquid.density:g} kg/m3; L = 2 R",
             _daughter_words(breakage, name)]
    return dictionaries.openqbmm(found, name, words)


def _daughter_words(breakage, name):
    if breakage is None:
        return f"daughters: {name} is an assumption; the campaign broke no granule into fragments"
    off = max(abs(fragments.NAMED[name](k) / breakage.moments[k] - 1) for k in fragments.MOMENTS)
    return f"daughters: moments b_0 to b_8 of {name} differ by up to {100 * off:.2g} % from those of {breakage.parents} breakups"


def _tables(folder, classes, counts, breakage, plan, rows):
    columns = ["critical_stress_shear", "critical_stress_elongation", "critical_stress_worst", "critical_stress_flexible"]
    write_csv(folder / "critical_stress.csv",
              ["id", "seed", "sha256", *(f"{key} [{plan.unit(key) or '1'}]" for key in plan.varied), "N", "radius_of_gyration [m]", *(f"{one} [Pa]" for one in columns),
               "error [relative]", "flexible_over_rigid"],
              [[row.id, row.realisation.runs[0].scene["run"]["seed"], row.hashes["dry"], *(row.point.get(key, "") for key in plan.varied), n, f"{g:.6g}",
                *("" if row.values.get(one) is None else f"{row.values[one]:.6g}" for one in columns),
                "" if STRENGTH not in row.errors else f"{row.errors[STRENGTH]:.3g}",
                f"{row.values['critical_stress_flexible'] / row.values['critical_stress_elongation']:.4g}"
                if row.values.get("critical_stress_flexible") and row.values.get("critical_stress_elongation") else ""]
               for one_class in classes for row, n, g in zip(one_class.loaded, one_class.particles, one_class.gyration)],
              ["rigid but for flexible; sha256: of the dried granule"])
    write_csv(folder / "survival.csv", ["class", "stress [Pa]", "whole", "low", "high"],
              [[number, f"{s:.6g}", f"{1 - k / len(one.stress):.6g}", f"{1 - high:.6g}", f"{1 - low:.6g}"] for number, one in enumerate(classes, 1)
               for k, (s, (low, high)) in enumerate(zip(sorted(one.stress), sample.share_band(len(one.stress))), 1)],
              [f"share of granules that {STRENGTH} of this much leaves whole; low, high: 95 %; class: number in kernel.json"])
    if counts:
        write_csv(folder / "rate.csv", ["sigma_rms_over_sigma_cr", "rate_over_sqrt_2EE", "low", "high", "exits", "exposure_sqrt_2EE", "born_above", "early", "tracks"],
                  [[f"{one.ratio:.6g}", *(f"{value:.6g}" for value in (one.rate, one.low, one.high)), one.exits, f"{one.exposure:.6g}", one.born, one.early, one.tracks]
                   for one in rate.table(counts)],
                  [f"first exits after {rate.RELAXATION:g} strain times; early: within these; born_above: at the very start; low, high: 95 %, over granules"])
    if breakage:
        write_csv(folder / "fragments.csv", ["mass_over_parent", "share_of_fragments_below"],
                  [[f"{x:.6g}", f"{k / len(breakage.shares):.6g}"] for k, x in enumerate(breakage.shares, 1)],
                  [f"{breakage.parents} breakups, {breakage.count:.4g} fragments each; b_k = " + ", ".join(f"{one:.5g}" for one in breakage.moments)])


def write(folder, plan, rows, runs):
    """Returns kernel.json's contents."""
    folder.mkdir(parents=True, exist_ok=True)
    classes = [one for one in (Granules(point, of) for point, of in by_point(plan, rows)) if one.loaded]
    if not classes:
        raise size_law.Refusal(f"no granule has a {STRENGTH}: the campaign needs [stress] with flow.elongation")
    inputs = classes[0].loaded[0].reports["stress"]["inputs"]
    liquid = dictionaries.Liquid(inputs["fluid"]["viscosity"], inputs["fluid"]["density"])
    radius = 1e-9 * classes[0].loaded[0].reports["stress"]["results"]["particle_radius_nm"]
    law, size_part = _size_law(classes)
    counts, power, rate_part = _rate_law(rows)
    breakage, fragment_part = _fragments(rows)
    _tables(folder, classes, counts, breakage, plan, rows)
    written = {}
    for name, file, make in (("openfoam", "breakupModels", lambda: _openfoam(law, size_part.get("refused"), classes, counts, radius, liquid, breakage)),
                             ("openqbmm", "breakupKernel", lambda: _openqbmm(law, size_part.get("refused"), power, rate_part.get("refused"), liquid, breakage))):
        place = folder / f"{name}.{file}"
        try:
            text = make()
        except dictionaries.Refusal as why:
            place.unlink(missing_ok=True)
            written[name] = f"refused: {why}"
        else:
            whole.write_text(place, text)
            written[name] = place.name
    errors = [row.errors[STRENGTH] for row in rows if STRENGTH in row.errors]
    kernel = {"format": kernel_schema.FORMAT, "campaign": plan.path.name, "commit": ", ".join(commits(rows, runs)), "granules_sha256": sha256(folder / "critical_stress.csv"),
              "material": {"particle_radius": radius, **{key: inputs["material"][key] for key in ("surface_energy", "youngs_modulus", "poisson_ratio")}},
              "liquid": {"viscosity": liquid.viscosity, "density": liquid.density},
              "strength": f"{STRENGTH}: {BY_NAME[STRENGTH].meaning}", "numerical_error": _mean(errors) if errors else None,
              "classes": [_class(one) for one in classes], "size_law": size_part, "rate_law": rate_part, "fragments": fragment_part, "flexible_over_rigid": _ratio(rows),
              "dictionaries": written, "limits": LIMITS}
    kernel_schema.check(kernel, folder / "kernel.json")
    whole.write_text(folder / "kernel.json", json.dumps(kernel, indent=1) + "\n")
    return kernel
