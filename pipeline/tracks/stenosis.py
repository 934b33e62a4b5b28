"""Histories of the velocity gradient through a narrowed vessel, from diameters, flow and liquid.

The vessel is a tube of radius R(x) = R0 [1 - n/2 (1 + cos(2 pi x/L))] for |x| < L/2 and R0 elsewhere, n being the narrowing of the diameter and L its
length. Where R changes slowly the flow is Poiseuille's at every place (lubrication theory; Manton 1971, J. Fluid Mech. 49, 451; MacDonald 1978, J. Appl.
Mech. 45, 475): with s = r/R(x) and U = 2 Q/(pi R^2)

    u_x = U (1 - s^2),   u_r = u_x s R',

which conserves mass exactly, so that a granule stays at its s. Near the wall it is sheared, 2 U s/R, and on the axis stretched where the vessel
narrows, -2 U R'/R. A granule is taken to follow the liquid: it must be much smaller than the vessel, and heavy ones drift.

What is left out: inertia of the liquid, which changes the shear rate at the wall by -Re R'/12 of it to first order (Re = 2 R U/(2 nu); derived and tested in
tests/pipeline/test_vessels.py), terms of the order R'^2, pulsation, red blood cells, and that blood is not Newtonian. The program prints the first
two. Beyond some 0.3 the flow separates behind the narrowing and forms a jet: take tracks of a simulation then (convert.py reads them).

    stenosis.py --diameter 300e-6 --narrowing 0.5 --length 1.2e-3 --flow 5e-9 --viscosity 3.5e-3 --density 1060 --position 0.9 -o near-wall.csv
    stenosis.py --diameter 300e-6 --narrowing 0.5 --length 1.2e-3 --flow 5e-9 --viscosity 3.5e-3 --density 1060 --tracks 20 -o tracks
"""

import dataclasses
import sys

import numpy

import passage


@dataclasses.dataclass(frozen=True)
class Vessel:
    """Lengths in m, flow in m3/s."""
    diameter: float
    narrowing: float  # of the diameter, 0 to below 1
    length: float     # of the narrowed part
    flow: float

    def radius(self, x):
        """R, R' and R'' at x, m; the throat is at 0."""
        k = 2 * numpy.pi / self.length
        inside = abs(x) < self.length / 2
        depth = numpy.where(inside, self.narrowing * self.diameter / 4, 0)
        return (self.diameter / 2 - depth * (1 + numpy.cos(k * x)), depth * k * numpy.sin(k * x), depth * k**2 * numpy.cos(k * x))

    def centre_speed(self, x):
        return 2 * self.flow / (numpy.pi * self.radius(x)[0] ** 2)

    def velocity(self, x, s):
        """Along the axis and away from it, m/s."""
        along = self.centre_speed(x) * (1 - s**2)
        return along, along * s * self.radius(x)[1]

    def gradient(self, x, s):
        """... x 3 x 3, 1/s: x along the axis, y away from it through the granule, z across both."""
        R, slope, curvature = self.radius(x)
        U, p = self.centre_speed(x), 1 - s**2
        found = numpy.zeros((*numpy.shape(U), 3, 3))
        found[..., 0, 0] = 2 * U * slope / R * (2 * s**2 - 1)
        found[..., 0, 1] = -2 * U * s / R
        found[..., 1, 0] = U / R * ((R * curvature - 2 * slope**2) * s * p - slope**2 * s * (1 - 3 * s**2))
        found[..., 1, 1] = U * slope / R * (1 - 3 * s**2)
        found[..., 2, 2] = U * slope / R * p
        return found

    def wall_shear_rate(self, x):
        return 2 * self.centre_speed(x) / self.radius(x)[0]

    def reynolds(self, x, kinematic_viscosity):
        """Mean speed times diameter over nu."""
        return self.centre_speed(x) * self.radius(x)[0] / kinematic_viscosity


def equal_shares(count):
    """Places s, each of which stands for an equal share of the flow: within s flows 2 s^2 - s^4 of it."""
    share = (numpy.arange(count) + 0.5) / count
    return numpy.sqrt(1 - numpy.sqrt(1 - share))


def track(vessel, s, ahead, strain_step=0.5, count=200001):
    """Time and gradient from `ahead` m before the narrowing to as far behind it."""
    end = vessel.length / 2 + ahead
    x = numpy.linspace(-end, end, count)
    time = passage.summed(1 / vessel.velocity(x, s)[0], x)
    gradient = vessel.gradient(x, s)
    keep = passage.instants(time, gradient, strain_step)
    return numpy.interp(keep, time, x), keep, vessel.gradient(numpy.interp(keep, time, x), s)


def command_line():
    parser = passage.parser(__doc__)
    parser.add_argument("--diameter", type=float, required=True, metavar="M", help="of the vessel before and behind")
    parser.add_argument("--narrowing", type=float, required=True, metavar="SHARE", help="of the diameter: 0.5 leaves half of it, a quarter of the area")
    parser.add_argument("--length", type=float, required=True, metavar="M", help="of the narrowed part")
    parser.add_argument("--flow", type=float, required=True, metavar="M3/S", help="volume flow Q")
    parser.add_argument("--ahead", type=float, metavar="M", help="straight vessel before and behind (default: the length of the narrowed part)")
    passage.add_liquid(parser)
    passage.add_places(parser, "distance from the axis over the radius, 0 on it, below 1")
    return parser


def main(options):
    passage.require_positive(options, "diameter", "length", "flow", "viscosity", "density")
    if not 0 <= options.narrowing < 1:
        sys.exit("--narrowing: 0 to below 1")
    vessel = Vessel(options.diameter, options.narrowing, options.length, options.flow)
    ahead = options.length if options.ahead is None else options.ahead
    places = passage.places(options, equal_shares)
    passage.write(options, places, lambda s: track(vessel, s, ahead)[1:], "stenosis, lubrication theory")
    x = numpy.linspace(-options.length / 2, options.length / 2, 2001)
    slope = vessel.radius(x)[1]
    inertia = float(abs(vessel.reynolds(x, options.viscosity / options.density) * slope).max()) / 12
    mu = options.viscosity
    print(f"at the wall {mu * vessel.wall_shear_rate(numpy.array(-options.length)):.4g} Pa before, {mu * vessel.wall_shear_rate(numpy.array(0.0)):.4g} Pa in the throat; "
          f"on the axis stretched by up to {abs(vessel.gradient(x, 0.0)[:, 0, 0]).max():.4g} 1/s; Re = {float(vessel.reynolds(numpy.array(-options.length), mu / options.density)):.3g} before; "
          f"left out: inertia {100 * inertia:.2g} %, slope {100 * float((slope**2).max()):.2g} % of the shear rate", file=sys.stderr)
    if inertia > 0.3:
        print("warning: lubrication theory does not hold at this Reynolds number: a jet and a region of separated flow form behind the throat; the "
              "shear rate before it is larger than said here", file=sys.stderr)


if __name__ == "__main__":
    main(command_line().parse_args())
