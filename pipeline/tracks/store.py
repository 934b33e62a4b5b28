"""Tracks in the files that `flow.history` takes: one HDF5 file with /time in s and /gradient (tracks x instants x 3 x 3) in 1/s, or a CSV file a track."""

import h5py
import numpy

import whole


def write(path, time, gradient, what, count=None):
    """gradient: an array; or with `count` anything that gives so many tracks, one after the other."""
    with whole.replacing(path) as temporary, h5py.File(temporary, "w") as file:
        file.attrs["what"] = what
        file["time"] = time
        file["time"].attrs["unit"] = "s"
        shape = (len(time), 3, 3)
        data = file.create_dataset("gradient", (len(gradient) if count is None else count, *shape), dtype="f8", chunks=(1, *shape))
        for k, track in enumerate(gradient):
            data[k] = track
        data.attrs["unit"] = "s-1"
        data.attrs["element"] = "row i, column j: du_i/dx_j"


def write_csv(path, time, gradient, what):
    names = ["t [s]", *(f"du{i}/d{j} [1/s]" for i in "xyz" for j in "xyz")]
    with whole.replacing(path) as temporary, open(temporary, "w", encoding="utf-8") as file:
        file.write(f"# {what}\n{','.join(names)}\n")
        numpy.savetxt(file, numpy.column_stack([time, gradient.reshape(len(time), 9)]), fmt="%.9g", delimiter=",")
