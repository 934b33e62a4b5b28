"""Other tools open the agglomerate file: h5dump, h5py and MDAnalysis agree with what we wrote.

Usage: file_other_readers.py PROGRAM_THAT_WRITES_A_SAMPLE
"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
import warnings

import h5py
import numpy as np

warnings.simplefilter("ignore")
try:
    import MDAnalysis
except ModuleNotFoundError as missing:  # Ubuntu 24.04 does not have it
    if missing.name != "MDAnalysis":
        raise
    MDAnalysis = None


class OtherReaders(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = os.path.join(cls.folder.name, "sample.h5")
        cls.frames = json.loads(subprocess.check_output([program, cls.path]))
        # MDAnalysis goes by the extension.
        cls.link = os.path.join(cls.folder.name, "sample.h5md")
        os.symlink(cls.path, cls.link)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_h5dump_lists_every_array_with_its_unit(self):
        text = subprocess.check_output(["h5dump", "-A", self.path], text=True)
        for word in ("position", "radius_of_gyration", "normal_force", "provenance", '"nm"', '"N m"', '"h5md"'):
            self.assertIn(word, text)

    def test_h5py_reads_values_units_and_links(self):
        with h5py.File(self.path, "r") as file:
            np.testing.assert_array_equal(file["h5md"].attrs["version"], [1, 1])
            self.assertEqual(file["particles/all/position/value"].attrs["unit"], "nm")
            self.assertEqual(file["particles"].get("trajectory", getlink=True).path, "all")
            self.assertEqual(file["particles/all/velocity/step"], file["particles/all/position/step"])
            self.assertEqual(file[file["connectivity/contacts"].attrs["particles_group"]], file["particles/all"])
            self.assertEqual(file["parameters/resolved"].asstr()[()], 'a = 1\nb = "é"\n')
            offset = file["contacts/offset"][:]
            pair = file["contacts/pair"][offset[-2]:offset[-1]]
            np.testing.assert_array_equal(pair, file["connectivity/contacts"][:])
            for t, frame in enumerate(self.frames):
                # x * 1e9 here and there: the same rounding, so the same bits.
                np.testing.assert_array_equal(file["particles/all/position/value"][t], frame["position_nm"])
                self.assertEqual(file["particles/all/position/time"][t], frame["time_s"])
                self.assertEqual(file["particles/all/position/step"][t], frame["step"])
                self.assertAlmostEqual(file["observables/radius_of_gyration/value"][t],
                                       frame["radius_of_gyration_nm"], delta=1e-12 * frame["radius_of_gyration_nm"])

    def test_every_array_has_a_unit_unless_it_is_a_pure_number(self):
        pure = {"step", "offset", "pair", "normal", "flags", "born", "id", "species", "contacts", "orientation",
                "contact_count", "coordination_number", "fragment_count", "largest_fragment", "wetted_count",
                "input", "resolved"}
        with h5py.File(self.path, "r") as file:
            def visit(name, item):
                if isinstance(item, h5py.Dataset):
                    parts = name.split("/")
                    noun = parts[-2] if parts[-1] == "value" else parts[-1]
                    self.assertEqual("unit" in item.attrs, noun not in pure, name)
            file.visititems(visit)

    @unittest.skipUnless(MDAnalysis, "this system has no MDAnalysis")
    def test_mdanalysis_agrees_on_positions_and_radius_of_gyration(self):
        universe = MDAnalysis.Universe(self.link)
        self.assertEqual(universe.trajectory.n_frames, len(self.frames))
        with h5py.File(self.path, "r") as file:
            mass = file["particles/all/mass"][:]
        universe.add_TopologyAttr("masses", mass / mass.mean())
        for ours, theirs in zip(self.frames, universe.trajectory):
            # It keeps single precision in Angstrom: a relative error of 6e-8 a coordinate, with some room.
            scale = np.abs(ours["position_nm"]).max()
            np.testing.assert_allclose(theirs.positions / 10, ours["position_nm"], rtol=0, atol=2e-7 * scale)
            gyration = universe.atoms.radius_of_gyration() / 10
            self.assertAlmostEqual(gyration / ours["radius_of_gyration_nm"], 1, delta=2e-7)
            self.assertAlmostEqual(theirs.data["radius_of_gyration"] / ours["radius_of_gyration_nm"], 1, delta=1e-12)
            self.assertAlmostEqual(theirs.time / (ours["time_s"] * 1e12), 1, delta=1e-12)  # its time is in ps
            self.assertTrue(theirs.has_velocities and theirs.has_forces)


if __name__ == "__main__":
    program = sys.argv.pop(1)
    unittest.main(verbosity=2)
