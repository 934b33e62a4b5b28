"""Strength of populations, section 3.4 of Vasquez Giuliano et al. (2022).

Beside every report FILE.json lies its stress file, FILE.h5. Beside FILE.txt are written FILE.csv (which the page of the paper shows, too),
fig8.csv (tension of every contact against its distance from the centre of mass, settled in elongation) and fig9.csv (N_max of the most
loaded orbit against time, in shear).

    strength.py compact=compact-1.json,compact-2.json hollow=hollow-1.json,hollow-2.json -o table.txt
"""

import json
import math
import statistics

import arguments
import crumble
import published
from interval import half_width
from table import write_csv, write_records

# name, where in the results N_max is, where its critical stress is
CASES = [("settled", ("elongation", "n_max_settled"), ("elongation", "critical_stress_settled_pa")),
         ("worst", ("elongation", "n_max_worst"), ("elongation", "critical_stress_worst_pa")),
         ("shear", ("shear", "n_max_orbit"), ("shear", "critical_stress_pa"))]


def several(of, values, least=2):
    return of(values) if len(values) >= least else math.nan


def rows(name, reports):
    results = [report["results"] for report in reports]
    error = max(report["errors"]["n_max_relative"]["value"] for report in reports)
    cpu = statistics.fmean(report["cpu_s"] for report in reports)
    coordination = statistics.fmean(r["coordination"] for r in results)
    for case, n_max, stress in CASES:
        n, critical = ([value for r in results if (value := r[of[0]][of[1]]) is not None]  # some settle nowhere
                       for of in (n_max, stress))
        if not n:
            continue
        paper = published.STRENGTH.get(name, {}).get(case, ("", ""))
        yield {"population": name, "agglomerates": len(n), "coordination": f"{coordination:.2f}", "flow": case,
               "n_max": f"{statistics.fmean(n):.2f}", "spread": f"{several(statistics.stdev, n):.2f}",
               "half_width": f"{several(half_width, n, 3):.2f}", "lowest": f"{min(n):.2f}", "highest": f"{max(n):.2f}",
               "error_percent": f"{100 * error:.1f}",
               "critical_stress_pa": f"{statistics.fmean(critical):.0f}", "spread_pa": f"{several(statistics.stdev, critical):.0f}",
               "half_width_pa": f"{several(half_width, critical, 3):.0f}", "lowest_pa": f"{min(critical):.0f}",
               "highest_pa": f"{max(critical):.0f}", "paper_n_max": paper[0], "paper_pa": paper[1],
               "cpu_s": f"{cpu:.3g}"}


def unit(result):
    """6 pi a^2 times the flow stress of 1 Pa that stored tensions belong to, N."""
    return 6 * math.pi * (1e-9 * result["particle_radius_nm"]) ** 2


def courses(name, path, result):
    """Rows of fig8.csv and fig9.csv of one agglomerate."""
    stress = crumble.read(path.with_suffix(".h5"))
    contacts = zip(stress["flows/elongation/radial_position"], stress["flows/elongation/normal_force"] / unit(result))
    instants = zip(stress["flows/shear/time"], stress["flows/shear/max_tension"] / unit(result))
    return ([[name, path.stem, f"{r:.2f}", f"{n:.5g}"] for r, n in contacts],
            [[name, path.stem, f"{t:.5g}", f"{n:.5g}"] for t, n in instants])


def command_line():
    parser = arguments.parser(__doc__, "the table", "FILE.txt")
    arguments.add_groups(parser, "populations, each with its reports of rigidstress")
    return parser


def main(options):
    folder = options.out.parent
    table, contacts, instants = [], [], []
    for name, paths in options.groups.items():
        reports = [json.loads(path.read_text()) for path in paths]
        table += rows(name, reports)
        for path, report in zip(paths, reports):
            of_contacts, of_instants = courses(name, path, report["results"])
            contacts += of_contacts
            instants += of_instants
    write_csv(folder / "fig8.csv", ["population", "agglomerate", "radial_position_nm", "n_over_6_pi_mu_gamma_dot_a2"], contacts)
    write_csv(folder / "fig9.csv", ["population", "agglomerate", "time_gamma_dot", "n_max_over_6_pi_mu_gamma_dot_a2"], instants)
    write_records(options.out.with_suffix(".csv"), table)
    with arguments.printing_to(options.out):
        show(table)


def show(table):
    widths = {key: max(len(key), *(len(str(row[key])) for row in table)) for key in table[0]}
    print("N_max in 6 pi mu gamma_dot a^2 and the flow stress that breaks the most loaded contact: mean, standard")
    print("deviation, half of the 95 % interval of the mean of three and more, lowest and highest; error: the largest that rigidstress states for one agglomerate.")
    print("settled and worst orientation in planar elongation; shear: largest over an orbit, mean over orbits.")
    for row in [dict(zip(widths, widths))] + table:
        print("  ".join(str(row[key]).rjust(width) for key, width in widths.items()))


if __name__ == "__main__":
    main(command_line().parse_args())
