"""Time against error of the dryer: step control, stiffness and integrator on the rows of Table 2, LAMMPS and Yade beside it.

    bench.py [--rows hollow intermediate compact lammps yade] [--seeds 2] [--jobs 2] [--out pipeline/results/bench-dryer]

Errors against the reference of each row: hollow against the inertial integrator at full stiffness, same starts (mean of the
absolute differences); with noise against full stiffness, differences of means with their 95 % interval. Gamma: concentration at
theta = 0.4 in ten shells of the radius that centres reach, rms difference to the continuum model in standard errors (1 where
only chance is left). Times are CPU seconds of one core. Writes bench.csv and bench.svg.
"""

import argparse
import os
import pathlib
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "pipeline/verify"), str(ROOT / "pipeline/report")]

import concentration  # noqa: E402
import interval  # noqa: E402
from drying import lammps, runs, yade  # noqa: E402
from figure import LINES, pyplot, save  # noqa: E402
from table import print_markdown, write_records  # noqa: E402

SOFT = {"material.youngs_modulus": "3.4e7"}  # a hundredth, at the same surface energy
STEP = "integrator.largest_displacement"
IMPLICIT = {"integrator.method": "implicit"}
# scene, seeds a case over --seeds, Peclet number, reference, cases
ROWS = {
    "hollow": ("pipeline/scenes/hollow.toml", 1, None, ("inertial, full stiffness", {"integrator.method": "inertial"}),
               {"displacement 0.1 a": {STEP: "0.1"}, "displacement 0.05 a": {STEP: "0.05"}, "default: 0.02 a": {},
                "displacement 0.01 a": {STEP: "0.01"}, "displacement 0.005 a": {STEP: "0.005"}, "E / 100": SOFT,
                "implicit, 0.02 a": IMPLICIT, "implicit, 0.005 a": IMPLICIT | {STEP: "0.005"}}),
    "intermediate": ("pipeline/scenes/intermediate.toml", 2, 10, ("softening 1", {"integrator.softening": "1"}),
                     {"softening 3": {"integrator.softening": "3"}, "softening 2": {"integrator.softening": "2"}, "default": {},
                      "half the step": {"integrator.contact_step": "0.075"}}),
    "compact": ("pipeline/scenes/compact.toml", 1, 1, ("softening 1", {"integrator.softening": "1"}),
                {"softening 3": {"integrator.softening": "3"}, "softening 2": {"integrator.softening": "2"}, "default": {}}),
}
PEERS_LIFETIME = 2.1e-5  # a tenth of Table 2's, for all
# Other codes, from the package if it is there: what dryer is told for the same physics.
PEERS = {"lammps": ("LAMMPS granular/jkr", lammps, {}), "yade": ("Yade, linear contacts", yade, yade.SETTINGS)}


def gamma_deviation(dryer, names):
    rows = [rows for theta, kind, rows in concentration.comparisons(dryer, *concentration.read(names)) if theta == 0.4 and kind == "accessible"]
    return concentration.deviation(rows[0], "shells")[1]


def errors(mine, reference, paired):
    """Percent in d_c and contacts: mean of absolute differences (same starts) or difference of means with half its interval."""
    for key in ("d_c_nm", "contacts"):
        a, b = [run[key] for run in mine], [run[key] for run in reference]
        if paired:
            yield statistics.fmean(100 * abs(x / y - 1) for x, y in zip(a, b)), 0.0
        else:
            difference, half = interval.difference(a, b)
            yield 100 * difference / statistics.fmean(b), 100 * half / statistics.fmean(b)


def bench_row(name, seeds, jobs):
    scene, times, peclet, (label, reference), cases = ROWS[name]
    seeds = list(range(1, seeds * times + 1))
    found = runs.run_all({f"bench_{name}_{k}": setting for k, setting in enumerate([reference, *cases.values()])}, seeds, jobs, scene)
    base = found[f"bench_{name}_0"]
    for k, case in enumerate([label, *cases]):
        mine = found[f"bench_{name}_{k}"]
        (d_c, d_c_half), (contacts, contacts_half) = errors(mine, base, peclet is None) if k else ((0, 0), (0, 0))
        files = [str(ROOT / runs.RESULTS / f"bench_{name}_{k}-{seed}.h5") for seed in seeds]
        overlap = max(run["overlap"] for run in mine)
        yield {"row": name, "case": case, "granules": len(seeds), "cpu_s": statistics.fmean(run["cpu_s"] for run in mine),
               "d_c_percent": d_c, "d_c_half": d_c_half, "contacts_percent": contacts, "contacts_half": contacts_half,
               "overlap_over_a": overlap, "gamma": gamma_deviation(str(ROOT / runs.DRYER), files) if peclet else None}


def beside(peer, seeds, jobs):
    """Rows (program, seed, d_c nm, pairs within 0.02 a, CPU s), all from the same starts."""
    label, code, settings = PEERS[peer]
    settings = settings | {"droplet.lifetime": str(PEERS_LIFETIME)}
    found = runs.run_all({f"bench_{peer}_inertial": settings | {"integrator.method": "inertial"}, f"bench_{peer}_overdamped": settings},
                         seeds, jobs)
    for k, seed in enumerate(seeds):
        for program in ("overdamped", "inertial"):
            mine, file = found[f"bench_{peer}_{program}"][k], ROOT / runs.RESULTS / f"bench_{peer}_{program}-{seed}.h5"
            x, radius = runs.last_frame(file)
            # The same measure for all: that of dryer is done again here as it is for the others.
            assert abs(runs.diameter(x, radius) / mine["d_c_nm"] - 1) < 1e-6, (file, mine["d_c_nm"])
            yield f"dryer, {program}", seed, mine["d_c_nm"], mine["within_0_02_a"], mine["cpu_s"]
        x, cpu = code.dry(file)
        yield label, seed, runs.diameter(1e9 * x, radius), runs.pairs_within(1e9 * x, radius, 0.02), cpu


def show(table):
    form = lambda value, half: f"{value:+.1f} ± {half:.1f}" if half else f"{value:.2f}"
    print_markdown(["row", "control", "granules", "CPU s", "d_c error %", "contacts error %", "overlap a", "Gamma"],
                   [[r["row"], r["case"], str(r["granules"]), f"{r['cpu_s']:.3g}", form(r["d_c_percent"], r["d_c_half"]),
                     form(r["contacts_percent"], r["contacts_half"]), f"{r['overlap_over_a']:.2g}",
                     "" if r["gamma"] is None else f"{r['gamma']:.1f}"] for r in table])


def draw(table, out):
    figure, panels = pyplot.subplots(1, 2, figsize=(8, 3.2), layout="constrained")
    for axes, key, label in zip(panels, ("d_c", "contacts"), ("d_c", "contacts")):
        for (colour, _), marker, name in zip(LINES, "os^", dict.fromkeys(r["row"] for r in table)):
            mine = [r for r in table if r["row"] == name and (r[f"{key}_percent"] or r[f"{key}_half"])]
            axes.errorbar([r["cpu_s"] for r in mine], [abs(r[f"{key}_percent"]) for r in mine], [r[f"{key}_half"] for r in mine],
                          fmt=marker, color=colour, capsize=2, fillstyle="none", label=name)
        axes.set(xscale="log", xlabel="CPU s a granule", ylabel=f"error of {label}, %", ylim=(0, None))
        axes.legend(frameon=False, fontsize=8)
    save(figure, out)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", nargs="+", choices=[*ROWS, *PEERS], default=[*ROWS, *PEERS])
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "pipeline/results/bench-dryer")
    options = parser.parse_args()
    runs.require_programs()
    options.out.mkdir(parents=True, exist_ok=True)
    print(f"{runs.machine()}\n")
    table = [row for name in ROWS if name in options.rows for row in bench_row(name, options.seeds, options.jobs)]
    if table:
        show(table)
        write_records(options.out / "bench.csv", table)
        draw(table, options.out / "bench.svg")
    for peer, (label, code, settings) in PEERS.items():
        if peer not in options.rows:
            continue
        if code.missing():
            print(f"\nNot compared with {label}: {code.missing()}")
            continue
        chosen = ", ".join(f"{key} = {value}" for key, value in settings.items()) or "defaults, full stiffness"
        print(f"\nPe = infinity at a lifetime of {1e3 * PEERS_LIFETIME:g} ms, same starts; {chosen}:\n")
        print_markdown(["program", "seed", "d_c nm", "pairs within 0.02 a", "CPU s"],
                       [[program, str(seed), f"{d_c:.2f}", str(contacts), f"{cpu:.3g}"]
                        for program, seed, d_c, contacts, cpu in beside(peer, list(range(1, options.seeds + 1)), options.jobs)])


if __name__ == "__main__":
    main()
