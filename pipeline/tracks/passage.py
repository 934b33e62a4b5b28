"""What generators of passages through a device share: instants along a path, places in the flow, files."""

import pathlib
import sys

import numpy

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1] / "report"))
import arguments  # noqa: E402
from store import write_csv  # noqa: E402


def summed(values, at):
    """The integral from the first place to each, by the trapezoidal rule."""
    return numpy.concatenate([[0], numpy.cumsum(0.5 * (values[1:] + values[:-1]) * numpy.diff(at))])


def rate(gradient):
    """sqrt(2 E:E)."""
    strain = 0.5 * (gradient + gradient.swapaxes(-1, -2))
    return numpy.sqrt(2 * (strain**2).sum((-1, -2)))


def instants(time, gradient, strain_step):
    """Instants between which the liquid is strained by no more than strain_step, at least 400; in weak flow no more than five times as far apart as in the strongest."""
    local = rate(gradient)
    measure = summed(numpy.maximum(local, local.max() / 5), time)
    return numpy.interp(numpy.linspace(0, measure[-1], max(int(numpy.ceil(measure[-1] / strain_step)), 400) + 1), measure, time)


def parser(doc):
    return arguments.parser(doc, "the history of --position, or the folder of those of --tracks", "FILE.csv or FOLDER")


def add_liquid(parser):
    parser.add_argument("--viscosity", type=float, default=1e-3, metavar="PA S", help="of the liquid (default: water, %(default)g)")
    parser.add_argument("--density", type=float, default=997, metavar="KG/M3", help="of the liquid (default: water, %(default)g)")


def add_places(parser, of):
    either = parser.add_mutually_exclusive_group(required=True)
    either.add_argument("--position", type=float, metavar="S", help=f"one history: {of}")
    either.add_argument("--tracks", type=int, metavar="COUNT", help="so many histories, each for an equal share of the flow")


def require_positive(options, *names):
    for name in names:
        if not getattr(options, name) > 0:
            sys.exit(f"--{name.replace('_', '-')}: must be above 0")


def places(options, equal_shares, low=0, low_is_allowed=True):
    if options.tracks is not None:
        if options.tracks < 1:
            sys.exit("--tracks: 1 or more")
        return equal_shares(options.tracks)
    if not (low <= options.position < 1 if low_is_allowed else low < options.position < 1):
        sys.exit(f"--position: {'from' if low_is_allowed else 'above'} {low:g} to below 1: at a wall nothing moves")
    return [options.position]


def write(options, where, track, what):
    """track(place) -> time, gradient."""
    if options.tracks is not None:
        options.out.mkdir(parents=True, exist_ok=True)
    for number, place in enumerate(where, 1):
        time, gradient = track(place)
        path = options.out / f"{number:04}.csv" if options.tracks is not None else options.out
        write_csv(path, time, gradient, f"{what}, place {place:.4g}")
        print(f"{path}: {len(time)} instants, {time[-1]:.4g} s, strain {summed(rate(gradient), time)[-1]:.4g}, up to {rate(gradient).max():.4g} 1/s", file=sys.stderr)
