"""The same droplet by LAMMPS: granular/jkr at full stiffness, inertia, drag, the receding surface as a force on each atom."""

import csv
import math
import os
import pathlib
import resource
import shutil
import subprocess
import tempfile

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[3]
# Stable at 10 nm: a third of the contact's period over 2 pi.
STEP_S = 8e-12

# units si. The limits of sliding, twisting and rolling are Coulomb's on |F_n + 2 F_po|, which at rest is 2 F_po; rolling is
# measured as a displacement R* times the angle. fix langevin at 0 K is Stokes drag of motion and rotation.
INPUT = """units si
atom_style sphere
atom_modify map array
boundary f f f
newton off
comm_modify vel yes
region box block {low} {high} {low} {high} {low} {high}
create_box 1 box
read_dump {start} 0 x y z add yes box no format native
set type 1 diameter {diameter} density {density}
pair_style granular
pair_coeff * * jkr {E} 0.0 {nu} {gamma} tangential linear_history {k_s} 0.0 {mu_s} rolling sds {k_roll} 0.0 {mu_roll} twisting sds {k_twist} 0.0 {mu_twist} damping velocity
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes
variable R equal "{R0}*sqrt(abs(1-step*dt/{tau}))"
variable r atom "sqrt(x*x+y*y+z*z)"
variable o atom "v_r-v_R"
variable f atom "-2*PI*{sigma}*sqrt(abs(({a}-v_o)*({a}+v_o)))*(abs(v_o)<{a})*(v_r+v_R>{a})/v_r"
variable fx atom "v_f*x"
variable fy atom "v_f*y"
variable fz atom "v_f*z"
fix drag all langevin 0 0 {damp} 1 omega yes
fix surface all addforce v_fx v_fy v_fz
fix move all nve/sphere
timestep {step}
thermo 1000000000
run {steps}
write_dump all custom {out} id x y z modify format float %.12g
"""


def missing():
    """What to do if LAMMPS is not there, or nothing."""
    return None if shutil.which("lmp") else "LAMMPS is not installed; on Debian: apt-get install lammps"


def constants(radius_nm):
    with (ROOT / "data/contact_constants.csv").open() as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return next({k: float(v) for k, v in row.items()} for row in rows if float(row["radius_nm"]) == radius_nm)


def settings(radius, lifetime, R0, start, out):
    c = constants(radius * 1e9)
    reduced, force = radius / 2, 2 * c["F_po_N"]
    density, viscosity, k_t = 1300.0, 1e-3, c["k_t_N_m"]
    mass = density * 4 / 3 * math.pi * radius**3
    return {"low": -1.05 * R0, "high": 1.05 * R0, "start": start, "out": out, "diameter": 2 * radius, "density": density,
            "E": 3.4e9, "nu": 0.5, "gamma": 4.8e-3, "k_s": c["k_s_N_per_m"], "mu_s": c["F_s_crit_N"] / force,
            "k_roll": c["k_r_N_m"] / reduced**2, "mu_roll": c["M_r_crit_N_m"] / reduced / force, "k_twist": k_t,
            "mu_twist": k_t * 0.05 * math.pi / 4 / force, "skin": 0.2 * radius, "R0": R0, "tau": lifetime, "sigma": 1.75e-4,
            "a": radius, "damp": mass / (6 * math.pi * viscosity * radius), "step": STEP_S, "steps": round(lifetime / STEP_S)}


def write_start(path, x, half):
    with path.open("w") as file:
        file.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(x)}\nITEM: BOX BOUNDS ff ff ff\n" +
                   f"{-half} {half}\n" * 3 + "ITEM: ATOMS id type x y z\n")
        file.writelines(f"{k + 1} 1 {p[0]:.12g} {p[1]:.12g} {p[2]:.12g}\n" for k, p in enumerate(x))


def dry(granule, lifetime, R0):
    """Dries the start of a file of dryer: last positions in m (rows in its order) and CPU seconds."""
    with h5py.File(granule) as file:
        x = 1e-9 * file["particles/all/position/value"][0]
        radius = 1e-9 * float(file["particles/all/radius"][0])
    with tempfile.TemporaryDirectory(prefix="crumble-lammps-") as folder:
        folder = pathlib.Path(folder)
        write_start(folder / "start.dump", x, 1.05 * R0)
        (folder / "in.drying").write_text(INPUT.format(**settings(radius, lifetime, R0, folder / "start.dump", folder / "end.dump")))
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(["lmp", "-in", folder / "in.drying", "-log", "none"], cwd=folder, capture_output=True, text=True,
                              env={**os.environ, "OMP_NUM_THREADS": "1"})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise RuntimeError(f"lmp: exit code {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
        rows = numpy.loadtxt(folder / "end.dump", skiprows=9)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return rows[numpy.argsort(rows[:, 0]), 1:4], cpu
