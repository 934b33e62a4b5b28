"""Frames as a GSD file in the schema of HOOMD-blue, for whatever reads that: OVITO, MDAnalysis, freud, gsd itself.

GSD has no units. Lengths and velocities are those of the file (nm, m/s), masses in kg. What the schema has no name for is logged under its
name here with its unit at the end.
"""

import numpy


def box(position, radius):
    """Edge of a cube around the origin that holds every particle of every frame: a droplet has no box, and no reader needs a tight one."""
    return float(2 * (numpy.abs(position).max() + radius.max()))


def log(result, frame, particles, contacts):
    found = {"time_s": result.frames.time[frame], "bonds/tension_N": contacts.normal_force, "bonds/gap_nm": contacts.gap,
             "particles/contacts": numpy.bincount(contacts.pair.ravel(), minlength=len(particles))}
    if "fragment" in particles:
        found["particles/fragment"] = particles.fragment
    for name, unit in result.observables.units.items():
        numbers = result.observables[name]
        if name != "time" and numbers.ndim == 1:
            found[f"{name}_{unit}" if unit else name] = numbers[frame]
    return {name: numpy.atleast_1d(numpy.asarray(value)) for name, value in found.items()}


def snapshot(kind, result, frame, edge):
    particles, contacts = result.particles(frame), result.contacts(frame)
    made = kind()
    made.configuration.step = int(result.frames.step[frame])
    made.configuration.box = [edge, edge, edge, 0, 0, 0]
    of = made.particles
    of.N, of.position, of.diameter, of.mass = len(particles), particles.position, 2 * numpy.asarray(particles.radius), particles.mass
    of.typeid = particles.species
    of.types = [f"species {k}" for k in range(int(particles.species.max()) + 1)]
    if "velocity" in particles:
        of.velocity = particles.velocity
    if "orientation" in particles:
        of.orientation = particles.orientation  # scalar part first in both
    made.bonds.N, made.bonds.group, made.bonds.types = len(contacts), contacts.pair, ["contact"]
    made.bonds.typeid = numpy.zeros(len(contacts), int)
    made.log = log(result, frame, particles, contacts)
    return made


def write(result, path):
    import gsd.hoomd  # not needed for anything else

    # Version 2.8 gave both their present names.
    kind, mode = (gsd.hoomd.Frame, "w") if hasattr(gsd.hoomd, "Frame") else (gsd.hoomd.Snapshot, "wb")
    edge = box(result["particles/all/position"], result.particles().radius)
    with gsd.hoomd.open(str(path), mode) as file:
        for frame in range(len(result.frames)):
            file.append(snapshot(kind, result, frame, edge))
