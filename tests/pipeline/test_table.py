import json
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def report(seed, d_c, contacts, **errors):
    return {"program": "dryer", "version": "0.1.0", "scene": "hollow.toml", "seed": seed, "wall_s": 2.0, "cpu_s": 1.5,
            "peak_rss_bytes": 1, "steps": 100 * seed,
            "results": {"d_c_nm": d_c, "h_c_over_d_c": 0.3, "contacts": contacts, "coordination": 2 * contacts / 115,
                        "fragments": 1},
            "errors": {key: {"value": value, "how": "by halving"} for key, value in errors.items()},
            "left_out": ["Brownian motion: D = 0"]}


class Table(unittest.TestCase):
    def table(self, *reports):
        with tempfile.TemporaryDirectory() as folder:
            names = []
            for i, content in enumerate(reports):
                names.append(f"{folder}/{i}.json")
                pathlib.Path(names[-1]).write_text(json.dumps(content))
            return subprocess.run(["/usr/bin/python3", "-B", ROOT / "pipeline/report/granules.py", "hollow=" + ",".join(names)], text=True,
                                  capture_output=True)

    def row(self, done, name):
        (line,) = [line for line in done.stdout.splitlines() if line.split()[:1] == [name]]
        return line.split()[1:]

    def test_mean_and_spread_are_over_the_seeds(self):
        done = self.table(report(1, 150, 170), report(2, 160.0, 180), report(3, 170, 175))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.row(done, "mean"), ["160.0", "0.300", "175.0", "3.04", "4.50"])
        self.assertEqual(self.row(done, "spread"), ["10.0", "0.000", "5.0", "0.09"])
        # Student's t for three: 4.30/sqrt(3) = 2.483 spreads.
        self.assertEqual(self.row(done, "±95%"), ["24.8", "0.000", "12.4", "0.22"])
        self.assertEqual(self.row(done, "place"), ["+0.0", "-", "+1.8", "+1.6"])
        self.assertEqual(self.row(done, "2"), ["160.0", "0.300", "180", "3.13", "1", "200", "2.00", "1.50"])

    def test_two_granules_are_shown_as_lowest_and_highest(self):
        done = self.table(report(1, 170, 170), report(2, 160.0, 180))
        self.assertEqual(self.row(done, "lowest"), ["160.0", "0.300", "170.0", "2.96"])
        self.assertEqual(self.row(done, "highest"), ["170.0", "0.300", "180.0", "3.13", "3.00"])
        self.assertFalse([line for line in done.stdout.splitlines() if line.split()[:1] in (["spread"], ["±95%"])])

    def test_the_error_is_the_largest_of_the_seeds_in_the_unit_of_its_column(self):
        errors = {"h_c_over_d_c": 0.002, "contacts_relative": 0.0}
        done = self.table(report(1, 150, 170, d_c_relative=-0.02, **errors),
                          report(2, 170, 170, d_c_relative=0.01, **errors))
        self.assertEqual(self.row(done, "error"), ["3.2", "0.002", "0", "0"])
        self.assertIn("d_c_relative, h_c_over_d_c, contacts_relative: by halving", done.stdout)

    def test_an_error_that_one_run_did_not_estimate_is_not_invented(self):
        done = self.table(report(1, 150, 170, d_c_relative=0.01), report(2, 150, 170, d_c_relative=None))
        self.assertEqual(self.row(done, "error"), ["?", "?", "?", "?"])

    def test_a_report_without_a_result_is_refused_by_name(self):
        broken = report(1, 150, 170)
        broken["results"]["d_c_nm"] = None
        done = self.table(broken)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("results/d_c_nm: expected a finite number, found None", done.stderr)


if __name__ == "__main__":
    unittest.main()
