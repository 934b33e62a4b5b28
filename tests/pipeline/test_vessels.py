"""Histories from devices: exact limits of each flow, balances, and the error that the manual states."""

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
import passage
import rotor_stator
import stenosis
import stirred_tank


def said_by(script, *words):
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        script.main(script.command_line().parse_args(list(map(str, words))))
    return said.getvalue()


def refusal(script, *words):
    with contextlib.redirect_stderr(io.StringIO()), unittest.TestCase().assertRaises(SystemExit) as ended:
        script.main(script.command_line().parse_args(list(map(str, words))))
    return str(ended.exception.code)


class Stenosis(unittest.TestCase):
    vessel = stenosis.Vessel(300e-6, 0.6, 1.2e-3, 5e-9)
    x = numpy.linspace(-0.7e-3, 0.7e-3, 41)

    def test_a_straight_tube_has_poiseuilles_flow(self):
        straight = stenosis.Vessel(300e-6, 0, 1.2e-3, 5e-9)
        for s in (0, 0.3, 0.95):
            gradient = straight.gradient(self.x, s)
            expected = numpy.zeros((3, 3))
            expected[0, 1] = -4 * 5e-9 * s * 150e-6 / (numpy.pi * (150e-6) ** 4)  # -4 Q r/(pi R^4)
            numpy.testing.assert_allclose(gradient, numpy.broadcast_to(expected, gradient.shape), rtol=1e-12, atol=1e-9)
        self.assertAlmostEqual(float(straight.wall_shear_rate(numpy.array(0.0))) / (32 * 5e-9 / (numpy.pi * (300e-6) ** 3)), 1, 12)

    def test_mass_is_conserved(self):
        for s in (0, 0.2, 0.5, 0.99):
            gradient = self.vessel.gradient(self.x, s)
            self.assertLess(abs(numpy.trace(gradient, axis1=1, axis2=2)).max(), 1e-12 * abs(gradient).max())
        # The flow through every section is Q.
        s = numpy.linspace(0, 1, 2001)
        for x in self.x[::8]:
            radius = self.vessel.radius(x)[0]
            flow = passage.summed(2 * numpy.pi * s * radius**2 * self.vessel.velocity(x, s)[0], s)[-1]
            self.assertAlmostEqual(flow / 5e-9, 1, 6)

    def test_the_gradient_is_that_of_the_velocity(self):
        # Differences of the velocity at places x, r over 1e-6 of the radius, to the 1e-8 that they are known to.
        def velocity(x, r):
            return numpy.array(self.vessel.velocity(x, r / self.vessel.radius(x)[0]))
        for x in (-0.45e-3, -0.2e-3, 0.07e-3, 0.3e-3):
            for s in (0.1, 0.6, 0.9):
                r, d = s * self.vessel.radius(x)[0], 1e-10
                found = self.vessel.gradient(numpy.array(x), s)
                along, away = (velocity(x + d, r) - velocity(x - d, r)) / (2 * d), (velocity(x, r + d) - velocity(x, r - d)) / (2 * d)
                expected = numpy.array([[along[0], away[0], 0], [along[1], away[1], 0], [0, 0, velocity(x, r)[1] / r]])
                numpy.testing.assert_allclose(found, expected, atol=1e-5 * abs(expected).max())

    def test_time_along_the_track_integrates_the_velocity(self):
        place, time, gradient = stenosis.track(self.vessel, 0.8, 1e-3)
        middle = 0.5 * (place[1:] + place[:-1])
        speed = self.vessel.velocity(middle, 0.8)[0]
        numpy.testing.assert_allclose(numpy.diff(place) / numpy.diff(time), speed, rtol=2e-2)  # the midpoint rule over one instant
        # Straight parts have the closed form L pi R^2/(2 Q (1 - s^2)).
        ahead = numpy.interp(-0.6e-3, place, time)
        self.assertAlmostEqual(ahead / (1e-3 * numpy.pi * (150e-6) ** 2 / (2 * 5e-9 * (1 - 0.64))), 1, 5)
        rate = passage.rate(gradient)
        self.assertLess((numpy.maximum(rate[1:], rate[:-1]) * numpy.diff(time)).max(), 0.6)
        self.assertLess(numpy.diff(time).max() / numpy.median(numpy.diff(time)), 10)  # no gap, as GradientHistory sees it

    def test_places_stand_for_equal_shares_of_the_flow(self):
        s = stenosis.equal_shares(50)
        numpy.testing.assert_allclose(2 * s**2 - s**4, (numpy.arange(50) + 0.5) / 50, rtol=1e-12)
        p = rotor_stator.equal_shares(50)
        numpy.testing.assert_allclose(3 * p**2 - 2 * p**3, (numpy.arange(50) + 0.5) / 50, rtol=1e-6)

    def test_inertia_changes_the_shear_rate_at_the_wall_by_a_twelfth_of_re_times_slope(self):
        """The equation of the first correction, solved by collocation: mu (1/s)(s u')' = R^2 p' + rho R^2 u0 du0/dx along s, no slip, no flow."""
        # With U = R = mu = 1 and rho R' = e: u0 du0/dx at constant s is U U' (1 - s^2)^2, U' = -2 U R'/R. Powers of s^2 solve it exactly.
        e = 1.0
        powers = numpy.arange(0, 8, 2)
        s = numpy.linspace(0.1, 0.9, 9)
        rows = [[k * k * at ** (k - 2) if k else 0 for k in powers] + [-1] for at in s]
        right = [-2 * e * (1 - at**2) ** 2 for at in s]
        rows += [[1] * 4 + [0], [1 / (k + 2) for k in powers] + [0]]
        right += [0, 0]
        solution, rest, *_ = numpy.linalg.lstsq(numpy.array(rows), numpy.array(right), rcond=None)
        self.assertLess(numpy.abs(numpy.array(rows) @ solution - right).max(), 1e-12)
        wall = sum(k * c for k, c in zip(powers, solution[:4]))
        self.assertAlmostEqual(wall / -2, -e / 12, 12)  # over u0' = -2; Re = R U/nu = 1

    def test_files_and_words(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "one.csv"
            words = ("--diameter", 300e-6, "--narrowing", 0.5, "--length", 1.2e-3, "--viscosity", 3.5e-3, "--density", 1060)
            said = said_by(stenosis, *words, "--flow", 5e-9, "--position", 0.9, "-o", out)
            self.assertIn("left out: inertia", said)
            self.assertNotIn("warning", said)
            lines = out.read_text().splitlines()
            self.assertEqual(lines[1].split(",")[2], "dux/dy [1/s]")
            self.assertIn("separated flow", said_by(stenosis, *words, "--flow", 5e-6, "--position", 0.9, "-o", out))
            said_by(stenosis, *words, "--flow", 5e-9, "--tracks", 3, "-o", pathlib.Path(folder) / "many")
            self.assertEqual(sorted(p.name for p in (pathlib.Path(folder) / "many").iterdir()), ["0001.csv", "0002.csv", "0003.csv"])
            self.assertIn("--position", refusal(stenosis, *words, "--flow", 5e-9, "--position", 1, "-o", out))
            self.assertIn("--flow", refusal(stenosis, *words, "--flow", 0, "--position", 0.5, "-o", out))


class RotorStator(unittest.TestCase):
    gap = rotor_stator.Gap(0.03, 200e-6, 0.01, 100, 2e-5)

    def test_shear_rate_and_residence_time(self):
        self.assertAlmostEqual(self.gap.nominal_shear_rate, numpy.pi * 0.03 * 100 / 200e-6, 6)
        middle = self.gap.gradient(0.5)
        self.assertAlmostEqual(float(passage.rate(middle)) / self.gap.nominal_shear_rate, 1, 12)
        self.assertEqual(numpy.trace(middle), 0)
        # By shares of the flow the residence time averages to volume over flow.
        times = [self.gap.residence_time(p) for p in rotor_stator.equal_shares(20000)]
        self.assertAlmostEqual(numpy.mean(times) / (numpy.pi * 0.03 * 200e-6 * 0.01 / 2e-5), 1, 2)

    def test_the_track_is_the_gap_with_an_edge_at_either_end(self):
        time, gradient = rotor_stator.track(self.gap, 0.3)
        self.assertAlmostEqual(time[-1] / self.gap.residence_time(0.3), 1, 12)
        numpy.testing.assert_allclose(gradient[len(time) // 2], self.gap.gradient(0.3), rtol=1e-12)
        self.assertEqual(abs(gradient[[0, -1]]).max(), 0)
        strain = passage.summed(passage.rate(gradient), time)[-1]
        whole = float(passage.rate(self.gap.gradient(0.3))) * self.gap.residence_time(0.3)
        self.assertAlmostEqual(strain / (whole * (1 - 200e-6 / 0.01)), 1, 3)

    def test_vortices_are_warned_of(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ("--rotor", 0.03, "--gap", 200e-6, "--height", 0.01, "--rpm", 6000, "--flow", 2e-5, "--position", 0.5, "-o", pathlib.Path(folder) / "a.csv")
            self.assertNotIn("warning", said_by(rotor_stator, *words, "--viscosity", 0.1, "--density", 1100))
            self.assertIn("not laminar", said_by(rotor_stator, *words))


class StirredTank(unittest.TestCase):
    tank = stirred_tank.Tank(0.1, 0.1 / 3, 10, 5, 0.75, 0.4 / 3, 0.6)

    def test_dissipation_and_stays_balance(self):
        near, bulk = self.tank.dissipation
        self.assertAlmostEqual((self.tank.zone * near + (1 - self.tank.zone) * bulk) / self.tank.mean_dissipation, 1, 12)
        self.assertAlmostEqual(self.tank.mean_dissipation, 5 * 1000 * (0.1 / 3) ** 5 / (numpy.pi / 4 * 1e-3), 12)
        self.assertAlmostEqual(self.tank.mean_stay.sum() / (self.tank.volume / (0.75 * 10 * (0.1 / 3) ** 3)), 1, 12)

    def test_time_near_the_impeller_is_its_share_of_the_volume(self):
        # 2000 circulations: the share of 0.133 is known to 0.133 x 0.867 sqrt(2/2000) = 0.0036; 4.7 deviations, one failure in 400,000.
        time = numpy.linspace(0, 2000 * self.tank.circulation_time, 400001)
        near = stirred_tank.zones(self.tank, numpy.random.Generator(numpy.random.Philox(5)), time) == 0
        self.assertAlmostEqual(near.mean(), self.tank.zone, delta=0.017)

    def test_the_square_of_the_rate_is_dissipation_over_viscosity(self):
        # All of the tank a zone: 40 tracks of 400 Kolmogorov times, some 350 independent values of five components each, are known
        # to sqrt(2/(5 x 40 x 170)) = 0.8 %; linear interpolation at 0.1 takes less than 0.1 % away. Five deviations.
        tank = stirred_tank.Tank(0.1, 0.1 / 3, 10, 5, 0.75, 0.5, 0.5)
        rate = (tank.mean_dissipation / 1e-6) ** 0.5
        time = numpy.arange(4000) * 0.1 / rate
        square = numpy.mean([(passage.rate(track) ** 2).mean() for track in stirred_tank.tracks(tank, 1e-6, time, 40, 3)])
        self.assertAlmostEqual(square / rate**2, 1, delta=0.045)

    def test_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "t.h5"
            said = said_by(stirred_tank, "--tank", 0.1, "--rpm", 600, "--tracks", 2, "--length", 0.02, "-o", out)
            self.assertIn("2 tracks of", said)
            self.assertIn("misses intermittency", said)
            with h5py.File(out) as file:
                self.assertEqual(file["gradient"].shape, (2, len(file["time"]), 3, 3))
            again = pathlib.Path(folder) / "again.h5"
            said_by(stirred_tank, "--tank", 0.1, "--rpm", 600, "--tracks", 1, "--length", 0.02, "-o", again)
            with h5py.File(out) as one, h5py.File(again) as two:  # a track does not depend on how many there are
                self.assertTrue((one["gradient"][0] == two["gradient"][0]).all())
            self.assertIn("not fully turbulent", said_by(stirred_tank, "--tank", 0.1, "--rpm", 60, "--tracks", 1, "--length", 0.02, "-o", out))
            self.assertIn("--share", refusal(stirred_tank, "--tank", 0.1, "--rpm", 600, "--share", 1, "-o", out))


if __name__ == "__main__":
    unittest.main()
