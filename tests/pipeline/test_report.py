"""What the scripts of pipeline/report share, how they and those of pipeline/verify take their arguments, and what they take from a file."""

import contextlib
import importlib
import io
import json
import math
import os
import pathlib
import re
import resource
import shlex
import signal
import statistics
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

PIPELINE = pathlib.Path(__file__).resolve().parents[2] / "pipeline"
sys.path[:0] = [str(PIPELINE / "report"), str(PIPELINE / "verify")]
import arguments
import concentration
import lifetimes
import table
from interval import half_width
drying_map = importlib.import_module("map")  # not to hide the built-in

SCENE = """[droplet]
peclet = {peclet}
[fluid]
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

    def test_a_disk_that_is_full_is_told_by_the_name_of_the_file_and_nothing_is_left_beside_it(self):
        path = self.folder / "a.csv"
        path.write_text("old")
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000, was := resource.getrlimit(resource.RLIMIT_FSIZE)[1]))
        handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        try:
            with self.assertRaises(OSError) as caught:
                table.write_csv(path, ["x"], [["y" * 100]] * 100)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, (was, was))
            signal.signal(signal.SIGXFSZ, handler)
        self.assertEqual(caught.exception.filename, str(path))
        self.assertEqual([one.read_text() for one in self.folder.iterdir()], ["old"])

    def test_what_stops_a_script_from_outside_is_told_in_one_line(self):
        script = PIPELINE / "report/population.py"
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run(["/usr/bin/python3", "-B", script, f"hollow={PIPELINE / 'campaigns/hollow.csv'}"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (1, "population.py: stdout: No space left on device\n"))

    def test_records_keep_the_order_of_their_keys(self):
        table.write_records(self.folder / "a.csv", [{"b": 1, "a": 2}, {"b": 3, "a": 4}])
        self.assertEqual((self.folder / "a.csv").read_text(), "b,a\n1,2\n3,4\n")

    def test_markdown_has_a_line_below_its_heading_and_one_width_a_column(self):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            table.print_markdown(["a", "long"], ([x, "y"] for x in ("1", "22")))
        self.assertEqual(out.getvalue(), "| a  | long |\n|----|------|\n| 1  | y    |\n| 22 | y    |\n")


class Arguments(InAFolder):
    def setUp(self):
        super().setUp()
        for name in ("a.h5", "b.h5", "c.h5"):
            (self.folder / name).touch()
        was = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, was)

    def parser(self, **more):
        parser = arguments.parser("What it does.\n\nMore of it.\n\n    it.py hollow=a.h5 -o b.md\n", "the table", **more)
        arguments.add_groups(parser, "rows", names=["hollow", "compact"])
        arguments.add_groups(parser, "broken ones", "--broken")
        return parser

    def refusal(self, *given, **more):
        said = io.StringIO()
        with self.assertRaises(SystemExit) as ended, contextlib.redirect_stderr(said):
            self.parser(**more).parse_args(given)
        self.assertEqual(ended.exception.code, 2)
        return said.getvalue()

    def test_groups_keep_their_order_and_so_do_their_files(self):
        found = self.parser().parse_args(["hollow=b.h5,a.h5", "compact=c.h5", "--broken", "x=a.h5", "-o", "t.md"])
        self.assertEqual({name: [str(path) for path in paths] for name, paths in found.groups.items()},
                         {"hollow": ["b.h5", "a.h5"], "compact": ["c.h5"]})
        self.assertEqual(list(found.groups), ["hollow", "compact"])
        self.assertEqual((found.broken, found.out), ({"x": [pathlib.Path("a.h5")]}, pathlib.Path("t.md")))
        self.assertEqual(self.parser().parse_args(["hollow=a.h5", "-o", "t.md"]).broken, {})

    def test_what_is_missing_is_named(self):
        self.assertIn("required: -o, NAME=FILE,...", self.refusal())
        self.assertIn("required: NAME=FILE,...\n", self.refusal(required=False))
        for given, words in (("hollow=a.h5,absent.h5", "absent.h5: no such file"), ("hollow=", "hollow=: names no file"),
                             ("a.h5", "'a.h5': expected NAME=FILE,FILE,..."), ("=a.h5", "'=a.h5': expected NAME=FILE"),
                             ("hollw=a.h5", "hollw: not known; there are hollow, compact")):
            self.assertIn(words, self.refusal(given, "-o", "t.md"))
        self.assertIn("hollow: named twice", self.refusal("hollow=a.h5", "hollow=b.h5", "-o", "t.md"))

    def test_what_is_printed_goes_to_the_file_which_stays_as_it_was_if_that_fails(self):
        with arguments.printing_to(self.folder / "t.md"):
            print("old")
        with self.assertRaises(ZeroDivisionError), arguments.printing_to(self.folder / "t.md"):
            print(f"{1 / 0}")
        self.assertEqual((self.folder / "t.md").read_text(), "old\n")

    def test_every_script_teaches_by_an_example_that_it_takes_itself(self):
        scripts = [path for folder in ("report", "verify") for path in sorted((PIPELINE / folder).glob("*.py"))
                   if "__main__" in path.read_text(encoding="utf-8")]
        self.assertGreater(len(scripts), 20)
        for path in scripts:
            with self.subTest(script=path.name):
                self.assertNotRegex(path.read_text(encoding="utf-8"), r"sys\.argv|import argparse")
                module = importlib.import_module(path.stem)
                parser = module.command_line()
                parser.prog = path.name
                said = " ".join(parser.format_help().split())
                first = module.__doc__.strip().splitlines()[0]
                self.assertRegex(first, r"[.!?:]$")
                self.assertIn(" ".join(first.split()), said)
                examples = re.findall(rf"(?m)^    {path.name}(.*)$", module.__doc__)
                self.assertTrue(examples, "no example")
                for example in examples:
                    self.assertIn(" ".join(example.split()), said)
                    words = shlex.split(example)
                    for name in re.findall(r"[\w./-]+", example):  # whatever is read has to be there
                        if "/" in name or "." in name:
                            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
                            (self.folder / name).touch()
                    parser.parse_args(words)
                if path.parent.name == "verify":
                    parser.parse_args([])  # as `make verify` runs it


    def test_every_other_script_answers_help_as_a_program(self):
        # Those of report and verify are asked above, without a process for each.
        programs = [path for path in sorted(PIPELINE.rglob("*.py")) if '__name__ == "__main__"' in path.read_text(encoding="utf-8")
                    and path.parent.name not in ("report", "verify", "campaign")]
        scripts = sorted(set(PIPELINE.rglob("*.sh")) - {PIPELINE / "verify/platforms/chroot.sh"}) + programs
        scripts += [PIPELINE / "campaign", PIPELINE / "install/crumble", PIPELINE / "install/crumble-demo", *sorted((PIPELINE.parent / "tests").rglob("bench.py")),
                    PIPELINE.parent / "tests/faults/plant.py"]
        self.assertGreater(len(scripts), 15)
        for path in scripts:
            with self.subTest(script=path.name):
                command = ["/bin/bash"] if path.suffix == ".sh" or path.parent.name == "install" else ["/usr/bin/python3", "-B"]
                done = subprocess.run([*command, path, "--help"], capture_output=True, text=True, timeout=30)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertGreater(len(done.stdout.splitlines()), 0)


class Lifetimes(InAFolder):
    def test_two_granules_are_lowest_to_highest_and_more_have_an_interval(self):
        row = lambda *values: {"granules": len(values), "d": statistics.fmean(values), "d_lowest": min(values), "d_highest": max(values),
                               "d_spread": statistics.stdev(values), "d_half_width": half_width(values)}
        self.assertEqual(lifetimes.cell(row(2.0, 1.0), "d", "{:.2f}"), "1.00 to 2.00")
        self.assertEqual(lifetimes.reach(row(2.0, 1.0), "d"), (0.5, 0.5))
        # Student's t for three: 4.30/sqrt(3) = 2.483 spreads.
        self.assertEqual(lifetimes.cell(row(1.0, 2.0, 3.0), "d", "{:.2f}"), "2.00 ± 2.48 (sd 1.00)")

    def test_the_integrator_is_that_of_the_report_whatever_the_name(self):
        report = {"inputs": {"integrator": {"method": "overdamped"}}, "cpu_s": 1, "results": {
            "inputs": {"lifetime_s": 3e-3, "capillary_speed_limit_m_per_s": 1, "evaporation_constant_m2_per_s": 1}, "d_c_nm": 8e3,
            "h_c_over_d_c": 0.3, "contacts": 1, "fragments": 1}}
        path = self.folder / "inertial-25ms-1.json"
        path.write_text(json.dumps(report))
        found = lifetimes.read(path)
        self.assertEqual((found["integrator"], found["lifetime_ms"]), ("overdamped", 3))


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
    def granule(self, name, tension="1.75e-04", temperature=300.0, angle=0.0, peclet="10"):
        path = self.folder / name
        with h5py.File(path, "w") as file:
            file["parameters/resolved"] = SCENE.format(peclet=peclet, tension=tension, temperature=temperature, angle=angle)
            file["particles/all/radius"] = [10.0]
            file["particles/all/position/value"] = [[[1.0, 0, 0]]] * 3
            file["observables/droplet_radius/value"] = 215 * numpy.sqrt(1 - numpy.array(concentration.THETA))
        return str(path)

    def test_the_liquid_is_that_of_the_file(self):
        _, peclet, a, tension, temperature = concentration.read([self.granule("a.h5", "7.2e-02", 350.0, 60.0)])
        self.assertEqual(peclet, 10)
        self.assertAlmostEqual(a, 1e-8)
        self.assertAlmostEqual(tension, 7.2e-2 * math.cos(math.pi / 6) ** 2)
        self.assertEqual(temperature, 350)

    def test_granules_of_two_liquids_are_not_averaged(self):
        with self.assertRaisesRegex(SystemExit, "differ"):
            concentration.read([self.granule("a.h5"), self.granule("b.h5", "3e-04")])
        with self.assertRaisesRegex(SystemExit, "differ"):
            concentration.read([self.granule("c.h5"), self.granule("d.h5", peclet="1")])

    def test_a_liquid_that_a_law_gives_is_refused_by_name(self):
        with self.assertRaisesRegex(SystemExit, 'fluid.surface_tension = "water"'):
            concentration.read([self.granule("a.h5", '"water"')])


if __name__ == "__main__":
    unittest.main()
