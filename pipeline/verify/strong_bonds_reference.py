"""Long steps with Brownian motion against short ones that resolve every contact, where bonds are worth 90 kT.

60 particles of 100 nm (pipeline/scenes/strong_bonds.toml) at four Peclet numbers: the integrator that the dryer chooses,
`stabilised`, against `two-rate` with contacts of full stiffness. Both dry the same random starts; differences are those
of each start, with the 95 % interval of their mean (Student's t).

    strong_bonds_reference.py --peclet 1000 --seeds 1 2 3 --jobs 2
"""

import statistics

from drying import runs
from interval import half_width
from table import print_markdown

SCENE = "pipeline/scenes/strong_bonds.toml"
REFERENCE = {"integrator.method": "two-rate", "integrator.softening": 1}
PECLET = [10000, 3000, 1000, 500]
# key of the result, title, format, where the difference of the means must lie, of the mean
QUANTITIES = [("d_c_nm", "d_c nm", ".1f", 0.01), ("h_c_over_d_c", "h_c/d_c", ".4f", None), ("contacts", "contacts", ".1f", 0.03)]


def shift(found, reference, key):
    """Mean difference and half of its 95 % interval, of the reference's mean."""
    scale = runs.mean(reference, key)
    parts = [(one[key] - other[key]) / scale for one, other in zip(found, reference)]
    return statistics.fmean(parts), half_width(parts)


def table_row(peclet, name, found, reference):
    cells = [str(peclet), name, str(len(found))]
    for key, _, digits, _ in QUANTITIES:
        cells.append(f"{runs.mean(found, key):{digits}} ± {runs.spread(found, key):{digits}}")
        mean, half = (100 * x for x in shift(found, reference, key))
        cells.append("" if found is reference else f"{mean:+.1f} ± {half:.1f}")
    lost = statistics.fmean(row["contacts_lost"] for row in found)
    return cells + [f"{lost:.1f}", f"{runs.mean(found, 'cpu_s'):.2f}"]


def claims(peclet, found, reference):
    for key, title, _, bound in QUANTITIES:
        if bound is None:
            continue
        mean, half = shift(found, reference, key)
        yield (f"Pe = {peclet}, {title}: {100 * mean:+.1f} ± {100 * half:.1f} %, the mean within ±{100 * bound:g} %",
               abs(mean) < bound)


def command_line():
    parser = runs.arguments(__doc__, list(range(1, 9)))
    parser.add_argument("--peclet", type=int, nargs="+", default=PECLET, help="(default: %(default)s)")
    return parser


def main(options):
    runs.require_programs()
    table, judged = [], []
    for peclet in options.peclet:
        speed = {"droplet.peclet": peclet}
        found = runs.run_all({f"strong_{peclet}_short": {**REFERENCE, **speed}, f"strong_{peclet}_long": speed},
                             options.seeds, options.jobs, SCENE)
        reference, long = found[f"strong_{peclet}_short"], found[f"strong_{peclet}_long"]
        table += [table_row(peclet, "short steps", reference, reference), table_row(peclet, "long steps", long, reference)]
        judged += claims(peclet, long, reference)
    heading = ["Pe", "integrator", "seeds"]
    for _, title, *_ in QUANTITIES:
        heading += [title, "difference %"]
    heading += ["bonds lost", "CPU s"]
    print(f"\n{runs.machine()}\n")
    print_markdown(heading, table)
    runs.store("strong_bonds_reference.csv", __doc__.splitlines()[0], heading, table)
    runs.judge(judged)


if __name__ == "__main__":
    main(command_line().parse_args())
