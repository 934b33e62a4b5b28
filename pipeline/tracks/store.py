"""Tracks in the one HDF5 file that `flow.history` of rigidstress takes: /time in s, /gradient (tracks x instants x 3 x 3) in 1/s."""

import h5py

import whole


def write(path, time, gradient, what):
    with whole.replacing(path) as temporary, h5py.File(temporary, "w") as file:
        file.attrs["what"] = what
        file["time"] = time
        file["time"].attrs["unit"] = "s"
        data = file.create_dataset("gradient", data=gradient, dtype="f8", chunks=(1, *gradient.shape[1:]))
        data.attrs["unit"] = "s-1"
        data.attrs["element"] = "row i, column j: du_i/dx_j"
