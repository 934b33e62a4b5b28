"""Histories of the velocity gradient in homogeneous isotropic turbulence, Gaussian, for those who have no measured ones.

Warning: a Gaussian history misses intermittency. In real turbulence rare gradients are many times the mean ones, and brittle granules break
in these: below the mean strength a Gaussian history gives far too few breakups. Take tracks of a simulation where you can (convert.py).

Covariance <A_ij A_kl> = epsilon/(30 nu) (4 d_ik d_jl - d_ij d_kl - d_il d_jk), so <2 E:E> = epsilon/nu. Strain and rotation forget themselves
within 2.3 and 7.2 Kolmogorov times sqrt(nu/epsilon) (integral times; Girimaji & Pope 1990, J. Fluid Mech. 220, 427; Brunk, Koch & Lion 1998,
J. Fluid Mech. 364, 81). Each component is a critically damped oscillator driven by white noise: once differentiable, as paths along particles are.

    gaussian.py --dissipation 10 --tracks 1000 --length 50 -o tracks.h5
"""

import pathlib
import sys

import numpy

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1] / "report"))
import arguments  # noqa: E402
from store import write  # noqa: E402

STRAIN_TIME, ROTATION_TIME = 2.3, 7.2  # Kolmogorov times


def path(draw, count, instants, step, integral_time):
    """count x instants numbers of variance 1 whose correlation (1 + t/T) exp(-t/T) has this integral, 2 T; step: of time."""
    s = 2 * step / integral_time
    move = numpy.exp(-s) * numpy.array([[1 + s, s], [-s, 1 - s]])  # of the value and T times its rate
    left = numpy.linalg.cholesky(numpy.eye(2) - move @ move.T)
    state = draw.standard_normal((2, count))  # stationary: both of variance 1, uncorrelated
    found = numpy.empty((instants, count))
    for k in range(instants):
        found[k] = state[0]
        state = move @ state + left @ draw.standard_normal((2, count))
    return found.T


def gradients(tracks, instants, step, seed):
    """tracks x instants x 3 x 3, for epsilon/nu = 1 and time in Kolmogorov times."""
    draw = numpy.random.Generator(numpy.random.Philox(seed))
    shape = (tracks, -1, instants)
    # Five components of strain in an orthonormal basis and three of rotation: 2 E:E and 2 W:W both are 1 on average.
    strain = path(draw, 5 * tracks, instants, step, STRAIN_TIME).reshape(shape) * numpy.sqrt(1 / 10)
    rotation = path(draw, 3 * tracks, instants, step, ROTATION_TIME).reshape(shape) * numpy.sqrt(1 / 12)
    h, s = numpy.sqrt(0.5), 1 / numpy.sqrt(6)
    basis = numpy.zeros((8, 3, 3))
    basis[0, 0, 1] = basis[0, 1, 0] = basis[1, 1, 2] = basis[1, 2, 1] = basis[2, 0, 2] = basis[2, 2, 0] = h
    basis[3] = numpy.diag([h, -h, 0])
    basis[4] = s * numpy.diag([-1, -1, 2])
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        basis[5 + k, j, i], basis[5 + k, i, j] = 1, -1
    return numpy.einsum("tck,cij->tkij", numpy.concatenate([strain, rotation], axis=1), basis, optimize=True)


def command_line():
    parser = arguments.parser(__doc__, "the tracks, as rigidstress takes them", "FILE.h5")
    parser.add_argument("--dissipation", type=float, required=True, metavar="W/KG", help="epsilon")
    parser.add_argument("--viscosity", type=float, default=1.0e-6, metavar="M2/S", help="kinematic, nu (default: water, %(default)g)")
    parser.add_argument("--tracks", type=int, default=1000, help="how many (default %(default)s)")
    parser.add_argument("--length", type=float, default=50, metavar="T", help="of each, in Kolmogorov times (default %(default)s)")
    parser.add_argument("--step", type=float, default=0.1, metavar="T", help="between instants, in Kolmogorov times (default %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="(default %(default)s)")
    return parser


def main(options):
    for name in ("dissipation", "viscosity", "tracks", "length", "step"):
        if not getattr(options, name) > 0:
            sys.exit(f"--{name}: must be above 0")
    rate = (options.dissipation / options.viscosity) ** 0.5
    instants = int(round(options.length / options.step)) + 1
    write(options.out, numpy.arange(instants) * options.step / rate,
          rate * gradients(options.tracks, instants, options.step, options.seed),
          f"Gaussian, isotropic, epsilon = {options.dissipation:g} W/kg, nu = {options.viscosity:g} m2/s; misses intermittency")
    print(f"{options.tracks} tracks of {instants} instants; sqrt(<2 E:E>) = {rate:.4g} 1/s.", __doc__.split("\n\n")[1].replace("\n", " "), file=sys.stderr)


if __name__ == "__main__":
    main(command_line().parse_args())
