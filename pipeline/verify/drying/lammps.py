"""The same droplet by LAMMPS: granular/jkr at full stiffness, inertia, drag, the receding surface as a force on each atom."""

import math
import pathlib
import shutil
import tempfile

import numpy

from drying import peer

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


def settings(d, start, out):
    c, reduced = d["constants"], d["a"] / 2
    force = 2 * c["F_po_N"]
    half = 1.05 * d["R0"]
    return {**d, "low": -half, "high": half, "start": start, "out": out, "diameter": 2 * d["a"], "k_s": c["k_s_N_per_m"],
            "mu_s": c["F_s_crit_N"] / force, "k_roll": c["k_r_N_m"] / reduced**2, "mu_roll": c["M_r_crit_N_m"] / reduced / force,
            "k_twist": c["k_t_N_m"], "mu_twist": c["k_t_N_m"] * 0.05 * math.pi / 4 / force, "skin": 0.2 * d["a"],
            "damp": d["mass"] / (6 * math.pi * d["mu"] * d["a"]), "step": STEP_S, "steps": round(d["tau"] / STEP_S)}


def write_start(path, x, half):
    with path.open("w") as file:
        file.write(f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(x)}\nITEM: BOX BOUNDS ff ff ff\n" +
                   f"{-half} {half}\n" * 3 + "ITEM: ATOMS id type x y z\n")
        file.writelines(f"{k + 1} 1 {p[0]:.12g} {p[1]:.12g} {p[2]:.12g}\n" for k, p in enumerate(x))


def dry(granule):
    """Dries the start of a file of dryer: last positions in m (rows in its order) and CPU seconds."""
    d = peer.droplet(granule)
    with tempfile.TemporaryDirectory(prefix="crumble-lammps-") as folder:
        folder = pathlib.Path(folder)
        write_start(folder / "start.dump", d["x"], 1.05 * d["R0"])
        (folder / "in.drying").write_text(INPUT.format(**settings(d, folder / "start.dump", folder / "end.dump")))
        cpu = peer.run(["lmp", "-in", folder / "in.drying", "-log", "none"], folder)
        rows = numpy.loadtxt(folder / "end.dump", skiprows=9)
    return rows[numpy.argsort(rows[:, 0]), 1:4], cpu
