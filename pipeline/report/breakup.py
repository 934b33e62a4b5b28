"""One breakup as tables, and its critical stress beside the prediction for a rigid agglomerate.

STEM-course.csv: size, shape and contacts against flow stress (Fig 7 of Vasquez Giuliano et al. 2022); STEM-events.csv: what happened
to the contacts. Beside BREAKUP.h5 stands its report BREAKUP.json and, if there is one, that of rigidstress, BREAKUP-rigid.json.

    breakup.py results/hollow-1-break.h5 -o results/hollow-1-break
"""
import json

import arguments
import crumble
from headline import with_error
from table import write_csv

KINDS = ["slips", "twists", "rolls", "breaks", "made", "fragment lost"]
COLUMNS = {"flow_stress": "flow_stress_pa", "radius_of_gyration": "radius_of_gyration_nm",
           "semi_axis_largest": "semi_axis_largest_nm", "semi_axis_middle": "semi_axis_middle_nm",
           "semi_axis_smallest": "semi_axis_smallest_nm", "contacts": "contacts", "largest_fragment": "largest_fragment",
           "max_tension": "max_tension_n", "slipping": "slipping", "twisting": "twisting", "rolling": "rolling"}


def tables(path, stem):
    breakup = crumble.read(path)
    series, events = breakup.series, breakup.events
    rows = [[f"{v:.7g}" for v in row] for row in zip(*(series[name] for name in COLUMNS), 2 * series.contacts / breakup.number)]
    write_csv(stem.with_name(stem.name + "-course.csv"), [*COLUMNS.values(), "coordination"], rows)
    write_csv(stem.with_name(stem.name + "-events.csv"), ["time_s", "flow_stress_pa", "what", "i", "j"],
              [[f"{t:.9g}", f"{s:.7g}", KINDS[kind], i, j] for t, s, kind, (i, j) in zip(events.time, events.stress, events.kind, events.pair)])


def command_line():
    parser = arguments.parser(__doc__, "tables STEM-course.csv and STEM-events.csv", "STEM")
    parser.add_argument("breakup", type=arguments.file, metavar="BREAKUP.h5", help="of breaker")
    return parser


def main(options):
    path, stem = options.breakup, options.out
    tables(path, stem)
    found = json.loads(path.with_suffix(".json").read_text())
    result, error = found["results"], found["errors"]["critical_stress_relative"]["value"]
    rigid = path.with_name(path.stem + "-rigid.json")
    print(f"{'critical stress, flexible':34}", "nothing broke" if result["critical_stress_pa"] is None else
          with_error(result["critical_stress_pa"], error, "Pa"))
    if result["first_rupture_stress_pa"] is not None:
        print(f"{'first contact breaks':34} {result['first_rupture_stress_pa']:.0f} Pa")
    if rigid.exists():
        loads = json.loads(rigid.read_text())["results"]
        for flow in ("elongation", "shear", "uniaxial", "biaxial"):
            stress = loads.get(flow, {}).get("critical_stress_pa" if flow == "shear" else "critical_stress_settled_pa")
            if stress is not None:
                print(f"{'rigid prediction, ' + flow:34} {stress:.0f} Pa")
    print(f"{'breakage':34} {result['breakage']}")
    print(f"{'contacts':34} {result['contacts_initial']} -> {result['contacts_at_breakup']}")
    for name, key in (("radius of gyration", "rg_change_relative"),
                      ("largest semi-axis", "largest_semi_axis_change_relative"),
                      ("smallest semi-axis", "smallest_semi_axis_change_relative")):
        print(f"{name:34} {100 * result[key]:+.1f} %")
    print(f"{'fragments':34} {' '.join(map(str, result['fragments']))}")
    print(f"tables: {stem}-course.csv (Fig 7), {stem}-events.csv")


if __name__ == "__main__":
    main(command_line().parse_args())
