"""Other programs' readers open what `agglomerate export` and the Python module write, and the files themselves: ASE, MDAnalysis, GSD and,
where it is installed, ParaView.

VTK's reader is asked by export_test.cpp, array by array.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = pathlib.Path(os.environ.get("CRUMBLE_BUILD", ROOT / "build/release")) / "bin/agglomerate"
SAMPLES = [ROOT / f"data/samples/{name}-1.2.h5" for name in ("dryer", "breaker")]
sys.path.insert(0, str(ROOT / "pipeline/python"))
import crumble

# A server that starts again after each client, as it does by itself, loses the next one: MPI of ParaView looks for screens first.
SCREEN = "-screen 0 1280x1024x24 -noreset"
# ParaView's own Python asks its own reader and draws with view.py.
PARAVIEW = """
import json, sys
sys.path.insert(0, sys.argv[1])
import view
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from paraview import servermanager
reader, spheres, tubes, scene = view.shown(sys.argv[2])
frames = []
for time in reader.TimestepValues:
    reader.UpdatePipeline(time)
    grid = servermanager.Fetch(reader)
    array = lambda data, name: vtk_to_numpy(data.GetArray(name)).tolist()
    frames.append({"time": time, "points": vtk_to_numpy(grid.GetPoints().GetData()).tolist(), "radius": array(grid.GetPointData(), "radius"),
                   "tension": array(grid.GetCellData(), "normal_force")[grid.GetNumberOfPoints():]})
tubes.UpdatePipeline(reader.TimestepValues[-1])
simple.SaveScreenshot(sys.argv[3], scene)
print(json.dumps({"frames": frames, "coloured": tubes.CellData["normal_force"].GetRange()}))
"""


class Viewers(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def exported(self, sample, name):
        subprocess.run([TOOL, "export", sample, "-o", self.folder / name], check=True, stdout=subprocess.DEVNULL)
        return self.folder / name

    def test_ase_reads_the_frames_of_an_extended_xyz_with_radii_fragments_and_times(self):
        try:
            import ase.io
        except ModuleNotFoundError:
            self.skipTest("this system has no ASE")
        for sample in SAMPLES:
            found = ase.io.read(self.exported(sample, "a.xyz"), index=":", format="extxyz")
            with h5py.File(sample) as file:
                times = file["particles/all/position/time"][:]
                self.assertEqual(len(found), len(times))
                for k, atoms in enumerate(found):
                    numpy.testing.assert_allclose(atoms.positions, file["particles/all/position/value"][k], rtol=1e-12)
                    numpy.testing.assert_allclose(atoms.arrays["radius"], file["particles/all/radius"][:], rtol=1e-12)
                    self.assertEqual(atoms.info["Time"], times[k])
                    self.assertEqual(atoms.arrays["n_neighb"].sum(), 2 * file["observables/contact_count/value"][k])
                    self.assertEqual(len(set(atoms.arrays["cluster"])), file["observables/fragment_count/value"][k])
                    self.assertFalse(atoms.pbc.any())

    def test_mdanalysis_opens_a_file_by_the_two_lines_of_the_manual(self):
        try:
            import MDAnalysis
        except ModuleNotFoundError:
            self.skipTest("this system has no MDAnalysis")
        manual = (ROOT / "common/tool/README.md").read_text(encoding="utf-8")
        lines = [line.strip() for line in manual.splitlines() if "MDAnalysis.Universe" in line or "load_new" in line]
        self.assertEqual(len(lines), 2)
        short = re.search(r"`(u = Universe\.empty.*?)`", (ROOT / "README.md").read_text(encoding="utf-8"))[1]  # as README says it
        for sample, text in ((sample, text) for sample in SAMPLES for text in ("\n".join(lines), short)):
            names = {"MDAnalysis": MDAnalysis, "Universe": MDAnalysis.Universe, "N": 8}
            exec(re.sub(r"granule\.h5|a\.h5", str(sample), text).replace("115", "8"), names)
            with h5py.File(sample) as file:
                self.assertEqual(len(names["u"].trajectory), len(file["particles/all/position/time"]))
                for k, step in enumerate(names["u"].trajectory):
                    place = file["particles/all/position/value"][k]
                    numpy.testing.assert_allclose(step.positions / 10, place, rtol=0, atol=2e-7 * numpy.abs(place).max())  # it keeps single precision

    def test_gsd_reads_particles_bonds_and_times_of_every_frame(self):
        try:
            import gsd.hoomd
        except ModuleNotFoundError:
            self.skipTest("this system has no gsd")
        for sample in SAMPLES:
            crumble.read(sample).to_gsd(self.folder / "a.gsd")
            with h5py.File(sample) as file, gsd.hoomd.open(str(self.folder / "a.gsd")) as found:
                times, offset = file["particles/all/position/time"][:], file["contacts/offset"][:]
                self.assertEqual(len(found), len(times))
                for k, frame in enumerate(found):
                    rows = slice(offset[k], offset[k + 1])
                    place, radius = file["particles/all/position/value"][k], file["particles/all/radius"][:]
                    self.assertEqual(frame.configuration.step, file["particles/all/position/step"][k])
                    self.assertEqual(frame.log["time_s"][0], times[k])
                    numpy.testing.assert_array_equal(frame.particles.position, place.astype("f4"))
                    numpy.testing.assert_array_equal(frame.particles.diameter, (2 * radius).astype("f4"))
                    numpy.testing.assert_array_equal(frame.particles.mass, file["particles/all/mass"][:].astype("f4"))
                    self.assertGreater(frame.configuration.box[0] / 2, (abs(place) + radius[:, None]).max() * (1 - 1e-6))
                    numpy.testing.assert_array_equal(frame.bonds.group, file["contacts/pair"][rows])
                    numpy.testing.assert_array_equal(frame.log["bonds/tension_N"], file["contacts/normal_force"][rows])
                    self.assertEqual(frame.log["particles/contacts"].sum(), 2 * file["observables/contact_count/value"][k])
                    if "orientation" in file["particles/all"]:
                        numpy.testing.assert_array_equal(frame.particles.orientation, file["particles/all/orientation/value"][k].astype("f4"))
                        numpy.testing.assert_array_equal(frame.log["particles/fragment"], file["particles/all/fragment/value"][k])
                        self.assertEqual(frame.log["flow_stress_Pa"][0], file["observables/flow_stress/value"][k])

    def test_many_frames_stand_in_a_folder_beside_their_series(self):
        series = self.exported(SAMPLES[0], "a.hdf").with_suffix(".hdf.series")
        with h5py.File(SAMPLES[0]) as file:
            times = file["particles/all/position/time"][:]
        files = json.loads(series.read_text())["files"]
        self.assertEqual([entry["time"] for entry in files], list(times))
        self.assertEqual([entry["name"] for entry in files], [f"a/{k:04}.hdf" for k in range(len(times))])
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["a", "a.hdf.series"])
        self.assertEqual(len(list((self.folder / "a").iterdir())), len(times))

    @unittest.skipUnless(shutil.which("pvpython") and shutil.which("xvfb-run"), "ParaView is asked where it is installed: pipeline/packages.sh viewers")
    def test_paraview_reads_the_series_and_colours_contacts_by_tension(self):
        series = self.exported(SAMPLES[1], "b.hdf").with_suffix(".hdf.series")
        (self.folder / "ask.py").write_text(PARAVIEW)
        done = subprocess.run(["xvfb-run", "-a", "-s", SCREEN, "pvpython", self.folder / "ask.py", ROOT / "pipeline", series, self.folder / "b.png"], capture_output=True, text=True, timeout=500)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        found = json.loads(done.stdout.strip().splitlines()[-1])
        with h5py.File(SAMPLES[1]) as file:
            times, offset = file["particles/all/position/time"][:], file["contacts/offset"][:]
            self.assertEqual([frame["time"] for frame in found["frames"]], list(times))
            for k, frame in enumerate(found["frames"]):
                numpy.testing.assert_allclose(frame["points"], file["particles/all/position/value"][k], rtol=1e-12)
                numpy.testing.assert_allclose(frame["radius"], file["particles/all/radius"][:], rtol=1e-12)
                numpy.testing.assert_array_equal(frame["tension"], file["contacts/normal_force"][offset[k]:offset[k + 1]])
            last = file["contacts/normal_force"][offset[-2]:]
            numpy.testing.assert_allclose(found["coloured"], [last.min(), last.max()], rtol=1e-6)
        import matplotlib.image
        picture = matplotlib.image.imread(self.folder / "b.png")[:, :, :3]
        red, blue = (picture[:, :, a] - picture[:, :, b] for a, b in ((0, 2), (2, 0)))
        self.assertGreater((numpy.abs(picture - 1).max(axis=2) > 0.1).mean(), 0.01)
        self.assertGreater(max(red.max(), blue.max()), 0.3)


if __name__ == "__main__":
    unittest.main()
