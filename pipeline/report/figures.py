"""Figures of one result file, and of several beside each other; errors that the files state are drawn.

    figures.py results/hollow-1.h5 -o results/hollow-1
"""

import os

import h5py
import numpy

import arguments
import breakup_pictures
from figure import BLACK, BLUE, LINES, ORANGE, pyplot, save
from headline import flow_title
from picture import in_time

MARKS = "osD^v<>"


def drying(file, out):
    """The course of a drying, and where the particles are at its end."""
    course = file["observables"]
    time, unit = in_time(file["particles/all/position/time"][:])
    has_places = "morphology/radial_position" in file  # not in every file of earlier programs
    figure, panels = pyplot.subplots(1, 2 + has_places, figsize=(11, 3.2), layout="constrained")
    size, contacts = panels[:2]
    droplet = course["droplet_radius/value"][:]
    factor, of_length = (1e-3, "µm") if droplet[0] >= 1000 else (1, "nm")
    size.plot(time, factor * droplet, "-", color=BLUE, label="droplet, radius")
    size.plot(time, factor * course["radius_of_gyration/value"][:], "--", color=ORANGE, label="particles, radius of gyration")
    if "morphology/diameter" in file:
        radius = factor * file["morphology/diameter"][()] / 2
        error = file["errors/d_c"][()] * radius if "errors/d_c" in file else None
        size.errorbar(time[-1], radius, error, fmt="o", color=BLACK, capsize=3, label="granule, d_c/2" + (" ± error" if error is not None else ""))
    size.set(xlabel=f"time, {unit}", ylabel=of_length, ylim=(0, None))
    contacts.plot(time, course["coordination_number/value"][:], color=BLUE)
    contacts.set(xlabel=f"time, {unit}", ylabel="mean number of contacts of a particle", ylim=(0, None))
    if has_places:
        r = factor * file["morphology/radial_position"][:]
        panels[2].step([0, *r], [0, *(numpy.arange(1, len(r) + 1) / len(r))], where="post", color=BLUE)
        panels[2].set(xlabel=f"distance from the centre of mass, {of_length}", ylabel="share of the particles within", ylim=(0, 1), xlim=(0, None))
    size.legend(frameon=False, fontsize=8)
    save(figure, out)


def loads(file, out):
    """Tension of each contact in each flow, and the largest along the worst orbit, with the error that the file states."""
    error = float(file["response/error"][()]) if "response/error" in file else 0.0
    flows = {name: group for name, group in file["flows"].items() if "normal_force" in group}
    factor, of_length = (1e-3, "µm") if max(group["radial_position"][:].max() for group in flows.values()) >= 1000 else (1, "nm")
    orbits = {name: group for name, group in flows.items() if "max_tension" in group}
    figure, panels = pyplot.subplots(1, 1 + bool(orbits), figsize=(11 if orbits else 6, 3.4), layout="constrained", squeeze=False)
    for k, (name, group) in enumerate(flows.items()):
        tension, radial = group["normal_force"][:] * 1e12, factor * group["radial_position"][:]
        colour = LINES[k % len(LINES)][0]
        panels[0][0].plot(radial, tension, MARKS[k % len(MARKS)], color=colour, markersize=3, alpha=0.5, label=flow_title(name))
        top = tension.argmax()
        panels[0][0].errorbar(radial[top], tension[top], error * tension[top], fmt=MARKS[k % len(MARKS)], color=colour, markersize=5, capsize=4)
    panels[0][0].axhline(0, color="#888888", linewidth=0.6)
    panels[0][0].set(xlabel=f"distance of the contact from the centre of mass, {of_length}", ylabel="tension at µγ̇ = 1 Pa, pN", xlim=(0, None))
    panels[0][0].legend(frameon=False, fontsize=8)
    for k, (name, group) in enumerate(orbits.items()):
        time, tension = group["time"][:], group["max_tension"][:] * 1e12
        colour, dashes = LINES[k % len(LINES)]
        panels[0][1].plot(time, tension, linestyle=dashes, color=colour, label=flow_title(name))
        panels[0][1].fill_between(time, tension * (1 - error), tension * (1 + error), color=colour, alpha=0.25, linewidth=0)
        panels[0][1].set(xlabel="time at γ̇ = 1/s, s", ylabel="largest tension at µγ̇ = 1 Pa, pN", xlim=(time[0], time[-1]))
        panels[0][1].legend(frameon=False, fontsize=8)
    save(figure, out)


def compared(files, out):
    """[(name, [Result])]: each number that all of them have, one point a file, with its error."""
    common = [r for r in files[0][1] if all(any(o.key == r.key for o in results) for _, results in files)]
    common = [r for r in common if isinstance(r.value, float) or r.key == "contacts"][:4]
    figure, panels = pyplot.subplots(1, len(common), figsize=(2.9 * len(common), 1.2 + 0.24 * len(files)), layout="constrained",
                                     squeeze=False, sharey=True)
    for axes, wanted in zip(panels[0], common):
        for k, (_, results) in enumerate(files):
            found = next(r for r in results if r.key == wanted.key)
            axes.errorbar(found.value, -k, xerr=abs((found.relative or 0) * found.value), fmt="o" if found.relative is not None else "x",
                          color=BLUE, capsize=3, markersize=5)
        axes.set(xlabel=wanted.title + (f", {wanted.unit}" if wanted.unit else ""), yticks=[-k for k in range(len(files))],
                 yticklabels=[name for name, _ in files])
        axes.margins(x=0.15, y=0.5 / len(files))
        axes.grid(axis="x", color="#dddddd", linewidth=0.6)
    save(figure, out)


def drawn(path, stem):
    """[(file, caption)] of the figures that this file has."""
    out = lambda ending: stem.with_name(f"{stem.name}-{ending}")
    with h5py.File(path) as file:
        if "observables/flow_stress" in file:
            breakup_pictures.strip(path, out("strip.png"))
            breakup_pictures.course(path, out("course.svg"))
            return [(out("strip.png"), "Snapshots at growing flow stress, seen along y; colour: contacts of each particle."),
                    (out("course.svg"), "The largest piece against the flow stress. Band: critical stress ± its error.")]
        if "observables/droplet_radius" in file:
            drying(file, out("drying.svg"))
            return [(out("drying.svg"), "The drying, and where the particles are at its end. Bar: the error of d_c, where the file states one.")]
        if "flows" in file:
            loads(file, out("loads.svg"))
            return [(out("loads.svg"), "Tension of each contact; positive: pulled. Large symbol: the largest; bars and bands: the error that the file states.")]
    return []


def command_line():
    parser = arguments.parser(__doc__, "figures STEM-drying.svg, STEM-loads.svg, or STEM-strip.png and STEM-course.svg", "STEM")
    parser.add_argument("file", type=arguments.file, metavar="RESULT.h5", help="of any program")
    return parser


def main(options):
    for path, _ in drawn(options.file, options.out):
        print(os.fspath(path))


if __name__ == "__main__":
    main(command_line().parse_args())
