"""Histories of the velocity gradient through the gap between a rotor and its stator, from diameters, speed and flow.

The gap, narrow beside the rotor, is taken as two flat walls: the rotor drags the liquid along its circumference, and the flow through the head passes
along the axis. Both profiles are exact for laminar flow between parallel walls; with y/g = p the distance from the stator over the gap, v = pi D N
the speed of the rotor's surface and w the mean speed through the gap, w = Q/(pi D g),

    u_x = v p,   u_z = 6 w p (1 - p),   so   du_x/dy = v/g (the nominal shear rate),   du_z/dy = 6 w (1 - 2 p)/g,

for the time h/u_z that a granule at p needs along the rotor of height h. The nominal shear rate is the usual measure of such mixers (Atiemo-Obeng & Calabrese
2004, in Paul, Atiemo-Obeng & Kresta, Handbook of Industrial Mixing, pp. 479-505; Hakansson 2018, Processes 6(4), 32). Over the first and the last gap's
width of the way the gradient rises from nothing and falls again: an assumption about the edges, nothing more.

What is left out: the curvature of the gap (of the order 2 g/D, printed), teeth and slots with the jets behind them, in which much of the power of a
toothed head is dissipated, and turbulence. Between smooth cylinders Couette flow gives way to vortices where Re_g sqrt(2 g/D) exceeds 41.3 (Taylor
1923, Phil. Trans. R. Soc. A 223, 289; Re_g = v g/nu): beyond it the program warns, and the nominal shear rate is a measure of size and no history.

    rotor_stator.py --rotor 0.03 --gap 200e-6 --height 0.01 --rpm 6000 --flow 2e-5 --viscosity 0.1 --density 1100 --position 0.5 -o middle.csv
    rotor_stator.py --rotor 0.03 --gap 200e-6 --height 0.01 --rpm 6000 --flow 2e-5 --viscosity 0.1 --density 1100 --tracks 20 -o tracks
"""

import dataclasses
import sys

import numpy

import passage

CRITICAL_TAYLOR = 41.3  # of Re_g sqrt(2 g/D), the inner cylinder turning, narrow gap


@dataclasses.dataclass(frozen=True)
class Gap:
    """Lengths in m, speed in 1/s, flow in m3/s."""
    rotor: float   # diameter
    gap: float
    height: float
    speed: float
    flow: float

    @property
    def tip_speed(self):
        return numpy.pi * self.rotor * self.speed

    @property
    def nominal_shear_rate(self):
        return self.tip_speed / self.gap

    def velocity(self, p):
        """Around and along the axis, m/s."""
        return self.tip_speed * p, 6 * self.flow / (numpy.pi * self.rotor * self.gap) * p * (1 - p)

    def gradient(self, p):
        """3 x 3, 1/s: x around, y from the stator to the rotor, z along the axis."""
        found = numpy.zeros((3, 3))
        found[0, 1] = self.nominal_shear_rate
        found[2, 1] = 6 * self.flow / (numpy.pi * self.rotor * self.gap**2) * (1 - 2 * p)
        return found

    def residence_time(self, p):
        return self.height / self.velocity(p)[1]

    def taylor(self, kinematic_viscosity):
        return self.tip_speed * self.gap / kinematic_viscosity * (2 * self.gap / self.rotor) ** 0.5


def equal_shares(count):
    """Places p, each of which stands for an equal share of the flow through the gap: below p flows 3 p^2 - 2 p^3 of it."""
    p = numpy.linspace(0, 1, 100001)
    return numpy.interp((numpy.arange(count) + 0.5) / count, 3 * p**2 - 2 * p**3, p)


def track(gap, p, strain_step=0.5):
    edge = min(gap.gap / gap.height, 0.5)  # shares of the way
    way = numpy.unique(numpy.concatenate([numpy.linspace(0, 1, 20001), [edge, 1 - edge]]))
    part = numpy.minimum(1, numpy.minimum(way, 1 - way) / edge)
    time, gradient = gap.residence_time(p) * way, part[:, None, None] * gap.gradient(p)
    keep = passage.instants(time, gradient, strain_step)
    return keep, numpy.interp(keep, time, part)[:, None, None] * gap.gradient(p)


def command_line():
    parser = passage.parser(__doc__)
    parser.add_argument("--rotor", type=float, required=True, metavar="M", help="its diameter D")
    parser.add_argument("--gap", type=float, required=True, metavar="M", help="between rotor and stator, g")
    parser.add_argument("--height", type=float, required=True, metavar="M", help="of the rotor: the way through the gap")
    parser.add_argument("--rpm", type=float, required=True, metavar="1/MIN", help="turns of the rotor a minute")
    parser.add_argument("--flow", type=float, required=True, metavar="M3/S", help="through the gap, Q")
    passage.add_liquid(parser)
    passage.add_places(parser, "distance from the stator over the gap, between 0 and 1")
    return parser


def main(options):
    passage.require_positive(options, "rotor", "gap", "height", "rpm", "flow", "viscosity", "density")
    gap = Gap(options.rotor, options.gap, options.height, options.rpm / 60, options.flow)
    places = passage.places(options, equal_shares, low_is_allowed=False)
    passage.write(options, places, lambda p: track(gap, p), "rotor and stator, laminar")
    taylor = gap.taylor(options.viscosity / options.density)
    print(f"tip speed {gap.tip_speed:.4g} m/s, nominal shear rate {gap.nominal_shear_rate:.4g} 1/s, {options.viscosity * gap.nominal_shear_rate:.4g} Pa; mean residence time "
          f"{numpy.pi * gap.rotor * gap.gap * gap.height / gap.flow:.4g} s; Re_g sqrt(2 g/D) = {taylor:.3g}; left out: curvature {200 * gap.gap / gap.rotor:.2g} %", file=sys.stderr)
    if taylor > CRITICAL_TAYLOR:
        print(f"warning: above {CRITICAL_TAYLOR} the flow in the gap is not laminar: the nominal shear rate is a measure of size, these are no histories of this flow", file=sys.stderr)


if __name__ == "__main__":
    main(command_line().parse_args())
