"""Cumulative distribution of the radial position, Fig. 3 of Vasquez Giuliano et al. (2022): distribution.py GRANULE.h5...

CSV: radius in nm from the centre of mass, and the fraction of particles within it: mean over the granules, lowest and
highest granule."""

import sys

import h5py
import numpy


def radii(name):
    with h5py.File(name, "r") as file:
        position = file["/particles/all/position/value"][-1]
    return numpy.sort(numpy.linalg.norm(position - position.mean(axis=0), axis=1))


def main(names):
    if not names:
        sys.exit(__doc__)
    all_radii = [radii(name) for name in names]
    grid = numpy.arange(0, max(r[-1] for r in all_radii) + 1, 1.0)
    within = numpy.array([numpy.searchsorted(r, grid, side="right") / len(r) for r in all_radii])
    print("radius_nm,mean,lowest,highest")
    for x, values in zip(grid, within.T):
        print(f"{x:g},{values.mean():.4f},{values.min():.4f},{values.max():.4f}")


if __name__ == "__main__":
    main(sys.argv[1:])
