"""What all programs do about their files, the disk and their streams.

    files_and_streams.py FOLDER_OF_THE_PROGRAMS SCENES
"""
import fcntl
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

PROGRAMS, SCENES = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
DROPLET = "[particle]\nradius = 10e-9\nnumber = 5\n[droplet]\nradius = 60e-9\nlifetime = 1e-5\n"
OWNER = "process 4711 on another-host since 2026-01-01T00:00:00Z (start 1)\n"


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="files-"))
        self.folder.chmod(0o755)
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "scene.toml").write_text(DROPLET)
        (self.folder / "chain.csv").write_text("x,y,z\n0,0,0\n20,0,0\n40,0,0\n")
        self.assertEqual(self.run_it("agglomerate", "import", "chain.csv", "--radius", 10, "-o", "chain.h5").returncode, 0)

    def run_it(self, program, *arguments, **options):
        return subprocess.run([str(PROGRAMS / program), *map(str, arguments)], cwd=self.folder, text=True, timeout=120,
                              **({"capture_output": True} | options))

    def commands(self, output="o.h5", scene="scene.toml", agglomerate="chain.h5"):
        """Each program that writes, as quick as it can be."""
        breaking = ["--set", "protocol.largest_stress=100", "--set", 'protocol.stage=[{kind="rest", duration=0.1}, {kind="ramp", rate=50000}]',
                    "--set", "error.estimate=false", "--quiet"]
        return {
            "dryer": ["dryer", scene, "-o", output, "--set", "error.estimate=false", "--quiet", "--threads", 1],
            "breaker": ["breaker", SCENES / "breakup.toml", agglomerate, "-o", output, *breaking],
            "rigidstress": ["rigidstress", SCENES / "stress-elongation.toml", agglomerate, "-o", output, "--quiet"],
            "import": ["agglomerate", "import", "chain.csv", "--radius", 10, "-o", output],
            "scale": ["agglomerate", "scale", agglomerate, "--radius", 20, "-o", output],
            "export": ["agglomerate", "export", agglomerate, "-o", output.replace(".h5", ".xyz")],
            "view": ["agglomerate", "export", agglomerate, "-o", output.replace(".h5", ".hdf")],
        }

    def each(self, **names):
        for name, command in self.commands(**names).items():
            for made in self.left():
                (self.folder / made).unlink()
            yield name, command, self.folder / str(command[command.index("-o") + 1])

    def ends(self, ran, *codes):
        self.assertIn(ran.returncode, codes, (ran.args, ran.stderr))

    def left(self):
        return sorted(p.name for p in self.folder.iterdir() if p.name.startswith("o."))

    def test_an_output_that_another_run_holds_is_refused_and_not_touched(self):
        for _, command, output in self.each():
            lock, unfinished = pathlib.Path(f"{output}.lock"), pathlib.Path(f"{output}.tmp")
            unfinished.write_text("of the other run")
            with open(lock, "w") as held:
                held.write(OWNER)
                held.flush()
                fcntl.flock(held, fcntl.LOCK_EX)
                ran = self.run_it(*command)
            self.ends(ran, 2)
            self.assertIn("is being written by process 4711 on another-host since 2026-01-01T00:00:00Z", ran.stderr)
            self.assertEqual(unfinished.read_text(), "of the other run")
            self.assertFalse(output.exists())
            # The lock was let go, as by a run that was killed: what it left is taken over.
            ran = self.run_it(*command)
            self.ends(ran, 0)
            self.assertTrue(output.exists())
            self.assertFalse(lock.exists())

    def test_an_output_is_never_an_input_or_what_stands_beside_it(self):
        for name, command, output in self.each():
            source = {"dryer": "scene.toml", "import": "chain.csv"}.get(name, "chain.h5")
            for ending in (".tmp", ".lock"):
                taken = pathlib.Path(f"{output}{ending}")
                shutil.copy(self.folder / source, taken)
                before = taken.read_bytes()
                ran = self.run_it(*[taken.name if a == source else a for a in command])
                self.ends(ran, 2)
                self.assertIn("would overwrite the input", ran.stderr)
                self.assertEqual(taken.read_bytes(), before)
                taken.unlink()
            self.assertFalse(output.exists())

    def test_a_report_is_never_the_result(self):
        for name, command, _ in self.each():
            if command[0] == "agglomerate":
                continue
            for report in ("./o.h5", "o.h5.tmp", str(self.folder / "o.h5.lock")):
                ran = self.run_it(*command, "--report", report)
                self.ends(ran, 2)
                self.assertIn("are the same file", ran.stderr)
            self.assertEqual(self.left(), [])

    def test_links_are_followed(self):
        (self.folder / "there").mkdir()
        for _, command, output in self.each(output="o.h5"):
            output.symlink_to(self.folder / "there" / output.name)
            ran = self.run_it(*command)
            self.ends(ran, 0)
            self.assertTrue(output.is_symlink())
            made = self.folder / "there" / output.name
            self.assertTrue(made.is_file())
            made.unlink()

    def test_devices_are_written_to_or_refused(self):
        for name, command, output in self.each():
            output.symlink_to("/dev/null")
            ran = self.run_it(*command)
            self.ends(ran, 0 if name == "export" else 2)
            self.assertTrue(output.is_symlink() and pathlib.Path("/dev/null").is_char_device())
            output.unlink()
            if command[0] == "agglomerate":
                continue
            (self.folder / "report").symlink_to("/dev/stdout")
            ran = self.run_it(*command, "--report", "report")
            self.ends(ran, 0)
            self.assertEqual(json.JSONDecoder().raw_decode(ran.stdout)[0]["program"], name)
            (self.folder / "report").unlink()

    def test_the_result_is_printed_though_the_report_fails_and_the_reverse(self):
        for name, command, output in self.each():
            if command[0] == "agglomerate":
                continue
            whole = self.run_it(*command, "--report", "whole.json")
            self.assertEqual(whole.returncode, 0, whole.stderr)
            ran = self.run_it(*command, "--report", "/dev/full")
            self.assertEqual((ran.returncode, ran.stdout), (1, whole.stdout))
            self.assertIn("/dev/full: cannot be written: No space left on device", ran.stderr)
            with open("/dev/full", "w") as full:
                ran = self.run_it(*command, "--report", "o.json", capture_output=False, stdout=full, stderr=subprocess.PIPE)
            self.assertEqual(ran.returncode, 1)
            self.assertIn("cannot be printed to stdout: No space left on device", ran.stderr)
            self.assertEqual(json.loads((self.folder / "o.json").read_text())["program"], name)
            self.assertEqual(self.run_it("agglomerate", "check", output).returncode, 0)

    def test_a_disk_that_is_full_ends_with_a_message(self):
        """A limit on the size of files fails as a full disk does: at any write, at the flush, at the close."""
        for name, command, output in self.each():
            for size in (1, 100, 1000, 3000, 10000, 25000):
                limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
                ran = self.run_it(*command, preexec_fn=limit)
                if size <= 1000 and "OMP: System error" in ran.stderr:
                    # LLVM's OpenMP wants a file of its own before the program begins. The empty one that it leaves would end a
                    # later process of the same number with SIGBUS.
                    for left in pathlib.Path("/dev/shm").glob("__KMP_REGISTERED_LIB_*"):
                        if left.stat().st_uid == os.getuid() and left.stat().st_size == 0:
                            left.unlink()
                    continue
                if ran.returncode == 0:  # it is as small as that
                    self.assertTrue(output.exists())
                    output.unlink()
                else:
                    self.assertEqual(ran.returncode, 2 if size == 1 else 1, (size, ran.stderr))
                    self.assertIn("o.", ran.stderr)
                    self.assertIn("File too large", ran.stderr)
                    self.assertNotIn("internal", ran.stderr)
                if "o.h5.checkpoint" in self.left():  # where there was room for that: from there it goes on
                    self.assertEqual(self.left(), ["o.h5.checkpoint"] + (["o.h5.frames"] if name != "rigidstress" else []))
                    self.ends(self.run_it(*command), 0)
                    for made in self.left():
                        (self.folder / made).unlink()
                self.assertEqual([n for n in self.left() if not n.endswith((".dump", ".series"))], [], size)

    def test_streams_may_be_closed(self):
        for streams in ((1, 2), (0, 1, 2), (0,), (2,)):
            close = lambda: [os.close(k) for k in streams]
            silent = {"capture_output": False, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
            for _, command, output in self.each():
                ran = self.run_it(*command, preexec_fn=close, **silent)
                self.assertEqual(ran.returncode, 0)
                if output.suffix == ".h5":
                    self.assertEqual(self.run_it("agglomerate", "check", output, preexec_fn=close, **silent).returncode, 0)
            ran = self.run_it(*self.commands()["rigidstress"], "--check", preexec_fn=close, **silent)
            self.assertEqual(ran.returncode, 0)

    def test_a_folder_that_may_not_be_written_to_is_known_before_the_start(self):
        (self.folder / "locked").mkdir(mode=0o555)
        drop = (lambda: os.setuid(65534)) if os.geteuid() == 0 else None
        for name, command, _ in self.each(output="locked/o.h5"):
            ran = self.run_it(*command, preexec_fn=drop)
            self.ends(ran, 2)
            self.assertIn("the folder 'locked' cannot be written to: Permission denied", ran.stderr)
        ran = self.run_it(*self.commands()["dryer"], "--report", "locked/r.json", preexec_fn=drop)
        self.assertEqual(ran.returncode, 2)

    def test_a_small_stack_is_made_larger_or_refused(self):
        limit = lambda hard: lambda: resource.setrlimit(resource.RLIMIT_STACK, (256 << 10, hard))
        for _, command, _ in self.each():
            ran = self.run_it(*command, preexec_fn=limit(resource.RLIM_INFINITY))
            self.ends(ran, 0)
        ran = self.run_it(*self.commands()["dryer"], preexec_fn=limit(256 << 10))
        self.ends(ran, 2)
        self.assertIn("the stack is limited to 256 kB", ran.stderr)

    def test_every_reader_refuses_what_check_refuses(self):
        damages = {"/particles/all/mass": (slice(None), 0.0), "/particles/all/position/value": ((0, 1, 0), numpy.nan),
                   "/particles/all/radius": (1, numpy.nan), "/contacts/pair": (1, [0, 1]),
                   "/contacts/normal": (0, [-1.0, 0.0, 0.0]), "/contacts/gap": (1, 500.0),
                   "/contacts/normal_force": (0, numpy.inf), "/observables/fragment_count/value": (0, 2)}
        for path, (index, value) in damages.items():
            shutil.copy(self.folder / "chain.h5", self.folder / "bad.h5")
            with h5py.File(self.folder / "bad.h5", "r+") as file:
                file[path][index] = value
            self.assertEqual(self.run_it("agglomerate", "check", "bad.h5").returncode, 1)
            readers = [c for n, c in self.commands(agglomerate="bad.h5").items() if n not in ("dryer", "import")]
            readers += [["agglomerate", "info", "bad.h5"], ["agglomerate", "morphology", "bad.h5"]]
            for command in readers:
                with self.subTest(path=path, command=command[:2]):
                    ran = self.run_it(*command)
                    self.ends(ran, 3)
                    self.assertIn(f"bad.h5: {path.replace('/value', '')}", ran.stderr)
                    self.assertIn(": expected ", ran.stderr)
                    self.assertEqual(self.left(), [])

    def test_a_result_of_another_scene_is_replaced_only_where_told_to(self):
        changes = {"dryer": "droplet.lifetime=2e-4", "breaker": "breakup.reach=0.9", "rigidstress": "flow.starts=3"}
        for name, command, output in self.each():
            if name not in changes:
                continue
            with self.subTest(name=name):
                self.ends(self.run_it(*command), 0)
                self.ends(self.run_it(*command), 0)  # the same scene again
                before = output.read_bytes()
                other = [*command, "--set", changes[name]]
                refused = self.run_it(*other)
                self.ends(refused, 2)
                self.assertIn(f"another scene ({changes[name].partition('=')[0]} = ", refused.stderr)
                self.assertIn("--overwrite", refused.stderr)
                self.assertEqual(output.read_bytes(), before)
                self.assertEqual(self.left(), [output.name])
                self.ends(self.run_it(*other, "--overwrite"), 0)
                self.assertNotEqual(output.read_bytes(), before)

    def test_two_runs_at_once_leave_the_result_of_one(self):
        scene = "[particle]\nradius = 10e-9\nnumber = 40\n[droplet]\nradius = 172e-9\nlifetime = 2.1e-2\n"
        (self.folder / "long.toml").write_text(scene)
        command = [str(PROGRAMS / "dryer"), "long.toml", "-o", "o.h5", "--set", "error.estimate=false", "--threads", "1"]
        first = subprocess.Popen(command, cwd=self.folder, stderr=subprocess.PIPE, text=True)
        self.addCleanup(first.stderr.close)
        self.addCleanup(first.kill)
        while not (self.folder / "o.h5.frames").exists():
            self.assertIsNone(first.poll())
        for setting in ({}, {"HDF5_USE_FILE_LOCKING": "FALSE"}):
            second = self.run_it(*command[0:1], *command[1:], "--seed", 2, env=os.environ | setting)
            self.assertEqual(second.returncode, 2, second.stderr)
            self.assertIn(f"is being written by process {first.pid} on ", second.stderr)
        first.send_signal(signal.SIGTERM)
        self.assertEqual(first.wait(60), 143)
        self.assertEqual(self.left(), ["o.h5.checkpoint", "o.h5.frames"])

    def test_values_that_no_colloid_has_are_refused_with_the_likely_unit(self):
        def refusal(*settings):
            ran = self.run_it("dryer", "scene.toml", "--check", *[a for s in settings for a in ("--set", s)])
            self.ends(ran, 2)
            return ran.stderr
        self.assertIn("if nanometres were meant, write 1e-08", refusal("particle.radius=10", "droplet.radius=120"))
        self.assertIn("if degrees Celsius were meant, write 298.15", refusal("fluid.temperature=25"))
        self.assertIn("makes contacts of b0 = 1.14 a", refusal("material.youngs_modulus=3.4e6"))
        self.assertIn("makes contacts of b0 = 114 a", refusal("material.youngs_modulus=3.4"))
        (self.folder / "metres.csv").write_text("x,y,z,radius\n0,0,0,1e-8\n2e-8,0,0,1e-8\n")
        ran = self.run_it("agglomerate", "import", "metres.csv", "-o", "o.h5")
        self.ends(ran, 3)
        self.assertIn("metres.csv:2: a radius of 1e-17 m, which no particle of a colloid has: check --unit", ran.stderr)

    def test_small_or_stiff_particles_with_brownian_motion_are_no_internal_error(self):
        for settings in (["particle.radius=1.6e-9", "droplet.radius=10e-9", "particle.number=14"],
                         ["particle.radius=4e-9"], ["material.youngs_modulus=70e9"]):
            ran = self.run_it("dryer", SCENES / "compact.toml", "--check", "--set", "particle.number=10",
                              *[a for s in settings for a in ("--set", s)])
            self.ends(ran, 0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
