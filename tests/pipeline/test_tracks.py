"""Histories of the velocity gradient: statistics of Gaussian ones, and the converter of measured ones."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "pipeline/tracks"), str(ROOT / "pipeline/report")]
import convert
import gaussian


class Gaussian(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tracks = gaussian.gradients(4000, 81, 0.25, 3)  # 20 Kolmogorov times

    def test_covariances_are_those_of_isotropic_turbulence(self):
        # epsilon/(30 nu) (4 d_ik d_jl - d_ij d_kl - d_il d_jk): of 4000 tracks at one instant each is known to
        # 1/30 (4 sqrt(2)/sqrt(4000)) = 0.003 at most; five deviations over 81 entries: one failure in 20,000 without a fault.
        at = self.tracks[:, 40]
        found = numpy.einsum("tij,tkl->ijkl", at, at) / len(at)
        d = numpy.eye(3)
        expected = (4 * numpy.einsum("ik,jl->ijkl", d, d) - numpy.einsum("ij,kl->ijkl", d, d) - numpy.einsum("il,jk->ijkl", d, d)) / 30
        self.assertLess(abs(found - expected).max(), 0.015)
        self.assertLess(abs(numpy.trace(at, axis1=1, axis2=2)).max(), 1e-14)

    def test_strain_and_rotation_forget_themselves_in_their_times(self):
        # Correlation (1 + t/T) exp(-t/T), T half of the integral time. 4000 tracks of 5 (3) components: known to 0.007 (0.009).
        strain = 0.5 * (self.tracks + self.tracks.swapaxes(-1, -2))
        for part, time in ((strain, gaussian.STRAIN_TIME), (self.tracks - strain, gaussian.ROTATION_TIME)):
            square = (part[:, 0] ** 2).sum((-1, -2)).mean()
            for k in (4, 12, 40):
                t = 0.25 * k / (0.5 * time)
                self.assertAlmostEqual((part[:, 0] * part[:, k]).sum((-1, -2)).mean() / square, (1 + t) * numpy.exp(-t), delta=0.04)

    def test_paths_are_smooth_whatever_the_step(self):
        # Twice the steps, half the increments: of white noise they would shrink by the root of two.
        coarse, fine = (gaussian.gradients(500, 21, step, 1) for step in (0.1, 0.05))
        ratio = numpy.diff(fine, axis=1).std() / numpy.diff(coarse, axis=1).std()
        self.assertAlmostEqual(ratio, 0.5, delta=0.05)


class Converter(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.gradient = gaussian.gradients(5, 30, 0.1, 2)

    def convert(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            convert.main(convert.command_line().parse_args([*map(str, words), "-o", str(self.folder / "out.h5")]))
        return said.getvalue()

    def refusal(self, *words):
        with self.assertRaises(SystemExit) as ended:
            self.convert(*words)
        return str(ended.exception.code)

    def check(self):
        with h5py.File(self.folder / "out.h5") as file:
            numpy.testing.assert_allclose(file["gradient"][:], 1e4 * self.gradient, rtol=1e-12, atol=1e-10)
            numpy.testing.assert_allclose(file["time"][:], 1e-4 * 0.1 * numpy.arange(30), rtol=1e-12)
            self.assertEqual((file["time"].attrs["unit"], file["gradient"].attrs["unit"]), ("s", "s-1"))

    UNITS = ("--time-unit", "1e-4", "--rate-unit", "1e4")

    def test_one_array_or_nine_in_hdf5_or_npz(self):
        time = 7 + 0.1 * numpy.arange(30)  # begins anywhere
        with h5py.File(self.folder / "one.h5", "w") as file:
            file["data/A"] = self.gradient.reshape(5, 30, 9)
            file["t"] = time
        self.assertIn("5 tracks of 30 instants", self.convert(self.folder / "one.h5", "--gradient", "data/A", "--time", "t", *self.UNITS))
        self.check()
        names = [f"u{i}{j}" for i in "xyz" for j in "xyz"]
        numpy.savez(self.folder / "nine.npz", **{name: self.gradient[:, :, k // 3, k % 3] for k, name in enumerate(names)})
        self.convert(self.folder / "nine.npz", "--gradient", ",".join(names), "--step", "0.1", *self.UNITS)
        self.check()

    def test_components_in_another_order_are_noticed_by_the_trace(self):
        with h5py.File(self.folder / "a.h5", "w") as file:
            file["A"] = numpy.roll(self.gradient.reshape(5, 30, 9), 1, axis=2)
        self.assertIn("another order", self.refusal(self.folder / "a.h5", "--gradient", "A", "--step", "0.1", *self.UNITS))

    def test_what_is_missing_is_named(self):
        with h5py.File(self.folder / "a.h5", "w") as file:
            file["A"] = self.gradient
            file["t"] = numpy.arange(7)
        for words, answer in ((("--gradient", "B", "--step", "1"), "has no array 'B'; there are A, t"), (("--gradient", "A"), "--time or --step"),
                              (("--gradient", "A", "--time", "t"), "7 instants, the gradient has 30"), (("--gradient", "t", "--step", "1"), "is not tracks x instants x 9"),
                              (("--gradient", "A,A", "--step", "1"), "one array or nine, not 2")):
            self.assertIn(answer, self.refusal(self.folder / "a.h5", *words, *self.UNITS))


if __name__ == "__main__":
    unittest.main()
