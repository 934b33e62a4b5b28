"""Breakups of several granules beside the rigid prediction for each, as a table in Markdown.

Granules of a campaign that were loaded and broken. Changes are those at 1 % less than the critical stress.

    breakups.py results/breakups/granules.csv -o results/breakups/table.md
"""

import json
import statistics

import arguments
import campaign_files
import published
from table import print_markdown

HEADING = ["granule", "breaks at", "the paper", "rigid", "the paper", "ratio", "first contact breaks", "contacts",
           "radius of gyration", "largest, smallest semi-axis", "", "fragments", "CPU s"]


def load(granule):
    found, rigid = (json.loads(granule.file(stage, ".json").read_text()) for stage in ("breakup", "stress"))
    return found, rigid["results"]["elongation"]["critical_stress_settled_pa"]


def row(granule, found, rigid):
    r, error = found["results"], found["errors"]["critical_stress_relative"]["value"]
    uncertain = "" if error is None else f" (error {100 * error:.1g} %)"
    theirs = [f"{stress} Pa" for stress in published.BREAKUPS.get(granule.kind, ())] or ["", ""]
    return [granule.name, f"{r['critical_stress_pa']:.0f} Pa{uncertain}", theirs[0], "settles nowhere" if rigid is None else f"{rigid:.0f} Pa", theirs[1],
            "" if rigid is None else f"{r['critical_stress_pa'] / rigid:.2f}", f"{r['first_rupture_stress_pa']:.0f} Pa",
            f"{r['contacts_initial']} -> {r['contacts_at_breakup']}", f"{100 * r['rg_change_relative']:+.1f} %",
            f"{100 * r['largest_semi_axis_change_relative']:+.1f} %, {100 * r['smallest_semi_axis_change_relative']:+.1f} %",
            r["breakage"], " ".join(map(str, r["fragments"][:4])), f"{found['cpu_s']:.0f}"]


def show(granules):
    loaded = [(granule, *load(granule)) for granule in granules]
    print_markdown(HEADING, [row(*one) for one in loaded])
    means = {}
    for granule, found, rigid in loaded:
        if rigid is not None:
            means.setdefault(granule.kind, []).append((found["results"]["critical_stress_pa"], rigid))
    means = {name: [statistics.fmean(values) for values in zip(*pairs)] for name, pairs in means.items()}
    print()
    for name, (flexible, rigid) in means.items():
        print(f"{name}: mean {flexible:.0f} Pa, rigid {rigid:.0f} Pa")
    if {"compact", "hollow"} <= means.keys():
        theirs = published.BREAKUPS["compact"][0] / published.BREAKUPS["hollow"][0]
        print(f"compact over hollow: {means['compact'][0] / means['hollow'][0]:.2f}; the paper {theirs:.2f}")


def command_line():
    parser = arguments.parser(__doc__, "the table (default: printed)", required=False)
    parser.add_argument("table", type=arguments.file, metavar="GRANULES.csv", help="of the campaign")
    return parser


def main(options):
    with arguments.printing_to(options.out):
        show(campaign_files.read(options.table, "stress", "breakup"))


if __name__ == "__main__":
    main(command_line().parse_args())
