"""A drying or a breakup as a film: STEM.mp4, and STEM.webp, a small loop for a page.

POV-Ray draws every frame of the file (beyond 150 only so many, evenly), seen along y at one scale with a bar, its time and, of a breakup, the
stress of the flow; ffmpeg joins them. A drying is coloured by distance from the middle (bright: farthest), a breakup by fragment.

    film.py results/hollow-1.h5 -o results/hollow-1
"""

import concurrent.futures
import pathlib
import subprocess
import tempfile

import h5py
import numpy

import arguments
import picture
import whole
from report import FRAGMENTS

MOST, SECONDS, WIDTH, LOOP_WIDTH = 150, 6, 720, 320  # frames, of the film, pixels


def drawings(path):
    """[(POV-Ray text, width over height)], one a frame."""
    with h5py.File(path) as file:
        total = len(file["particles/all/position/time"])
        if total < 2:
            raise SystemExit(f"{path}: one frame is no film; pipeline/report/picture.py draws it")
        kept = sorted({int(k) for k in numpy.linspace(0, total - 1, min(total, MOST)).round()})
        radius = file["particles/all/radius"][:]
        unit = radius.mean()
        place = file["particles/all/position/value"]
        droplet = file["observables/droplet_radius/value"][:] / unit if "observables/droplet_radius" in file else numpy.zeros(total)
        label = file["particles/all/fragment/value"] if "particles/all/fragment" in file else None
        stress = file["observables/flow_stress/value"][:] if "observables/flow_stress" in file else None
        time, name = picture.in_time(file["particles/all/position/time"][:])
        shown = []
        for k in kept:
            x = place[k] / unit
            if droplet[k] <= 0:  # the middle of the largest piece stays where it is; a droplet is in the middle of its file
                x = x - x[label[k] == 0 if label is not None else slice(None)].mean(axis=0)
            colours = picture.by_distance(x) if label is None else numpy.array(FRAGMENTS)[numpy.minimum(label[k], len(FRAGMENTS) - 1)] / 255
            title = f"{time[k]:.3g} {name}" + ("" if stress is None else f"   {stress[k]:.4g} Pa")
            shown.append((x, radius / unit, colours, droplet[k], title, False))
        # A droplet is shown as it begins. A breakup at the scale of what has not come apart yet, with room for what then does.
        whole = [panel for k, panel in zip(kept, shown) if label is None or label[k].max() == label[kept[0]].max()]
        size = max(picture.reach(panel[0], panel[1], panel[3]) for panel in whole) * (1 if label is None else 1.5)
        caption = picture.said_of([unit]) if label is None else f"particles of radius {picture.length(unit)}; blue: the largest piece"
        return [picture.scene([panel], unit, caption, size) for panel in shown]


def join(pattern, count, out, *how):
    rate = f"{max(4, min(25, count / SECONDS)):.3f}"
    with whole.replacing(out) as temporary:
        done = subprocess.run(["ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-framerate", rate, "-i", str(pattern), *how, "-bitexact",
                               "-f", out.suffix[1:], str(temporary)], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"ffmpeg: {done.stderr.strip()}")


def command_line():
    parser = arguments.parser(__doc__, "films STEM.mp4 and STEM.webp", "STEM")
    parser.add_argument("file", type=arguments.file, metavar="RESULT.h5", help="of dryer or breaker")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="pictures drawn side by side")
    return parser


def main(options):
    scenes = drawings(options.file)
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        folder = pathlib.Path(name)
        list(pool.map(lambda k: picture.render(*scenes[k], folder / f"{k:04}.png", WIDTH), range(len(scenes))))
        stem, count = options.out, len(scenes)
        join(folder / "%04d.png", count, stem.with_name(stem.name + ".mp4"), "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-movflags", "+faststart")
        join(folder / "%04d.png", count, stem.with_name(stem.name + ".webp"), "-vf", f"scale={LOOP_WIDTH}:-2", "-c:v", "libwebp", "-quality", "60", "-loop", "0")
    for ending in ("mp4", "webp"):
        print(f"{options.out}.{ending}")


if __name__ == "__main__":
    main(command_line().parse_args())
