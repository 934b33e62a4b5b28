"""Concentration in the shrinking droplet, particles beside the continuum model: Fig. 5 of Vasquez Giuliano et al. (2022).

Two comparisons for each theta, both with the same estimator on both sides:
raw         as the paper draws it: r/R(t), against the continuum of points that reach R(t);
accessible  r over the radius that centres reach, against the continuum of a droplet whose wall is there.
Estimators: that of the paper (a particle with the 20 before and the 20 after it) and ten shells of equal volume. Concentrations
are over that of all particles spread evenly over the volume compared, times (1 - theta)^(-3/2): Gamma of the paper.
Beside FILE.md are written FILE.csv and FILE.svg. The Peclet number is that of the granules.

    concentration.py compact=results/table2/granules.csv --dryer build/release/bin/dryer -o figure5.md
"""

import csv
import io
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

import h5py
import numpy

import arguments
import scene
from figure import LINES, pyplot, save
from table import print_markdown, write_csv

THETA = (0.0, 0.2, 0.4)
NEIGHBOURS = 20
SHELLS = 10
SAMPLES = 4000  # drawings of the continuum; their own error is a tenth of that of 25 granules
BOLTZMANN = 1.380649e-23


def accessible(radius, droplet, tension, temperature):
    """Radius within which as many centres fit as the surface lets through, m: the surface as a soft wall, its energy that of
    Eq. 8, integrated from first touch (offset -a): R - a + integral of exp(-U/kT)."""
    x = numpy.linspace(0, 1, 20001)[1:] * radius  # depth beyond first touch
    offset = x - radius
    energy = math.pi * tension * (offset * numpy.sqrt(radius**2 - offset**2) +
                                  radius**2 * (numpy.arcsin(offset / radius) + math.pi / 2))
    passes = numpy.exp(-energy / (BOLTZMANN * temperature))
    return droplet - radius + 0.5 * numpy.sum((passes[1:] + passes[:-1]) * numpy.diff(x))  # trapezoidal rule


def liquid(of):
    """Of a scene: what the tension of the surface is worth on a sphere (Eq. 8 with the factor of the contact angle), N/m, and kelvins."""
    angle = math.radians(scene.number(of, "fluid", "contact_angle"))
    return scene.number(of, "fluid", "surface_tension") * math.cos(angle / 2) ** 2, scene.number(of, "fluid", "temperature")


def read(names):
    """{theta: (radius of the droplet, centres' distances of each granule)}, in metres; Peclet number; radius of the particles, m; what liquid() gives."""
    found, kinds = {}, set()
    for name in names:
        with h5py.File(name) as file:
            a = 1e-9 * file["particles/all/radius"][0]
            of = scene.resolved(file)
            kinds.add((scene.number(of, "droplet", "peclet"), a, *liquid(of)))
            R = 1e-9 * file["observables/droplet_radius/value"][:]
            theta = 1 - (R / R[0]) ** 2
            for wanted in THETA:
                frame = int(numpy.abs(theta - wanted).argmin())
                if abs(theta[frame] - wanted) > 0.005:
                    sys.exit(f"{name}: no frame at theta = {wanted}; set output.theta = [0.2, 0.4] in its scene")
                r = 1e-9 * numpy.linalg.norm(file["particles/all/position/value"][frame], axis=1)
                found.setdefault(wanted, (R[frame], []))[1].append(numpy.sort(r))
    if len(kinds) > 1:
        sys.exit(f"{names[0]} and others: Peclet numbers, particles or liquids differ")
    return found, *kinds.pop()


def continuum(dryer, peclet, theta):
    """rho and Gamma of the continuum model, by the program."""
    if theta <= 0:
        return numpy.array([0.0, 1.0]), numpy.array([1.0, 1.0])
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "profile.csv"
        subprocess.run([dryer, "continuum", "--peclet", str(peclet), "--theta", str(theta), "-o", out], check=True,
                       stdout=subprocess.DEVNULL)
        rows = list(csv.DictReader(io.StringIO(out.read_text())))
    return numpy.array([float(row["rho"]) for row in rows]), numpy.array([float(row["gamma"]) for row in rows])


def drawings(rho, gamma, particles, count):
    """`count` sets of sorted r/R, independent points of the density rho^2 Gamma."""
    fine = numpy.linspace(0, 1, 20001)
    density = fine**2 * numpy.interp(fine, rho, gamma)
    within = numpy.concatenate([[0], numpy.cumsum((density[1:] + density[:-1]) / 2)])
    keys = numpy.random.Generator(numpy.random.Philox(1)).random((count, particles))
    return numpy.sort(numpy.interp(keys, within / within[-1], fine), axis=1)


def neighbours(x):
    """Mean radius and concentration of the n-th particle: 41 of N in its shell, over N in the unit sphere. Rows: sets."""
    inner, outer = x[:, :-2 * NEIGHBOURS], x[:, 2 * NEIGHBOURS:]
    value = (2 * NEIGHBOURS + 1) / x.shape[1] / (outer**3 - inner**3)
    return x[:, NEIGHBOURS:-NEIGHBOURS].mean(axis=0), value


def shells(x):
    edges = numpy.linspace(0, 1, SHELLS + 1) ** (1 / 3)
    count = numpy.array([numpy.histogram(row, edges)[0] for row in x])
    return (numpy.linspace(0.5, SHELLS - 0.5, SHELLS) / SHELLS) ** (1 / 3), count * SHELLS / x.shape[1]


def compare(x, rho, gamma, theta):
    """Rows (estimator, place, value, its standard error, continuum) in Gamma."""
    model = drawings(rho, gamma, x.shape[1], SAMPLES)
    scale = (1 - theta) ** -1.5
    rows = []
    for name, estimate in (("neighbours", neighbours), ("shells", shells)):
        place, value = estimate(x)
        _, expected = estimate(model)
        error = expected.std(axis=0) / math.sqrt(len(x))
        rows += [(name, *row) for row in zip(place, scale * value.mean(axis=0), scale * error, scale * expected.mean(axis=0))]
    return rows


def comparisons(dryer, granules, peclet, a, tension, temperature):
    R0 = granules[0.0][0]
    reached0 = R0 - a  # the start is fully immersed
    for theta, (R, radii) in granules.items():
        x = numpy.array(radii)
        yield theta, "raw", compare(x / R, *continuum(dryer, peclet, theta), theta)
        reached = accessible(a, R, tension, temperature) if theta > 0 else reached0
        # A wall at R - d moves like one of a droplet with Pe (1 - d/R); d/R is taken half-way.
        slower = 1 - (R0 - reached0) / R0 / 2 - (R - reached) / R / 2
        inner = 1 - (reached / reached0) ** 2
        inside = numpy.minimum(x / reached, 1)
        yield theta, "accessible", compare(inside, *continuum(dryer, peclet * slower if theta > 0 else peclet, inner), inner)


def deviation(rows, estimator):
    """Root mean square of the difference, relative and in standard errors."""
    mine = [row for row in rows if row[0] == estimator]
    relative = math.sqrt(statistics.fmean(((v - m) / m) ** 2 for _, _, v, _, m in mine))
    return relative, math.sqrt(statistics.fmean(((v - m) / e) ** 2 for _, _, v, e, m in mine))


def draw(found, out):
    panels = [(peclet, kind) for peclet in found for kind in ("raw", "accessible")]
    figure, axes = pyplot.subplots(2, len(found), figsize=(3.6 * len(found), 5.6), squeeze=False, layout="constrained")
    for peclet, kind in panels:
        axis = axes[("raw", "accessible").index(kind)][list(found).index(peclet)]
        for (theta, which), rows in found[peclet].items():
            if which != kind:
                continue
            colour, _ = LINES[THETA.index(theta)]
            estimator = "neighbours" if kind == "raw" else "shells"
            place, value, error, model = (numpy.array(c) for c in list(zip(*[r for r in rows if r[0] == estimator]))[1:])
            if kind == "raw":
                axis.plot(place, value, "-", color=colour, label=f"θ = {theta:g}")
                axis.fill_between(place, value - 2 * error, value + 2 * error, color=colour, alpha=0.15, linewidth=0)
            else:
                axis.errorbar(place, value, 2 * error, fmt="o", color=colour, capsize=2, markersize=3, label=f"θ = {theta:g}")
            axis.plot(place, model, "--", color=colour)
        axis.set(title=f"Pe = {peclet:g}", xlim=(0, 1), ylim=(0, None), ylabel="C/C₀",
                 xlabel="r/R(t)" if kind == "raw" else "r over the radius that centres reach")
        axis.legend(frameon=False, fontsize=8)
    save(figure, out)


def command_line():
    parser = arguments.parser(__doc__, "the table", "FILE.md")
    parser.add_argument("--dryer", type=arguments.file, required=True, help="the program, which computes the continuum model")
    arguments.add_groups(parser, "granules of one Peclet number each, files of dryer", campaign=("dry", ".h5"))
    return parser


def main(options):
    found = {}
    for name, files in options.groups.items():
        granules, peclet, *rest = read(files)
        if peclet in found:
            sys.exit(f"{name}: another group has Pe = {peclet:g}, too")
        found[peclet] = {(theta, kind): rows for theta, kind, rows in comparisons(options.dryer, granules, peclet, *rest)}
    write_csv(options.out.with_suffix(".csv"), ["peclet", "theta", "radius", "estimator", "place", "gamma", "standard_error", "continuum"],
              ([peclet, theta, kind, name, *(f"{v:.5g}" for v in rest)] for peclet, sets in found.items()
               for (theta, kind), rows in sets.items() for name, *rest in rows))
    draw(found, options.out.with_suffix(".svg"))
    with arguments.printing_to(options.out):
        show(found)


def show(found):
    cells = lambda relative, errors: [f"{100 * relative:.1f} %", f"{errors:.1f}"]
    print_markdown(["Pe", "theta", "radius", "41 neighbours: rms difference", "in standard errors", "ten shells", "in standard errors"],
                   [[f"{peclet:g}", f"{theta:g}", kind, *cells(*deviation(rows, "neighbours")), *cells(*deviation(rows, "shells"))]
                    for peclet, sets in found.items() for (theta, kind), rows in sets.items()])
    print("\nDifference of the particles to the continuum. Neighbouring values of the 41-particle estimator share particles.")


if __name__ == "__main__":
    main(command_line().parse_args())
