"""Files of earlier programs stay readable: test_samples.py FOLDER_OF_PROGRAMS.

data/samples holds one file of each program, PROGRAM-SCHEMA.h5, and what `agglomerate info --json` said of it on that day,
PROGRAM-SCHEMA.json. A file is never changed or removed; a new version of the schema adds its own.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(sys.argv.pop())
SAMPLES = sorted((ROOT / "data" / "samples").glob("*.h5"))


class Samples(unittest.TestCase):
    def run_program(self, program, *arguments):
        done = subprocess.run([BIN / program, *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, f"{program} {' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
        return done.stdout

    def test_there_is_one_of_each_program_in_every_version(self):
        versions = {file.stem.partition("-")[2] for file in SAMPLES}
        self.assertEqual({file.stem for file in SAMPLES}, {f"{program}-{version}" for version in versions
                                                          for program in ("import", "dryer", "breaker", "rigidstress")})

    def test_each_is_valid(self):
        self.run_program("agglomerate", "check", *SAMPLES)

    def test_each_says_what_it_said(self):
        for file in SAMPLES:
            with self.subTest(file.name):
                said = json.loads(self.run_program("agglomerate", "info", file, "--json"))
                self.assertEqual({**said, "file": file.name}, json.loads(file.with_suffix(".json").read_text()))

    def test_each_is_taken_by_the_stages_that_follow_and_by_the_exports(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "scene.toml")
            scene.write_text('[particle]\nfragments = "largest"\n')
            each = pathlib.Path(folder, "each.toml")
            each.write_text('[particle]\nfragments = "each"\n')
            for file in SAMPLES:
                with self.subTest(file.name):
                    self.run_program("breaker", scene, file, "--check")
                    self.run_program("rigidstress", each, file, "--check")
                    self.run_program("agglomerate", "export", file, "-o", pathlib.Path(folder, file.stem + ".xyz"))
                    self.run_program("agglomerate", "morphology", file)


if __name__ == "__main__":
    unittest.main()
