"""Agglomerates as POV-Ray sees them, side by side at one scale with a bar.

One file: five of its frames, spaced evenly in the radius of the droplet where it has one. Several, or --cut: the last frame of each.
Spheres are coloured by their distance from the centre of mass (bright: farthest); the droplet is drawn as glass.

    picture.py hollow-1.h5 -o drying-hollow.png
    picture.py --cut hollow-1.h5 compact-1.h5 -o granules.png
"""

import os
import pathlib
import subprocess
import tempfile

import h5py
import matplotlib
import numpy

import arguments

FRAMES, WIDTH = 5, 1200  # of one file; pixels
COLOURS = matplotlib.colormaps["cividis"]
# y points away from the camera, z up, as in the other pictures.
SCENE = """#version 3.7;
global_settings {{ assumed_gamma 1.0 }}
background {{ color rgb 1 }}
camera {{ orthographic location <{x}, -1000, {z}> right <{wide}, 0, 0> up <0, 0, {high}> direction <0, 1, 0> sky <0, 0, 1>
  look_at <{x}, 0, {z}> }}
light_source {{ <-400, -900, 700> color rgb 0.85 parallel point_at <0, 0, 0> }}
light_source {{ <500, -700, -200> color rgb 0.3 parallel point_at <0, 0, 0> shadowless }}
#declare matte = finish {{ ambient 0.3 diffuse 0.75 specular 0.15 roughness 0.05 }}
#declare glass = texture {{ pigment {{ color rgbt <0.55, 0.75, 0.9, 0.82> }} finish {{ ambient 0.3 diffuse 0.3 specular 0.4 }} }}
"""


def frames(name, count):
    """[(positions, radii, shade in 0 to 1, droplet or 0)] in units of the mean radius."""
    with h5py.File(name) as file:
        radius = file["particles/all/radius"][:]
        unit = radius.mean()
        total = len(file["particles/all/position/value"])
        droplet = file["observables/droplet_radius/value"][:] if "observables/droplet_radius" in file else numpy.zeros(total)
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
            r = numpy.linalg.norm(x, axis=1)
            out.append((x, radius / unit, r / max(r.max(), 1e-9), droplet[k] / unit))
        return out, unit


def reach(x, radius, droplet):
    return max(numpy.abs(x[:, [0, 2]]).max() + radius.max(), droplet)


def spheres(x, radius, shade, keep, at):
    for p in numpy.flatnonzero(keep):
        r, g, b = COLOURS(0.15 + 0.85 * shade[p])[:3]
        yield (f"sphere {{ <{x[p][0] + at:.4f}, {x[p][1]:.4f}, {x[p][2]:.4f}>, {radius[p]:.4f} "
               f"pigment {{ color srgb <{r:.4f}, {g:.4f}, {b:.4f}> }} finish {{ matte }} }}")


def scene(panels, unit):
    """POV-Ray text of panels (positions, radii, shade, droplet, cut), its width over height."""
    sizes = [reach(x, radius, droplet) for x, radius, _, droplet, _ in panels]
    high, gap = 2 * max(sizes) + 4, 1.5
    lines, at = [], 0.0
    for (x, radius, shade, droplet, cut), size in zip(panels, sizes):
        at += size + gap
        keep = x[:, 1] > -0.5 if cut else numpy.ones(len(x), bool)
        lines += spheres(x, radius, shade, keep, at)
        if droplet > 0:
            lines.append(f"sphere {{ <{at:.4f}, 0, 0>, {droplet:.4f} texture {{ glass }} no_shadow }}")
        at += size + gap
    bar = 10.0 ** numpy.floor(numpy.log10(0.3 * at * unit))
    length, low = bar / unit, -0.5 * high + 1.2
    label = f"{bar:g} nm" if bar < 1000 else f"{bar / 1000:g} um"
    lines.append(f"cylinder {{ <1, -900, {low}>, <{1 + length:.4f}, -900, {low}>, 0.12 pigment {{ color rgb 0 }} }}")
    lines.append(f"text {{ internal 2 \"{label}\" 0.01, 0 scale {high / 18:.4f} rotate 90*x "
                 f"translate <1, -900, {low + 0.4:.4f}> pigment {{ color rgb 0 }} finish {{ ambient 0 diffuse 0 }} }}")
    head = SCENE.format(x=f"{at / 2:.4f}", z=0, wide=f"{at:.4f}", high=f"{high:.4f}")
    return head + "\n".join(lines) + "\n", at / high


def timeless(png):
    """Without the time that POV-Ray puts in: the same scene is the same file."""
    out, at = png[:8], 8
    while at < len(png):
        end = at + 12 + int.from_bytes(png[at:at + 4], "big")
        out += png[at:end] if png[at + 4:at + 8] != b"tIME" else b""
        at = end
    return out


def render(text, aspect, out):
    with tempfile.TemporaryDirectory() as folder:
        source, image = pathlib.Path(folder) / "scene.pov", pathlib.Path(folder) / "scene.png"
        source.write_text(text)
        done = subprocess.run(["povray", "-D", "-GA", f"+W{WIDTH}", f"+H{round(WIDTH / aspect)}", "+A0.2", "+WT1",
                               f"+I{source}", f"+O{image}"], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"povray: {done.stderr.strip().splitlines()[-1]}")
        data = timeless(image.read_bytes())
    temporary = out.with_suffix(".png.tmp")
    temporary.write_bytes(data)
    os.replace(temporary, out)


def command_line():
    parser = arguments.parser(__doc__, "the picture", "FILE.png")
    parser.add_argument("--cut", action="store_true", help="show each with its front half taken away, too")
    arguments.add_files(parser, "of any program", "AGGLOMERATE.h5")
    return parser


def main(options):
    one = len(options.files) == 1
    panels, unit = [], 1.0
    for name in options.files:
        found, unit = frames(name, FRAMES if one and not options.cut else 1)
        for panel in found:
            panels.append((*panel, False))
            if options.cut:
                panels.append((*panel, True))
    render(*scene(panels, unit), options.out)


if __name__ == "__main__":
    main(command_line().parse_args())
