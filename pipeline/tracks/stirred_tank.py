"""Histories of the velocity gradient in a stirred tank, from its size and speed: turns near the impeller between long stays in the bulk.

Two well-mixed zones exchange liquid, as compartment models have it (Alexopoulos, Maggioris & Kiparissides 2002, Chem. Eng. Sci. 57, 1735). With speed N,
impeller diameter D and a tank of diameter and height T, V = pi T^3/4,

    power                P = N_p rho N^3 D^5      N_p = 5 for a Rushton turbine at Re = N D^2/nu above 1e4 (Rushton, Costich & Everett 1950, Chem. Eng. Prog. 46, 395)
    mean dissipation     P/(rho V)
    near the impeller    share P/(rho V_i)        share = 0.6 in the impeller and its stream (Wu & Patterson 1989, Chem. Eng. Sci. 44, 2207: balance of energy
                                                  from laser-Doppler measurements; 40 % in the bulk)
    in the bulk          (1 - share) P/(rho (V - V_i))
    exchange             q = N_Q N D^3            N_Q = 0.75 +- 0.15 for a Rushton turbine (Revill 1982, 4th Eur. Conf. Mixing, p. 11); circulation time V/q

V_i is the disc of the tank's diameter and twice the blade's height, 2 D/5, in which impeller and stream lie: an assumption, --zone changes it. Stays in each zone
have exponentially distributed times of mean V_i/q and (V - V_i)/q, so the dissipation averages to P/(rho V). In each zone the gradient is the Gaussian
one of gaussian.py at the dissipation rate there; its warning holds here too. Within the zone of the impeller dissipation varies further: close behind the blades it
is several times the mean of the zone, so that breakups are too few.

    stirred_tank.py --tank 0.1 --rpm 600 --tracks 20 -o tracks.h5
"""

import dataclasses
import pathlib
import sys

import numpy

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1] / "report"))
import arguments  # noqa: E402
import gaussian  # noqa: E402
from store import write  # noqa: E402

STEP = 0.1  # between instants, in Kolmogorov times near the impeller


@dataclasses.dataclass(frozen=True)
class Tank:
    """SI units; zone and share: of volume and power, of the impeller and its stream."""
    tank: float
    impeller: float
    speed: float
    power_number: float
    flow_number: float
    zone: float
    share: float

    @property
    def volume(self):
        return numpy.pi / 4 * self.tank**3

    @property
    def mean_dissipation(self):
        """W/kg."""
        return self.power_number * self.speed**3 * self.impeller**5 / self.volume

    @property
    def dissipation(self):
        """Near the impeller and in the bulk, W/kg."""
        return numpy.array([self.share / self.zone, (1 - self.share) / (1 - self.zone)]) * self.mean_dissipation

    @property
    def circulation_time(self):
        return self.volume / (self.flow_number * self.speed * self.impeller**3)

    @property
    def mean_stay(self):
        """Near the impeller and in the bulk, s."""
        return numpy.array([self.zone, 1 - self.zone]) * self.circulation_time


def zones(tank, draw, time):
    """0 near the impeller, 1 in the bulk, at each time; from a stationary start."""
    zone = int(draw.random() >= tank.zone)
    ends = [draw.exponential(tank.mean_stay[zone])]  # of an exponential stay what is left is one, too
    first = zone
    while ends[-1] < time[-1]:
        zone = 1 - zone
        ends.append(ends[-1] + draw.exponential(tank.mean_stay[zone]))
    return (first + numpy.searchsorted(ends, time, side="right")) % 2


def tracks(tank, kinematic_viscosity, time, count, seed):
    rates = numpy.sqrt(tank.dissipation / kinematic_viscosity)
    for number in range(count):
        draw = numpy.random.Generator(numpy.random.Philox([seed, number]))
        rate = rates[zones(tank, draw, time)]
        own = numpy.concatenate([[0], numpy.cumsum(0.5 * (rate[1:] + rate[:-1]) * numpy.diff(time))])  # Kolmogorov times passed
        even = gaussian.gradients(1, int(own[-1] / STEP) + 2, STEP, [seed, number, 1])[0]
        place = own / STEP
        left = place.astype(int)
        part = (place - left)[:, None, None]
        yield rate[:, None, None] * ((1 - part) * even[left] + part * even[left + 1])


def command_line():
    parser = arguments.parser(__doc__, "the tracks", "FILE.h5")
    parser.add_argument("--tank", type=float, required=True, metavar="M", help="diameter and height of the liquid, T")
    parser.add_argument("--impeller", type=float, metavar="M", help="diameter D (default: T/3)")
    parser.add_argument("--rpm", type=float, required=True, metavar="1/MIN", help="turns of the impeller a minute")
    parser.add_argument("--power-number", type=float, default=5.0, metavar="N_P", help="(default: Rushton turbine, %(default)g)")
    parser.add_argument("--flow-number", type=float, default=0.75, metavar="N_Q", help="(default: Rushton turbine, %(default)g)")
    parser.add_argument("--share", type=float, default=0.6, help="of the power, dissipated in the zone of the impeller (default %(default)g)")
    parser.add_argument("--zone", type=float, metavar="SHARE", help="of the volume (default: 2 D/(5 T))")
    parser.add_argument("--viscosity", type=float, default=1.0e-6, metavar="M2/S", help="kinematic, nu (default: water, %(default)g)")
    parser.add_argument("--tracks", type=int, default=20, metavar="COUNT", help="how many (default %(default)s)")
    parser.add_argument("--length", type=float, default=1.0, metavar="T", help="of each, in circulation times (default %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="(default %(default)s)")
    return parser


def main(options):
    impeller = options.tank / 3 if options.impeller is None else options.impeller
    zone = 0.4 * impeller / options.tank if options.zone is None else options.zone
    for name, value in (("tank", options.tank), ("impeller", impeller), ("rpm", options.rpm), ("power-number", options.power_number), ("flow-number", options.flow_number),
                        ("viscosity", options.viscosity), ("tracks", options.tracks), ("length", options.length)):
        if not value > 0:
            sys.exit(f"--{name}: must be above 0")
    for name, value in (("share", options.share), ("zone", zone)):
        if not 0 < value < 1:
            sys.exit(f"--{name}: between 0 and 1")
    tank = Tank(options.tank, impeller, options.rpm / 60, options.power_number, options.flow_number, zone, options.share)
    near, bulk = tank.dissipation
    step = STEP / (near / options.viscosity) ** 0.5
    time = step * numpy.arange(int(options.length * tank.circulation_time / step) + 1)
    write(options.out, time, tracks(tank, options.viscosity, time, options.tracks, options.seed),
          f"stirred tank, Gaussian; dissipation {near:.4g} W/kg near the impeller, {bulk:.4g} W/kg in the bulk; misses intermittency", options.tracks)
    reynolds = tank.speed * tank.impeller**2 / options.viscosity
    print(f"{options.tracks} tracks of {len(time)} instants over {time[-1]:.4g} s; dissipation {tank.mean_dissipation:.4g} W/kg on average, {near:.4g} near the impeller, {bulk:.4g} in the bulk; "
          f"circulation time {tank.circulation_time:.4g} s, {tank.mean_stay[0]:.4g} s of it near the impeller; Re = {reynolds:.3g}; misses intermittency, "
          "and dissipation close behind the blades is several times that of the zone", file=sys.stderr)
    if reynolds < 1e4:
        print("warning: Re is below 1e4: the flow is not fully turbulent, and numbers of power and flow depend on it", file=sys.stderr)


if __name__ == "__main__":
    main(command_line().parse_args())
