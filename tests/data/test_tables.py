"""Every table of data/ can be read, says its source and its units, and is listed; the paper's row is the one we dry."""

import csv
import math
import pathlib
import sys
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT / "data"
sys.path.insert(0, str(ROOT / "pipeline/report"))
import published  # what the programs print beside our numbers

TEXT = {"material", "quantity", "symbol", "unit", "code", "choice", "cluster", "case", "function", "lubrication"}
UNITS = ("_nm", "_um", "_ms", "_s", "_N", "_pN", "_J", "_kT", "_kT_300K", "_percent", "_N_per_m", "_N_m", "_m2_per_s", "_J_per_m2")
DIMENSIONLESS = {"monomers", "starts", "peclet", "h_c_over_d_c", "h_c_over_d_c_spread", "coordination", "contacts",
                 "contacts_spread", "rolling_limit", "counted_gap_over_a", "gap_over_a", "inverse", "logarithm",
                 "constant", "x_logarithm", "value", "error",
                 "XA11", "XA12", "YA11", "YA12", "YB11", "YC11", "YC12", "XG11", "XM11", "YM11", "ZM11"}


def read(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    count = next(k for k, line in enumerate(lines) if not line.startswith("#"))
    heading, *rows = list(csv.reader(lines[count:], strict=True))
    return lines[:count], heading, rows


class Tables(unittest.TestCase):
    def each(self, claim):
        paths = sorted(DATA.glob("*.csv"))
        self.assertGreater(len(paths), 10)
        for path in paths:
            with self.subTest(path.name):
                claim(*read(path))

    def test_each_says_its_source(self):
        def claim(comments, heading, rows):
            self.assertEqual(sum(line.startswith("# source: ") for line in comments), 1)
            self.assertRegex(" ".join(comments), "2022|1984|computed for Crumble, November 2026")
        self.each(claim)

    def test_each_has_rows_as_wide_as_its_heading(self):
        def claim(comments, heading, rows):
            self.assertEqual(len(set(heading)), len(heading))
            self.assertGreater(len(rows), 0)
            for row in rows:
                self.assertEqual(len(row), len(heading), row)
        self.each(claim)

    def test_each_cell_is_a_number_unless_its_column_is_text(self):
        def claim(comments, heading, rows):
            for row in rows:
                for name, cell in zip(heading, row):
                    if name not in TEXT and cell:
                        float(cell)  # raises
        self.each(claim)

    def test_each_column_has_its_unit(self):
        def claim(comments, heading, rows):
            if "unit" not in heading:
                for name in heading:
                    self.assertTrue(name in TEXT or name in DIMENSIONLESS or name.endswith(UNITS), name)
        self.each(claim)

    def test_the_readme_lists_every_file(self):
        readme = (DATA / "README.md").read_text(encoding="utf-8")
        for path in DATA.iterdir():
            if path.name != "README.md" and not path.name.endswith(".tmp"):
                self.assertIn(f"`{path.name}`", readme)


class Paper(unittest.TestCase):
    def setUp(self):
        _, heading, rows = read(DATA / "paper_table_2.csv")
        self.rows = [dict(zip(heading, row)) for row in rows]
        self.first = self.rows[0]

    def test_the_hollow_scene_is_the_first_row_of_table_2(self):
        scene = tomllib.loads((ROOT / "pipeline/scenes/hollow.toml").read_text(encoding="utf-8"))
        self.assertEqual(scene["particle"]["number"], int(self.first["monomers"]))
        self.assertAlmostEqual(scene["particle"]["radius"] * 1e9, float(self.first["radius_nm"]))
        self.assertAlmostEqual(scene["droplet"]["radius"] * 1e6, float(self.first["droplet_radius_um"]))
        self.assertAlmostEqual(scene["droplet"]["lifetime"] * 1e3, float(self.first["lifetime_ms"]))

    def test_the_published_numbers_are_those_of_the_table(self):
        self.assertEqual(len(published.GRANULES), len(self.rows))
        for granule, row in zip(published.GRANULES.values(), self.rows):
            for key in ("d_c_nm", "h_c_over_d_c"):
                self.assertEqual(float(granule[key]), float(row[key]), row)
            peclet = "→ ∞" if row["peclet"] == "inf" else f"= {row['peclet']}"
            self.assertEqual(granule["title"], f"Pe {peclet}, N = {row['monomers']}")

    def test_contacts_and_coordination_agree(self):
        # 2 contacts/N; the paper rounds to 0.01 and tells of one contact more or less in different places.
        for granule, row in zip(published.GRANULES.values(), self.rows):
            if "contacts" in granule:
                self.assertAlmostEqual(granule["coordination"], 2 * granule["contacts"] / int(row["monomers"]), delta=0.025)


class SurfaceEnergy(unittest.TestCase):
    def test_the_page_says_what_follows_from_the_hamaker_constants(self):
        page = (ROOT / "common/contact/SURFACE_ENERGY.md").read_text(encoding="utf-8")
        _, heading, rows = read(DATA / "surface_energy.csv")
        for row in rows:
            cell = dict(zip(heading, row))
            for place in ("dry", "water"):
                hamaker, energy = float(cell[f"hamaker_{place}_J"]), float(cell[f"surface_energy_{place}_J_per_m2"])
                computed = hamaker / (24 * math.pi * 0.165e-9**2)
                self.assertAlmostEqual(energy / computed, 1, delta=0.03)  # two digits
            line = next(line for line in page.splitlines() if line.lower().startswith(f"| {cell['material'].lower()} |"))
            self.assertEqual([column.strip() for column in line.split("|")[2:4]],
                             [cell["surface_energy_dry_J_per_m2"], cell["surface_energy_water_J_per_m2"]])


if __name__ == "__main__":
    unittest.main()
