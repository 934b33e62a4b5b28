"""Strength of populations of granules with intervals, and where the numbers of section 3.4 of Vasquez Giuliano et al. (2022) lie in them.

Takes the tables of campaigns. The paper's numbers are means of ten granules: the distance to ours is counted in the standard error of such a mean and ours
together, with the spread of ours.

    population.py results/strength/granules.csv
    population.py hollow=results/hollow/granules.csv compact=results/compact/granules.csv -o populations.md
"""

import math
import pathlib
import sys

import arguments
import campaign_files
import published
from levels import processor
from table import print_markdown

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1] / "campaign"))
import sample  # noqa: E402
import weibull  # noqa: E402

# Our column, its unit in words, and where the paper's number stands.
COLUMNS = [("n_max_elongation [6 pi mu gamma_dot a^2]", "N_max settled in elongation", ("settled", 0)),
           ("n_max_worst [6 pi mu gamma_dot a^2]", "N_max, worst orientation", None),
           ("n_max_shear [6 pi mu gamma_dot a^2]", "N_max in shear, largest of an orbit", ("shear", 0)),
           ("critical_stress_elongation [Pa]", "critical stress in elongation, Pa", ("settled", 1)),
           ("critical_stress_shear [Pa]", "critical stress in shear, Pa", ("shear", 1)),
           ("critical_stress_worst [Pa]", "critical stress, worst orientation, Pa", None)]
PAPER = 10  # granules


def populations(text):
    """NAME=granules.csv, or the table of a campaign of several kinds of granules: {name: (path, its rows)}."""
    name, _, path = text.rpartition("=")
    path = arguments.file(path)
    found = {}
    for one in campaign_files.rows(path):
        found.setdefault(name or one.get("dry.scene [1]") or path.parent.name, (path, []))[1].append(one)
    return found


def row(name, rows, column, words, place):
    values = [float(one[column]) for one in rows if one.get(column)]
    error = [float(one[key]) for one in rows if one.get(key := column.split(" [")[0] + "_error [relative]")]
    interval = lambda of, statistic: "" if (found := sample.bootstrap(values, statistic, f"{name} {column} {of}")) is None else f" ({found[0]:.4g} to {found[1]:.4g})"
    low, high = sample.quantile_interval(values, 0.5)
    if not values:
        return [name, words, "0", *["-"] * 8]
    mean, spread = float(sample.mean(values)), float(sample.spread(values)) if len(values) > 2 else math.nan
    try:
        fit = weibull.fit(values)
        modulus = f"{fit.modulus:.3g} ({fit.modulus_interval[0]:.3g} to {fit.modulus_interval[1]:.3g})"
    except weibull.Refusal:
        modulus = "-"
    paper = published.STRENGTH.get(name, {}).get(place[0], (None, None))[place[1]] if place else None
    distance = "" if paper is None or math.isnan(spread) else f"{(paper - mean) / (spread * (1 / PAPER + 1 / len(values)) ** 0.5):+.1f}"
    below = "" if paper is None else f"{100 * sum(value < paper for value in values) / len(values):.0f} %"
    # A mean and a spread of two say nothing.
    middle = f"{min(values):.4g} to {max(values):.4g}" if len(values) == 2 else f"{mean:.4g}{interval('mean', sample.mean)}"
    return [name, words, str(len(values)), middle, "-" if len(values) < 3 else f"{spread:.3g}{interval('spread', sample.spread)}",
            f"{sample.quantile(values, 0.5):.4g} ({'?' if low is None else f'{low:.4g}'} to {'?' if high is None else f'{high:.4g}'})",
            modulus if "critical" in words else "", f"{100 * sum(error) / len(error):.2g} %" if error else "", "" if paper is None else str(paper), below, distance]


def head(path, rows):
    """Commits and days of all granules, from their files."""
    import h5py
    commits, days = {}, {}
    for one in rows:
        for place in (f"dry/{one['id']}.h5", f"stress/{one.get('stress_id')}.h5"):
            if (path.parent / place).is_file():
                with h5py.File(path.parent / place) as file:
                    made = file["parameters/provenance"].attrs
                    commits[str(made["git"])[:7] + (" with changes" if made["dirty"] else "")] = days[str(made["created"])[:10]] = True
    return ", ".join(commits), ", ".join(days)


def campaign_of(path):
    """Its file, which the first line of its table names."""
    with path.open(encoding="utf-8") as file:
        return file.readline().removeprefix("# ").partition(":")[0]


def show(groups):
    print("# Populations\n")
    for name, (path, rows) in groups.items():
        commit, day = head(path, rows)
        cpu = {stage: [float(one[f"{stage}_cpu [s]"]) for one in rows if one.get(f"{stage}_cpu [s]")] for stage in ("dry", "stress")}
        print(f"{name}: `make -C pipeline campaign CAMPAIGN=pipeline/campaigns/{campaign_of(path)}`, commit {commit}, {day}, {processor()[0]}; {len(rows)} granules, "
              f"{sample.mean(cpu['dry']):.2g} s of CPU to dry one and {sample.mean(cpu['stress']):.2g} s to load it.\n")
    print_markdown(["granules", "quantity", "number", "mean", "spread", "median", "Weibull modulus", "numerical error", "the paper", "of ours below", "distance"],
                   [row(name, rows, *column) for name, (_, rows) in groups.items() for column in COLUMNS])
    print("\nIn brackets: 95 % intervals; two granules: lowest to highest. Numerical error: mean of what the runs state. Distance: of the paper's mean of ten granules from ours, in standard errors of\n"
          "both together; beyond 2 it is more than chance would have it in one of twenty cases. Rigid, particles of 100 nm, material of the paper's Table 1.")


def command_line():
    parser = arguments.parser(__doc__, "the table (default: printed)", required=False)
    parser.add_argument("tables", type=populations, nargs="+", metavar="[NAME=]GRANULES.csv", help="tables of campaigns; without NAME each kind of granule is a population")
    return parser


def main(options):
    with arguments.printing_to(options.out):
        show({name: of for table in options.tables for name, of in table.items()})


if __name__ == "__main__":
    main(command_line().parse_args())
