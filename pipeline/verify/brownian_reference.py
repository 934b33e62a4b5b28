"""What softened contacts do to a granule that dries at Pe = 10 and 1: against full stiffness, means over seeds.

With noise, two runs of one seed part after a while, so only means can be compared: the difference of each quantity with
its 95 % interval (Welch). Also writes pipeline/verify/brownian.json, from which the tables of `make -C pipeline` take the
errors of their rows with Brownian motion.

    brownian_reference.py --rows intermediate --seeds 1 2 3 --jobs 2
"""

import json

from drying import runs
from interval import difference
from table import print_markdown
import whole

# scene: Peclet number, particles, seeds of the default, which is cheap: many narrow the interval
ROWS = {"intermediate": (10, 102, range(1, 26)), "compact": (1, 85, range(1, 13))}
# Where the interval must lie. At Pe = 1 the softer core in the liquid costs 2 % of the size.
BOUNDS = {"intermediate": {"d_c_nm": 0.02, "contacts": 0.05}, "compact": {"d_c_nm": 0.04, "contacts": 0.05}}
# key of the result, title, format, key in brownian.json, whether that is a fraction of the value
QUANTITIES = [("d_c_nm", "d_c nm", ".2f", "d_c_relative", True), ("h_c_over_d_c", "h_c/d_c", ".4f", "h_c_over_d_c", False),
              ("contacts", "contacts", ".1f", "contacts_relative", True)]
STORED = runs.ROOT / "pipeline/verify/brownian.json"


def values(rows, key):
    return [row[key] for row in rows]


def shift(found, full, key):
    """Difference of the means and half of its 95 % interval."""
    return difference(values(found, key), values(full, key))


def table_row(row, name, found, full):
    cells = [row, name, str(len(found))]
    for key, _, digits, _, _ in QUANTITIES:
        cells.append(f"{runs.mean(found, key):{digits}} ± {runs.spread(found, key):{digits}}")
        percent, half = (100 * x / runs.mean(full, key) for x in shift(found, full, key))
        cells.append("" if found is full else f"{percent:+.1f} ± {half:.1f}")
    return cells + [f"{runs.mean(found, 'cpu_s'):.1f}"]


def errors(row, default, full):
    """What the tables of granules take for the numerical error of their row."""
    peclet, number, _ = ROWS[row]
    stored = {"how": f"difference of means to contacts of full stiffness at Pe = {peclet}, N = {number}, {len(default)} and "
                     f"{len(full)} seeds (95 % interval in pipeline/verify/README.md)"}
    for key, _, _, name, relative in QUANTITIES:
        scale = runs.mean(full, key) if relative else 1
        found, half = shift(default, full, key)
        stored[name] = {"difference": round(found / scale, 5), "interval_95": round(half / scale, 5)}
    return stored


def claims(row, default, full):
    for key, title, _, _, _ in QUANTITIES:
        if key not in BOUNDS[row]:
            continue
        scale = runs.mean(full, key)
        found, half = (x / scale for x in shift(default, full, key))
        yield (f"{row}, {title}: 95 % interval of the difference, {100 * (found - half):+.1f} to {100 * (found + half):+.1f} %, "
               f"within ±{100 * BOUNDS[row][key]:g} %", abs(found) + half < BOUNDS[row][key])


def command_line():
    return runs.arguments(__doc__, [1, 2, 3, 4, 5, 6, 7, 8], rows=list(ROWS))


def main(options):
    runs.require_programs()
    stored = json.loads(STORED.read_text(encoding="utf-8"))
    table, judged = [], []
    for row in options.rows:
        scene = f"pipeline/scenes/{row}.toml"
        full = runs.run_all({f"{row}_full": {"integrator.softening": 1}}, options.seeds, options.jobs, scene)[f"{row}_full"]
        default = runs.run_all({f"{row}_default": {}}, ROWS[row][2], options.jobs, scene)[f"{row}_default"]
        table += [table_row(row, "full stiffness", full, full), table_row(row, "default", default, full)]
        stored[row] = errors(row, default, full)
        judged += claims(row, default, full)
    heading = ["row", "contacts of", "seeds"]
    for _, title, *_ in QUANTITIES:
        heading += [title, "difference %"]
    print(f"\n{runs.machine()}\n")
    print_markdown(heading + ["CPU s"], table)
    runs.store("brownian_reference.csv", __doc__.splitlines()[0], heading + ["cpu_s"], table)
    whole.write_text(STORED, json.dumps(stored, indent=1) + "\n")
    print(f"written: {STORED.relative_to(runs.ROOT)}")
    runs.judge(judged)


if __name__ == "__main__":
    main(command_line().parse_args())
