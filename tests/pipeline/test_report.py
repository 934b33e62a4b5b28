"""What the scripts of pipeline/report share, and that they take from a file what stands in it."""

import contextlib
import io
import math
import pathlib
import sys
import tempfile
import unittest

import h5py
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "pipeline/report"))
import concentration
import table

SCENE = """[liquid]
temperature = {temperature}  # K
surface_tension = {tension}  # N m-1
contact_angle = {angle}  # degree
"""


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


class Tables(InAFolder):
    def test_a_table_whose_rows_fail_leaves_the_old_file_as_it_was(self):
        path = self.folder / "a.csv"
        table.write_csv(path, ["x", "y"], [[1, "a, b"]], ["why"])
        self.assertEqual(path.read_bytes(), b'# why\nx,y\n1,"a, b"\n')
        with self.assertRaises(ZeroDivisionError):
            table.write_csv(path, ["x"], ([1 / k] for k in (1, 0)))
        self.assertEqual(path.read_bytes(), b'# why\nx,y\n1,"a, b"\n')

    def test_records_keep_the_order_of_their_keys(self):
        table.write_records(self.folder / "a.csv", [{"b": 1, "a": 2}, {"b": 3, "a": 4}])
        self.assertEqual((self.folder / "a.csv").read_text(), "b,a\n1,2\n3,4\n")

    def test_markdown_has_a_line_below_its_heading_and_one_width_a_column(self):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            table.print_markdown(["a", "long"], ([x, "y"] for x in ("1", "22")))
        self.assertEqual(out.getvalue(), "| a  | long |\n|----|------|\n| 1  | y    |\n| 22 | y    |\n")


class Concentration(InAFolder):
    def granule(self, name, tension="1.75e-04", temperature=300.0, angle=0.0):
        path = self.folder / name
        with h5py.File(path, "w") as file:
            file["parameters/resolved"] = SCENE.format(tension=tension, temperature=temperature, angle=angle)
            file["particles/all/radius"] = [10.0]
            file["particles/all/position/value"] = [[[1.0, 0, 0]]] * 3
            file["observables/droplet_radius/value"] = 215 * numpy.sqrt(1 - numpy.array(concentration.THETA))
        return str(path)

    def test_the_liquid_is_that_of_the_file(self):
        *_, a, tension, temperature = concentration.read([self.granule("a.h5", "7.2e-02", 350.0, 60.0)])
        self.assertAlmostEqual(a, 1e-8)
        self.assertAlmostEqual(tension, 7.2e-2 * math.cos(math.pi / 6) ** 2)
        self.assertEqual(temperature, 350)

    def test_granules_of_two_liquids_are_not_averaged(self):
        with self.assertRaisesRegex(SystemExit, "differ"):
            concentration.read([self.granule("a.h5"), self.granule("b.h5", "3e-04")])

    def test_a_liquid_that_a_law_gives_is_refused_by_name(self):
        with self.assertRaisesRegex(SystemExit, 'liquid.surface_tension = "water"'):
            concentration.read([self.granule("a.h5", '"water"')])


if __name__ == "__main__":
    unittest.main()
