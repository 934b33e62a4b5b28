"""Campaigns: designs, identities, what is run again and what is not, tables. With stand-ins for the programs but in the last test."""

import contextlib
import csv
import importlib.util
import io
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "pipeline/campaign"
sys.path[:0] = [str(PACKAGE), str(ROOT / "pipeline/report")]
import design
import plan as plans
import precision
import scene_text

BUILD = pathlib.Path(os.environ.get("CRUMBLE_BUILD", ROOT / "build/release"))
SPEC = importlib.util.spec_from_file_location("campaign_main", PACKAGE / "__main__.py")
campaign = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(campaign)


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="crumble with blank ")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.programs = self.folder / "bin"
        self.programs.mkdir()
        for name in ("dryer", "rigidstress", "breaker"):
            shutil.copy(ROOT / "tests/pipeline/stand_in_program.py", self.programs / name)
            (self.programs / name).chmod(0o755)
        self.write("dry.toml", "[particle]\nradius = 1e-8\nnumber = 40\n[droplet]\npeclet = 1\n")
        self.write("stress.toml", "[particle]\nfragments = \"each\"\n")
        self.write("break.toml", "[flow]\nkind = \"elongation\"\n")

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def plan(self, text):
        return plans.read(self.write("my.toml", text), self.programs)[0]

    def run_it(self, text, *more):
        """(exit code, stdout, stderr) of `campaign run`, without the cost of another Python."""
        path = self.write("my.toml", text)
        said, answered = io.StringIO(), io.StringIO()
        was, sys.argv = sys.argv, ["campaign", "run", str(path), "-o", str(self.folder / "out"), "--programs", str(self.programs), *more]
        try:
            with contextlib.redirect_stderr(said), contextlib.redirect_stdout(answered):
                code = campaign.main()
        finally:
            sys.argv = was
        return code, answered.getvalue(), said.getvalue()

    def calls(self):
        """Since the last question."""
        path = self.programs / "calls"
        lines = [line for line in path.read_text().splitlines() if line != "end"] if path.exists() else []
        path.write_text("")
        return lines

    def table(self, name="granules.csv"):
        with open(self.folder / "out" / name, newline="") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Scenes(InAFolder):
    def test_what_is_written_is_read_again(self):
        scene = {"particle": {"radius": 1e-8, "fragments": "a \"b\" \\ c", "flag": True, "list": [1, 2.5]}, "protocol": {"stage": [
            {"kind": "rest", "duration": 0.1}, {"kind": "ramp", "rate": 5000}], "strain": 3.0}, "empty": {}}
        self.assertEqual(scene_text.read(self.write("a.toml", scene_text.write(scene, ["why"]))), scene)

    def test_every_scene_that_is_handed_out_survives(self):
        for path in sorted((ROOT / "pipeline/scenes").glob("*.toml")):
            with self.subTest(scene=path.name):
                scene = scene_text.read(path)
                self.assertEqual(scene_text.read(self.write("a.toml", scene_text.write(scene))), scene)

    def test_numbers_of_one_value_are_one_value(self):
        self.assertEqual(scene_text.canonical({"a": 1, "b": [2]}), scene_text.canonical({"b": [2.0], "a": 1.0}))
        self.assertNotEqual(scene_text.canonical({"a": True}), scene_text.canonical({"a": 1}))


class Designs(InAFolder):
    def test_a_grid_has_every_pair_and_lists_that_go_together_each_once(self):
        axes = {"a": [1, 2], "b": {"from": 1, "to": 100, "count": 3, "spacing": "log"}}
        grid = design.points(axes, "grid", None, "f")
        self.assertEqual([(p["a"], p["b"]) for p in grid], [(1, 1.0), (1, 10.0), (1, 100.0), (2, 1.0), (2, 10.0), (2, 100.0)])
        self.assertEqual(design.points({"a": [1, 2], "b": [3, 4]}, "together", None, "f"), [{"a": 1, "b": 3}, {"a": 2, "b": 4}])

    def test_a_latin_hypercube_visits_every_stratum_once_and_is_the_same_every_time(self):
        axes = {"a": {"from": 0, "to": 1}, "b": {"from": 1, "to": 1000, "spacing": "log"}}
        points = design.points(axes, "latin hypercube", 50, "f")
        self.assertEqual(sorted(int(50 * p["a"]) for p in points), list(range(50)))
        import math
        self.assertEqual(sorted(int(50 * math.log(p["b"]) / math.log(1000)) for p in points), list(range(50)))
        self.assertEqual(points, design.points(axes, "latin hypercube", 50, "f"))

    def test_what_is_wrong_is_named(self):
        for axes, kind, count, words in (
                ({"a": [1], "b": [1, 2]}, "together", None, "of one length; they have 1, 2"), ({"a": []}, "grid", None, "must be a list of values"),
                ({"a": {"from": 1, "to": 2}}, "grid", None, "needs 'count'"), ({"a": {"from": 2, "to": 1, "count": 2}}, "grid", None, "above 'from'"),
                ({"a": {"from": 0, "to": 1, "count": 2, "spacing": "log"}}, "grid", None, "begins above 0"),
                ({"a": [1]}, "latin", None, "one of grid, together"), ({"a": [1]}, "latin hypercube", None, "points"),
                ({"a": {"frm": 1, "to": 2, "count": 3}}, "grid", None, "frm: not known")):
            with self.subTest(words=words), self.assertRaisesRegex(scene_text.Fault, words):
                design.points(axes, kind, count, "f")


PLAIN = "seeds = 3\n[dry]\nscene = \"dry.toml\"\n"
VARIED = PLAIN + "[vary]\n\"dry.droplet.peclet\" = [1, 10]\n"


class Identities(InAFolder):
    def identities(self, text):
        return {(one.point.get("dry.droplet.peclet"), one.replicate): (one.runs[0].id, one.runs[0].scene["run"]["seed"])
                for one in plans.realisations(self.plan(text))}

    def test_a_granule_keeps_its_seed_whatever_stands_before_it(self):
        few = self.identities(VARIED)
        many = self.identities(VARIED.replace("[1, 10]", "[0.1, 10, 1]").replace("seeds = 3", "seeds = 5"))
        self.assertEqual(few, {key: many[key] for key in few})
        self.assertEqual(len({seed for _, seed in many.values()}), 15)
        self.assertTrue(all(1 <= seed <= 2**31 - 1 for _, seed in many.values()))

    def test_another_scene_is_another_granule(self):
        before = set(self.identities(VARIED).values())
        self.write("dry.toml", "[particle]\nradius = 1e-8\nnumber = 41\n[droplet]\npeclet = 1\n")
        self.assertFalse(before & set(self.identities(VARIED).values()))

    def test_listed_seeds_are_taken_as_they_are(self):
        made = plans.realisations(self.plan(PLAIN.replace("3", "[7, 9]")))
        self.assertEqual([one.runs[0].scene["run"]["seed"] for one in made], [7, 9])

    def test_a_point_that_two_blocks_share_is_visited_once(self):
        plan = self.plan("seeds = 1\n[dry]\nscene = \"dry.toml\"\n[[vary]]\n\"dry.droplet.peclet\" = [1, 10]\n[[vary]]\n\"dry.droplet.peclet\" = [10.0, 100]\nseeds = 2\n")
        self.assertEqual([(point["dry.droplet.peclet"], seeds) for point, seeds in plan.points], [(1, 1), (10, 1), (100, 2)])

    def test_a_history_counts_by_its_content(self):
        text = PLAIN + "[stress]\nscene = \"stress.toml\"\nset = {\"flow.history\" = \"h.csv\"}\n"
        self.write("h.csv", "one")
        first = plans.realisations(self.plan(text))[0].runs[1]
        self.write("h.csv", "two")
        self.assertNotEqual(first.id, plans.realisations(self.plan(text))[0].runs[1].id)

    def test_a_range_of_whole_numbers_numbers_tracks(self):
        self.write("h.csv", "one")
        text = PLAIN + ("[breakup]\nscene = \"break.toml\"\nset = {\"flow.history\" = \"h.csv\"}\n"
                        "[vary]\n\"breakup.flow.track\" = {from = 1, to = 4, count = 4}\n")
        made = plans.realisations(self.plan(text))
        tracks = [one.runs[-1].scene["flow"]["track"] for one in made]
        self.assertEqual(tracks, [1] * 3 + [2] * 3 + [3] * 3 + [4] * 3)
        self.assertTrue(all(isinstance(track, int) for track in tracks))
        self.assertEqual(len({one.runs[0].id for one in made}), 3)  # each granule is dried once
        self.assertEqual(len({one.runs[-1].id for one in made}), 12)

    def test_scenes_are_varied_by_name_and_a_granule_is_the_same_in_every_campaign(self):
        self.write("other.toml", "[particle]\nradius = 1e-8\nnumber = 60\n")
        plan = self.plan(PLAIN + "set = {\"particle.brownian_motion\" = true}\n[vary]\n\"dry.scene\" = [\"other\", \"dry\"]\n")
        made = plans.realisations(plan)
        self.assertEqual([(one.kind, one.number, one.runs[0].scene["particle"]["number"]) for one in made], [(*of, 60) for of in (("other", 1), ("other", 2), ("other", 3))] +
                         [(*of, 40) for of in (("dry", 1), ("dry", 2), ("dry", 3))])
        self.assertTrue(all(one.runs[0].scene["particle"]["brownian_motion"] for one in made))
        alone = plans.realisations(self.plan(PLAIN + "set = {\"particle.brownian_motion\" = true}\n"))
        self.assertEqual([one.runs[0].id for one in alone], [one.runs[0].id for one in made[3:]])
        self.assertEqual(self.run_it(PLAIN + "[vary]\n\"dry.scene\" = [\"absent\"]\n")[0], 2)

    def test_settings_stand_in_place_of_what_the_file_says(self):
        path = self.write("my.toml", VARIED)
        plan, _ = plans.read(path, self.programs, ["seeds=[4,5]", "dry.particle.number=44", "vary={\"dry.droplet.peclet\"=[7]}", "name=short"])
        (one, other) = plans.realisations(plan)
        self.assertEqual((plan.name, one.point, [of.runs[0].scene["run"]["seed"] for of in (one, other)], one.runs[0].scene["particle"]["number"]),
                         ("short", {"dry.droplet.peclet": 7}, [4, 5], 44))
        for setting in ("seeds", "sed=3", "dri.particle.number=4"):
            with self.subTest(setting=setting), self.assertRaisesRegex(scene_text.Fault, "must be a key"):
                plans.read(path, self.programs, [setting])
        with self.assertRaisesRegex(scene_text.Fault, "did you mean 'particle.number'"):
            plans.read(path, self.programs, ["dry.particle.nunber=44"])

    def test_faults_name_file_and_key(self):
        for text, words in (
                (PLAIN + "[vary]\n\"dry.droplet.peclt\" = [1]\n", "my.toml: .vary.: unknown key 'droplet.peclt' of dryer; did you mean 'droplet.peclet'"),
                (PLAIN + "[vary]\n\"stress.flow.shear\" = [true]\n", "must begin with a stage of this campaign: dry"), (PLAIN.replace("seeds", "seed"), "did you mean 'seeds'"),
                ("seeds = 0\n[dry]\nscene = \"dry.toml\"\n", "seeds: must be a number"), ("[stress]\nscene = \"stress.toml\"\n", "needs .dry."),
                (PLAIN.replace("dry.toml", "absent.toml"), "absent.toml: No such file"), (PLAIN + "set = {\"a.b\" = 1}\n", "unknown key 'a.b' of dryer"),
                (PLAIN + "[stress]\nscene = \"stress.toml\"\nflows = [\"sheer\"]\n", "did you mean 'shear'"),
                (PLAIN + "[stress]\nscene = \"stress.toml\"\nset = {\"flow.history\" = \"no.csv\"}\n", "no.csv\": no such file"), ("x = [", "my.toml: ")):
            with self.subTest(words=words):
                code, _, said = self.run_it(text)
                self.assertEqual(code, 2)
                self.assertRegex(said, words)
        self.assertEqual(self.calls(), [])


class Running(InAFolder):
    THREE = PLAIN + "[stress]\nscene = \"stress.toml\"\n[breakup]\nscene = \"break.toml\"\ncount = 2\n[vary]\n\"dry.droplet.peclet\" = [1, 10]\n"

    def test_every_file_is_made_once_and_seeds_are_added_without_the_others(self):
        code, answer, _ = self.run_it(self.THREE)
        self.assertEqual(code, 0)
        self.assertEqual(sorted(call.split()[0] for call in self.calls()), ["breaker"] * 4 + ["dryer"] * 6 + ["rigidstress"] * 6)
        first = self.table()
        self.assertEqual(self.run_it(self.THREE)[:2], (0, answer))
        self.assertEqual(self.calls(), [])
        self.run_it(self.THREE.replace("seeds = 3", "seeds = 4"))
        self.assertEqual(sorted(call.split()[0] for call in self.calls()), ["dryer"] * 2 + ["rigidstress"] * 2)
        rows = {row["id"]: row for row in self.table()}
        self.assertEqual(len(rows), 8)
        for row in first:
            self.assertEqual(rows[row["id"]], row)

    def test_a_file_of_another_scene_or_of_another_parent_is_made_again_and_so_is_what_follows(self):
        self.run_it(PLAIN + "[stress]\nscene = \"stress.toml\"\n")
        self.calls()
        dried = sorted((self.folder / "out/dry").glob("*.h5"))
        shutil.copy(dried[0], dried[1])  # a granule under the name of another
        self.run_it(PLAIN + "[stress]\nscene = \"stress.toml\"\n")
        self.assertEqual([call.split()[0] for call in self.calls()], ["dryer"])  # made of the same scene: the same bytes, and the stress file is that of them
        (self.folder / "out/dry" / dried[2].with_suffix(".json").name).unlink()
        self.run_it(PLAIN)
        self.assertEqual([call.split()[0] for call in self.calls()], ["dryer"])

    def test_a_granule_whose_file_is_gone_is_made_again(self):
        text = PLAIN + "[stress]\nscene = \"stress.toml\"\n"
        self.run_it(text)
        self.calls()
        next((self.folder / "out/dry").glob("*.h5")).unlink()
        self.assertEqual(self.run_it(text)[0], 0)
        self.assertEqual([call.split()[0] for call in self.calls()], ["dryer"])  # the same bytes: the stress file is that of them

    def test_a_granule_that_two_points_share_is_dried_once_even_where_they_run_side_by_side(self):
        text = PLAIN.replace("3", "1") + "[stress]\nscene = \"stress.toml\"\n[vary]\n\"stress.particle.fragments\" = [\"each\", \"refuse\"]\n"
        self.assertEqual(self.run_it(text, "--jobs", "2")[0], 0)
        self.assertEqual(sorted(call.split()[0] for call in self.calls()), ["dryer", "rigidstress", "rigidstress"])

    def test_campaigns_that_share_their_files_make_them_once_and_link_them_by_names(self):
        shared, names = str(self.folder / "files"), self.folder / "names"
        self.assertEqual(self.run_it(PLAIN, "--files", shared, "--names", str(names))[0], 0)
        self.calls()
        self.assertEqual(self.run_it(PLAIN.replace("3", "4") + "[breakup]\nscene = \"break.toml\"\ncount = 1\n", "--files", shared, "--names", str(names), "-o", str(self.folder / "two"))[0], 0)
        self.assertEqual(sorted(call.split()[0] for call in self.calls()), ["breaker", "dryer"])
        self.assertEqual(sorted(str(path.relative_to(names)) for path in names.rglob("*.h5")), ["breakup/dry-1.h5", *(f"dry-{k}.h5" for k in (1, 2, 3, 4))])
        self.assertTrue((names / "dry-1.h5").resolve().is_relative_to(self.folder.resolve() / "files/dry"))

    def test_parts_make_every_file_once_and_no_table(self):
        for k in (1, 2, 3):
            self.assertEqual(self.run_it(PLAIN.replace("3", "9"), "--part", f"{k}/3")[0], 0)
        self.assertEqual(len(self.calls()), 9)
        self.assertFalse((self.folder / "out/granules.csv").exists())
        self.assertEqual(self.run_it(PLAIN.replace("3", "9"))[0], 0)
        self.assertEqual((len(self.calls()), len(self.table())), (0, 9))
        self.assertRegex(self.run_it(PLAIN, "--part", "4/3")[2], "must be K/N")

    def test_what_is_older_than_its_program_is_made_again_if_that_is_asked(self):
        self.run_it(PLAIN)
        self.calls()
        later = time.time() + 5
        os.utime(self.programs / "dryer", (later, later))
        self.run_it(PLAIN)
        self.assertEqual(self.calls(), [])
        self.run_it(PLAIN, "--fresh")
        self.assertEqual(len(self.calls()), 3)

    def test_a_launcher_begins_every_command_and_its_words_are_not_those_of_a_program(self):
        launcher = self.write("launch", "#!/bin/bash\necho launched >> \"$(dirname \"$0\")/launches\"\n\"$@\" || { code=$?; echo 'srun: error: n1: task 0: Exited with exit code 1' >&2; exit $code; }\n")
        launcher.chmod(0o755)
        code, _, said = self.run_it(PLAIN.replace("3", "2") + "[vary]\n\"dry.particle.number\" = [12, 13]\n", "--launcher", str(launcher))
        self.assertEqual(code, 1)
        self.assertEqual(len((self.folder / "launches").read_text().split()), 4)
        self.assertEqual({row["failed"] for row in self.table()}, {"", "dry, exit code 1: particle 3 left the droplet"})

    def test_a_run_that_ends_well_without_a_file_has_failed_and_its_granule_goes_no_further(self):
        launcher = self.write("launch", "#!/bin/bash\necho 'srun: error: Node failure on n1' >&2\n")
        launcher.chmod(0o755)
        code, _, _ = self.run_it(PLAIN.replace("3", "1") + "[stress]\nscene = \"stress.toml\"\n", "--launcher", str(launcher))
        self.assertEqual((code, [row["failed"] for row in self.table()]), (1, ["dry, exit code 0: srun: error: Node failure on n1"]))

    def test_the_table_has_units_hashes_and_errors(self):
        self.run_it(self.THREE)
        row = self.table()[0]
        import hashlib
        self.assertEqual(row["dry_sha256"], hashlib.sha256((self.folder / "out/dry" / f"{row['id']}.h5").read_bytes()).hexdigest())
        for heading in ("dry.droplet.peclet [1]", "d_c [nm]", "critical_stress_elongation [Pa]", "critical_stress_elongation_error [relative]", "critical_stress_flexible [Pa]"):
            self.assertIn(heading, row)
        self.assertEqual(sum(row["critical_stress_flexible [Pa]"] != "" for row in self.table()), 4)
        for name in ("critical_stress_elongation.svg", "critical_stress_flexible.svg", "response.svg"):
            self.assertEqual((self.folder / "out" / name).exists(), name != "critical_stress_flexible.svg", name)  # of two granules there is no curve

    def test_failures_and_censored_cases_are_counted_and_what_follows_a_failure_is_left_out(self):
        code, answer, _ = self.run_it(self.THREE.replace("\"dry.droplet.peclet\" = [1, 10]", "\"dry.particle.number\" = [12, 13]\n\"breakup.protocol.largest_stress\" = [2e3]"))
        self.assertEqual(code, 1)
        self.assertNotIn("rigidstress 13", answer)
        failed = [row for row in self.table() if row["failed"]]
        self.assertEqual([row["failed"] for row in failed], ["dry, exit code 1: particle 3 left the droplet"] * 3)
        self.assertTrue(all(row["dry.particle.number [1]"] == "13" and row["d_c [nm]"] == "" for row in failed))
        known = {(row["dry.particle.number [1]"], row["quantity"]): row for row in self.table("summary.csv")}
        self.assertEqual(known["12", "d_c"]["failed"], "0")
        self.assertEqual(known["12", "critical_stress_flexible"]["censored"], "2")
        self.assertEqual({row["critical_stress_flexible_above [Pa]"] for row in self.table() if row["dry.particle.number [1]"] == "12"}, {"2000", ""})
        self.assertIn("Failed:", answer)
        self.calls()
        self.run_it(self.THREE.replace("\"dry.droplet.peclet\" = [1, 10]", "\"dry.particle.number\" = [12, 13]\n\"breakup.protocol.largest_stress\" = [2e3]"))
        self.assertEqual(len(self.calls()), 3)  # those that failed are tried again

    def test_after_an_interruption_it_goes_on_from_the_checkpoint_and_ends_with_the_same_table(self):
        self.run_it(PLAIN)
        whole = self.table()
        shutil.rmtree(self.folder / "out")
        (self.folder / "out/dry").mkdir(parents=True)
        (self.folder / "out/dry/hold").touch()
        command = [sys.executable, "-B", str(PACKAGE), "run", str(self.folder / "my.toml"), "-o", str(self.folder / "out"), "--programs", str(self.programs)]
        for signum in (signal.SIGTERM, signal.SIGINT):
            with self.subTest(signal=signum):
                process = subprocess.Popen([*command, "--jobs", "2"], stderr=subprocess.PIPE, text=True)
                for _ in range(600):
                    if len(list((self.folder / "out/dry").glob("*.checkpoint"))) == 2:
                        break
                    time.sleep(0.1)
                code, _, answer = self.run_it(PLAIN)  # a second one beside it
                self.assertEqual((code, f"process {process.pid}" in answer), (2, True), answer)
                process.send_signal(signum)
                said = process.communicate(timeout=60)[1]
                self.assertEqual(process.returncode, 128 + signum)
                self.assertIn("stopped; 0 of 3 granules are there", said)
                self.assertEqual(list((self.folder / "out/dry").glob("*.h5")), [])
                for path in (self.folder / "out/dry").glob("*.checkpoint"):
                    if signum == signal.SIGTERM:
                        path.unlink()
        (self.folder / "out/dry/hold").unlink()
        self.calls()
        self.assertEqual(self.run_it(PLAIN)[0], 0)
        calls = [call.split()[0] for call in self.calls()]
        self.assertEqual((calls.count("resumed"), calls.count("dryer")), (2, 3))
        self.assertEqual(self.table(), whole)

    def test_granules_are_added_until_the_interval_is_narrow_enough(self):
        text = "seeds = 5\n[dry]\nscene = \"dry.toml\"\n[stress]\nscene = \"stress.toml\"\n"
        code, _, said = self.run_it(text, "--more-until", "critical_stress 8 %")
        self.assertEqual(code, 0, said)
        (row,) = [row for row in self.table("summary.csv") if row["quantity"] == "critical_stress_elongation"]
        self.assertLessEqual(float(row["sampling_error_relative"]), 0.08)
        self.assertGreater(int(row["granules"]), 5)  # modulus 5: 23 % of spread ask for some 30
        self.assertLess(int(row["granules"]), 100)

    def test_a_wish_that_cannot_be_granted_is_refused(self):
        for wish, words in (("critical_stress", "a quantity and a percentage"), ("strength 5 %", "no quantity 'strength'"), ("d_c 0 %", "between")):
            with self.subTest(wish=wish), self.assertRaisesRegex(scene_text.Fault, words):
                precision.wish(wish)
        code, _, said = self.run_it(PLAIN.replace("3", "[1, 2]"), "--more-until", "d_c 1 %")
        self.assertEqual(code, 2)
        self.assertIn("a list cannot grow", said)


class WithThePrograms(InAFolder):
    def test_small_granules_from_scene_to_table_and_nothing_is_done_twice(self):
        self.programs = BUILD / "bin"
        text = f"""seeds = 2
[dry]
scene = "{ROOT}/pipeline/scenes/hollow.toml"
set = {{"particle.number" = 24, "droplet.radius" = 128e-9, "droplet.lifetime" = 2e-5, "error.estimate" = false, "output.frames" = 0}}
[stress]
scene = "{ROOT}/pipeline/scenes/stress-elongation.toml"
set = {{"particle.fragments" = "each", "hydrodynamics.method" = "fts"}}
flows = ["elongation"]
"""
        code, answer, said = self.run_it(text)
        self.assertEqual(code, 0, said)
        self.assertIn("4 runs made now", said)
        self.assertIn("critical_stress_elongation, Pa", answer)
        self.assertTrue(all(float(row["critical_stress_elongation [Pa]"]) > 0 for row in self.table()))
        code, again, said = self.run_it(text)
        self.assertEqual((code, again), (0, answer))
        self.assertIn("0 runs made now", said)
        code, _, said = self.run_it(text.replace("24,", "-24,"))
        self.assertEqual(code, 2)
        self.assertRegex(said, r"my\.toml: \[dry\] at the base scene: .*particle\.number")


if __name__ == "__main__":
    unittest.main()
