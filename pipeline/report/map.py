"""How must I dry to get a granule that breaks at this stress? Granules over Peclet number, number and solids.

The table and, for a few stresses, which Peclet number gives them. Beside FILE.md are written FILE.csv and FILE.svg. Granules are those of a campaign, by its
table; what was dried is read from the reports.

    map.py results/map/granules.csv -o map.md
"""

import csv
import json
import math
import statistics

from matplotlib.ticker import NullLocator

import arguments
from figure import BLACK, BLUE, GREEN, ORANGE, PURPLE, pyplot, save
from table import print_markdown, write_records

QUANTITIES = [("d_c_nm", "d_c, nm"), ("h_c_over_d_c", "h_c/d_c"), ("porosity", "porosity"), ("coordination", "coordination"),
              ("critical_stress_pa", "critical stress, Pa")]
WATER = 1e-3  # Pa s
STRESSES = (2000, 3000, 4000, 5000, 6000, 8000)  # Pa


def read(path):
    with path.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            if row.get("stress_id"):  # else it failed
                yield granule(path.parent / f"dry/{row['id']}.json", path.parent / f"stress/{row['stress_id']}.json")


def granule(dry, stress):
    dried, load = json.loads(dry.read_text()), json.loads(stress.read_text())["results"]
    r = dried["results"]
    # The flow stress at which the weakest contact gives way in the orientation to which a granule settles in elongation.
    return {"peclet": float(f"{r['inputs']['peclet']:.9g}"), "number": r["inputs"]["number"], "solids": r["inputs"]["solids_fraction"],
            "d_c_nm": r["d_c_nm"], "h_c_over_d_c": r["h_c_over_d_c"], "porosity": r["porosity"],
            "coordination": r["coordination"], "fragments": r["fragments"],
            "critical_stress_pa": load["elongation"]["critical_stress_settled_pa"], "cpu_s": dried["cpu_s"]}


def rows(runs):
    for key in sorted({(run["peclet"], run["number"], run["solids"]) for run in runs}):
        group = [run for run in runs if (run["peclet"], run["number"], run["solids"]) == key]
        row = {"peclet": key[0], "number": key[1], "solids": key[2], "granules": len(group)}
        for name, _ in QUANTITIES:
            values = [run[name] for run in group if run[name] is not None] or [math.nan]  # a granule may settle nowhere
            row |= {name: statistics.fmean(values), name + "_lowest": min(values), name + "_highest": max(values)}
        row["fragments"] = statistics.fmean(run["fragments"] for run in group)
        if row["fragments"] > key[1] / 10:  # dust, no granule: what is left of it has a strength, but not that of a granule
            row |= dict.fromkeys(("critical_stress_pa", "critical_stress_pa_lowest", "critical_stress_pa_highest"), math.nan)
        row["critical_shear_rate_in_water_per_s"] = row["critical_stress_pa"] / WATER
        row["cpu_s"] = statistics.fmean(run["cpu_s"] for run in group)
        yield row


def usual(table):
    """Number and solids of the scan over the Peclet number: what most rows share."""
    return max(((row["number"], row["solids"]) for row in table),
               key=lambda pair: sum((row["number"], row["solids"]) == pair for row in table))


def short(value, digits):
    """So many digits, no exponent below a million."""
    return f"{float(f'{value:.{digits}g}'):g}"


def show(table):
    cell = lambda row, name: ("-" if math.isnan(row[name]) else
                              f"{short(row[name], 3)} ({short(row[name + '_lowest'], 3)} to {short(row[name + '_highest'], 3)})")
    print_markdown(["Pe", "N", "solids %", "granules", *(label for _, label in QUANTITIES), "fragments", "CPU s"],
                   [[f"{row['peclet']:g}", str(row["number"]), f"{100 * row['solids']:.2g}", str(row["granules"]),
                     *(cell(row, name) for name, _ in QUANTITIES), f"{row['fragments']:.1f}", f"{row['cpu_s']:.3g}"]
                    for row in table])
    print("\nMean (lowest to highest of the granules). Critical stress: rigid, planar elongation, settled, particles of 100 nm; it\n"
          "goes as surface energy over radius; a granule that settles nowhere is left out, dust (more than N/10 pieces) has none. The shear rate that reaches it is the stress over the viscosity of the liquid.\n")
    answer([row for row in table if (row["number"], row["solids"]) == usual(table) and not math.isnan(row["critical_stress_pa"])])


def answer(scan):
    """Peclet numbers that give a stress, where the stress falls with them."""
    first = len(scan) - 1
    while first > 0 and scan[first - 1]["critical_stress_pa"] > scan[first]["critical_stress_pa"]:
        first -= 1
    dense, falling = scan[:first + 1], scan[first:]
    if len(dense) > 1:
        print(f"Up to Pe = {dense[-1]['peclet']:g} the stress does not follow the Peclet number: means from "
              f"{min(row['critical_stress_pa'] for row in dense):.0f} to {max(row['critical_stress_pa'] for row in dense):.0f} Pa, single "
              f"granules from {min(row['critical_stress_pa_lowest'] for row in dense):.0f} to "
              f"{max(row['critical_stress_pa_highest'] for row in dense):.0f} Pa. Beyond:\n")
    cell = lambda peclet: "-" if peclet is None else short(peclet, 2)
    print_markdown(["to break at, Pa", "that is in water, 1/s", "dry at Pe", "if like the weakest granules", "like the strongest"],
                   [[str(stress), f"{stress / WATER:.1g}", *(cell(peclet_for(stress, falling, name)) for name in (
                       "critical_stress_pa", "critical_stress_pa_lowest", "critical_stress_pa_highest"))] for stress in STRESSES])


def peclet_for(stress, falling, name):
    """Between two rows as a power law; nothing beyond them."""
    for low, high in zip(falling, falling[1:]):
        if low[name] >= stress >= high[name]:
            part = math.log(stress / low[name]) / math.log(high[name] / low[name])
            return math.exp(math.log(low["peclet"]) + part * math.log(high["peclet"] / low["peclet"]))
    return None


def panel(axes, scan, x, name, label, colour):
    places = [row[x] for row in scan]
    axes.plot(places, [row[name] for row in scan], "o-", color=colour, markersize=3)
    axes.fill_between(places, [row[name + "_lowest"] for row in scan], [row[name + "_highest"] for row in scan], color=colour,
                      alpha=0.2, linewidth=0)
    top = max((row[name + "_highest"] for row in scan if not math.isnan(row[name])), default=1)
    axes.set(ylabel=label, xscale="log", ylim=(0, 1.1 * top))


def draw(table, out):
    number, solids = usual(table)
    scans = [("peclet", "Pe", [r for r in table if (r["number"], r["solids"]) == (number, solids)]),
             ("number", "N", [r for r in table if r["number"] != number]),
             ("solids", "solids", [r for r in table if r["number"] == number and r["solids"] != solids])]
    for k in (1, 2):
        if scans[k][2]:  # the point that it shares with the scan over Pe
            fixed = scans[k][2][0]["peclet"]
            shared = [r for r in scans[0][2] if r["peclet"] == fixed]
            scans[k] = (scans[k][0], f"{scans[k][1]} (Pe = {fixed:g})", sorted(scans[k][2] + shared, key=lambda r: r[scans[k][0]]))
    scans = [scan for scan in scans if scan[2]]
    figure, panels = pyplot.subplots(len(QUANTITIES), len(scans), figsize=(3 * len(scans), 9), squeeze=False, sharex="col",
                                     layout="constrained")
    for column, (x, title, scan) in enumerate(scans):
        for line, ((name, label), colour) in enumerate(zip(QUANTITIES, (BLACK, BLUE, GREEN, PURPLE, ORANGE))):
            panel(panels[line][column], scan, x, name, label, colour)
        lowest = panels[-1][column]
        lowest.set(xlabel=title)
        lowest.xaxis.set_minor_locator(NullLocator())
        if len(scan) < 6:  # a short scan names its values
            lowest.set_xticks([row[x] for row in scan], [f"{row[x]:.2g}" if x == "solids" else str(row[x]) for row in scan])
    right = panels[-1][-1].secondary_yaxis("right", functions=(lambda s: 1e-6 * s / WATER, lambda g: 1e6 * g * WATER))
    right.set_ylabel("shear rate in water, 1e6/s")
    save(figure, out)


def command_line():
    parser = arguments.parser(__doc__, "the table", "FILE.md")
    parser.add_argument("table", type=arguments.file, metavar="granules.csv", help="of the campaign, its files beside it")
    return parser


def main(options):
    table = list(rows(list(read(options.table))))
    write_records(options.out.with_suffix(".csv"), table)
    draw(table, options.out.with_suffix(".svg"))
    with arguments.printing_to(options.out):
        show(table)


if __name__ == "__main__":
    main(command_line().parse_args())
