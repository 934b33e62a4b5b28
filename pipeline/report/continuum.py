"""Concentration profiles of the continuum model as SVG (Fig. 5 of Vasquez Giuliano et al. 2022, dashed lines).

One panel for each file that `dryer continuum` writes; NAME is its Peclet number.

    continuum.py 1=continuum-1.csv 10=continuum-10.csv -o continuum.svg
"""

import csv
import sys

import arguments
from figure import LINES, pyplot, save


def read(name):
    """{theta: ([rho], [gamma])} in the order of the file."""
    profiles = {}
    with open(name, newline="") as file:
        for row in csv.DictReader(file):
            rho, gamma = profiles.setdefault(row["theta"], ([], []))
            rho.append(float(row["rho"]))
            gamma.append(float(row["gamma"]))
    return profiles


def draw(panels, out):
    figure, axes = pyplot.subplots(1, len(panels), figsize=(3.2 * len(panels), 2.8), squeeze=False, layout="constrained")
    for axis, (peclet, (name, *more)) in zip(axes[0], panels.items()):
        if more:
            sys.exit(f"{peclet}: one file for each Peclet number, please")
        for i, (theta, (rho, gamma)) in enumerate(read(name).items()):
            colour, dashes = LINES[i % len(LINES)]
            axis.plot(rho, gamma, color=colour, linestyle=dashes, label=f"θ = {theta}")
        axis.set(title=f"Pe = {peclet}", xlabel="r/R(t)", ylabel="C/C₀", xlim=(0, 1), ylim=(0, None))
        axis.legend(frameon=False)
    save(figure, out)


def command_line():
    parser = arguments.parser(__doc__, "the figure", "FILE.svg")
    arguments.add_groups(parser, "Peclet numbers, each with its file")
    return parser


def main(options):
    draw(options.groups, options.out)


if __name__ == "__main__":
    main(command_line().parse_args())
