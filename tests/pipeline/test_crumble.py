"""The Python module `crumble`: its examples are run as they stand in the docstrings, and what it says is held against the format."""

import doctest
import importlib.util
import os
import pathlib
import re
import sys
import tempfile
import unittest

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The module of an installation is tested by the same tests.
sys.path.insert(0, os.environ.get("CRUMBLE_PYTHON", str(ROOT / "pipeline/python")))

import crumble

FILES = ["data/hollow.h5", "data/compact.h5", *(f"data/samples/{stage}-1.2.h5" for stage in ("dryer", "breaker", "rigidstress", "import"))]
SCHEMA = (ROOT / "common/io/SCHEMA.md").read_text(encoding="utf-8")
FOLDER = tempfile.TemporaryDirectory()  # of what the examples write


def load_tests(loader, tests, pattern):
    os.chdir(ROOT)
    for module in (crumble, crumble.arrays, crumble.programs, crumble.result):
        examples = doctest.DocTestSuite(module, extraglobs={"folder": pathlib.Path(FOLDER.name)})
        tests.addTests(test for test in examples if "to_gsd" not in test.id() or importlib.util.find_spec("gsd"))
    return tests


class Module(unittest.TestCase):
    def setUp(self):
        os.chdir(ROOT)

    def test_every_array_has_the_unit_that_the_page_of_the_format_gives(self):
        units = dict(re.findall(r"(?m)^\| `/([^`@]+)` \| [^|]+ \| ([^|]*) \|", SCHEMA))
        checked = 0
        for path in FILES:
            result = crumble.read(path)
            read = {f"particles/all/{name}": array for name, array in result.particles()._columns.items()}
            for group in ("observables", "events"):
                read |= {f"{group}/{name}": array for name, array in getattr(result, group)._columns.items()}
            read |= {f"contacts/{name}": array for name, array in result.contacts()._columns.items()} | result.results
            for name, array in read.items():
                name = re.sub(r"^(flows|errors)/[^/]+", r"\1/<name>", name)
                if units.get(name) not in (None, "as the attribute says"):
                    with self.subTest(file=path, name=name):
                        self.assertEqual(array.unit, units[name])
                        checked += 1
        self.assertGreater(checked, 150)

    def test_arrays_are_those_of_the_file(self):
        for path in FILES:
            result = crumble.read(path)
            with h5py.File(path) as file:
                offset = file["contacts/offset"][:]
                for frame in range(len(result.frames)):
                    numpy.testing.assert_array_equal(result.particles(frame).position, file["particles/all/position/value"][frame])
                    numpy.testing.assert_array_equal(result.contacts(frame).pair, file["contacts/pair"][offset[frame]:offset[frame + 1]])
            self.assertEqual(result.contacts().pair.tolist(), result["connectivity/contacts"].tolist())

    def test_kinds_of_events_are_those_of_the_format(self):
        self.assertIn("| " + ", ".join(f"{k} {kind}" for k, kind in enumerate(crumble.EVENT_KINDS)) + " |", SCHEMA)

    def test_what_is_no_result_is_refused_by_name(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.h5"
            with self.assertRaisesRegex(FileNotFoundError, "a.h5: no such file"):
                crumble.read(path)
            path.write_text("no HDF5")
            with self.assertRaisesRegex(crumble.FileError, "cannot be read as HDF5"):
                crumble.read(path)
            with h5py.File(path, "w"):
                pass
            with self.assertRaisesRegex(crumble.FileError, "not a result of Crumble"):
                crumble.read(path)
            for name, value, words in (("complete", numpy.uint8(0), "not complete"), ("version", numpy.array([2, 0]), "its format is 2.0")):
                path.write_bytes(pathlib.Path(FILES[0]).read_bytes())
                with h5py.File(path, "a") as file:
                    file["h5md/modules/agglomerate"].attrs[name] = value
                with self.assertRaisesRegex(crumble.FileError, words):
                    crumble.read(path)

    def test_frames_and_names_that_are_not_there_are_errors_that_say_what_is(self):
        result = crumble.read(FILES[0])
        with self.assertRaisesRegex(IndexError, "no frame 22, there are 22"):
            result.contacts(22)
        with self.assertRaisesRegex(AttributeError, "no gaps here; there are born, flags, gap"):
            result.contacts().gaps
        with self.assertRaisesRegex(KeyError, "no array contacts/gaps"):
            result["contacts/gaps"]

    def test_a_program_that_fails_is_an_exception_with_its_message_and_code(self):
        with tempfile.TemporaryDirectory() as folder:
            broken = pathlib.Path(folder) / "broken.h5"
            with h5py.File(broken, "w"):
                pass
            for scene, inputs, code, words in (("no.toml", [], 2, "no.toml"), ("pipeline/scenes/stress.toml", [broken], 3, "broken.h5")):
                with self.assertRaisesRegex(crumble.ProgramError, words) as raised:
                    crumble.run("rigidstress" if inputs else "dryer", scene, *inputs, output=pathlib.Path(folder) / "out.h5")
                self.assertEqual(raised.exception.code, code)
            with self.assertRaisesRegex(crumble.ProgramError, "unknown verb 'look'"):
                crumble.agglomerate("look", "a.h5")
            with self.assertRaisesRegex(FileNotFoundError, "crusher: not found"):
                crumble.run("crusher", "a.toml", output="a.h5")


if __name__ == "__main__":
    unittest.main()
