"""An installation in a temporary folder: programs, Python module, manual pages, completion and the pipeline work from there."""

import gzip
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = os.environ.get("CRUMBLE_BUILD", str(ROOT / "build/release"))
PROGRAMS = ("dryer", "rigidstress", "breaker", "agglomerate")
TINY = "--set particle.number=12 --set droplet.radius=101e-9"
TINY_GRANULES = "dry.particle.number=12 dry.droplet.radius=101e-9"


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.prefix, cls.work = pathlib.Path(folder.name) / "prefix", pathlib.Path(folder.name) / "work"
        cls.work.mkdir()
        subprocess.run(["cmake", "--install", BUILD, "--prefix", cls.prefix], check=True, stdout=subprocess.DEVNULL)

    def run_there(self, *command):
        env = {"PATH": f"{self.prefix}/bin:/usr/bin:/bin", "HOME": str(self.work), "LC_ALL": "C.UTF-8", "MANWIDTH": "80",
               "PYTHONPATH": str(self.prefix / "lib/python3/dist-packages")}
        done = subprocess.run(command, cwd=self.work, env=env, text=True, stdin=subprocess.DEVNULL, capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_every_program_says_version_and_build(self):
        version = re.search(r"project\(crumble VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
        for program in PROGRAMS:
            self.assertRegex(self.run_there(program, "--version").stdout, rf"^{program} {version}\ncommit [0-9a-f]{{7,}}|unknown.*\ncompiler ")
        self.assertEqual(self.run_there("crumble", "--version").stdout, self.run_there("dryer", "--version").stdout)
        self.assertIn(f"\nversion: {version}\n", (ROOT / "CITATION.cff").read_text())
        self.assertIn(f"\n## {version}", (ROOT / "CHANGELOG.md").read_text())

    def test_the_front_command_runs_stages_and_the_pipeline(self):
        scenes = self.prefix / "share/crumble/pipeline/scenes"
        (self.work / "quick.toml").write_text("[integrator]\ntolerance = 0.1\n[error]\nestimate = false\n")
        self.run_there("crumble", "dry", scenes / "hollow.toml", "-o", "a.h5", "--quiet", *TINY.split())
        self.assertEqual(self.run_there("crumble", "file", "check", "a.h5").stdout, "a.h5: valid\n")
        self.run_there("crumble", "stress", scenes / "stress.toml", "a.h5", "-o", "b.h5", "--quiet", "--set", "hydrodynamics.method=fts")
        table = self.run_there("crumble", "all", "SEEDS=1 2", "KINDS=hollow", f"ROW_SETTINGS={TINY_GRANULES}").stdout
        self.assertRegex(table, r"(?m)^ *paper +160\.0")
        self.assertTrue((self.work / "crumble-results/hollow-2.h5").exists())
        # Files are named as seen from the folder of the user, who can write in no other.
        self.run_there("crumble", "check", "FILE=b.h5")
        self.run_there("crumble", "breakup", "AGGLOMERATE=a.h5", "SCENE=quick.toml", "OUT=broken.h5")
        self.assertTrue((self.work / "broken-course.csv").exists())
        self.run_there("crumble", "report", "FILES=a.h5 b.h5", "OUT=page.html")
        self.assertIn("b.h5: loads in a rigid granule", (self.work / "page.html").read_text(encoding="utf-8"))
        self.assertRegex(self.run_there("crumble", "help").stdout, r"(?m)^  table2 ")

    def test_the_module_is_there_and_takes_the_programs_beside_it(self):
        found = self.run_there("/usr/bin/python3", "-B", "-c", "import crumble, json, crumble.programs as p; "
                               "print(json.dumps([crumble.__file__, p.find('dryer')]))").stdout
        self.assertEqual([pathlib.Path(path).is_relative_to(self.prefix) for path in json.loads(found)], [True, True])

    def test_every_command_has_a_manual_page_without_a_warning(self):
        pages = {path.name.removesuffix(".1.gz"): path for path in (self.prefix / "share/man/man1").glob("*.1.gz")}
        verbs = re.findall(r"(?m)^  ([a-z]+) ", self.run_there("agglomerate", "--help").stdout.partition("Verbs:")[2].partition("Examples")[0])
        self.assertEqual(set(pages), {*PROGRAMS, "crumble", "crumble-demo", "dryer-continuum", *(f"agglomerate-{verb}" for verb in verbs)})
        self.assertGreater(len(verbs), 6)
        for name, path in pages.items():
            with self.subTest(page=name):
                done = self.run_there("man", "--warnings=w", "-E", "UTF-8", "-l", path)
                self.assertEqual(done.stderr, "")
                self.assertRegex(" ".join(done.stdout.split()), rf"NAME {name} - \w.* SYNOPSIS {name.replace('-', '[- ]')}.* OPTIONS .*help")

    def test_a_page_has_every_option_and_every_parameter(self):
        for program in PROGRAMS[:3]:
            page = gzip.decompress((self.prefix / f"share/man/man1/{program}.1.gz").read_bytes()).decode().replace("\\-", "-")
            options = re.findall(r"(?m)^  +(?:-.,)?(--[a-z-]+)", self.run_there(program, "--help").stdout)
            keys = re.findall(r"(?m)^(?:# )?([a-z_]+) = ", self.run_there(program, "--print-defaults").stdout)
            self.assertGreater(len(keys), 20)
            for word in (*options, *(f"{key} = " for key in keys)):
                self.assertIn(word, page)

    def complete(self, line):
        ask = ('. "$1"; COMP_LINE=$2 COMP_POINT=${#2}; words=($2); _crumble "${words[0]}"; ((${#COMPREPLY[@]})) && printf "%s\\n" "${COMPREPLY[@]}"')
        return self.run_there("bash", "-uc", ask, "bash", self.prefix / "share/bash-completion/completions/dryer", line).stdout.split()

    def test_completion_knows_options_keys_words_verbs_and_files(self):
        (self.work / "my scene.toml").touch()
        (self.work / "my.toml").touch()
        (self.work / "my.h5").touch()
        for line, expected in (("dryer --fit", ["--fit-to"]), ("rigidstress my.toml --ou", ["--output"]),
                               ("dryer my.toml --set particle.radi", ["particle.radius="]),
                               ("breaker my.toml my.h5 --set flow.kind=sh", ["shear"]),
                               ("dryer my.toml --set particle.distribution=", ["equal", "lognormal", "bimodal"]),
                               ("rigidstress my.toml m", ["my.h5"]), ("agglomerate mor", ["morphology"]), ("agglomerate export m", ["my.h5"]),
                               ("agglomerate export my.h5 --fr", ["--frame"]), ("crumble str", ["stress"]), ("crumble stress --at", ["--at"]),
                               ("crumble file inf", ["info"])):
            with self.subTest(line=line):
                self.assertEqual(self.complete(line), expected)
        self.assertIn("my.toml", self.complete("dryer m"))
        self.assertIn(str(self.prefix / "share/crumble/pipeline/scenes/hollow.toml"), self.complete("dryer "))


if __name__ == "__main__":
    unittest.main()
