import os
import pathlib
import re
import shutil
import time
import unittest

from sandbox import DRYER, ROOT, Sandbox


# Stands for the scripts of report that write one file.
PYTHON = """#!/bin/bash
echo "python $*" >> "$LOG"
said="$*"
while (($#)); do
  [[ $1 != -o || $2 != *.* ]] || echo "$said" > "$2"
  shift
done
"""


class MainJob(Sandbox):
    def setUp(self):
        super().setUp()
        self.results = self.root / "pipeline" / "results"
        for program in ("dryer", "rigidstress", "breaker"):
            self.stand_in(program, (ROOT / "tests/pipeline/stand_in_program.py").read_text(), self.programs)

    def lines(self):
        path = self.root / "build/release/bin/calls"
        return path.read_text().splitlines() if path.exists() else []

    def runs(self):
        """Since the last question."""
        found = [line for line in self.lines() if line.startswith("dryer")]
        (self.root / "build/release/bin/calls").unlink(missing_ok=True)
        return found

    def test_dries_five_hollow_seeds_and_a_compact_one_checks_them_and_prints_the_tables(self):
        done = self.make()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(self.runs()), 6)
        made = sorted(path.name for path in self.results.glob("*-*.h5"))
        self.assertEqual(made, ["compact-1.h5"] + [f"hollow-{seed}.h5" for seed in range(1, 6)])
        (check,) = self.called("agglomerate")
        self.assertEqual({(self.root / "pipeline" / name).resolve() for name in check.split()[2:]}, {(self.results / name).resolve() for name in made})
        self.assertRegex(done.stdout, r"(?m)^ *mean +1\d\d\.\d +0\.300 +173\.0 +3\.00")
        self.assertRegex(done.stdout, r"(?m)^ *paper +160\.0 +0\.280 +184\.0 +3\.18$")
        self.assertRegex(done.stdout, r"(?m)^ *paper +132\.0 +0\.440 +177\.0 +4\.16$")

    def test_fewer_are_asked_for_by_kind_and_seed(self):
        self.assertEqual(self.make("KINDS=hollow", "SEEDS=2 4").returncode, 0)
        self.assertEqual(sorted(path.name for path in self.results.glob("*-*.h5")), ["hollow-2.h5", "hollow-4.h5"])

    def test_the_meaning_of_the_scene_is_said_once_and_every_message_of_a_run(self):
        said = self.make().stderr.splitlines()
        self.assertEqual(said.count("115 particles in a droplet"), 2, said)  # of two scenes
        self.assertEqual(sorted(line for line in said if "message" in line),
                         sorted(f"{2 if seed == 1 else 1} runs: seed {seed}: a message" for seed in [1, 2, 3, 4, 5]))

    def test_a_scene_that_is_refused_stops_before_any_run(self):
        done = self.make(SCENE_CODE="2")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("115 particles in a droplet", done.stderr)
        self.assertEqual(self.runs(), [])

    def test_again_does_nothing_but_print_the_table(self):
        first = self.make()
        self.runs()
        self.forget()
        again = self.make()
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(self.runs() + self.called("agglomerate"), [])
        self.assertIn(first.stdout[first.stdout.index(" seed"):].split("make:")[0], again.stdout)

    def test_a_changed_scene_or_program_makes_every_result_out_of_date(self):
        self.make()
        self.runs()
        scene = self.root / "pipeline/scenes/hollow.toml"
        scene.write_text(scene.read_text().replace("number = 115", "number = 114"))
        self.make()
        self.assertEqual(len(self.runs()), 5)
        later = time.time() + 2
        os.utime(self.root / "build/release/bin/dryer", (later, later))
        self.make()
        self.assertEqual(len(self.runs()), 6)

    def test_one_missing_file_is_made_again_and_no_other(self):
        self.make()
        for missing in ("hollow-3.h5", "hollow-2.json"):
            self.runs()
            (self.results / missing).resolve().unlink()
            self.assertEqual(self.make().returncode, 0)
            self.assertEqual(len(self.runs()), 1, missing)

    def test_a_failed_stage_leaves_nothing_that_looks_finished(self):
        done = self.make("-k", BREAK="2")
        self.assertNotEqual(done.returncode, 0)
        left = {path.name for path in self.results.iterdir()}
        self.assertFalse({"hollow-2.h5", "hollow-2.json", "granules.txt"} & left, left)
        self.assertFalse((self.results / "granules/granules.csv").exists())
        self.assertIn("hollow-1.h5", left)
        self.runs()
        self.assertEqual(self.make().returncode, 0)
        self.assertEqual(len(self.runs()), 1)

    def test_an_invalid_file_leaves_no_table(self):
        self.assertNotEqual(self.make(CHECK_CODE="1").returncode, 0)
        self.assertFalse((self.results / "granules.txt").exists())

    def most_at_once(self, wanted, *arguments):
        shutil.rmtree(self.results, ignore_errors=True)
        self.runs()
        self.assertEqual(self.make(*(arguments or ("results/granules.txt",)), AWAIT=str(wanted)).returncode, 0)
        running, most = 0, 0
        for line in self.lines():
            running += line.startswith("dryer") - (line == "end")
            most = max(most, running)
        return most

    def test_runs_go_side_by_side_and_one_by_one_if_asked(self):

        cores = min(5, len(os.sched_getaffinity(0)))  # as nproc counts
        self.assertEqual(self.most_at_once(1, "results/granules.txt", "-j1"), 1)
        self.assertEqual(self.most_at_once(5, "results/granules.txt", "-j5"), 5)
        self.assertEqual(self.most_at_once(cores), cores)
        (self.root / "my.toml").write_text("seeds = 4\n[dry]\nscene = \"pipeline/scenes/hollow.toml\"\n")
        self.assertEqual(self.most_at_once(3, "campaign", "CAMPAIGN=my.toml", "-j3"), 3)
        self.assertEqual(self.most_at_once(1, "campaign", "CAMPAIGN=my.toml", "-j1"), 1)

    def test_a_campaign_of_one_s_own_and_on_a_cluster_by_the_words_before_its_programs(self):
        (self.root / "my.toml").write_text("seeds = 2\n[dry]\nscene = \"pipeline/scenes/hollow.toml\"\n")
        self.assertEqual(self.make("campaign", "CAMPAIGN=my.toml").returncode, 0)
        self.assertTrue((self.root / "pipeline/results/my/summary.md").exists())
        self.stand_in("srun", '#!/bin/bash\necho "srun $*" >> "$LOG"\nwhile [[ $1 == --* ]]; do shift; done\nexec "$@"\n')
        self.assertEqual(len(self.runs()), 2)
        done = self.make("CLUSTER=slurm", "KINDS=hollow", "SEEDS=1 2 3")
        self.assertEqual(done.returncode, 0, done.stderr)
        said = self.called("srun")
        self.assertEqual([sum(f"--job-name={name}" in line for line in said) for name in ("dryer", "make")], [3, 2])  # the table, and its print
        self.assertEqual(len(self.runs()), 3)
        self.assertFalse(any("campaign run" in line for line in said))

    def test_what_two_tables_want_is_made_once(self):
        self.assertEqual(self.make("results/table2/granules.csv", "SEEDS=1 2", "KINDS=hollow").returncode, 0)
        self.assertEqual(len(self.runs()), 2)
        self.assertEqual(self.make("results/granules.txt", "SEEDS=1 2 3", "KINDS=hollow").returncode, 0)
        self.assertEqual(len(self.runs()), 1)


class Stages(Sandbox):
    SCENE = "pipeline/scenes/hollow.toml"

    def test_dry_names_its_output_after_scene_and_seed(self):
        done = self.make("dry", f"SCENE={self.SCENE}", "SEED=7")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.called("dryer"), [f"dryer {self.SCENE} -o pipeline/results/hollow-7.h5 "
                                                "--report pipeline/results/hollow-7.json --overwrite --seed 7"])
        self.assertTrue((self.root / "pipeline/results/hollow-7.h5").exists())

    def test_dry_takes_names_with_blanks_and_its_own_folder(self):
        scene = self.root / "my scene.toml"
        scene.write_text("x = 1\n")
        self.assertEqual(self.make("dry", f"SCENE={scene}", "OUT=new folder/my file.h5").returncode, 0)
        self.assertTrue((self.root / "new folder" / "my file.h5").exists())

    def test_dry_does_only_what_is_out_of_date(self):
        self.make("dry", f"SCENE={self.SCENE}")
        self.forget()
        done = self.make("dry", f"SCENE={self.SCENE}")
        self.assertIn("pipeline/results/hollow.h5 is up to date", done.stdout)
        self.assertEqual(self.called("dryer"), [])
        later = time.time() + 2
        os.utime(self.root / self.SCENE, (later, later))
        self.make("dry", f"SCENE={self.SCENE}")
        self.assertEqual(len(self.called("dryer")), 1)

    def test_the_old_report_stays_until_the_new_one_is_complete(self):
        self.make("dry", f"SCENE={self.SCENE}")
        made = [self.root / f"pipeline/results/hollow.{ending}" for ending in ("h5", "json")]
        before = [path.read_text() for path in made]
        later = time.time() + 2
        os.utime(self.root / self.SCENE, (later, later))
        # Fails before anything is renamed, as the program does.
        self.stand_in("dryer", '#!/bin/bash\necho part > pipeline/results/hollow.json.tmp\nexit 1\n', self.root / "build/release/bin")
        self.assertNotEqual(self.make("dry", f"SCENE={self.SCENE}").returncode, 0)
        self.assertEqual([path.read_text() for path in made], before)
        self.stand_in("dryer", DRYER, self.root / "build/release/bin")
        self.forget()
        self.assertEqual(self.make("dry", f"SCENE={self.SCENE}").returncode, 0)
        self.assertEqual(len(self.called("dryer")), 1)

    def test_a_report_older_than_its_file_is_of_another_run(self):
        self.make("dry", f"SCENE={self.SCENE}")
        self.forget()
        later = time.time() + 2
        os.utime(self.root / "pipeline/results/hollow.h5", (later, later))
        self.make("dry", f"SCENE={self.SCENE}")
        self.assertEqual(len(self.called("dryer")), 1)

    def test_dry_without_or_with_a_missing_scene_says_so(self):
        self.assertIn("which scene?", self.make("dry").stderr)
        self.assertNotEqual(self.make("dry").returncode, 0)
        self.assertIn("absent.toml: no such file", self.make("dry", "SCENE=absent.toml").stderr)

    def test_stress_takes_an_agglomerate_and_a_scene(self):
        (self.root / "my granule.h5").write_text("x")
        done = self.make("stress", "AGGLOMERATE=my granule.h5", "THREADS=1")
        self.assertEqual(done.returncode, 0, done.stderr)
        out = "pipeline/results/my granule-stress"
        self.assertEqual(self.called("rigidstress"),
                         [f"rigidstress pipeline/scenes/stress.toml my granule.h5 -o {out}.h5 "
                          f"--report {out}.json --overwrite --threads 1"])
        self.forget()
        done = self.make("stress", "AGGLOMERATE=my granule.h5", "SCENE=pipeline/scenes/stress-shear.toml", "OUT=a.h5")
        self.assertIn("stress-shear.toml my granule.h5 -o a.h5", self.called("rigidstress")[0])
        self.assertIn("which agglomerate?", self.make("stress").stderr)
        self.assertIn("absent.h5: no such file", self.make("stress", "AGGLOMERATE=absent.h5").stderr)

    def test_breakup_runs_both_programs_and_the_table(self):
        (self.root / "my granule.h5").write_text("x")
        self.stand_in("python", PYTHON)
        done = self.make("breakup", "AGGLOMERATE=my granule.h5", "THREADS=1", "PYTHON=python")
        self.assertEqual(done.returncode, 0, done.stderr)
        out = "pipeline/results/my granule-break"
        self.assertEqual(self.called("breaker"), [f"breaker pipeline/scenes/break.toml my granule.h5 -o {out}.h5 "
                                                  f"--report {out}.json --overwrite --threads 1"])
        self.assertIn(f"rigidstress {out}-rigid.toml my granule.h5 -o {out}-rigid.h5", self.called("rigidstress")[0])
        self.assertIn(f"pipeline/report/rigid_scene.py {out}.h5", (self.root / f"{out}-rigid.toml").read_text())
        for script in ("breakup", "breakup_pictures"):
            self.assertIn(f"python pipeline/report/{script}.py {out}.h5 -o {out}", self.called("python"))
        self.assertIn("which agglomerate?", self.make("breakup").stderr)

    def test_check_hands_on_the_verdict(self):
        self.assertEqual(self.make("check", "FILE=a b.h5").returncode, 0)
        self.assertEqual(self.called("agglomerate"), ["agglomerate check a b.h5"])
        self.assertNotEqual(self.make("check", "FILE=a.h5", CHECK_CODE="1").returncode, 0)
        self.assertIn("which file?", self.make("check").stderr)

    def test_test_builds_everything_and_ends_with_the_summary_of_ctest(self):
        done = self.make("test")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse(any("--target" in call for call in self.called("cmake")))
        self.assertEqual(len(self.called("ctest")), 1)
        self.assertIn("100% tests passed", done.stdout.splitlines()[-2:])

    def test_a_failing_test_fails_the_target(self):
        self.stand_in("ctest", "#!/bin/bash\nexit 8\n")
        self.assertNotEqual(self.make("test").returncode, 0)

    def test_help_names_every_target(self):
        text = (ROOT / "pipeline" / "Makefile").read_text()
        phony = set(re.search(r"^\.PHONY: (.*)$", text, re.M).group(1).split()) - {"FORCE"}
        listed = {line.split()[0] for line in self.make("help").stdout.splitlines() if re.match(r"  [a-z0-9-]+  ", line)}
        self.assertEqual(listed, phony)

    def test_help_begins_with_what_one_does_every_day(self):
        lines = [line for line in self.make("help").stdout.splitlines() if not line.startswith("make:")]
        self.assertEqual([line.split()[0] for line in lines[:6]], ["Every", "all", "dry", "breakup", "report", "test"])

    def test_report_and_film_take_files_by_their_names_from_the_top(self):
        self.stand_in("python", PYTHON)
        done = self.make("report", "FILES=data/a.h5 data/b.h5", "PYTHON=python")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("pipeline/results/report.html", done.stdout.splitlines())
        (call,) = self.called("python")
        self.assertEqual(call, "python pipeline/report/report.py data/a.h5 data/b.h5 --tool build/release/bin/agglomerate -o pipeline/results/report.html")
        self.forget()
        self.assertEqual(self.make("film", "FILE=my data/a b.h5", "OUT=films/x", "PYTHON=python").returncode, 0)
        self.assertIn("python pipeline/report/film.py my data/a b.h5", self.called("python")[0])
        self.assertIn("-o films/x", self.called("python")[0])
        self.assertIn("which files?", self.make("report").stderr)
        self.assertIn("which file?", self.make("film").stderr)

    def test_a_report_is_made_where_its_3d_view_cannot_be_had(self):
        self.stand_in("python", PYTHON)
        self.stand_in("dpkg-query", '#!/bin/bash\nshift 3\nprintf "%s=installed\\n" "$@" | grep -v libjs-three\n')
        self.stand_in("apt-get", "#!/bin/bash\nexit 100\n")
        self.stand_in("apt-cache", "#!/bin/bash\nexit 0\n")
        self.stand_in("id", "#!/bin/bash\necho 0\n")
        done = self.make("report", "FILES=a.h5", "PYTHON=python")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("made without its 3D view", done.stderr)
        self.assertEqual(len(self.called("python")), 1)

    def test_ci_runs_the_test_target_and_takes_warnings_for_errors(self):
        self.assertIn("pipeline\" test WERROR=ON", (pathlib.Path(ROOT) / ".ci" / "run").read_text())
        self.assertEqual(self.make("test", "WERROR=ON").returncode, 0)
        self.assertIn("-DCMAKE_COMPILE_WARNING_AS_ERROR=ON", self.called("cmake")[0])

    def test_a_user_s_build_does_not_end_at_a_warning(self):
        for target in ("build", "test"):
            self.forget()
            self.assertEqual(self.make(target).returncode, 0)
            self.assertEqual([call for call in self.called("cmake") if "ERROR" in call], [])


if __name__ == "__main__":
    unittest.main()
