"""Figs 8 and 9 of Vasquez Giuliano et al. (2022) from the tables that strength.py writes:

    strength_figures.py FOLDER      (reads FOLDER/fig8.csv and fig9.csv, writes fig8.svg and fig9.svg)
"""

import csv
import pathlib
import statistics
import sys

import numpy

from figure import BLUE, GREEN, ORANGE, pyplot, save

STYLES = {"compact": (ORANGE, "o"), "hollow": (BLUE, "s"), "adhesive": (GREEN, "^")}
UNIT = "/(6πμγ̇a²)"


def read(path):
    """{population: {agglomerate: array of two columns}} in the order of the file."""
    found = {}
    with path.open(newline="") as file:
        rows = csv.reader(file)
        next(rows)
        for population, agglomerate, x, y in rows:
            found.setdefault(population, {}).setdefault(agglomerate, []).append((float(x), float(y)))
    return {p: {name: numpy.array(points) for name, points in of.items()} for p, of in found.items()}


def tension_against_radius(found, out):
    figure, axes = pyplot.subplots(figsize=(4.4, 3.2), layout="constrained")
    for population, agglomerates in found.items():
        colour, marker = STYLES.get(population, (GREEN, "^"))
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
        colour, _ = STYLES.get(population, (GREEN, "^"))
        for k, points in enumerate(agglomerates.values()):
            axes.plot(*points.T, color=colour, linewidth=1.4 if k == 0 else 0.5, alpha=1 if k == 0 else 0.35,
                      label=population if k == 0 else None)
        mean = statistics.fmean(points[:, 1].max() for points in agglomerates.values())
        axes.axhline(mean, color=colour, linestyle=":", linewidth=1.2)
    axes.set(xlabel="γ̇ t", ylabel="N_max" + UNIT, xlim=(0, 100), ylim=(0, None))
    axes.legend(frameon=False)
    save(figure, out)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    tension_against_radius(read(folder / "fig8.csv"), folder / "fig8.svg")
    tension_in_time(read(folder / "fig9.csv"), folder / "fig9.svg")
