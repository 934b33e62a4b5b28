"""Agglomerates as POV-Ray sees them, side by side at one scale with a bar.

One file: five of its frames, spaced evenly in the radius of the droplet where it has one, each with its time. Several, or --cut: the last
frame of each. Spheres are coloured by their distance from the centre of mass (bright: farthest); the droplet is drawn as glass.

    picture.py hollow-1.h5 -o drying-hollow.png
    picture.py --cut hollow-1.h5 compact-1.h5 -o granules.png
"""

import pathlib
import subprocess
import tempfile

import h5py
import matplotlib.font_manager
import numpy

import arguments
import whole

FRAMES, WIDTH = 5, 1200  # of one file; pixels
COLOURS = matplotlib.colormaps["cividis"]
FONT = matplotlib.font_manager.findfont("DejaVu Sans")  # matplotlib brings it
# y points away from the camera, z up, as in the other pictures.
SCENE = """#version 3.7;
global_settings {{ assumed_gamma 1.0 charset utf8 }}
background {{ color rgb 1 }}
camera {{ orthographic location <{x}, -1000, {z}> right <{wide}, 0, 0> up <0, 0, {high}> direction <0, 1, 0> sky <0, 0, 1>
  look_at <{x}, 0, {z}> }}
light_source {{ <-400, -900, 700> color rgb 0.85 parallel point_at <0, 0, 0> }}
light_source {{ <500, -700, -200> color rgb 0.3 parallel point_at <0, 0, 0> shadowless }}
#declare matte = finish {{ ambient 0.3 diffuse 0.75 specular 0.15 roughness 0.05 }}
#declare glass = texture {{ pigment {{ color rgbt <0.55, 0.75, 0.9, 0.82> }} finish {{ ambient 0.3 diffuse 0.3 specular 0.4 }} }}
"""


def in_time(seconds):
    """Times in the unit that suits the last one, and that unit."""
    for factor, unit in ((1, "s"), (1e3, "ms"), (1e6, "µs"), (1e9, "ns")):
        if seconds[-1] * factor >= 1 or unit == "ns":
            return seconds * factor, unit


def length(nm):
    return f"{nm:.4g} nm" if nm < 1000 else f"{nm / 1000:.4g} µm"


def by_distance(x):
    """Bright: farthest from the middle."""
    r = numpy.linalg.norm(x, axis=1)
    return COLOURS(0.15 + 0.85 * r / max(r.max(), 1e-9))[:, :3]


def frames(name, count):
    """[(positions, radii, colours, droplet or 0, title)] in units of the mean radius."""
    with h5py.File(name) as file:
        radius = file["particles/all/radius"][:]
        unit = radius.mean()
        total = len(file["particles/all/position/value"])
        droplet = file["observables/droplet_radius/value"][:] if "observables/droplet_radius" in file else numpy.zeros(total)
        time, name_of_time = in_time(file["particles/all/position/time"][:])
        if count == 1:
            chosen = [total - 1]
        else:
            wanted = numpy.linspace(droplet[0], 0, count) if droplet[0] > 0 else numpy.linspace(0, total - 1, count)
            along = droplet if droplet[0] > 0 else numpy.arange(total)
            chosen = [int(numpy.abs(along - value).argmin()) for value in wanted]
        out = []
        for k in chosen:
            x = file["particles/all/position/value"][k] / unit
            if droplet[k] <= 0:
                x = x - x.mean(axis=0)
            out.append((x, radius / unit, by_distance(x), droplet[k] / unit, f"{time[k]:.3g} {name_of_time}" if count > 1 else ""))
        return out, unit


def reach(x, radius, droplet):
    return max(numpy.abs(x[:, [0, 2]]).max() + radius.max(), droplet)


def spheres(x, radius, colour, keep, at):
    for p in numpy.flatnonzero(keep):
        r, g, b = colour[p]
        yield (f"sphere {{ <{x[p][0] + at:.4f}, {x[p][1]:.4f}, {x[p][2]:.4f}>, {radius[p]:.4f} "
               f"pigment {{ color srgb <{r:.4f}, {g:.4f}, {b:.4f}> }} finish {{ matte }} }}")


def text_at(words, x, z, size):
    return (f"text {{ ttf \"{FONT}\" \"{words}\" 0.01, 0 scale {size:.4f} rotate 90*x translate <{x:.4f}, -900, {z:.4f}> "
            "pigment { color rgb 0 } finish { ambient 0 diffuse 0 } }")


def scene(panels, unit, caption, size=None):
    """POV-Ray text of panels (positions, radii, colours, droplet, title, cut), its width over height. The caption stands beside the bar;
    size: half of what a panel shows, without it what there is."""
    sizes = [size or reach(x, radius, droplet) for x, radius, _, droplet, _, _ in panels]
    high, gap = 2 * max(sizes) + 7, 1.5  # the rest: two lines of text
    text = high / 20
    lines, at = [], 0.0
    for (x, radius, colour, droplet, title, cut), size in zip(panels, sizes):
        at += size + gap
        if title:
            lines.append(text_at(title, at - size, 0.5 * high - 0.9 * text, text))
        keep = x[:, 1] > -0.5 if cut else numpy.ones(len(x), bool)
        lines += spheres(x, radius, colour, keep, at)
        if droplet > 0:
            lines.append(f"sphere {{ <{at:.4f}, 0, 0>, {droplet:.4f} texture {{ glass }} no_shadow }}")
        at += size + gap
    bar = 10.0 ** numpy.floor(numpy.log10(0.3 * at * unit))
    length_of_bar, low = bar / unit, -0.5 * high + 1.2
    lines.append(f"cylinder {{ <1, -900, {low}>, <{1 + length_of_bar:.4f}, -900, {low}>, 0.12 pigment {{ color rgb 0 }} }}")
    words = f"{length(bar)}   {caption}"
    lines.append(text_at(words, 1, low + 0.4, min(text, (at - 2) / (0.55 * len(words)))))  # a letter is half as wide as high
    head = SCENE.format(x=f"{at / 2:.4f}", z=0, wide=f"{at:.4f}", high=f"{high:.4f}")
    return head + "\n".join(lines) + "\n", at / high


def timeless(png):
    """Without the time and the text with date and platform that POV-Ray puts in: the same scene is the same file."""
    out, at = png[:8], 8
    while at < len(png):
        end = at + 12 + int.from_bytes(png[at:at + 4], "big")
        out += png[at:end] if png[at + 4:at + 8] not in (b"tIME", b"tEXt") else b""
        at = end
    return out


def render(text, aspect, out, width=WIDTH):
    with tempfile.TemporaryDirectory() as folder:
        source, image = pathlib.Path(folder) / "scene.pov", pathlib.Path(folder) / "scene.png"
        source.write_text(text, encoding="utf-8")
        done = subprocess.run(["povray", "-D", "-GA", f"+W{width}", f"+H{2 * round(width / aspect / 2)}", "+A0.2", "+WT1",
                               f"+I{source}", f"+O{image}"], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"povray: {done.stderr.strip().splitlines()[-1]}")
        data = timeless(image.read_bytes())
    with whole.replacing(out) as temporary:
        temporary.write_bytes(data)


def said_of(radii):
    """What is drawn, for who has no legend: mean radii and the meaning of the colours."""
    known = sorted({length(a) for a in radii})
    return f"particles of radius {', '.join(known)}; bright: far from the middle"


def command_line():
    parser = arguments.parser(__doc__, "the picture", "FILE.png")
    parser.add_argument("--cut", action="store_true", help="show each with its front half taken away, too")
    arguments.add_files(parser, "of any program", "AGGLOMERATE.h5")
    return parser


def main(options):
    one = len(options.files) == 1
    panels, units = [], []
    for name in options.files:
        found, unit = frames(name, FRAMES if one and not options.cut else 1)
        units.append(unit)
        for panel in found:
            panels.append((*panel, False))
            if options.cut:
                panels.append((*panel, True))
    render(*scene(panels, units[-1], said_of(units)), options.out)


if __name__ == "__main__":
    main(command_line().parse_args())
