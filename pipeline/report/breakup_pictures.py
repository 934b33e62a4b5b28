"""One breakup in pictures (Figs 6 and 7 of Vasquez Giuliano et al. 2022): snapshots as a strip, courses against flow stress.

The strip looks along y, so that elongation and shear lie in the page; spheres are coloured by their number of contacts; each snapshot has its flow
stress and its time.

    breakup_pictures.py results/hollow-1-break.h5 -o results/hollow-1-break
"""
import h5py
import matplotlib
import numpy

import arguments
import whole
from figure import BLACK, BLUE, GREEN, ORANGE, pyplot, save
from matplotlib.collections import PatchCollection
from matplotlib.patches import Circle
from picture import in_time, length

SNAPSHOTS = 6


def chosen(stress, broken, count):
    """Frames at even stresses, the last one before breakup, and the end."""
    last = len(stress) - 1
    whole = [k for k in range(last) if stress[k] <= stress[last]]
    if broken and len(whole) > 1:
        inner = [int(abs(stress[whole] - stress[whole[-1]] * part).argmin()) for part in numpy.linspace(0, 1, count - 1)]
    else:
        inner = [int(abs(stress - stress[last] * part).argmin()) for part in numpy.linspace(0, 1, count)[:-1]]
    return sorted({*inner, last})


def draw(axes, x, radius, contacts, colours):
    order = numpy.argsort(-x[:, 1])  # far ones first: y points away from the reader
    for shade, size, shift in ((0.0, 1.0, 0.0), (0.35, 0.55, 0.25), (0.75, 0.18, 0.4)):
        # Layer by layer would let the lights of far spheres shine through near ones: z-order goes with depth.
        for rank, p in enumerate(order):
            face = numpy.array(colours(contacts[p]))
            face[:3] += shade * (1 - face[:3])
            place = x[p, [0, 2]] + shift * radius[p] * numpy.array([-1, 1]) / numpy.sqrt(2)
            axes.add_collection(PatchCollection([Circle(place, size * radius[p])], facecolors=[face],
                                                edgecolors=BLACK if shift == 0 else "none", linewidths=0.3,
                                                zorder=2 + 3 * rank + 4 * shift))


def strip(path, out):
    with h5py.File(path) as file:
        stress = file["observables/flow_stress/value"][:]
        frames = chosen(stress, file["h5md/modules/agglomerate"].attrs["state"] in ("broken", b"broken"), SNAPSHOTS)
        radius, offset = file["particles/all/radius"][:], file["contacts/offset"][:]
        time, unit = in_time(file["particles/all/position/time"][:])
        snapshots = []
        for k in frames:
            pairs = file["contacts/pair"][offset[k]:offset[k + 1]]
            x, label = file["particles/all/position/value"][k], file["particles/all/fragment/value"][k]
            largest = numpy.bincount(label).argmax()
            snapshots.append((f"{stress[k]:.0f} Pa, {time[k]:.3g} {unit}", x - x[label == largest].mean(axis=0),
                              numpy.bincount(pairs.ravel(), minlength=len(radius))))
    # One scale for all panels; pieces of the end may be far away and are cut off.
    wide, high = (1.1 * max(abs(x[:, axis]).max() for _, x, _ in (snapshots[:-1] or snapshots)) + 2 * radius.max()
                  for axis in (0, 2))
    figure, panels = pyplot.subplots(1, len(snapshots), squeeze=False,
                                     figsize=(2.6 * len(snapshots), 2.6 * high / wide + 0.5))
    colours = matplotlib.colormaps["cividis"]
    most = max(8, max(contacts.max() for _, _, contacts in snapshots))
    for axes, (title, x, contacts) in zip(panels[0], snapshots):
        draw(axes, x, radius, contacts, lambda c: colours(c / most))
        axes.set(xlim=(-wide, wide), ylim=(-high, high), aspect="equal", xticks=[], yticks=[], title=title)
        for side in axes.spines.values():
            side.set_visible(False)
    first = panels[0][0]
    bar = 10 ** numpy.floor(numpy.log10(wide))
    first.plot([-0.95 * wide, -0.95 * wide + bar], [-0.95 * high] * 2, color=BLACK, linewidth=2)
    first.text(-0.95 * wide, -0.9 * high, f"{length(bar)}; particles of radius {length(radius.mean())}", fontsize=8)
    shades = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, most), colours)
    figure.colorbar(shades, ax=list(panels[0]), fraction=0.02, pad=0.01, label="contacts of a particle")
    with whole.replacing(out) as temporary:
        figure.savefig(temporary, format="png", dpi=150, bbox_inches="tight")
    pyplot.close(figure)


def course(path, out):
    with h5py.File(path) as file:
        series = {name: file[f"series/{name}/value"][:] for name in file["series"]}
        critical = file["breakup/critical_stress"][()] if "breakup/critical_stress" in file else None
        error = file["errors/critical_stress"][()] if "errors/critical_stress" in file else 0.0
    stress, size = series["flow_stress"], series["radius_of_gyration"][0]
    factor, unit = (1e-3, "µm") if size >= 1000 else (1, "nm")
    figure, (shape, contacts, limits) = pyplot.subplots(1, 3, figsize=(12, 3.6), constrained_layout=True)
    for name, label, colour, dashes in (("semi_axis_largest", "largest semi-axis", ORANGE, "-"),
                                        ("semi_axis_middle", "middle semi-axis", GREEN, "--"),
                                        ("semi_axis_smallest", "smallest semi-axis", BLUE, "-."),
                                        ("radius_of_gyration", "radius of gyration", BLACK, ":")):
        shape.plot(stress, factor * series[name], dashes, color=colour, label=label)
    shape.set(ylabel=f"size of the largest piece, {unit}", ylim=(0, 4 * factor * size))
    contacts.plot(stress, series["contacts"], color=BLUE, label="contacts")
    contacts.plot(stress, series["largest_fragment"], "--", color=ORANGE, label="particles, largest fragment")
    contacts.set(ylabel="number", ylim=(0, None))
    for name, colour, dashes in (("slipping", GREEN, "--"), ("twisting", BLUE, "-."), ("rolling", ORANGE, "-")):
        limits.plot(stress, series[name], dashes, color=colour, label=f"{name} contacts")
    limits.set(ylabel="number at their limit", ylim=(0, None))
    for axes in (shape, contacts, limits):
        if critical is not None:
            axes.axvline(critical, color=BLACK, linewidth=0.6, zorder=0)
            axes.axvspan(critical * (1 - error), critical * (1 + error), color=BLACK, alpha=0.2, linewidth=0, zorder=0)
        axes.set(xlabel="flow stress, Pa", xlim=(0, None))
        axes.legend(frameon=False, fontsize=8)
    save(figure, out)


def command_line():
    parser = arguments.parser(__doc__, "pictures STEM-strip.png and STEM-course.svg", "STEM")
    parser.add_argument("breakup", type=arguments.file, metavar="BREAKUP.h5", help="of breaker")
    return parser


def main(options):
    strip(options.breakup, f"{options.out}-strip.png")
    course(options.breakup, f"{options.out}-course.svg")
    print(f"pictures: {options.out}-strip.png (Fig 6), {options.out}-course.svg (Fig 7)")


if __name__ == "__main__":
    main(command_line().parse_args())
