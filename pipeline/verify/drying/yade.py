"""The same droplet by Debian's Yade: linear contacts with the constant pull-off force of Eq. 6 and Coulomb friction on compression
plus adhesion (what our law cundall-strack is), inertia, drag of motion.

Of the laws with adhesion that the package has, Law2_ScGeom6D_CohFrictPhys_CohesionMoment can do this; JKR is not among them, and its
rolling moments are limited by friction on compression alone, so both codes leave rolling and twisting out. It has no drag of
rotation either. The receding surface is a force on each body from Python, renewed every `EVERY` steps: a particle moves 0.2 % of
its radius meanwhile.
"""

import json
import pathlib
import shutil
import tempfile

import numpy

from drying import peer

# What dryer has to be told for the same physics.
SETTINGS = {"contact.law": "cundall-strack", "contact.rolling_limit_factor": "0", "contact.twisting_limit_factor": "0"}
STEP_S = 4e-12  # a third of sqrt(m/k)
EVERY = 100

SCRIPT = """
import json, math, os, numpy
from yade import *
d = json.load(open("droplet.json"))
a = d["a"]
material = O.materials.append(CohFrictMat(young=d["E"], poisson=d["nu"], density=d["density"], frictionAngle=math.atan(d["friction"]),
                                          normalCohesion=d["F_po"] / a**2, shearCohesion=d["friction"] * d["F_po"] / a**2,
                                          fragile=False, momentRotationLaw=False, isCohesive=True))
ids = [O.bodies.append(sphere(x, a, material=material)) for x in d["x"]]
n = len(ids)

def surface():
    x = numpy.array([O.bodies[i].state.pos for i in ids])
    r = numpy.linalg.norm(x, axis=1)
    R = d["R0"] * math.sqrt(max(0.0, 1 - O.iter * O.dt / d["tau"]))
    offset = r - R
    cut = (abs(offset) < a) & (r + R > a)
    pull = numpy.where(cut, -2 * math.pi * d["sigma"] * numpy.sqrt(abs(a * a - offset**2)) / r, 0.0)
    for i, f in zip(ids, pull[:, None] * x):
        O.forces.setPermF(i, Vector3(*f))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.2 * a),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D()], [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)],
                    [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]),
    LinearDragEngine(nu=d["mu"], ids=ids),
    PyRunner(command="surface()", iterPeriod=d["every"], firstIterRun=1),
    NewtonIntegrator(damping=0, gravity=(0, 0, 0)),
]
O.dt = d["step"]
O.run(d["steps"], True)
numpy.savetxt("end.txt", [O.bodies[i].state.pos for i in ids])
os._exit(0)
"""


def missing():
    """What to do if Yade is not there, or nothing."""
    return None if shutil.which("yade") else "Yade is not installed; on Debian: apt-get install --no-install-recommends yade"


def dry(granule):
    """Dries the start of a file of dryer: last positions in m (rows in its order) and CPU seconds."""
    d = peer.droplet(granule)
    d |= {"x": d["x"].tolist(), "F_po": d["constants"]["F_po_N"], "step": STEP_S, "every": EVERY,
          "steps": round(d["tau"] / STEP_S)}
    with tempfile.TemporaryDirectory(prefix="crumble-yade-") as folder:
        folder = pathlib.Path(folder)
        (folder / "droplet.json").write_text(json.dumps(d))
        (folder / "drying.py").write_text(SCRIPT)
        cpu = peer.run(["yade", "-n", "-x", "-j1", "drying.py"], folder)
        return numpy.loadtxt(folder / "end.txt"), cpu
