"""Time against error of the dryer: step control, stiffness and integrator on the rows of Table 2, and LAMMPS beside it.

    bench.py [--rows hollow intermediate compact lammps] [--seeds 2] [--out pipeline/results/bench-dryer]

Errors against the reference of each row: hollow against the inertial integrator at full stiffness, same starts (mean of the
absolute differences); with noise against full stiffness, differences of means with their 95 % interval. Gamma: concentration at
theta = 0.4 in ten shells of the radius that centres reach, rms difference to the continuum model in standard errors (1 where
only chance is left). Times are CPU seconds of one core. Writes bench.csv and bench.svg.
"""

import argparse
import csv
import os
import pathlib
import statistics
import sys

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "pipeline/verify"), str(ROOT / "pipeline/report")]

import concentration  # noqa: E402
import interval  # noqa: E402
from drying import lammps, runs  # noqa: E402
from figure import LINES, pyplot, save  # noqa: E402

SOFT = {"material.youngs_modulus": "3.4e7"}  # a hundredth, at the same surface energy
STEP = "integrator.largest_displacement"
# scene, seeds a case over --seeds, Peclet number, reference, cases
ROWS = {
    "hollow": ("pipeline/scenes/hollow.toml", 1, None, ("inertial, full stiffness", {"integrator.method": "inertial"}),
               {"displacement 0.1 a": {STEP: "0.1"}, "displacement 0.05 a": {STEP: "0.05"}, "default: 0.02 a": {},
                "displacement 0.01 a": {STEP: "0.01"}, "displacement 0.005 a": {STEP: "0.005"}, "E / 100": SOFT}),
    "intermediate": ("pipeline/scenes/intermediate.toml", 2, 10, ("softening 1", {"integrator.softening": "1"}),
                     {"softening 3": {"integrator.softening": "3"}, "softening 2": {"integrator.softening": "2"}, "default": {},
                      "half the step": {"integrator.contact_step": "0.075"}}),
    "compact": ("pipeline/scenes/compact.toml", 1, 1, ("softening 1", {"integrator.softening": "1"}),
                {"softening 3": {"integrator.softening": "3"}, "softening 2": {"integrator.softening": "2"}, "default": {}}),
}
LAMMPS_LIFETIME = 2.1e-5  # a tenth of Table 2's, for both


def gamma_deviation(dryer, peclet, names):
    rows = [rows for theta, kind, rows in concentration.comparisons(dryer, peclet, names) if theta == 0.4 and kind == "accessible"]
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


def bench_row(name, seeds):
    scene, times, peclet, (label, reference), cases = ROWS[name]
    seeds = list(range(1, seeds * times + 1))
    found = runs.run_all({f"bench_{name}_{k}": setting for k, setting in enumerate([reference, *cases.values()])}, seeds, os.cpu_count(), scene)
    base = found[f"bench_{name}_0"]
    for k, case in enumerate([label, *cases]):
        mine = found[f"bench_{name}_{k}"]
        (d_c, d_c_half), (contacts, contacts_half) = errors(mine, base, peclet is None) if k else ((0, 0), (0, 0))
        files = [str(ROOT / runs.RESULTS / f"bench_{name}_{k}-{seed}.h5") for seed in seeds]
        overlap = max(run["overlap"] for run in mine)
        yield {"row": name, "case": case, "granules": len(seeds), "cpu_s": statistics.fmean(run["cpu_s"] for run in mine),
               "d_c_percent": d_c, "d_c_half": d_c_half, "contacts_percent": contacts, "contacts_half": contacts_half,
               "overlap_over_a": overlap, "gamma": gamma_deviation(str(ROOT / runs.DRYER), peclet, files) if peclet else None}


def diameter(x, radius):
    """d_c of section 3.1 of the paper: twice the mean distance of the farthest tenth plus a radius."""
    r = numpy.sort(numpy.linalg.norm(x - x.mean(axis=0), axis=1))
    return 2 * (r[-max(1, len(r) // 10):].mean() + radius)


def touching(x, radius):
    i, j = numpy.triu_indices(len(x), 1)
    return int((numpy.linalg.norm(x[i] - x[j], axis=1) < 2.02 * radius).sum())


def beside_lammps(seeds):
    """Rows (program, seed, d_c nm, contacts within 0.02 a, CPU s), all from the same starts."""
    settings = {"droplet.lifetime": str(LAMMPS_LIFETIME)}
    found = runs.run_all({"bench_peer_inertial": settings | {"integrator.method": "inertial"}, "bench_peer_overdamped": settings},
                         seeds, os.cpu_count())
    for seed in seeds:
        for program in ("overdamped", "inertial"):
            file = ROOT / runs.RESULTS / f"bench_peer_{program}-{seed}.h5"
            with h5py.File(file) as h5:
                x = 1e-9 * h5["particles/all/position/value"][-1]
            cpu = found[f"bench_peer_{program}"][seeds.index(seed)]["cpu_s"]
            yield f"dryer, {program}", seed, 1e9 * diameter(x, 10e-9), touching(x, 10e-9), cpu
        x, cpu = lammps.dry(ROOT / runs.RESULTS / f"bench_peer_overdamped-{seed}.h5", LAMMPS_LIFETIME, 215e-9)
        yield "LAMMPS granular/jkr", seed, 1e9 * diameter(x, 10e-9), touching(x, 10e-9), cpu


def show(table):
    print("| row | control | granules | CPU s | d_c error % | contacts error % | overlap a | Gamma |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    form = lambda value, half: f"{value:+.1f} +- {half:.1f}" if half else f"{value:.2f}"
    for r in table:
        gamma = "" if r["gamma"] is None else f"{r['gamma']:.1f}"
        print(f"| {r['row']} | {r['case']} | {r['granules']} | {r['cpu_s']:.3g} | {form(r['d_c_percent'], r['d_c_half'])} | "
              f"{form(r['contacts_percent'], r['contacts_half'])} | {r['overlap_over_a']:.2g} | {gamma} |", flush=True)


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
    parser.add_argument("--rows", nargs="+", choices=[*ROWS, "lammps"], default=[*ROWS, "lammps"])
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "pipeline/results/bench-dryer")
    options = parser.parse_args()
    runs.require_programs()
    options.out.mkdir(parents=True, exist_ok=True)
    print(f"{runs.machine()}\n")
    table = [row for name in ROWS if name in options.rows for row in bench_row(name, options.seeds)]
    if table:
        show(table)
        with (options.out / "bench.csv").open("w", newline="") as file:
            writer = csv.DictWriter(file, table[0].keys())
            writer.writeheader()
            writer.writerows(table)
        draw(table, options.out / "bench.svg")
    if "lammps" in options.rows:
        if lammps.missing():
            print(f"\nNot compared with LAMMPS: {lammps.missing()}")
            return
        print(f"\nPe = infinity at a lifetime of {1e3 * LAMMPS_LIFETIME:g} ms, full stiffness, same starts:\n")
        print("| program | seed | d_c nm | pairs within 0.02 a | CPU s |\n|---|---|---|---|---|")
        for program, seed, d_c, contacts, cpu in beside_lammps(list(range(1, options.seeds + 1))):
            print(f"| {program} | {seed} | {d_c:.2f} | {contacts} | {cpu:.3g} |", flush=True)


if __name__ == "__main__":
    main()
