"""Answers in a formulator's words, beside the numbers they come from."""

import contextlib
import io
import sys
import types
import unittest

import test_campaign
from test_campaign import InAFolder, campaign, scene_text

import answer
import sample


class Answers(InAFolder):
    def ask(self, text, *more, code=0):
        path = self.write("my.toml", text)
        was, sys.argv = sys.argv, ["campaign", "strength", str(path), "-o", str(self.folder / "out"), "--programs", str(self.programs), *more]
        try:
            with contextlib.redirect_stdout(io.StringIO()) as told, contextlib.redirect_stderr(io.StringIO()) as said:
                self.assertEqual(campaign.main(), code, said.getvalue())
        finally:
            sys.argv = was
        return told.getvalue() + said.getvalue()

    TEXT = test_campaign.PLAIN.replace("3", "20") + "[stress]\nscene = \"stress.toml\"\n[breakup]\nscene = \"break.toml\"\ncount = 5\n"

    def test_shear_rates_and_dissipation_rates_are_those_of_the_stresses(self):
        told = self.ask(self.TEXT, "--liquid", "syrup 0.1 Pa s 1200 kg/m3")
        self.run_it(self.TEXT)
        stresses = sorted(float(row["critical_stress_worst [Pa]"]) for row in self.table())
        half = sample.quantile(stresses, 0.5)
        line = next(line for line in told.partition("**Turbulence**")[2].splitlines() if line.startswith("| syrup"))
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        self.assertTrue(cells[2].startswith(f"{half / 0.1:.2g} ("), cells)
        self.assertTrue(cells[5].startswith(f"{0.1 / 1200 * (half / 0.1) ** 2:.2g} ("), cells)
        low, high = sample.quantile_interval(stresses, 0.5)
        self.assertIn(f"({low / 0.1:.2g} to {high / 0.1:.2g})", cells[2])
        self.assertIn("blood (0.0035 Pa s)", told)
        self.assertIn("as in: a device of the worst", told)
        self.assertIn("Into what: 3 pieces on average of 5 breakups; the largest has 60 % of the mass", told)
        self.assertTrue(told.startswith((self.folder / "out/strength.md").read_text()), told)

    def test_where_eddies_are_smaller_than_the_granule_the_answer_is_marked(self):
        # Stresses of thousands of Pa in a thin liquid: eddies of some 20 nm beside granules of 1 um; in a thick one they are larger.
        told = self.ask(self.TEXT, "--liquid", "thin 1e-4 Pa s 1000 kg/m3", "--liquid", "thick 10 Pa s 1000 kg/m3").partition("**Turbulence**")[2]
        line = lambda name: next(line for line in told.splitlines() if line.startswith(f"| {name}"))
        self.assertEqual((line("thin").count("*"), line("thick").count("*")), (3, 0))
        self.assertIn("the flow is not linear about it", told)

    def test_faults_are_named(self):
        self.assertIn("--liquid 'syrup': must be a name, a viscosity and a density", self.ask(self.TEXT, "--liquid", "syrup", code=2))
        self.assertIn("varies one key", self.ask(self.TEXT, "--break-at", "100", code=2))


class HowToMake(unittest.TestCase):
    def plan(self, medians):
        """Granules of 30 that scatter by a tenth about a median, over Pe = 1, 10, 100 ..."""
        points = [{"dry.droplet.peclet": 10.0**k} for k in range(len(medians))]
        rows = [types.SimpleNamespace(point=point, values={"critical_stress_elongation": median * (0.9 + 0.2 * j / 29)}, above={}, errors={}, failure=None)
                for point, median in zip(points, medians) for j in range(30)]
        return types.SimpleNamespace(path="my.toml", points=[(point, 30) for point in points], varied=["dry.droplet.peclet"], unit=lambda key: ""), rows

    def test_between_two_points_stress_is_a_power_of_the_key(self):
        told = answer.how_to_make(*self.plan([8000, 4000, 1000]), 2000)
        self.assertIn("at droplet.peclet = 32;", told)  # half way between 10 and 100 in ratios
        self.assertRegex(told, r"intervals of the medians (2[0-9]|3[01]) to 3[2-9]")

    def test_what_lies_outside_or_is_crossed_twice_is_said(self):
        self.assertIn("No droplet.peclet of the campaign", answer.how_to_make(*self.plan([8000, 4000]), 100))
        self.assertIn("more than once", answer.how_to_make(*self.plan([8000, 1000, 8000]), 2000))


if __name__ == "__main__":
    unittest.main()
