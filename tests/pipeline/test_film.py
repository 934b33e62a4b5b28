"""Pictures and films of pipeline/report: what they show is what the files hold."""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "pipeline/report"))
import film
import picture

DRYING, BREAKUP, LOADS = (ROOT / f"data/samples/{name}-1.2.h5" for name in ("dryer", "breaker", "rigidstress"))


class Films(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_every_frame_has_its_spheres_its_time_and_its_stress(self):
        for path, unit in ((DRYING, "µs"), (BREAKUP, "Pa")):
            with h5py.File(path) as file:
                frames, particles = file["particles/all/position/value"].shape[:2]
            scenes = film.drawings(path)
            self.assertEqual(len(scenes), frames)
            for text, _ in scenes:
                self.assertEqual(len(re.findall(r"sphere .*finish \{ matte \}", text)), particles)
                self.assertIn(f' {unit}"', text)

    def test_all_frames_of_a_film_are_of_one_size(self):
        self.assertEqual(len({aspect for _, aspect in film.drawings(BREAKUP)}), 1)

    def test_one_frame_is_no_film(self):
        with self.assertRaisesRegex(SystemExit, "one frame is no film"):
            film.drawings(LOADS)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is for films alone: pipeline/packages.sh film")
    def test_the_films_have_as_many_frames_as_the_file(self):
        film.main(film.command_line().parse_args([str(DRYING), "-o", str(self.folder / "a film"), "--jobs", "2"]))
        with h5py.File(DRYING) as file:
            frames = len(file["particles/all/position/time"])
        found = json.loads(subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", self.folder / "a film.mp4"],
                                          capture_output=True, text=True, check=True).stdout)["streams"][0]
        self.assertEqual((found["codec_name"], int(found["nb_read_frames"]), found["width"]), ("h264", frames, film.WIDTH))
        loop = (self.folder / "a film.webp").read_bytes()
        self.assertEqual((loop[:4], loop[8:12], loop.count(b"ANMF")), (b"RIFF", b"WEBP", frames))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["a film.mp4", "a film.webp"])


class Pictures(unittest.TestCase):
    def test_a_picture_says_radius_times_and_what_its_colours_mean(self):
        panels, unit = picture.frames(DRYING, 3)
        text, _ = picture.scene([(*panel, False) for panel in panels], unit, picture.said_of([unit]))
        self.assertIn("particles of radius 10 nm; bright: far from the middle", text)
        with h5py.File(DRYING) as file:
            last = file["particles/all/position/time"][-1]
        self.assertIn(f'"{1e6 * last:.3g} µs"', text)

    def test_the_time_of_drawing_is_taken_out_of_a_picture(self):
        chunk = lambda kind, data: len(data).to_bytes(4, "big") + kind + data + bytes(4)
        head, rest = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", bytes(13)), chunk(b"IDAT", b"tIME") + chunk(b"IEND", b"")
        self.assertEqual(picture.timeless(head + chunk(b"tIME", bytes(7)) + chunk(b"tEXt", b"Comment\0Render Date: now") + rest), head + rest)


if __name__ == "__main__":
    unittest.main()
