"""Radius, temperature and Peclet number of a droplet in its gas against time, as SVG.

Takes what `dryer conditions -o` writes; several files make several curves, named in a legend.

    conditions.py air.csv -o air.svg
"""

import csv

import arguments
from figure import LINES, pyplot, save

PANELS = (("radius_m", 1e6, "R / µm"), ("temperature_k", 1, "T / K"), ("peclet", 1, "Pe = k/D"))


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    return {name: [row[name] for row in rows] for name in rows[0]}


def draw(files, out):
    figure, axes = pyplot.subplots(1, len(PANELS), figsize=(3.2 * len(PANELS), 2.8), layout="constrained")
    for i, path in enumerate(files):
        course = read(path)
        colour, dashes = LINES[i % len(LINES)]
        for axis, (name, factor, _) in zip(axes, PANELS):
            axis.plot(course["time_s"], [factor * value for value in course[name]], color=colour, linestyle=dashes,
                      label=path.stem)
    for axis, (_, _, label) in zip(axes, PANELS):
        axis.set(xlabel="t / s", ylabel=label, xlim=(0, None))
    axes[0].set(ylim=(0, None))
    if len(files) > 1:
        axes[0].legend(frameon=False)
    save(figure, out)


def command_line():
    parser = arguments.parser(__doc__, "the figure", "FILE.svg")
    arguments.add_files(parser, "what dryer conditions -o wrote, one curve each", "FILE.csv")
    return parser


def main(options):
    draw(options.files, options.out)


if __name__ == "__main__":
    main(command_line().parse_args())
