"""Granules against the lifetime of the droplet: Table 3 and Fig. 4 of Vasquez Giuliano et al. (2022), and beyond.

Lifetime and integrator are those of the reports. Beside FILE.md are written FILE.csv and FILE.svg, which is Fig. 4.

    lifetimes.py results/table3/granules.csv -o results/table3/table3.md
"""

import json
import statistics

import arguments
import campaign_files
from figure import BLUE, ORANGE, pyplot, save
from interval import half_width
from table import print_markdown, write_records

QUANTITIES = [("d_c_um", "d_c, µm", "{:.2f}"), ("h_c_um", "h_c, µm", "{:.2f}"), ("h_c_over_d_c", "h_c/d_c", "{:.3f}"),
              ("contacts", "contacts", "{:.1f}"), ("fragments", "fragments", "{:.1f}")]


def read(path):
    report = json.loads(path.read_text())
    r = report["results"]
    d_c = 1e-3 * r["d_c_nm"]
    return {"lifetime_ms": 1e3 * r["inputs"]["lifetime_s"], "integrator": report["inputs"]["integrator"]["method"],
            "d_c_um": d_c, "h_c_um": d_c * r["h_c_over_d_c"], "h_c_over_d_c": r["h_c_over_d_c"],
            "contacts": r["contacts"], "fragments": r["fragments"], "cpu_s": report["cpu_s"],
            "limit": r["inputs"]["capillary_speed_limit_m_per_s"], "k": r["inputs"]["evaporation_constant_m2_per_s"]}


def rows(runs):
    """One row a lifetime and integrator: means, their intervals, and the front's speed at the final radius over the limit."""
    for key in sorted({(run["lifetime_ms"], run["integrator"]) for run in runs}):
        group = [run for run in runs if (run["lifetime_ms"], run["integrator"]) == key]
        row = {"lifetime_ms": key[0], "integrator": key[1], "granules": len(group)}
        for name, _, _ in QUANTITIES:
            values = [run[name] for run in group]
            row[name] = statistics.fmean(values)
            row[name + "_spread"] = statistics.stdev(values)
            row[name + "_half_width"] = half_width(values)
            row[name + "_lowest"], row[name + "_highest"] = min(values), max(values)
        row["front_over_limit"] = group[0]["k"] / (1e-6 * row["d_c_um"]) / group[0]["limit"]
        row["cpu_s"] = statistics.fmean(run["cpu_s"] for run in group)
        yield row


def cell(row, name, form):
    if row["granules"] == 2:
        return f"{form.format(row[name + '_lowest'])} to {form.format(row[name + '_highest'])}"
    return f"{form.format(row[name])} ± {form.format(row[name + '_half_width'])} (sd {form.format(row[name + '_spread'])})"


def reach(row, name):
    """How far a bar goes down and up from the mean: to the ends of its interval, of two granules to both."""
    if row["granules"] == 2:
        return row[name] - row[name + "_lowest"], row[name + "_highest"] - row[name]
    return row[name + "_half_width"], row[name + "_half_width"]


def show(table):
    print_markdown(["lifetime ms", "integrator", "granules", *(label for _, label, _ in QUANTITIES), "front", "CPU s"],
                   [[f"{row['lifetime_ms']:g}", row["integrator"], str(row["granules"]),
                     *(cell(row, name, form) for name, _, form in QUANTITIES),
                     f"{row['front_over_limit']:.2f}", f"{row['cpu_s']:.1f}"] for row in table])
    print("\n±: half of the 95 % interval of the mean; two granules: lowest to highest. sd: standard deviation between granules. front: speed of the receding surface where its radius is d_c/2, over the\n"
          "speed sigma/(3 mu) at which the capillary force can move a particle.")


def draw(table, out):
    figure, panels = pyplot.subplots(1, 4, figsize=(11, 2.8), layout="constrained")
    for axes, (name, label, _) in zip(panels, QUANTITIES):
        for integrator, colour, marker in (("overdamped", BLUE, "o"), ("inertial", ORANGE, "x")):
            mine = [row for row in table if row["integrator"] == integrator]
            axes.errorbar([row["lifetime_ms"] for row in mine], [row[name] for row in mine],
                          list(zip(*(reach(row, name) for row in mine))) or None, fmt=marker, color=colour, capsize=2, label=integrator,
                          fillstyle="none")
        axes.set(xlabel="lifetime, ms", ylabel=label, xscale="log", ylim=(0, None))
        axes.axvspan(3, 25, color="#dddddd", zorder=0, label="Table 3")
    panels[0].legend(frameon=False, fontsize=7, loc="lower right")
    save(figure, out)


def command_line():
    parser = arguments.parser(__doc__, "the table", "FILE.md")
    parser.add_argument("table", type=arguments.file, metavar="GRANULES.csv", help="of the campaign, with two or more granules for each lifetime and integrator")
    return parser


def main(options):
    table = list(rows([read(granule.file("dry", ".json")) for granule in campaign_files.read(options.table)]))
    write_records(options.out.with_suffix(".csv"), table)
    draw(table, options.out.with_suffix(".svg"))
    with arguments.printing_to(options.out):
        show(table)


if __name__ == "__main__":
    main(command_line().parse_args())
