"""The stored granules are valid files and what data/README.md says: test_granules.py PATH_OF_AGGLOMERATE."""

import pathlib
import re
import subprocess
import sys
import unittest

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
AGGLOMERATE = sys.argv.pop()


def stated(name):
    """Of the README: the numbers of the last frame as they are printed below the heading of the file."""
    text = (ROOT / "data/README.md").read_text(encoding="utf-8").split(f"## {name}")[1]
    row = re.search(r"\| ([\d.]+) nm \| ([\d.]+) \| (\d+) \| ([\d.]+) \|", text)
    return dict(zip(("d_c", "h_c_over_d_c", "contacts", "coordination"), row.groups()))


def extent(position, radius):
    """Outer and inner radius by section 3.1 of the paper: mean over the farthest and the nearest tenth."""
    distance = numpy.sort(numpy.linalg.norm(position - position.mean(axis=0), axis=1))
    tenth = (len(distance) + 5) // 10
    return distance[-tenth:].mean() + radius, distance[:tenth].mean() - radius


class Stored:
    def test_is_a_valid_file(self):
        done = subprocess.run([AGGLOMERATE, "check", str(self.file)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_is_below_one_megabyte(self):
        self.assertLess(self.file.stat().st_size, 1_000_000)

    def test_last_frame_has_the_stated_morphology(self):
        with h5py.File(self.file) as file:
            position = file["particles/all/position/value"][-1]
            radius = file["particles/all/radius"][0]
            contacts = len(file["connectivity/contacts"])
            bonded = int(numpy.diff(file["contacts/offset"][-2:])[0])
        outer, inner = extent(position, radius)
        said = stated(self.file.name)
        self.assertEqual(f"{2 * outer:.2f}", said["d_c"])
        self.assertEqual(f"{(outer - inner) / (2 * outer):.4f}", said["h_c_over_d_c"])
        self.assertEqual(str(contacts), said["contacts"])
        self.assertEqual(bonded, contacts)
        self.assertEqual(f"{2 * contacts / len(position):.3f}", said["coordination"])

    def test_was_made_by_the_stated_command_from_a_committed_state(self):
        with h5py.File(self.file) as file:
            provenance = dict(file["parameters/provenance"].attrs)
        text = lambda value: value.decode() if isinstance(value, bytes) else str(value)
        readme = (ROOT / "data/README.md").read_text(encoding="utf-8")
        self.assertIn("    " + text(provenance["command"]) + "\n", readme)
        self.assertEqual(int(provenance["dirty"]), 0)
        self.assertRegex(text(provenance["git"]), r"^[0-9a-f]{40}$")


class Hollow(Stored, unittest.TestCase):
    file = ROOT / "data/hollow.h5"


class Compact(Stored, unittest.TestCase):
    file = ROOT / "data/compact.h5"


if __name__ == "__main__":
    unittest.main()
