"""Tracks of tracer particles in turbulence, as public data sets store them, in the file that `flow.history` of rigidstress takes.

Takes an HDF5 file (or .npz) in which nine arrays tracks x instants, or one array of tracks x instants x 9 (or 3 x 3), hold the velocity gradient, row by
row: du_x/dx, du_x/dy, ... du_z/dz. Names and units differ from data set to data set, so they are said here: which array, and how many seconds and 1/s
one unit of time and gradient of the data are. A simulation in its own units is made one of a real liquid by its Kolmogorov time: divide the time by it
and multiply the gradient with it (units of sqrt(nu/epsilon)), then give --time-unit and --rate-unit of your liquid.

    convert.py TURB.h5 --gradient velocity_gradient --time t --time-unit 1.0 --rate-unit 1.0 -o tracks.h5
    convert.py TURB.h5 --gradient uxx,uxy,uxz,uyx,uyy,uyz,uzx,uzy,uzz --step 1e-4 --time-unit 1.0 --rate-unit 1.0 -o tracks.h5
"""

import pathlib
import sys

import h5py
import numpy

sys.path.insert(1, str(pathlib.Path(__file__).resolve().parents[1] / "report"))
import arguments  # noqa: E402
from store import write  # noqa: E402


class Arrays:
    """Arrays of an HDF5 or .npz file by name."""

    def __init__(self, path):
        self.path = path
        if path.suffix == ".npz":
            self.file = numpy.load(path)
            self.names = self.file.files
        else:
            self.file = h5py.File(path)
            self.names = []
            self.file.visititems(lambda name, item: self.names.append(name) if isinstance(item, h5py.Dataset) else None)

    def __getitem__(self, name):
        if name.strip("/") not in self.names:
            sys.exit(f"{self.path}: has no array '{name}'; there are {', '.join(self.names)}")
        return numpy.asarray(self.file[name.strip("/")], dtype=float)


def gradient(arrays, names):
    """tracks x instants x 3 x 3."""
    found = [arrays[name] for name in names]
    if len(found) == 9:
        if len({one.shape for one in found}) > 1 or found[0].ndim != 2:
            sys.exit(f"{arrays.path}: --gradient: nine arrays of one shape, tracks x instants, are needed; they are {', '.join(str(one.shape) for one in found)}")
        return numpy.stack(found, axis=-1).reshape(*found[0].shape, 3, 3)
    if len(found) != 1:
        sys.exit(f"--gradient: one array or nine, not {len(found)}")
    (one,) = found
    if one.ndim == 3 and one.shape[2] == 9 or one.ndim == 4 and one.shape[2:] == (3, 3):
        return one.reshape(*one.shape[:2], 3, 3)
    sys.exit(f"{arrays.path}: {names[0]}: its shape {one.shape} is not tracks x instants x 9")


def checked(values, path):
    """Without the rest of a trace; a large one says that the components are in another order."""
    size = numpy.sqrt((values**2).sum(axis=(-1, -2)))
    trace = numpy.trace(values, axis1=-2, axis2=-1)
    if not numpy.isfinite(values).all():
        sys.exit(f"{path}: the gradient holds numbers that are not finite")
    share = float(numpy.sqrt((trace**2).mean() / (size**2).mean()))
    if share > 0.05:
        sys.exit(f"{path}: the trace of the gradient is {100 * share:.2g} % of it (rms): the fluid is incompressible, so the components must be in another order")
    return values - trace[..., None, None] * numpy.eye(3) / 3, share


def command_line():
    parser = arguments.parser(__doc__, "the tracks, as rigidstress takes them", "FILE.h5")
    parser.add_argument("data", type=arguments.file, metavar="DATA", help="HDF5 or .npz")
    parser.add_argument("--gradient", required=True, metavar="NAME[,NAME...]", help="one array, or nine in the order of rows")
    parser.add_argument("--time", metavar="NAME", help="array of the instants")
    parser.add_argument("--step", type=float, metavar="T", help="instead: time between instants, in the unit of the data")
    parser.add_argument("--time-unit", type=float, required=True, metavar="S", help="one unit of time of the data, in s")
    parser.add_argument("--rate-unit", type=float, required=True, metavar="1/S", help="one unit of the gradient of the data, in 1/s")
    return parser


def main(options):
    if (options.time is None) == (options.step is None):
        sys.exit("--time or --step: one of them is needed")
    arrays = Arrays(options.data)
    values, share = checked(gradient(arrays, options.gradient.split(",")), options.data)
    time = arrays[options.time].reshape(-1) if options.time else options.step * numpy.arange(values.shape[1])
    if len(time) != values.shape[1]:
        sys.exit(f"{options.data}: {options.time}: {len(time)} instants, the gradient has {values.shape[1]}")
    write(options.out, options.time_unit * (time - time[0]), options.rate_unit * values, f"{options.data.name}, converted")
    strain = 0.5 * (values + values.swapaxes(-1, -2))
    rate = options.rate_unit * float(numpy.sqrt(2 * (strain**2).sum(axis=(-1, -2)).mean()))
    print(f"{values.shape[0]} tracks of {values.shape[1]} instants over {options.time_unit * (time[-1] - time[0]):.4g} s; sqrt(<2 E:E>) = {rate:.4g} 1/s; "
          f"a trace of {100 * share:.2g} % was taken out", file=sys.stderr)


if __name__ == "__main__":
    main(command_line().parse_args())
