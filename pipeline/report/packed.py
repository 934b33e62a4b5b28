"""Frames of an agglomerate as a page takes them: what `agglomerate export` writes, in one compressed block of text.

Nothing is computed here: coordination, fragments and forces are those of the exported files.
"""

import base64
import gzip
import json
import pathlib
import subprocess
import tempfile

import h5py
import numpy

MOST_FRAMES = 120
# A frame of one particle and one contact takes so much of the page, compressed and in base64; measured, rounded up.
PARTICLE_BYTES, CONTACT_BYTES = 16, 15
# name in the page: name in the exported file, type there
OF_PARTICLES = {"coordination": ("coordination", "u2"), "fragment": ("fragment", "u4")}
OF_CONTACTS = {"tension": ("normal_force", "f4"), "gap": ("gap", "f4"), "limit": ("at_limit", "u1")}
# A value of each frame that the page shows beside its time.
OF_FRAMES = {"droplet_radius": "nm", "flow_stress": "Pa"}


class Pack:
    """Arrays one after the other, each at a multiple of four bytes, and where they stand."""

    def __init__(self):
        self.bytes = bytearray()

    def put(self, array, kind):
        array = numpy.ascontiguousarray(array, dtype="<" + kind)
        self.bytes += bytes(-len(self.bytes) % 4)
        at = len(self.bytes)
        self.bytes += array.tobytes()
        return [kind, at, array.size]

    def text(self):
        # Without a time in its head the same arrays are the same text.
        return base64.b64encode(gzip.compress(bytes(self.bytes), 9, mtime=0)).decode()


def run(tool, *arguments):
    done = subprocess.run([tool, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr.strip())
    return done.stdout


def chosen(count, particles, contacts, room):
    """Frames at even distances, first and last among them, that fit into so many bytes; the last one always does."""
    fit = min(MOST_FRAMES, int(room / (PARTICLE_BYTES * particles + CONTACT_BYTES * contacts)))
    if fit < 2 or count < 2:
        return [count - 1]
    return sorted({int(k) for k in numpy.linspace(0, count - 1, min(fit, count)).round()})


def flows(file):
    """{name: (tension of each pair, what it belongs to)} of a file of rigidstress, and the pairs."""
    if "flows" not in file or "response/pair" not in file:
        return {}, numpy.empty((0, 2), int)
    loads = {name: group["normal_force"] for name, group in file["flows"].items() if "normal_force" in group}
    return {name: (data[:], data.attrs.get("method", "")) for name, data in loads.items()}, file["response/pair"][:]


def frame_of(pack, exported, loads, pairs):
    with h5py.File(exported) as file:
        grid = file["VTKHDF"]
        particles = int(grid["NumberOfPoints"][0])
        ends = grid["Connectivity"][particles:].reshape(-1, 2)
        entry = {"position": pack.put(grid["Points"][:], "f4"), "pair": pack.put(ends, "u4")}
        for name, (source, kind) in OF_PARTICLES.items():
            entry[name] = pack.put(grid["PointData"][source][:], kind)
        for name, (source, kind) in OF_CONTACTS.items():
            entry[name] = pack.put(grid["CellData"][source][particles:], kind)
        # Loads are those of the pairs of the file, in whatever order it has them.
        row = {tuple(pair): k for k, pair in enumerate(pairs)}
        order = [row.get(tuple(pair), -1) for pair in ends]
        for name, (tension, _) in loads.items():
            entry["load " + name] = pack.put(numpy.append(tension, numpy.nan)[order], "f4")
        return entry, grid["PointData/radius"][:], grid["PointData/id"][:]


def packed(path, tool, room):
    """The head, as a page's script reads it, and the block."""
    info = json.loads(run(tool, "info", path, "--json"))
    pack = Pack()
    with h5py.File(path) as file, tempfile.TemporaryDirectory() as folder:
        times = file["particles/all/position/time"][:]
        loads, pairs = flows(file)
        # Of a drying the last frame has most contacts, of a breakup hardly fewer than any.
        kept = chosen(info["frames"], info["particles"], info["contacts"] * (1 + len(loads) / 3), room)
        frames = []
        for k in kept:
            exported = pathlib.Path(folder) / "frame.hdf"
            run(tool, "export", path, "-o", exported, "--frame", k)
            entry, radius, identity = frame_of(pack, exported, loads, pairs)
            entry |= {"number": k, "time": float(times[k])}
            entry |= {name: float(file[f"observables/{name}/value"][k]) for name in OF_FRAMES if f"observables/{name}" in file}
            frames.append(entry)
        head = {"name": path.name, "stage": info["stage"], "state": info["state"], "particles": info["particles"],
                "frames_in_file": info["frames"], "radius": pack.put(radius, "f4"), "id": pack.put(identity, "u4"),
                "loads": {name: text for name, (_, text) in loads.items()}, "frames": frames}
    return head, pack.text()
