"""Radial position of the particles, cumulative: Fig. 3 of Vasquez Giuliano et al. (2022).

Radius in nm from the centre of mass against the fraction of particles within it: mean over the granules, lowest and highest.
Beside FILE.svg is written FILE-NAME.csv for each group.

    distribution.py results/table2/granules.csv -o figure3.svg
"""

import numpy

import arguments
import crumble
import published
from figure import LINES, pyplot, save
from table import write_csv


def radii(name):
    position = crumble.read(name).particles().position
    return numpy.sort(numpy.linalg.norm(position - position.mean(axis=0), axis=1))


def distribution(names):
    """Grid in nm; mean, lowest and highest fraction within."""
    all_radii = [radii(name) for name in names]
    grid = numpy.arange(0, max(r[-1] for r in all_radii) + 1, 1.0)
    within = numpy.array([numpy.searchsorted(r, grid, side="right") / len(r) for r in all_radii])
    return grid, within.mean(axis=0), within.min(axis=0), within.max(axis=0)


def command_line():
    parser = arguments.parser(__doc__, "the figure", "FILE.svg")
    arguments.add_groups(parser, "rows of Table 2, each with its granules, files of dryer", names=published.GRANULES, campaign=("dry", ".h5"))
    return parser


def main(options):
    figure, axes = pyplot.subplots(figsize=(4.2, 3.2), layout="constrained")
    for (colour, dashes), (name, files) in zip(LINES, options.groups.items()):
        grid, mean, lowest, highest = distribution(files)
        write_csv(options.out.with_name(f"{options.out.stem}-{name}.csv"), ["radius_nm", "mean", "lowest", "highest"],
                  ([f"{x:g}", f"{m:.4f}", f"{a:.4f}", f"{b:.4f}"] for x, m, a, b in zip(grid, mean, lowest, highest)))
        axes.plot(grid, mean, color=colour, linestyle=dashes, label=published.GRANULES[name]["title"])
        axes.fill_between(grid, lowest, highest, color=colour, alpha=0.2, linewidth=0)
    axes.set(xlabel="distance from the centre of mass, nm", ylabel="fraction of particles within", xlim=(0, None), ylim=(0, 1.02))
    axes.legend(frameon=False)
    save(figure, options.out)


if __name__ == "__main__":
    main(command_line().parse_args())
