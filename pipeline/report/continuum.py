"""Concentration profiles of the continuum model (Fig. 5 of Vasquez Giuliano et al. 2022, dashed lines) as SVG:

    continuum.py --profile PECLET FILE.csv [--profile PECLET FILE.csv ...] -o OUT.svg

One panel for each Peclet number; FILE.csv is what `dryer continuum` writes.
"""

import argparse
import csv

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
    for axis, (peclet, name) in zip(axes[0], panels):
        for i, (theta, (rho, gamma)) in enumerate(read(name).items()):
            colour, dashes = LINES[i % len(LINES)]
            axis.plot(rho, gamma, color=colour, linestyle=dashes, label=f"θ = {theta}")
        axis.set(title=f"Pe = {peclet}", xlabel="r/R(t)", ylabel="C/C₀", xlim=(0, 1), ylim=(0, None))
        axis.legend(frameon=False)
    save(figure, out)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--profile", nargs=2, metavar=("PECLET", "FILE.csv"), action="append", required=True)
    parser.add_argument("-o", dest="out", metavar="OUT.svg", required=True)
    arguments = parser.parse_args()
    draw(arguments.profile, arguments.out)
