"""Strength of populations, section 3.4 of Vasquez Giuliano et al. (2022): strength.py FOLDER NAME=REPORT.json,...

Each NAME is a population, its reports are those of rigidstress; beside every report lies its stress file. Prints the
table and writes FOLDER/table.csv, FOLDER/fig8.csv (tension of every contact against its distance from the centre of
mass, settled in elongation) and FOLDER/fig9.csv (N_max of the most loaded orbit against time, in shear).
"""

import csv
import json
import math
import pathlib
import statistics
import sys

import h5py

# N_max/(6 pi mu gamma_dot a^2) and critical stress in Pa that the paper gives: settled in elongation, largest in shear.
PAPER = {"compact": {"settled": (2.89, 4120), "shear": (3.3, 3650)},
         "hollow": {"settled": (6.24, 1930), "shear": (5.1, 2360)}}

# name, where in the results N_max is, where its critical stress is
CASES = [("settled", ("elongation", "n_max_settled"), ("elongation", "critical_stress_settled_pa")),
         ("worst", ("elongation", "n_max_worst"), ("elongation", "critical_stress_worst_pa")),
         ("shear", ("shear", "n_max_orbit"), ("shear", "critical_stress_pa"))]


def spread(values):
    return statistics.stdev(values) if len(values) > 1 else math.nan


def rows(name, results, errors):
    coordination = statistics.fmean(r["coordination"] for r in results)
    for case, n_max, stress in CASES:
        n = [r[n_max[0]][n_max[1]] for r in results]
        critical = [r[stress[0]][stress[1]] for r in results]
        paper = PAPER.get(name, {}).get(case, ("", ""))
        yield {"population": name, "agglomerates": len(results), "coordination": f"{coordination:.2f}", "flow": case,
               "n_max": f"{statistics.fmean(n):.2f}", "spread": f"{spread(n):.2f}",
               "error_percent": f"{100 * max(errors):.1f}", "critical_stress_pa": f"{statistics.fmean(critical):.0f}",
               "spread_pa": f"{spread(critical):.0f}", "paper_n_max": paper[0], "paper_pa": paper[1]}


def unit(result):
    """6 pi a^2 times the flow stress of 1 Pa that stored tensions belong to, N."""
    return 6 * math.pi * (1e-9 * result["particle_radius_nm"]) ** 2


def main(folder, populations):
    folder = pathlib.Path(folder)
    table = []
    with open(folder / "fig8.csv", "w", newline="") as fig8, open(folder / "fig9.csv", "w", newline="") as fig9:
        contact, instant = csv.writer(fig8), csv.writer(fig9)
        contact.writerow(["population", "agglomerate", "radial_position_nm", "n_over_6_pi_mu_gamma_dot_a2"])
        instant.writerow(["population", "agglomerate", "time_gamma_dot", "n_max_over_6_pi_mu_gamma_dot_a2"])
        for population in populations:
            name, _, files = population.partition("=")
            results, errors = [], []
            for path in (pathlib.Path(file) for file in files.split(",")):
                report = json.loads(path.read_text())
                result = report["results"]
                results.append(result)
                errors.append(report["errors"]["n_max_relative"]["value"])
                with h5py.File(path.with_suffix(".h5")) as stress:
                    settled, shear = stress["flows/elongation"], stress["flows/shear"]
                    for r, n in zip(settled["radial_position"][:], settled["normal_force"][:] / unit(result)):
                        contact.writerow([name, path.stem, f"{r:.2f}", f"{n:.5g}"])
                    for t, n in zip(shear["time"][:], shear["max_tension"][:] / unit(result)):
                        instant.writerow([name, path.stem, f"{t:.5g}", f"{n:.5g}"])
            table += rows(name, results, errors)
    with open(folder / "table.csv", "w", newline="") as out:
        writer = csv.DictWriter(out, table[0].keys())
        writer.writeheader()
        writer.writerows(table)
    widths = {key: max(len(key), *(len(str(row[key])) for row in table)) for key in table[0]}
    print("N_max in 6 pi mu gamma_dot a^2 and the flow stress that breaks the most loaded contact: mean and standard")
    print("deviation; error: the largest that rigidstress states for one agglomerate. settled and worst orientation in")
    print("planar elongation; shear: largest over an orbit, mean over orbits.")
    for row in [dict(zip(widths, widths))] + table:
        print("  ".join(str(row[key]).rjust(width) for key, width in widths.items()))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
