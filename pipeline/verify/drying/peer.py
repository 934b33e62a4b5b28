"""What the comparisons with other codes share: the droplet that a file of dryer began with, and a program's CPU seconds."""

import csv
import math
import os
import resource
import subprocess

import h5py

from drying.runs import ROOT  # also puts pipeline/report on the path
import scene  # noqa: E402


def droplet(granule):
    """Start and scene of a file of dryer, SI; particles are equal and D = 0 or left out."""
    with h5py.File(granule) as file:
        found = {"x": 1e-9 * file["particles/all/position/value"][0], "a": 1e-9 * float(file["particles/all/radius"][0])}
        said = scene.resolved(file)
    keys = {"R0": ("droplet", "radius"), "tau": ("droplet", "lifetime"), "sigma": ("fluid", "surface_tension"),
            "mu": ("fluid", "viscosity"), "E": ("material", "youngs_modulus"), "nu": ("material", "poisson_ratio"),
            "gamma": ("material", "surface_energy"), "density": ("material", "density"), "friction": ("contact", "friction")}
    found |= {key: scene.number(said, *place) for key, place in keys.items()}
    return found | {"constants": constants(found), "mass": found["density"] * 4 / 3 * math.pi * found["a"] ** 3}


def constants(of):
    """Of a contact, from the stored table, which is for one material."""
    with (ROOT / "data/contact_constants.csv").open() as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(line for line in file if not line.startswith("#"))]
    b0 = (9 * math.pi * of["gamma"] * of["a"] ** 2 * (1 - of["nu"] ** 2) / (2 * of["E"])) ** (1 / 3)
    for row in rows:
        if math.isclose(row["radius_nm"], 1e9 * of["a"], rel_tol=1e-6) and math.isclose(row["b0_nm"], 1e9 * b0, rel_tol=1e-5):
            return row
    raise ValueError(f"data/contact_constants.csv has no row of this material and a = {of['a']:g} m")


def run(command, folder):
    """CPU seconds on one thread."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        raise RuntimeError(f"{command[0]}: exit code {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
