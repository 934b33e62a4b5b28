"""The page of pipeline/report/report.py without a browser: what it says and carries is what the files say. A browser opens it in
pipeline/verify/report_view.py."""

import base64
import contextlib
import gzip
import html
import io
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = str(pathlib.Path(os.environ.get("CRUMBLE_BUILD", ROOT / "build/release")) / "bin/agglomerate")
sys.path.insert(0, str(ROOT / "pipeline/report"))
import headline
import of_campaign
import packed
import report

SAMPLES = [ROOT / f"data/samples/{name}-1.2.h5" for name in ("dryer", "breaker", "rigidstress", "import")]


def unpacked(head, block):
    """The frames as the script of the page sees them."""
    data = gzip.decompress(base64.b64decode(block))
    array = lambda entry: numpy.frombuffer(data, "<" + entry[0], entry[2], entry[1])
    return [{key: array(value) if isinstance(value, list) else value for key, value in frame.items()} for frame in head["frames"]], array(head["radius"])


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        report.made(SAMPLES, TOOL, cls.folder / "all.html")
        cls.text = (cls.folder / "all.html").read_text(encoding="utf-8")

    def part(self, kind, name):
        return re.search(rf'<script type="{kind}" id="{name}">(.*?)</script>', self.text, re.S)[1]

    def test_it_asks_for_nothing_but_itself_and_is_small(self):
        without_programs = re.sub(r"<script.*?</script>|<style.*?</style>", "", self.text, flags=re.S)
        self.assertEqual([link for link in re.findall(r'(?:src|href)="([^"]*)"', without_programs) if not re.match(r"data:|#", link)], [])
        self.assertNotRegex(self.text, r"@import|<link")
        self.assertLess(len(self.text.encode()), 10_000_000)

    def test_every_file_has_its_numbers_its_scene_and_the_command_that_made_it(self):
        for path in SAMPLES:
            with h5py.File(path) as file:
                command = file["parameters/provenance"].attrs["command"]
                self.assertIn(f"<pre>{html.escape(command)}</pre>", self.text)
                self.assertIn(file["parameters/provenance"].attrs["git"], self.text)
                if "parameters/input" in file:
                    self.assertIn(html.escape(file["parameters/input"].asstr()[()]), self.text)
            for result in headline.results(path, TOOL):
                self.assertIn(f"<td>{html.escape(result.title)}</td><td>{html.escape(result.text())}</td>", self.text)

    def test_numbers_and_errors_are_those_of_the_file(self):
        with h5py.File(SAMPLES[1]) as file:
            value, error = file["breakup/critical_stress"][()], file["errors/critical_stress"][()]
        first = headline.results(SAMPLES[1], TOOL)[0]
        self.assertEqual((first.key, first.value, first.relative), ("critical_stress_pa", value, error))
        self.assertIn("±", first.text())
        with h5py.File(SAMPLES[2]) as file:
            stress = {name: group["critical_stress"][()] for name, group in file["flows"].items()}
            error = file["response/error"][()]
        loads = {r.key: r for r in headline.results(SAMPLES[2], TOOL)}
        self.assertGreater(len(stress), 1)
        for name, value in stress.items():
            self.assertEqual((loads[f"{name}.critical_stress_pa"].value, loads[f"{name}.critical_stress_pa"].relative), (value, error))

    @unittest.skipUnless(report.THREE.is_file(), "there is no libjs-three")
    def test_the_view_carries_the_frames_of_the_files(self):
        heads = json.loads(self.part("application/json", "view-data"))["files"]
        self.assertEqual([head["name"] for head in heads], [path.name for path in SAMPLES])
        for head, path in zip(heads, SAMPLES):
            frames, radius = unpacked(head, self.part("text/plain", head["block"]))
            with h5py.File(path) as file:
                self.assertEqual(len(frames), len(file["particles/all/position/time"]))
                numpy.testing.assert_allclose(radius, file["particles/all/radius"][:], rtol=1e-6)
                offset = file["contacts/offset"][:]
                for k, frame in enumerate(frames):
                    rows = slice(offset[k], offset[k + 1])
                    self.assertEqual(frame["time"], file["particles/all/position/time"][k])
                    numpy.testing.assert_allclose(frame["position"].reshape(-1, 3), file["particles/all/position/value"][k], rtol=1e-6)
                    numpy.testing.assert_array_equal(frame["pair"].reshape(-1, 2), file["contacts/pair"][rows])
                    numpy.testing.assert_allclose(frame["tension"], file["contacts/normal_force"][rows], rtol=1e-6)
                    numpy.testing.assert_array_equal(frame["limit"], file["contacts/flags"][rows])
                    self.assertAlmostEqual(frame["coordination"].mean(), file["observables/coordination_number/value"][k])
                    if "particles/all/fragment" in file:
                        self.assertEqual(numpy.unique(frame["fragment"]).size, file["observables/fragment_count/value"][k])
                    for name in head["loads"]:
                        numpy.testing.assert_allclose(frame["load " + name], file[f"flows/{name}/normal_force"][:], rtol=1e-6)
        self.assertEqual(set(heads[2]["loads"]), {"elongation", "elongation-worst", "shear"})

    @unittest.skipUnless(report.THREE.is_file(), "there is no libjs-three")
    def test_the_library_comes_with_its_licence(self):
        self.assertRegex(self.text, r"/\* three\.js, release \d+\nCopyright: .*three\.js authors")
        self.assertIn("Permission is hereby granted, free of charge", self.text)

    def test_the_same_files_make_the_same_page(self):
        report.made(SAMPLES, TOOL, self.folder / "again.html")
        self.assertEqual((self.folder / "again.html").read_text(encoding="utf-8"), self.text)

    def test_without_the_library_the_page_says_so_and_has_the_rest(self):
        was, report.THREE = report.THREE, pathlib.Path("/absent.js")
        try:
            report.made(SAMPLES[:1], TOOL, self.folder / "without.html")
        finally:
            report.THREE = was
        text = (self.folder / "without.html").read_text(encoding="utf-8")
        self.assertIn("libjs-three was not there", text)
        self.assertIn("outer diameter d_c", text)
        self.assertNotIn('id="frames-0"', text)

    def test_files_of_one_kind_stand_side_by_side_with_mean_and_interval_from_three_on(self):
        names = []
        for k in range(3):
            names.append(self.folder / f"granule-{k}.h5")
            shutil.copy(SAMPLES[0], names[-1])
        for count, there in ((2, False), (3, True)):
            report.made(names[:count], TOOL, self.folder / "side.html")
            text = (self.folder / "side.html").read_text(encoding="utf-8")
            self.assertIn("Side by side", text)
            self.assertEqual("95 % interval over files" in text, there)

    def test_the_folder_of_a_campaign_stands_for_its_summary_and_its_weakest_middle_and_strongest_granule(self):
        folder = self.folder / "my"
        rows = ["id,seed,d_c [nm],critical_stress_worst [Pa],stress_id,dry_sha256"]
        for k, stress in enumerate((300, 100, 500, "", 200, 400)):
            for stage, sample in (("dry", SAMPLES[0]), ("stress", SAMPLES[2])):
                (folder / stage).mkdir(parents=True, exist_ok=True)
                shutil.copy(sample, folder / stage / f"{stage[0]}{k}.h5")
            rows.append(f"d{k},{k},100.123456,{stress},s{k},0")
        (folder / "granules.csv").write_text("# my.toml\n" + "\n".join(rows) + "\n")
        (folder / "summary.md").write_text("# my\n\n6 granules at 1 point of my.toml; by the programs of commit abc.\n\n| peclet | quantity | granules | mean | spread | 10 % | 50 % | sampling error | numerical error |\n"
                                           "|---|---|---|---|---|---|---|---|---|\n| 3 | d_c | 6 | 77.7 (70 to 80) | 4 | 71 | 78 | 2 % | 0.1 % |\n\nwords below\n")
        (folder / "campaign.toml").write_text("seeds = 6 # as given\n")
        (folder / "critical_stress_worst.svg").write_text("<svg><g id='drawn'/></svg>")
        self.assertEqual({str(path.relative_to(folder)): name for path, name in of_campaign.shown(folder).items()},
                         {"dry/d1.h5": "weakest granule, dried", "stress/s1.h5": "weakest granule, loaded", "dry/d0.h5": "middle granule, dried",
                          "stress/s0.h5": "middle granule, loaded", "dry/d2.h5": "strongest granule, dried", "stress/s2.h5": "strongest granule, loaded"})
        report.made([folder], TOOL, self.folder / "campaign.html")
        text = (self.folder / "campaign.html").read_text(encoding="utf-8")
        self.assertIn("<td>3</td><td>d_c</td><td>6</td><td>77.7 (70 to 80)</td><td>4</td><td>78</td><td>2 %</td><td>0.1 %</td>", text)
        for there in ("<td>77.7 (70 to 80)</td><td>4</td><td>71</td>", "words below", "id='drawn'", "commit abc", "CAMPAIGN=my.toml", "seeds = 6 # as given", "<td>100.1</td>",
                      "<h2>weakest granule, dried: dried droplet</h2>"):
            self.assertIn(there, text)
        self.assertNotIn("Side by side", text)  # chosen granules have no mean
        with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as said:
            report.command_line().parse_args([str(folder / "dry"), "-o", "a.html"])
        self.assertIn("not a folder of a campaign", said.getvalue())

    def test_a_file_that_is_no_result_is_refused_by_name(self):
        (self.folder / "no.h5").write_text("no")
        with self.assertRaisesRegex(SystemExit, r"no\.h5"), contextlib.redirect_stderr(io.StringIO()):
            report.made([self.folder / "no.h5"], TOOL, self.folder / "no.html")
        self.assertFalse((self.folder / "no.html").exists())


class Pieces(unittest.TestCase):
    def test_an_error_decides_how_many_digits_a_value_has(self):
        self.assertEqual(headline.with_error(156.5696, 0.01 / 156.5696, "nm"), "156.570 ± 0.010 nm")
        self.assertEqual(headline.with_error(4119.6, 0.02, "Pa"), "4120 ± 82 Pa")
        self.assertEqual(headline.with_error(38795.6, 161.3 / 38795.6, "Pa"), "38.80 ± 0.16 kPa")
        self.assertEqual(headline.with_error(7846.0, None, "nm"), "7.846 µm")
        self.assertEqual(headline.with_error(170, 0.0), "170 ± 0")
        self.assertEqual(headline.with_error(170, None), "170")

    def test_frames_are_left_out_evenly_where_they_do_not_fit(self):
        self.assertEqual(packed.chosen(5, 100, 200, 1e9), [0, 1, 2, 3, 4])
        self.assertEqual(packed.chosen(101, 1000, 3000, 5 * (1000 * packed.PARTICLE_BYTES + 3000 * packed.CONTACT_BYTES)), [0, 25, 50, 75, 100])
        self.assertEqual(packed.chosen(50, 10**6, 3 * 10**6, 1e6), [49])
        self.assertEqual(packed.chosen(1, 10, 10, 1e9), [0])


if __name__ == "__main__":
    unittest.main()
