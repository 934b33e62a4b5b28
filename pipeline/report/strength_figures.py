"""Figs 8 and 9 of Vasquez Giuliano et al. (2022), from the granules of a campaign that were loaded in elongation and shear.

In the folder are written fig8.svg (tension of every contact against its distance from the centre of mass, settled in elongation), fig9.svg (N_max
of the most loaded orbit against time, in shear), and the points of both as CSV.

    strength_figures.py results/strength/granules.csv -o results/strength
"""

import json
import math
import statistics

import numpy

import arguments
import campaign_files
import crumble
from figure import BLUE, GREEN, ORANGE, pyplot, save
from interval import half_width
from table import write_csv

STYLES = {"compact": (ORANGE, "o", "--"), "hollow": (BLUE, "s", "-"), "adhesive": (GREEN, "^", "-.")}
OTHER = (GREEN, "^", "-.")
UNIT = "/(6πμγ̇a²)"


def unit(granule):
    """6 pi a^2 times the flow stress of 1 Pa that stored tensions belong to, N."""
    report = json.loads(granule.file("stress", ".json").read_text())
    return 6 * math.pi * (1e-9 * report["results"]["particle_radius_nm"]) ** 2


def read(path, flow, abscissa, ordinate):
    """{kind: {granule: array of two columns}}"""
    found = {}
    for granule in campaign_files.read(path, "stress"):
        loads = crumble.read(granule.file("stress", ".h5"))
        found.setdefault(granule.kind, {})[granule.name] = numpy.array(
            [loads[f"flows/{flow}/{abscissa}"], loads[f"flows/{flow}/{ordinate}"] / unit(granule)]).T
    return found


def write(path, heading, found):
    write_csv(path, ["kind", "granule", *heading], ([kind, name, f"{x:.5g}", f"{y:.5g}"] for kind, granules in found.items()
                                                    for name, points in granules.items() for x, y in points))


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
    parser = arguments.parser(__doc__, "where figures and points go", "FOLDER")
    parser.add_argument("table", type=arguments.file, metavar="GRANULES.csv", help="of the campaign")
    return parser


def main(options):
    contacts = read(options.table, "elongation", "radial_position", "normal_force")
    instants = read(options.table, "shear", "time", "max_tension")
    write(options.out / "fig8.csv", ["radial_position [nm]", "tension [6 pi mu gamma_dot a^2]"], contacts)
    write(options.out / "fig9.csv", ["gamma_dot t [1]", "n_max [6 pi mu gamma_dot a^2]"], instants)
    tension_against_radius(contacts, options.out / "fig8.svg")
    tension_in_time(instants, options.out / "fig9.svg")


if __name__ == "__main__":
    main(command_line().parse_args())
