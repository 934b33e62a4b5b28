"""Breakups of several granules beside the rigid prediction for each: breakups.py NAME=BREAKUP.json,... [NAME=...]

Beside every BREAKUP.json lies BREAKUP-rigid.json of rigidstress. Prints a table in Markdown; changes are those at 1 % less
than the critical stress.
"""
import json
import pathlib
import statistics
import sys

PAPER = {"compact": (4040, 4120), "hollow": (2010, 1930)}  # section 3.3: flexible and rigid, Pa, one granule each


def load(path):
    found = json.loads(path.read_text())
    rigid = json.loads(path.with_name(path.stem + "-rigid.json").read_text())
    return found, rigid["results"]["elongation"]["critical_stress_settled_pa"]


def row(name, found, rigid):
    r, error = found["results"], found["errors"]["critical_stress_relative"]["value"]
    uncertain = "" if error is None else f" +- {100 * error:.1g} %"
    return (f"| {name} | {r['critical_stress_pa']:.0f} Pa{uncertain} | {rigid:.0f} Pa | "
            f"{r['critical_stress_pa'] / rigid:.2f} | {r['first_rupture_stress_pa']:.0f} Pa | "
            f"{r['contacts_initial']} -> {r['contacts_at_breakup']} | {100 * r['rg_change_relative']:+.1f} % | "
            f"{100 * r['largest_semi_axis_change_relative']:+.1f} %, {100 * r['smallest_semi_axis_change_relative']:+.1f} % | "
            f"{r['breakage']} | {' '.join(map(str, r['fragments'][:4]))} | {found['cpu_s']:.0f} |")


def main(classes):
    print("| granule | breaks at | rigid | ratio | first contact breaks | contacts | radius of gyration | "
          "largest, smallest semi-axis | | fragments | CPU s |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    means = {}
    for entry in classes:
        name, _, files = entry.partition("=")
        loaded = [(pathlib.Path(file).stem, *load(pathlib.Path(file))) for file in files.split(",")]
        for granule, found, rigid in loaded:
            print(row(granule, found, rigid))
        means[name] = [statistics.fmean(values) for values in
                       zip(*((found["results"]["critical_stress_pa"], rigid) for _, found, rigid in loaded))]
    print()
    for name, (flexible, rigid) in means.items():
        paper = f"; the paper {PAPER[name][0]} and {PAPER[name][1]} Pa" if name in PAPER else ""
        print(f"{name}: mean {flexible:.0f} Pa, rigid {rigid:.0f} Pa{paper}")
    if {"compact", "hollow"} <= means.keys():
        print(f"compact over hollow: {means['compact'][0] / means['hollow'][0]:.2f}; the paper 2.01")


if __name__ == "__main__":
    main(sys.argv[1:])
