"""What the scripts of pipeline/report share, and that they take from a file what stands in it."""

import contextlib
import importlib
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
drying_map = importlib.import_module("map")  # not to hide the built-in

SCENE = """[fluid]
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


class Map(unittest.TestCase):
    def scan(self, *stresses):
        return [{"peclet": float(10**k), **{f"critical_stress_pa{which}": factor * stress
                                           for which, factor in (("", 1), ("_lowest", 0.5), ("_highest", 2))}}
                for k, stress in enumerate(stresses)]

    def said(self, scan):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            drying_map.answer(scan)
        return out.getvalue()

    def test_between_two_rows_the_stress_is_a_power_of_the_peclet_number(self):
        scan = self.scan(8000, 4000, 1000)  # Pe = 1, 10, 100
        self.assertAlmostEqual(drying_map.peclet_for(2000, scan, "critical_stress_pa"), 10 * math.sqrt(10))
        self.assertAlmostEqual(drying_map.peclet_for(2000, scan, "critical_stress_pa_lowest"), 10)
        self.assertIsNone(drying_map.peclet_for(500, scan, "critical_stress_pa"))

    def test_only_where_it_falls_does_the_stress_name_a_peclet_number(self):
        text = self.said(self.scan(5000, 3000, 6000, 1500))
        self.assertIn("Up to Pe = 100 ", text)
        self.assertIn("means from 3000 to 6000 Pa, single granules from 1500 to 12000 Pa", text)
        row = next(line for line in text.splitlines() if line.startswith("| 3000 "))
        self.assertEqual([cell.strip() for cell in row.strip("|").split("|")][2:], ["320", "100", "1000"])

    def test_a_granule_that_settles_nowhere_is_left_out_of_the_stress_alone(self):
        run = {"peclet": 1.0, "number": 85, "solids": 0.01, "d_c_nm": 100, "h_c_over_d_c": 0.4, "porosity": 0.5, "coordination": 4,
               "fragments": 1, "critical_stress_pa": 4000, "cpu_s": 1}
        (row,) = drying_map.rows([run, run | {"d_c_nm": 200, "critical_stress_pa": None}])
        self.assertEqual((row["critical_stress_pa"], row["d_c_nm"], row["granules"]), (4000, 150, 2))
        (row,) = drying_map.rows([run | {"critical_stress_pa": None}])
        self.assertTrue(math.isnan(row["critical_stress_pa"]))


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
        with self.assertRaisesRegex(SystemExit, 'fluid.surface_tension = "water"'):
            concentration.read([self.granule("a.h5", '"water"')])


if __name__ == "__main__":
    unittest.main()
