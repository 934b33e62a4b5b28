"""The program as users meet it: rigidstress and agglomerate on small agglomerates, hard cases included.

    program.py RIGIDSTRESS AGGLOMERATE SCENE.toml
"""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy

RIGIDSTRESS, AGGLOMERATE, SCENE = (str(pathlib.Path(p).resolve()) for p in sys.argv[1:4])
PULL_OFF = 1.5 * math.pi * 4.8e-3 * 100e-9  # N, of spheres of 100 nm


def dodecahedron(edge):
    """Its 20 corners, each with three neighbours at the given distance."""
    g = (1 + 5**0.5) / 2
    corners = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    for p in (-1 / g, 1 / g):
        for q in (-g, g):
            corners += [[0, p, q], [p, q, 0], [q, 0, p]]
    return numpy.array(corners) * edge * g / 2


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="rigidstress-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_it(self, *arguments):
        return subprocess.run([RIGIDSTRESS, *map(str, arguments)], capture_output=True, text=True, timeout=120)

    def agglomerate(self, centres, radius=100, tolerance=0.02):
        """Centres in nm -> closed agglomerate file; `radius` may be a list."""
        lists = hasattr(radius, "__len__")
        table = self.folder / "centres.csv"
        rows = ["x,y,z,radius" if lists else "x,y,z"]
        for k, x in enumerate(centres):
            rows.append(",".join(f"{v:.12g}" for v in ([*x, radius[k]] if lists else x)))
        table.write_text("\n".join(rows) + "\n")
        out = self.folder / "agglomerate.h5"
        command = [AGGLOMERATE, "import", str(table), "-o", str(out), "--contact-tolerance", str(tolerance)]
        subprocess.run(command + ([] if lists else ["--radius", str(radius)]), check=True, capture_output=True)
        return out

    def stress(self, agglomerate, *settings, scene=SCENE, output="stress.h5"):
        out, report = self.folder / output, self.folder / "stress.json"
        run = self.run_it(scene, agglomerate, "-o", out, "--report", report, "--overwrite", *[a for s in settings for a in ("--set", s)])
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(report.read_text()), run, out

    def refused(self, agglomerate, *settings):
        out = self.folder / "refused.h5"
        run = self.run_it(SCENE, agglomerate, "-o", out, *[a for s in settings for a in ("--set", s)])
        self.assertNotEqual(run.returncode, 0)
        self.assertFalse(out.exists())
        return run

    def test_doublet(self):
        report, _, out = self.stress(self.agglomerate([[0, 0, 0], [200, 0, 0]]),
                                     "hydrodynamics.method=multipole", "hydrodynamics.order=9")
        found = report["results"]
        numpy.testing.assert_allclose(found["drag_over_6_pi_mu_a"], [1.290283, 1.449322, 1.449322], atol=1e-5)
        # Converged multipoles, 1.01936; order 9 is within 2e-4 of it.
        self.assertAlmostEqual(found["elongation"]["n_max_worst"], 1.01936, delta=2e-4)
        self.assertAlmostEqual(found["elongation"]["n_max_settled"], 1.01936, delta=2e-4)
        self.assertEqual(found["elongation"]["contact"], [0, 1])
        for kind in ("settled", "worst"):
            stress = PULL_OFF / (6 * math.pi * 1e-14 * found["elongation"]["n_max_" + kind])
            self.assertAlmostEqual(found["elongation"][f"critical_stress_{kind}_pa"], stress, delta=1e-6 * stress)
        self.assertLess(report["errors"]["n_max_relative"]["value"], 1e-3)
        self.assertEqual(set(found["shear"]) & {"n_max_orbit", "n_max_time_mean", "mean_tumbling_time",
                                                "critical_stress_pa"},
                         {"n_max_orbit", "n_max_time_mean", "mean_tumbling_time", "critical_stress_pa"})
        check = subprocess.run([AGGLOMERATE, "check", str(out)], capture_output=True, text=True)
        self.assertEqual(check.returncode, 0, check.stdout)

    def test_surface_forces_lower_the_pull_off_force_in_the_liquid_and_change_nothing_else(self):
        doublet = self.agglomerate([[0, 0, 0], [200, 0, 0]])
        alone = self.stress(doublet, "hydrodynamics.method=fts")[0]["results"]
        salt = ("surface_forces.hamaker=9.85e-21", "surface_forces.surface_potential=0.04",
                "surface_forces.ionic_strength=100")
        report, run, _ = self.stress(doublet, "hydrodynamics.method=fts", *salt)
        charged, forces = report["results"], report["results"]["surface_forces"]
        self.assertEqual(charged["elongation"]["n_max_worst"], alone["elongation"]["n_max_worst"])
        ratio = forces["pull_off_force_in_liquid_n"] / forces["pull_off_force_n"]
        self.assertLess(ratio, 0.9)
        self.assertAlmostEqual(charged["elongation"]["critical_stress_worst_pa"] / alone["elongation"]["critical_stress_worst_pa"],
                               ratio, delta=1e-6)
        self.assertIn("the pull-off force in this liquid counts here, and nothing else", run.stderr)
        twice = self.refused(doublet, *salt, "surface_forces.sets_surface_energy=true")
        self.assertIn("material.surface_energy", twice.stderr)
        scene = self.folder / "hamaker.toml"
        scene.write_text("[surface_forces]\nhamaker = 9.85e-21\nsurface_potential = 0\nsets_surface_energy = true\n")
        from_hamaker = self.stress(doublet, "hydrodynamics.method=fts", scene=scene)
        with h5py.File(from_hamaker[2]) as file:  # A/(24 pi D0^2)
            self.assertAlmostEqual(file["material/surface_energy"][()], 9.85e-21 / (24 * math.pi * 0.165e-9**2), delta=1e-9)
        refused = self.refused(doublet, *salt[:1], "surface_forces.surface_potential=40", salt[2])
        self.assertEqual(refused.returncode, 2)
        self.assertIn("if mV were meant, write 0.04", refused.stderr)

    def test_far_field_by_override(self):
        report, _, _ = self.stress(self.agglomerate([[0, 0, 0], [200, 0, 0]]), "hydrodynamics.method=fts")
        self.assertAlmostEqual(report["results"]["elongation"]["n_max_worst"], 20 / 21, delta=1e-6)
        self.assertEqual(report["results"]["hydrodynamics"], "fts")

    def test_orbit_from_a_chosen_orientation(self):
        """A doublet along the vorticity spins there and bears no tension; one along the flow tumbles (Jeffery 1922)."""
        doublet = self.agglomerate([[0, 0, 0], [200, 0, 0]])
        along_vorticity, _, _ = self.stress(doublet, "hydrodynamics.method=fts",
                                            "flow.orientation=[0.7071067811865476, 0, -0.7071067811865476, 0]")
        along_flow, _, _ = self.stress(doublet, "hydrodynamics.method=fts", "flow.orientation=[1, 0, 0, 0]")
        self.assertLess(along_vorticity["results"]["shear"]["n_max_orbit"], 1e-9)
        # Somewhere on its way it lies at 45 degrees to the flow, where it bears what it does in elongation of that rate.
        self.assertAlmostEqual(along_flow["results"]["shear"]["n_max_orbit"], 20 / 21, delta=1e-3)
        for wrong in ("[1, 0, 0]", "[0, 0, 0, 0]", "1,0,0,0", '[1, 0, "nonsense", 0]'):
            run = self.refused(doublet, "flow.orientation=" + wrong)
            self.assertEqual(run.returncode, 2)
            self.assertIn("flow.orientation", run.stderr)

    SILICA = ("--youngs-modulus", "7e10", "--poisson-ratio", "0.17", "--surface-energy", "0.05")
    SQUARE = [[0, 0, 0], [48, 0, 0], [48, 48, 0], [0, 48, 0], [24, 24, 33.94]]

    def silica(self):
        """A granule of 24 nm, imported with its material."""
        table, out = self.folder / "silica.csv", self.folder / "silica.h5"
        table.write_text("\n".join(["x,y,z"] + [",".join(map(str, x)) for x in self.SQUARE]) + "\n")
        subprocess.run([AGGLOMERATE, "import", table, "-o", out, "--radius", "24", *self.SILICA], check=True, capture_output=True)
        return out

    def test_material_and_radius_are_those_of_the_file(self):
        granule = self.silica()
        report, run, out = self.stress(granule, scene="/dev/null")
        first = run.stderr.splitlines()[0]
        self.assertIn("radius 24 nm (file), scaled by 1, E 7e+10 Pa (file), nu 0.17 (file), gamma_s 0.05 J/m2 (file)", first)
        self.assertIn("liquid 0.001 Pa s (default)", first)
        self.assertEqual(report["inputs"]["material"]["surface_energy"], 0.05)
        self.assertEqual(report["granule"]["material"]["surface_energy"], {"value": 0.05, "from": "file", "in_file": 0.05})
        self.assertAlmostEqual(report["granule"]["particle"]["radius"]["in_file"], 24e-9, delta=1e-18)
        with h5py.File(out) as file:
            self.assertEqual(file["material/surface_energy"][()], 0.05)
            self.assertEqual(file["material/density"][()], 1300)  # the scene does not know it: handed on
            self.assertIn("surface_energy = 0.05", file["parameters/resolved"].asstr()[()])
        # The same, typed.
        typed, _, _ = self.stress(granule, "particle.radius=24e-9", "material.youngs_modulus=7e10", "material.poisson_ratio=0.17",
                                  "material.surface_energy=0.05", scene="/dev/null", output="typed.h5")
        for key in ("n_max_worst", "critical_stress_worst_pa", "critical_stress_settled_pa"):
            self.assertAlmostEqual(typed["results"]["elongation"][key] / report["results"]["elongation"][key], 1, delta=1e-9)
        # What F_po/(6 pi a^2) of this material makes a hundred times that of the paper's spheres of 100 nm.
        self.assertGreater(report["results"]["elongation"]["critical_stress_worst_pa"], 1e5)

    def test_every_critical_stress_has_its_shear_rate_in_this_liquid(self):
        report, run, _ = self.stress(self.silica(), "fluid.viscosity=0.02", "flow.uniaxial=true", scene="/dev/null")
        pairs = 0
        for group in report["results"].values():
            for name, stress in group.items() if isinstance(group, dict) else ():
                if name.startswith("critical_stress"):
                    rate = group[name.replace("stress", "shear_rate").replace("_pa", "_per_s")]
                    self.assertAlmostEqual(stress / rate / 0.02, 1, delta=1e-12)
                    pairs += 1
        self.assertEqual(pairs, 6)  # settled and worst in two flows, mean and largest in shear
        for device in ("stirred tank", "extensional nozzle", "turbulence"):
            self.assertIn(device, run.stdout)

    def test_does_it_hold_there(self):
        granule = self.silica()
        first, _, _ = self.stress(granule, scene="/dev/null")
        weakest = first["results"]["elongation"]["critical_stress_worst_pa"]
        out, report = self.folder / "at.h5", self.folder / "at.json"
        for load, verdict, share in (("100 Pa", "holds", 100 / weakest), (f"{2 * weakest} Pa", "breaks", 2),
                                     (f"{0.5 * weakest / 1e-3} 1/s", "holds", 0.5), ("10 W/kg", "holds", (10 * 1e-3 * 997)**0.5 / weakest)):
            run = self.run_it("/dev/null", granule, "-o", out, "--report", report, "--at", load)
            self.assertEqual(run.returncode, 0, run.stderr)
            at = json.loads(report.read_text())["results"]["at"]
            self.assertEqual(at["verdict"], verdict)
            self.assertAlmostEqual(at["share_of_strength"] / share, 1, delta=1e-9)
            self.assertAlmostEqual(at["surface_energy_to_break_j_per_m2"] / (0.05 * share), 1, delta=1e-9)
            self.assertEqual(at["error_numerical_relative"], first["errors"]["n_max_relative"]["value"])
            self.assertIsNone(at["error_sampling_relative"])
            self.assertIn(at["sentence"], run.stdout)
        run = self.run_it("/dev/null", granule, "-o", out, "--at", "100")
        self.assertEqual(run.returncode, 2)
        self.assertIn("number > 0 with its unit", run.stderr)

    def test_the_default_surface_energy_of_another_material_is_told(self):
        granule = self.agglomerate([[0, 0, 0], [200, 0, 0]])
        _, run, _ = self.stress(granule, "hydrodynamics.method=fts")
        self.assertNotIn("warning", run.stderr)
        with h5py.File(granule, "a") as file:
            del file["material"], file["parameters/resolved"]
        report, run, _ = self.stress(granule, "material.youngs_modulus=7e10", "hydrodynamics.method=fts", scene="/dev/null",
                                     output="other.h5")
        self.assertIn("warning: E = 7e+10 Pa (scene) is of another material than the surface energy", run.stderr)
        self.assertIn("SURFACE_ENERGY.md", report["results"]["material_warning"])

    def test_the_scene_wins_and_both_values_are_said(self):
        report, run, _ = self.stress(self.silica())
        self.assertIn("radius 100 nm (scene; the file says 24), scaled by 4.16667, E 3.4e+09 Pa (scene; the file says 7e+10), "
                      "nu 0.5 (scene; the file says 0.17), gamma_s 0.0048 J/m2 (scene; the file says 0.05)",
                      run.stderr.splitlines()[0])
        self.assertEqual(report["granule"]["material"]["surface_energy"], {"value": 4.8e-3, "from": "scene", "in_file": 0.05})

    def test_a_file_before_schema_1_1_lends_its_resolved_scene(self):
        granule = self.silica()
        new, _, _ = self.stress(granule, scene="/dev/null")
        with h5py.File(granule, "a") as file:
            del file["material"]
            file["h5md/modules/agglomerate"].attrs["version"] = numpy.array([1, 0], dtype="int32")
        old, run, _ = self.stress(granule, scene="/dev/null", output="old.h5")
        self.assertIn("gamma_s 0.05 J/m2 (file)", run.stderr)
        self.assertEqual(new["results"], old["results"])

    def test_a_stress_file_with_the_keys_of_an_earlier_version_lends_its_response(self):
        granule = self.agglomerate([[0, 0, 0], [200, 0, 0], [400, 0, 0]])
        _, _, out = self.stress(granule, "contact.rolling_stiffness_factor=2", "hydrodynamics.method=fts")
        with h5py.File(out, "a") as file:
            text = file["parameters/resolved"].asstr()[()]
            del file["parameters/resolved"], file["material"], file["fluid"]
            text = text.replace("[contact]", "[structure]").replace("rolling_stiffness_factor", "bending_factor")
            text = text.replace("twisting_stiffness_factor", "twisting_factor")
            file["parameters"].create_dataset("resolved", data=text, dtype=h5py.string_dtype())
        _, run, _ = self.stress(out, "hydrodynamics.method=fts", output="again.h5")
        self.assertIn("nothing is factorised", run.stderr)

    def test_scale_leaves_what_a_stage_leaves(self):
        compact = pathlib.Path(__file__).resolve().parents[2] / "data/compact.h5"
        scaled = self.folder / "scaled.h5"
        run = subprocess.run([AGGLOMERATE, "scale", compact, "--radius", "100", "-o", scaled], check=True, capture_output=True,
                             text=True)
        self.assertIn("scaled by 10", run.stdout)
        _, _, out = self.stress(compact, "hydrodynamics.method=fts", "flow.shear=false", "flow.starts=1")
        with h5py.File(scaled) as a, h5py.File(out) as b:
            self.assertEqual(a["contacts/pair"][:].tolist(), b["contacts/pair"][:].tolist())
            for name in ("contacts/gap", "closing/residual_max", "closing/residual_rms"):
                self.assertTrue(numpy.allclose(a[name][()], b[name][()], rtol=1e-9, atol=0), name)

    def test_keys_of_earlier_versions_are_answered(self):
        for old, new in (("structure.bending_factor=1", "contact.rolling_stiffness_factor"),
                         ("hydrodynamics.tolerance=0.1", "error.accuracy"), ("structure.fragments=each", "particle.fragments")):
            self.assertIn(f"is now called '{new}'", self.refused(self.agglomerate([[0, 0, 0], [200, 0, 0]]), old).stderr)

    def test_another_flow_on_a_stress_file_factorises_nothing(self):
        square = [[0, 0, 0], [200, 0, 0], [200, 200, 0], [0, 200, 0], [100, 100, 141.4213562]]
        first, _, out = self.stress(self.agglomerate(square))
        again, run, _ = self.stress(out, "flow.uniaxial=true", output="again.h5")
        self.assertIn("nothing is factorised", run.stderr)
        for key in ("n_max_worst", "n_max_settled", "critical_stress_worst_pa"):
            self.assertAlmostEqual(first["results"]["elongation"][key] / again["results"]["elongation"][key], 1, 9)
        self.assertIn("n_max_worst", again["results"]["uniaxial"])
        self.assertEqual(first["results"]["statically_determinate_contacts"],
                         again["results"]["statically_determinate_contacts"])
        self.assertEqual(first["errors"]["n_max_relative"]["value"], again["errors"]["n_max_relative"]["value"])
        # Another structure is another response.
        other, run, _ = self.stress(out, "contact.rolling_stiffness_factor=2", output="other.h5")
        self.assertNotIn("nothing is factorised", run.stderr)
        self.assertNotEqual(other["results"]["elongation"]["n_max_worst"], first["results"]["elongation"]["n_max_worst"])

    def test_response_in_the_file_gives_the_flow(self):
        square = [[0, 0, 0], [200, 0, 0], [200, 200, 0], [0, 200, 0], [100, 100, 141.4213562]]
        report, _, out = self.stress(self.agglomerate(square))
        with h5py.File(out) as file:
            load, basis = file["response/load"][:], file["response/basis"][:]
            normal, pair = file["contacts/normal"][:], file["response/pair"][:]
            tension = -numpy.einsum("pk,pks->ps", normal, load[:, :3])
            tensors = numpy.einsum("ps,sij->pij", tension, basis)
            eigenvalues = numpy.linalg.eigvalsh(tensors)
            worst = (eigenvalues[:, 2] - eigenvalues[:, 0]) / 2
            k = int(worst.argmax())
            self.assertAlmostEqual(worst[k] / (6 * math.pi * 1e-14),
                                   report["results"]["elongation"]["n_max_worst"], delta=1e-6)
            forces = file["flows/elongation-worst/normal_force"][:]
            self.assertAlmostEqual(forces.max() / (6 * math.pi * 1e-14),
                                   report["results"]["elongation"]["n_max_worst"], delta=1e-6)
            self.assertEqual(pair.shape, (8, 2))
            self.assertEqual(file["response/velocity"].shape, (6, 5))

    def test_scaled_and_closed_from_10_nm(self):
        report, _, out = self.stress(self.agglomerate([[0, 0, 0], [20, 0, 0], [10, 17.32, 0]], radius=10))
        self.assertAlmostEqual(report["results"]["scaled_by"], 10)
        with h5py.File(out) as file:
            self.assertAlmostEqual(file["particles/all/radius"][0], 100)
            # Equilibrium gap of JKR at 100 nm.
            numpy.testing.assert_allclose(file["contacts/gap"][:], -0.18795, atol=1e-5)

    def test_one_particle(self):
        report, _, _ = self.stress(self.agglomerate([[0, 0, 0]]))
        self.assertEqual(report["results"]["elongation"]["n_max_worst"], 0)
        self.assertIsNone(report["results"]["elongation"]["critical_stress_worst_pa"])
        numpy.testing.assert_allclose(report["results"]["drag_over_6_pi_mu_a"], 1, atol=1e-12)

    def test_two_fragments(self):
        pieces = self.agglomerate([[0, 0, 0], [200, 0, 0], [400, 0, 0], [0, 900, 0], [200, 900, 0]])
        run = self.refused(pieces)
        self.assertEqual(run.returncode, 2)
        self.assertIn("2 pieces", run.stderr)
        report, _, out = self.stress(pieces, "particle.fragments=each", "hydrodynamics.method=fts")
        found = report["results"]
        self.assertEqual(found["fragment_sizes"], [3, 2])
        # Each as if alone: the trimer and the doublet of the far field.
        numpy.testing.assert_allclose(found["fragment_n_max_worst"], [1.425765, 0.952381], atol=1e-5)
        again, run, _ = self.stress(out, "particle.fragments=each", "hydrodynamics.method=fts", output="again.h5")
        self.assertIn("nothing is factorised", run.stderr)
        numpy.testing.assert_allclose(again["results"]["fragment_n_max_worst"], found["fragment_n_max_worst"],
                                      rtol=1e-9)

    def test_shell_with_a_loose_particle_inside(self):
        shell = self.agglomerate(numpy.r_[dodecahedron(200), [[0, 0, 0]]])
        run = self.refused(shell)
        self.assertIn("particle 20 belongs to the second", run.stderr)
        report, _, _ = self.stress(shell, "particle.fragments=each", "hydrodynamics.method=fts")
        self.assertEqual(report["results"]["fragment_sizes"], [20, 1])
        self.assertGreater(report["results"]["elongation"]["n_max_worst"], 0)
        self.assertEqual(report["results"]["fragment_n_max_worst"][1], 0)

    def test_contact_of_spheres_one_radius_apart_is_refused_with_its_pair(self):
        out = self.agglomerate([[0, 0, 0], [200, 0, 0], [400, 0, 0]])
        with h5py.File(out, "r+") as file:
            file["particles/all/position/value"][0, 2, 0] += 100
            file["contacts/gap"][1] += 100
            # What follows from the positions goes with them, else the file would not be read at all.
            x = file["particles/all/position/value"][0, :, 0]
            x = x - x.mean()
            square = (x**2).mean()
            file["observables/radius_of_gyration/value"][0] = square**0.5
            file["observables/semi_axes/value"][0] = [(5 * square + 100**2) ** 0.5, 100, 100]
            file["morphology/radial_position"][:] = sorted(abs(x))
        run = self.refused(out)
        self.assertEqual(run.returncode, 2)
        self.assertIn("contact 1-2", run.stderr)
        self.assertIn("0.998 a apart", run.stderr)

    def test_mechanism_is_named(self):
        run = self.refused(self.agglomerate([[0, 0, 0], [200, 0, 0], [400, 0, 0]]), "contact.rolling_stiffness_factor=0")
        self.assertEqual(run.returncode, 2)
        self.assertIn("contact 0-1 is free to bend", run.stderr)

    def test_unequal_radii(self):
        report, _, _ = self.stress(self.agglomerate([[0, 0, 0], [150, 0, 0], [300, 0, 0]], radius=[100, 50, 100]))
        found = report["results"]["elongation"]
        # Both contacts are alike by symmetry, R* = 100/3 nm: F_po = (3/2) pi 2 gamma_s R*.
        pull_off = 3 * math.pi * 4.8e-3 * 100e-9 / 3
        # The scene's radius is the mean one, 83.3 nm in the file: all is scaled by 1.2.
        unit = 6 * math.pi * 100e-9**2
        self.assertAlmostEqual(found["critical_stress_worst_pa"] * found["n_max_worst"] * unit / (1.2 * pull_off), 1, 6)

    def test_memory_limit_is_said(self):
        run = self.refused(self.agglomerate([[200 * k, 0, 0] for k in range(20)]), "hydrodynamics.method=multipole",
                           "hydrodynamics.memory=1e6")
        self.assertIn("GB", run.stderr)
        self.assertIn("hydrodynamics.memory", run.stderr)

    def test_history(self):
        names = ["t [s]"] + [f"{u}{x} [1/s]" for u in "uvw" for x in "xyz"]
        rows = [",".join(names)] + [f"{0.01 * k},0,50,0,0,0,0,0,0,0" for k in range(101)]
        (self.folder / "flow.csv").write_text("\n".join(rows) + "\n")
        scene = self.folder / "history.toml"
        scene.write_text('[particle]\nradius = 1e-7\n[fluid]\nviscosity = 2.0\n[flow]\nhistory = "flow.csv"\n'
                         'elongation = false\nshear = false\n')
        report, _, out = self.stress(self.agglomerate([[0, 0, 0], [200, 0, 0]]), scene=scene)
        found = report["results"]["history"]
        self.assertAlmostEqual(found["largest_stress_pa"], 100, places=9)
        self.assertAlmostEqual(found["critical_stress_pa"], 100 / found["use_of_pull_off"], places=6)
        with h5py.File(out) as file:
            self.assertAlmostEqual(file["flows/history/max_tension"][:].max(), found["n_max_worst_orbit_n"], delta=1e-15)
            self.assertEqual(len(file["flows/history/time"]), 101)
        (self.folder / "flow.csv").write_text("\n".join(rows[:20] + rows[60:]) + "\n")
        run = self.run_it(scene, self.folder / "agglomerate.h5", "-o", self.folder / "x.h5")
        self.assertEqual(run.returncode, 2)
        self.assertIn("flow.csv:21", run.stderr)

    def test_many_tracks_in_a_folder_and_in_one_file_are_the_same_flow(self):
        granule = self.agglomerate(dodecahedron(200))
        sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "pipeline/tracks"))
        import gaussian
        import store
        rate, time = 1e6, numpy.arange(200) * 1e-7
        gradient = rate * gaussian.gradients(12, 200, 0.1, 5)
        store.write(self.folder / "tracks.h5", time, gradient, "made")
        (self.folder / "tracks").mkdir()
        names = [f"du{i}/d{j} [1/s]" for i in "xyz" for j in "xyz"]
        for k, track in enumerate(gradient):
            rows = [",".join(map(repr, [float(t), *map(float, g.ravel())])) for t, g in zip(time, track)]
            (self.folder / f"tracks/{k:03}.csv").write_text("\n".join([",".join(["t [s]", *names]), *rows]) + "\n")
        found = {}
        for name in ("tracks.h5", "tracks"):
            scene = self.folder / f"{name}.toml"
            scene.write_text(f'[hydrodynamics]\nmethod = "fts"\n[flow]\nelongation = false\nshear = false\nhistory = "{name}"\n')
            report, run, _ = self.stress(granule, scene=scene)
            found[name] = report["results"]["tracks"]
            self.assertIn("12 tracks, sqrt(<2 E:E>) = ", run.stdout)
        for key, values in found["tracks"].items():  # the trace is taken out of each: to round-off the same numbers
            numpy.testing.assert_allclose(values, found["tracks.h5"][key], rtol=1e-9, err_msg=key)
        self.assertEqual(found["tracks"]["count"], 12)
        strain = 0.5 * (gradient + gradient.swapaxes(-1, -2))
        square = 2 * (strain**2).sum((-1, -2))
        mean = (0.5 * (square[:, 1:] + square[:, :-1])).mean()
        self.assertAlmostEqual(found["tracks"]["rms_rate_per_s"] / mean**0.5, 1, 9)
        levels, intervals = len(found["tracks"]["level"]), len(found["tracks"]["time_s"]) - 1
        exits = numpy.reshape(found["tracks"]["exits"], (levels, intervals)).sum(1) + found["tracks"]["born_above"]
        self.assertTrue(all(a <= b for a, b in zip(exits, exits[1:])))  # a stronger flow breaks no fewer
        self.assertEqual((exits[0], exits[-1]), (0, 12))
        # One of them alone is the history of that file.
        alone = []
        for name, settings in (("tracks.h5", ["--set", "flow.track=3"]), ("tracks", ["--set", "flow.track=3"]), ("tracks/002.csv", [])):
            scene.write_text(f'[hydrodynamics]\nmethod = "fts"\n[flow]\nelongation = false\nshear = false\norbits = 2\nhistory = "{name}"\n')
            report = self.folder / "alone.json"
            run = self.run_it(scene, granule, "-o", self.folder / "alone.h5", "--report", report, "--overwrite", *settings)
            self.assertEqual(run.returncode, 0, run.stderr)
            alone.append(json.loads(report.read_text())["results"]["history"]["use_of_pull_off"])
        numpy.testing.assert_allclose(alone, alone[0], rtol=1e-9)
        for number, words in (("13", "holds 12 tracks"), ("0", "must be")):
            scene.write_text('[flow]\nhistory = "tracks.h5"\n')
            run = self.run_it(scene, granule, "-o", self.folder / "no.h5", "--set", f"flow.track={number}")
            self.assertEqual(run.returncode, 2)
            self.assertIn(words, run.stderr)

    def test_tracks_that_are_not_tracks_are_refused_by_name(self):
        granule = self.agglomerate([[0, 0, 0], [200, 0, 0]])
        (self.folder / "empty").mkdir()
        with h5py.File(self.folder / "bad.h5", "w") as file:
            file["time"] = [0.0, 1e-7]
            file["gradient"] = numpy.zeros((2, 3, 3, 3))
            file["gradient"].attrs["unit"] = "1/s"
        scene = self.folder / "scene.toml"
        for name, words in (("empty", "a folder without .csv files"), ("bad.h5", "attribute unit = ''"), ("no.h5", "no.h5")):
            scene.write_text(f'[flow]\nhistory = "{name}"\n')
            run = self.run_it(scene, granule, "-o", self.folder / "r.h5")
            self.assertIn(run.returncode, (2, 3), name)
            self.assertIn(words, run.stderr)
        with h5py.File(self.folder / "bad.h5", "a") as file:
            file["time"].attrs["unit"] = "s"
        scene.write_text('[flow]\nhistory = "bad.h5"\n')
        run = self.run_it(scene, granule, "-o", self.folder / "r.h5")
        self.assertIn("expected tracks x instants x 3 x 3", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
