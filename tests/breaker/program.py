"""The program as users meet it: breaker and agglomerate on small agglomerates, hard cases included.

    program.py BREAKER AGGLOMERATE SCENE.toml
"""
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

from coil import coil
from program_runs import contents, interrupt, seconds

BREAKER, AGGLOMERATE, SCENE = (str(pathlib.Path(p).resolve()) for p in sys.argv[1:4])
DOUBLET = [[0, 0, 0], [200, 0, 0]]


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="breaker-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_it(self, *arguments):
        return subprocess.run([BREAKER, *map(str, arguments)], capture_output=True, text=True, timeout=120)

    def agglomerate(self, centres, radius=100, tolerance=0.02):
        """Centres in nm -> closed agglomerate file."""
        table = self.folder / "centres.csv"
        table.write_text("\n".join(["x,y,z"] + [",".join(f"{v:.12g}" for v in x) for x in centres]) + "\n")
        out = self.folder / "agglomerate.h5"
        subprocess.run([AGGLOMERATE, "import", str(table), "-o", str(out), "--radius", str(radius),
                        "--contact-tolerance", str(tolerance)], check=True, capture_output=True)
        return out

    def command(self, agglomerate, *settings, output="breakup.h5"):
        return [SCENE, agglomerate, "-o", self.folder / output, *[a for s in settings for a in ("--set", s)]]

    def breakup(self, agglomerate, *settings, output="breakup.h5"):
        return self.breakup_of(SCENE, agglomerate, *settings, output=output)

    def breakup_of(self, scene, agglomerate, *settings, output="breakup.h5"):
        report = self.folder / "breakup.json"
        run = self.run_it(scene, *self.command(agglomerate, *settings, output=output)[1:], "--report", report, "--overwrite")
        self.assertEqual(run.returncode, 0, run.stderr)
        out = self.folder / output
        check = subprocess.run([AGGLOMERATE, "check", str(out)], capture_output=True, text=True)
        self.assertEqual(check.returncode, 0, check.stdout)
        return json.loads(report.read_text()), run, out

    def refused(self, agglomerate, *settings):
        run = self.run_it(*self.command(agglomerate, *settings, output="refused.h5"))
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertFalse((self.folder / "refused.h5").exists())
        return run.stderr

    def test_doublet(self):
        report, run, out = self.breakup(self.agglomerate(DOUBLET))
        found = report["results"]
        self.assertAlmostEqual(found["critical_stress_pa"], 11770, delta=30)
        self.assertEqual(found["breakage"], "brittle")
        self.assertEqual(found["fragments"], [1, 1])
        self.assertEqual((found["contacts_initial"], found["contacts_at_breakup"]), (1, 1))
        self.assertLess(report["errors"]["critical_stress_relative"]["value"], 3e-3)
        self.assertIn("needed to turn into the flow", run.stderr)
        with h5py.File(out) as file:
            # The equilibrium gap of JKR at 100 nm.
            self.assertAlmostEqual(file["contacts/gap"][0], -0.18795, delta=1e-5)
            self.assertEqual(file["h5md/modules/agglomerate"].attrs["state"], "broken")
            self.assertEqual(list(file["events/kind"]), [3, 5])
            self.assertEqual(list(file["events/fragment_sizes"]), [1, 1])
            stress = file["series/flow_stress/value"][:]
            self.assertTrue((numpy.diff(stress) > 0).all())
            self.assertTrue((numpy.diff(file["observables/flow_stress/value"][:]) >= 0).all())

    def test_radii_beyond_the_table_of_lubrication_are_named_and_the_far_field_takes_them(self):
        table = self.folder / "unequal.csv"
        table.write_text("x,y,z,radius\n0,0,0,10\n120,0,0,110\n")
        out = self.folder / "unequal.h5"
        subprocess.run([AGGLOMERATE, "import", str(table), "-o", str(out)], check=True, capture_output=True)
        said = self.refused(out)
        self.assertIn("particles 0 and 1 have radii of", said)
        self.assertIn("11 to 1", said)
        self.assertIn('hydrodynamics.method = "fts"', said)
        run = self.run_it(*self.command(out, 'hydrodynamics.method="fts"', output="far.h5"), "--check")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_does_it_hold_there(self):
        start = self.agglomerate(DOUBLET)
        report = self.folder / "at.json"
        run = self.run_it(*self.command(start, "error.estimate=false"), "--report", report, "--at", "5000 1/s")
        self.assertEqual(run.returncode, 0, run.stderr)
        found = json.loads(report.read_text())["results"]
        # breakup.toml has 1 Pa s.
        self.assertAlmostEqual(found["critical_shear_rate_per_s"], found["critical_stress_pa"])
        self.assertAlmostEqual(found["at"]["share_of_strength"], 5000 / found["critical_stress_pa"])
        self.assertEqual(found["at"]["verdict"], "holds")
        self.assertIsNone(found["at"]["error_numerical_relative"])
        self.assertIn("5000 1/s = 5e+03 Pa: holds, at ", run.stdout)
        self.assertIn("stagnation flow", run.stdout)

    def test_a_run_that_cannot_go_on_says_where_and_keeps_its_state(self):
        run = self.run_it(*self.command(self.agglomerate(DOUBLET), "material.youngs_modulus=1e120", "error.estimate=false"))
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertRegex(run.stderr, r"step 0 at t = 0 s \(0 Pa\): no step from \S+ s down to \S+ s is accepted \(1 contacts\)")
        self.assertTrue((self.folder / "breakup.h5.checkpoint").exists())
        self.assertFalse((self.folder / "breakup.h5").exists())

    def test_scaled_from_10_nm_breaks_as_at_100_nm(self):
        report, _, _ = self.breakup(self.agglomerate([[0, 0, 0], [20, 0, 0]], radius=10),
                                    "hydrodynamics.method=fts", "error.estimate=false")
        self.assertAlmostEqual(report["results"]["scaled_by"], 10)
        self.assertAlmostEqual(report["results"]["critical_stress_pa"], 12597, delta=15)
        self.assertIsNone(report["errors"]["critical_stress_relative"]["value"])

    def test_viscosity_changes_nothing_when_the_protocol_goes_with_it(self):
        start = self.agglomerate(coil(5))
        first, run, _ = self.breakup(start, "error.estimate=false")
        self.assertRegex(run.stderr, r"rigid but for elastic contacts up to [\d.]+ Pa \(\d+ steps\); from here")
        second, _, _ = self.breakup(start, "error.estimate=false", "fluid.viscosity=1e-3", output="thin.h5")
        ratio = second["results"]["critical_stress_pa"] / first["results"]["critical_stress_pa"]
        self.assertAlmostEqual(ratio, 1, delta=1e-5)

    def test_interrupted_run_goes_on_to_the_same_bits(self):
        self.goes_on(self.agglomerate(coil(16)), "error.estimate=false", "integrator.tolerance=0.002",
                     'protocol.stage=[{kind="rest", duration=0.1}, {kind="ramp", rate=5000}]', "breakup.until_stable=true", "breakup.stable_strain=5")

    def test_interrupted_explicit_run_goes_on_to_the_same_bits(self):
        self.goes_on(self.agglomerate(coil(8)), "error.estimate=false", "integrator.method=explicit",
                     'protocol.stage=[{kind="ramp", rate=1e7}]')

    def test_interrupted_run_of_a_halved_tolerance_goes_on_to_the_same_bits(self):
        self.goes_on(self.agglomerate(coil(16)), "integrator.tolerance=0.016", "error.accuracy=1e-12", "error.halvings=3",
                     'protocol.stage=[{kind="rest", duration=0.1}, {kind="ramp", rate=5000}]')

    def test_tolerance_is_halved_until_the_error_is_as_wanted(self):
        start = self.agglomerate(coil(16))
        wanted, _, _ = self.breakup(start, "integrator.tolerance=0.08", "error.accuracy=1e-12")
        given, _, _ = self.breakup(start, "integrator.tolerance=0.02", "error.accuracy=0.5")
        self.assertEqual(wanted["results"]["tolerance"], 0.02)
        self.assertEqual(wanted["results"], given["results"])
        self.assertEqual(wanted["errors"], given["errors"])
        loose, _, _ = self.breakup(start, "integrator.tolerance=0.08", "error.accuracy=0.5")
        self.assertEqual(loose["results"]["tolerance"], 0.08)

    def history(self, gradient, times, name="flow.csv"):
        """gradient(t): 3 x 3 in 1/s."""
        rows = [",".join(map(repr, [float(t), *map(float, numpy.ravel(gradient(t)))])) for t in times]
        names = ["t [s]", *(f"du{i}/d{j} [1/s]" for i in "xyz" for j in "xyz")]
        (self.folder / name).write_text("\n".join([",".join(names), *rows]) + "\n")
        scene = self.folder / "history.toml"
        scene.write_text(f'[particle]\nradius = 1e-7\n[fluid]\nviscosity = 1.0\n[flow]\nhistory = "{name}"\n')
        return scene

    def test_a_history_that_grows_breaks_as_the_ramp_does(self):
        start = self.agglomerate(DOUBLET)
        ramp, _, _ = self.breakup(start, 'protocol.stage=[{kind="ramp", rate=5e6}]')
        scene = self.history(lambda t: 5e6 * t * numpy.diag([0.5, 0, -0.5]), numpy.linspace(0, 4e-3, 401))
        report, run, out = self.breakup_of(scene, start, output="history.h5")
        found = report["results"]
        self.assertAlmostEqual(5e6 * found["breakup_time_s"] / ramp["results"]["critical_stress_pa"], 1, delta=2e-3)
        self.assertAlmostEqual(found["breakup_stress_pa"] / (5e6 * found["breakup_time_s"]), 1, delta=1e-9)
        self.assertNotIn("critical_stress_pa", found)  # it is none
        self.assertLess(report["errors"]["breakup_time_relative"]["value"], 5e-3)
        self.assertIn("breaks at ", run.stdout)
        self.assertIn("may break as a rigid body", run.stderr)
        with h5py.File(out) as file:
            self.assertEqual(file["flow"].attrs["type"], "history")
            self.assertAlmostEqual(file["breakup/time"][()], found["breakup_time_s"])
            self.assertTrue((numpy.diff(file["series/flow_stress/time"][:]) > 0).all())
            self.assertGreater(len(file["series/flow_stress/time"]), 20)

    def test_a_history_that_is_too_weak_breaks_nothing_and_says_so(self):
        scene = self.history(lambda t: 500 * numpy.diag([0.5, 0, -0.5]), numpy.linspace(0, 0.01, 11))
        report, run, _ = self.breakup_of(scene, self.agglomerate(DOUBLET), "error.estimate=false")
        self.assertIsNone(report["results"]["breakup_time_s"])
        self.assertIn("nothing broke until the end of the history, 0.01 s", run.stdout)
        self.assertIn("as a rigid body it would hold", run.stderr)

    def test_an_interrupted_run_along_a_history_goes_on_to_the_same_bits(self):
        start = self.agglomerate(coil(16))
        scene = self.history(lambda t: 3e5 * t * numpy.array([[0, 1, 0], [0, 0, 0], [0, 0, 0]]), numpy.linspace(0, 0.05, 5001))
        self.goes_on(start, "error.estimate=false", "integrator.tolerance=0.002", scene=scene)

    def test_of_many_tracks_one_is_followed(self):
        root = pathlib.Path(__file__).resolve().parents[2]
        sys.path[:0] = [str(root / "pipeline/tracks"), str(root / "pipeline/report")]
        import store
        start, time = self.agglomerate(DOUBLET), numpy.linspace(0, 4e-3, 401)
        weak = 1e3 * numpy.broadcast_to(numpy.diag([0.5, 0, -0.5]), (401, 3, 3))
        strong = 5e6 * time[:, None, None] * numpy.diag([0.5, 0, -0.5])
        store.write(self.folder / "tracks.h5", time, numpy.stack([weak, strong]), "made")
        scene = self.folder / "tracks.toml"
        scene.write_text('[particle]\nradius = 1e-7\n[fluid]\nviscosity = 1.0\n[flow]\nhistory = "tracks.h5"\n')
        held, _, _ = self.breakup_of(scene, start, "flow.track=1", "error.estimate=false")
        broken, _, _ = self.breakup_of(scene, start, "flow.track=2", "error.estimate=false", output="second.h5")
        self.assertIsNone(held["results"]["breakup_time_s"])
        self.assertGreater(broken["results"]["breakup_time_s"], 1e-3)
        for settings, words in (((), "names 2 histories; one granule goes along one of them"), (("flow.track=3",), "holds 2 tracks")):
            run = self.run_it(scene, start, "-o", self.folder / "no.h5", *[a for s in settings for a in ("--set", s)])
            self.assertEqual(run.returncode, 2)
            self.assertIn(words, run.stderr)

    def test_what_contradicts_a_history_is_refused(self):
        start = self.agglomerate(DOUBLET)
        scene = self.history(lambda t: 500 * numpy.diag([0.5, 0, -0.5]), numpy.linspace(0, 0.01, 11))
        for setting, words in (("flow.kind=shear", "has no meaning along a history"), ("protocol.strain=10", "has no meaning along a history"),
                               ('protocol.stage=[{kind="rest", duration=1}]', "no [[protocol.stage]] goes with it"), ("flow.track=1", "nothing to choose from"),
                               ("output.frame_interval=3", "has no meaning along a history")):
            run = self.run_it(scene, start, "-o", self.folder / "no.h5", "--set", setting)
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(words, run.stderr)
        run = self.run_it(scene, start, "-o", self.folder / "no.h5", "--at", "100 Pa")
        self.assertEqual(run.returncode, 2)
        self.assertIn("--at asks", run.stderr)
        self.history(lambda t: 500 * numpy.array([[0, 1, 0], [-1, 0, 0], [0, 0, 0]]), numpy.linspace(0, 0.01, 11))
        run = self.run_it(scene, start, "-o", self.folder / "no.h5")
        self.assertIn("turns like a solid", run.stderr)

    def goes_on(self, start, *settings, scene=SCENE):
        whole, cut = self.folder / "whole.h5", self.folder / "cut.h5"
        duration = seconds([BREAKER, scene, *self.command(start, *settings, output=whole.name)[1:]])
        for number, part in ((signal.SIGINT, 0.15), (signal.SIGTERM, 0)):
            code = interrupt([BREAKER, scene, *self.command(start, *settings, output=cut.name)[1:]], number, part * duration)
            self.assertEqual(code, 128 + number)
            self.assertTrue(pathlib.Path(f"{cut}.checkpoint").exists() and not cut.exists())
        other = self.run_it(scene, *self.command(start, *settings[:1], output=cut.name)[1:])
        self.assertEqual(other.returncode, 2)
        self.assertIn("another scene", other.stderr)
        again = self.run_it(scene, *self.command(start, *settings, output=cut.name)[1:], "--restart")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertFalse(pathlib.Path(f"{cut}.checkpoint").exists())
        a, b = contents(whole), contents(cut)
        self.assertEqual(a.keys(), b.keys())
        for name in a:
            self.assertTrue(numpy.array_equal(a[name], b[name]), name)

    def test_restart_without_a_checkpoint_is_refused(self):
        start = self.agglomerate(DOUBLET)
        run = self.run_it(*self.command(start, output="none.h5"), "--restart")
        self.assertEqual(run.returncode, 2)
        self.assertIn("--restart: there is no ", run.stderr)
        self.assertFalse((self.folder / "none.h5").exists())

    def test_fragments_break_until_they_are_stable(self):
        report, _, out = self.breakup(self.agglomerate(coil(12)), "breakup.until_stable=true", "error.estimate=false")
        found = report["results"]
        self.assertEqual(sum(found["fragments"]), 12)
        self.assertGreaterEqual(len(found["fragments"]), 2)
        with h5py.File(out) as file:
            labels = file["particles/all/fragment/value"][-1]
            sizes = sorted(numpy.bincount(labels).tolist(), reverse=True)
            self.assertEqual(sizes, found["fragments"])

    def test_particles_lost_in_several_pieces_add_up(self):
        """A chain of 8 breaks in the middle, and the half that is left when it alone would: 4 + 2 particles are lost."""
        def chain(n):
            return self.agglomerate([[200 * k, 0, 0] for k in range(n)])
        fast = ("hydrodynamics.method=fts", "error.estimate=false")
        once, _, _ = self.breakup(chain(8), *fast)
        twice, _, _ = self.breakup(chain(8), "breakup.lost_particles=6", *fast)
        half, _, _ = self.breakup(chain(4), *fast)
        self.assertEqual(once["results"]["fragments"], [4, 4])
        self.assertEqual(twice["results"]["fragments"], [4, 2, 2])
        stress = [run["results"]["critical_stress_pa"] for run in (once, twice, half)]
        self.assertLess(stress[0], 0.7 * stress[1])
        self.assertAlmostEqual(stress[1] / stress[2], 1, delta=5e-3)

    def test_largest_fragment_goes_on(self):
        _, _, out = self.breakup(self.agglomerate(coil(8)), "error.estimate=false")
        text = pathlib.Path(SCENE).read_text().replace("radius = 100e-9", "")
        scene = self.folder / "more.toml"
        scene.write_text(text)
        more = self.run_it(scene, out, "-o", self.folder / "more.h5", "--set", "particle.contacts=keep",
                           "--set", "particle.fragments=largest", "--set", "error.estimate=false")
        self.assertEqual(more.returncode, 0, more.stderr)
        self.assertIn("critical stress", more.stdout)

    def test_pieces_are_refused(self):
        pieces = self.agglomerate(DOUBLET + [[0, 900, 0], [200, 900, 0], [400, 900, 0]])
        self.assertIn("2 pieces", self.refused(pieces))
        report, _, _ = self.breakup(pieces, "particle.fragments=largest", "error.estimate=false")
        self.assertEqual(report["results"]["contacts_initial"], 2)

    def test_loose_particle_in_a_shell_is_refused(self):
        g = (1 + 5**0.5) / 2
        corners = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        for p in (-1 / g, 1 / g):
            for q in (-g, g):
                corners += [[0, p, q], [p, q, 0], [q, 0, p]]
        shell = self.agglomerate((numpy.array(corners) * 100 * g).tolist() + [[0, 0, 0]])
        self.assertIn("2 pieces", self.refused(shell))

    def test_one_particle_never_breaks(self):
        report, run, _ = self.breakup(self.agglomerate([[0, 0, 0]]))
        self.assertIsNone(report["results"]["critical_stress_pa"])
        self.assertIn("nothing broke", run.stdout)

    def test_rest_leaves_a_closed_agglomerate_as_it_is(self):
        report, run, out = self.breakup(self.agglomerate(coil(6)), "flow.kind=quiescent", 'protocol.stage=[{kind="rest", duration=1}]')
        self.assertIn("until the end of the protocol", run.stdout)
        with h5py.File(out) as file:
            x = file["particles/all/position/value"][:]
            # 1e-6 nm: round-off of coordinates of 1000 nm in forces of stiff contacts.
            self.assertLess(abs(x[-1] - x[0]).max(), 1e-6)

    def test_a_ramp_ten_thousand_times_too_fast_still_breaks(self):
        report, run, _ = self.breakup(self.agglomerate(coil(6)), 'protocol.stage=[{kind="ramp", rate=5e7}]', "error.estimate=false")
        self.assertIn("may break before it is aligned", run.stderr)
        self.assertGreater(report["results"]["critical_stress_pa"], 1000)

    def test_flows(self):
        start = self.agglomerate(coil(4))
        report, _, out = self.breakup(start, "flow.kind=uniaxial", "error.estimate=false")
        self.assertGreater(report["results"]["critical_stress_pa"], 1000)
        with h5py.File(out) as file:
            self.assertEqual(file["flow"].attrs["type"], "uniaxial")
        # In shear it tumbles; a slow ramp would let it tumble a thousand times.
        _, run, out = self.breakup(start, "flow.kind=shear", "error.estimate=false", 'protocol.stage=[{kind="ramp", rate=5e5, to=3000}]')
        self.assertIn("needed to turn into the flow: not within 2000", run.stderr)
        with h5py.File(out) as file:
            self.assertEqual(file["flow"].attrs["type"], "shear")

    def test_an_explicit_step_beyond_the_stability_limit_is_refused(self):
        start = self.agglomerate(DOUBLET)
        text = self.refused(start, "integrator.method=explicit", "integrator.step=1e-6", "hydrodynamics.method=fts")
        self.assertIn("beyond the stability limit", text)
        self.assertIn("1.49e-07", text)  # 2/1.35e7 per second: far field, 1 Pa s

    def test_an_unstable_explicit_run_says_where_and_keeps_its_state(self):
        run = self.run_it(*self.command(self.agglomerate(coil(8)), "integrator.method=explicit", "integrator.step=1e-4",
                                        "integrator.allow_unstable=true", 'protocol.stage=[{kind="ramp", rate=5e6}]',
                                        "error.estimate=false"))
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"step \d+ at t = .* has become unstable")
        self.assertTrue((self.folder / "breakup.h5.checkpoint").exists())
        self.assertFalse((self.folder / "breakup.h5").exists())

    def test_explicit_program_agrees(self):
        start = self.agglomerate(DOUBLET)
        settings = ('protocol.stage=[{kind="ramp", rate=5e6}]', "error.estimate=false", "hydrodynamics.method=fts")
        fast, _, _ = self.breakup(start, *settings)
        slow, _, _ = self.breakup(start, *settings, "integrator.method=explicit", output="explicit.h5")
        ratio = fast["results"]["critical_stress_pa"] / slow["results"]["critical_stress_pa"]
        self.assertAlmostEqual(ratio, 1, delta=2e-3)

    def granule(self, centres, radius, youngs_modulus, surface_energy):
        """In units of the radius -> file that says radius (nm) and material."""
        table, out = self.folder / "own.csv", self.folder / "own.h5"
        table.write_text("\n".join(["x,y,z"] + [",".join(f"{radius * v:.12g}" for v in x) for x in centres]) + "\n")
        subprocess.run([AGGLOMERATE, "import", table, "-o", out, "--radius", str(radius), "--youngs-modulus", str(youngs_modulus),
                        "--poisson-ratio", "0.2", "--surface-energy", str(surface_energy)], check=True, capture_output=True)
        return out

    def test_the_ramp_follows_from_the_granule(self):
        """Of 500 kPa or of 10 Pa, without any key set by hand: within 1 % of a ramp twenty times as slow."""
        bent = numpy.array(coil(5)) / 100
        for radius, modulus, energy, low, high in ((24, 7e10, 0.05, 5e4, 5e6), (12000, 1e9, 4.8e-4, 1, 100)):
            granule = self.granule(bent, radius, modulus, energy)
            reports = []
            for strain in ("500", "10000"):
                out, report = self.folder / f"{strain}.h5", self.folder / "own.json"
                run = self.run_it("/dev/null", granule, "-o", out, "--report", report, "--overwrite", "--set", "error.estimate=false",
                                  *([] if strain == "500" else ["--set", f"protocol.strain={strain}"]))
                self.assertEqual(run.returncode, 0, run.stderr)
                reports.append(json.loads(report.read_text()))
            default, slow = (r["results"] for r in reports)
            self.assertTrue(low < default["critical_stress_pa"] < high, default)
            self.assertAlmostEqual(default["critical_stress_pa"] / slow["critical_stress_pa"], 1, delta=0.01)
            with h5py.File(self.folder / "500.h5") as file:
                self.assertGreater(len(file["series/flow_stress/value"]), 20)
            self.assertEqual(reports[0]["granule"]["material"]["surface_energy"]["from"], "file")

    def test_the_rigid_scene_is_of_the_same_granule(self):
        """A scene that is not the paper's: the rigid run beside it has its radius, material and hydrodynamics."""
        granule = self.granule(numpy.array(coil(5)) / 100, 24, 7e10, 0.05)
        report, _, out = self.breakup_of("/dev/null", granule, "particle.radius=50e-9", "material.surface_energy=0.02",
                                         "hydrodynamics.gap_floor=0.01", "flow.kind=shear", "error.estimate=false",
                                         'protocol.stage=[{kind="ramp", rate=1e12, to=1000}]')
        root = pathlib.Path(__file__).resolve().parents[2]
        text = subprocess.run([sys.executable, root / "pipeline/report/rigid_scene.py", out], check=True, capture_output=True,
                              text=True).stdout
        scene, stress = self.folder / "rigid.toml", self.folder / "rigid.json"
        scene.write_text(text)
        run = subprocess.run([pathlib.Path(BREAKER).with_name("rigidstress"), scene, granule, "-o", self.folder / "rigid.h5",
                              "--report", stress], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        rigid = json.loads(stress.read_text())
        for section, keys in (("particle", ("radius",)), ("fluid", ("viscosity",)), ("hydrodynamics", ("method", "gap_floor")),
                              ("material", ("youngs_modulus", "poisson_ratio", "surface_energy"))):
            for key in keys:
                self.assertEqual(rigid["inputs"][section][key], report["inputs"][section][key], key)
        # Of touching spheres here, of closed contacts there.
        ratio = rigid["results"]["shear"]["critical_stress_supremum_pa"] / report["results"]["rigid_prediction_pa"]
        self.assertAlmostEqual(ratio, 1, delta=0.01)

    def test_messages_say_what_is_wrong(self):
        start = self.agglomerate(DOUBLET)
        for setting, message in (("protocol.stages=ramp 5000", "'protocol.stages' is now called '[[protocol.stage]]'"),
                                 ('protocol.stage=[{kind="wait"}]', "must be one of rest, hold, ramp"),
                                 ('protocol.stage=[{kind="hold", stress=2}]', "needs 'duration'"),
                                 ('protocol.stage=[{kind="rest", duration=1, rate=2}]', "has no meaning where kind"),
                                 ('protocol.stage=[{kind="ramp", raet=2}]', "did you mean 'protocol.stage[0].rate'"),
                                 ('protocol.stage=[{kind="ramp", rate=5000}, {kind="rest", duration=1}]',
                                  "nothing can follow"),
                                 ("protocol.stage=5", "must be tables"),
                                 ("integrator.step=1e-9", "has no meaning to the implicit integrator"),
                                 ("particle.contacts=keep", "scales the agglomerate"),
                                 ("breakup.reech=1", "did you mean 'breakup.reach'")):
            self.assertIn(message, self.refused(start, setting))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
