"""Fig 8 or 9 of Vasquez Giuliano et al. (2022) from the table of its points that strength.py writes.

    strength_figures.py fig8.csv -o fig8.svg
"""

import csv
import statistics

import numpy

import arguments
from figure import BLUE, GREEN, ORANGE, pyplot, save
from interval import half_width

STYLES = {"compact": (ORANGE, "o", "--"), "hollow": (BLUE, "s", "-"), "adhesive": (GREEN, "^", "-.")}
OTHER = (GREEN, "^", "-.")
UNIT = "/(6πμγ̇a²)"


def read(path):
    """{population: {agglomerate: array of two columns}} in the order of the file; name of the first column."""
    found = {}
    with path.open(newline="") as file:
        rows = csv.reader(file)
        abscissa = next(rows)[2]
        for population, agglomerate, x, y in rows:
            found.setdefault(population, {}).setdefault(agglomerate, []).append((float(x), float(y)))
    return {p: {name: numpy.array(points) for name, points in of.items()} for p, of in found.items()}, abscissa


def tension_against_radius(found, out):
    figure, axes = pyplot.subplots(figsize=(4.4, 3.2), layout="constrained")
    for population, agglomerates in found.items():
        colour, marker, _ = STYLES.get(population, OTHER)
        for k, points in enumerate(agglomerates.values()):
            axes.plot(*points.T, marker, color=colour, markersize=3.5 if k == 0 else 1.2, alpha=1 if k == 0 else 0.25,
                      fillstyle="none" if k == 0 else "full", linestyle="", label=population if k == 0 else None,
                      zorder=3 if k == 0 else 1, rasterized=k > 0)
    axes.axhline(0, color="#888888", linewidth=0.6)
    axes.set(xlabel="distance from the centre of mass, nm", ylabel="N" + UNIT, xlim=(0, None))
    axes.legend(frameon=False)
    save(figure, out)


def tension_in_time(found, out):
    figure, axes = pyplot.subplots(figsize=(5.2, 3.2), layout="constrained")
    for population, agglomerates in found.items():
        colour, _, dashes = STYLES.get(population, OTHER)
        for k, points in enumerate(agglomerates.values()):
            axes.plot(*points.T, color=colour, linestyle=dashes, linewidth=1.4 if k == 0 else 0.5, alpha=1 if k == 0 else 0.35,
                      label=population if k == 0 else None)
        largest = [points[:, 1].max() for points in agglomerates.values()]
        mean = statistics.fmean(largest)
        axes.axhline(mean, color=colour, linestyle=":", linewidth=1.2)
        if len(largest) > 1:
            half = half_width(largest)
            axes.axhspan(*((min(largest), max(largest)) if len(largest) == 2 else (mean - half, mean + half)), color=colour, alpha=0.12, linewidth=0, zorder=0)
    axes.set(xlabel="γ̇ t", ylabel="N_max" + UNIT, xlim=(0, 100), ylim=(0, None))
    axes.legend(frameon=False)
    save(figure, out)


def command_line():
    parser = arguments.parser(__doc__, "the figure", "FILE.svg")
    parser.add_argument("points", type=arguments.file, metavar="POINTS.csv", help="fig8.csv or fig9.csv")
    return parser


def main(options):
    found, abscissa = read(options.points)
    (tension_against_radius if abscissa == "radial_position_nm" else tension_in_time)(found, options.out)


if __name__ == "__main__":
    main(command_line().parse_args())
