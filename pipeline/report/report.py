"""One page about any result files: their numbers with errors, figures, scenes, how to make them again, and a 3D view to look into them.

The page holds all that it needs and opens from disk. What the files say is taken as it stands; shape, contacts and fragments come from the
program `agglomerate`. Without Debian's libjs-three the page is made without the 3D view.

The folder of a campaign stands for its summary, its figures and three of its granules.

    report.py hollow-1.h5 hollow-1-break.h5 -o report.html
    report.py results/my -o report.html
"""

import html
import json
import pathlib
import re
import statistics
import sys
import tempfile

import h5py
import matplotlib

import arguments
import figures
import headline
import of_campaign
import page
import picture
from interval import half_width
from packed import packed, run

HERE = pathlib.Path(__file__).parent
THREE = pathlib.Path("/usr/share/javascript/three/three.min.js")
LICENCE = pathlib.Path("/usr/share/doc/libjs-three/copyright")
ROOM = 7_500_000  # bytes of all frames; the page stays below ten million
STAGES = {"dryer": "dried droplet", "breaker": "breakup", "rigidstress": "loads in a rigid granule", "agglomerate": "agglomerate"}
# Okabe & Ito (2008); the last one is for all that are smaller.
FRAGMENTS = [[0, 114, 178], [230, 159, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [213, 94, 0], [170, 170, 170]]


def colours(name, count=64):
    return [[round(255 * c) for c in matplotlib.colormaps[name](k / (count - 1))[:3]] for k in range(count)]


def licence():
    """Who holds the rights in three.js, and its licence, as Debian states them."""
    stanzas = LICENCE.read_text(encoding="utf-8").split("\n\n")
    holders = next(s for s in stanzas if re.match(r"Files: *\*", s))
    return re.search(r"Copyright:.*?(?=\nLicense:)", holders, re.S)[0] + "\n" + next(s for s in stanzas if s.startswith("License: Expat\n"))


def library():
    """three.js as a script with its licence, or None."""
    if not (THREE.is_file() and LICENCE.is_file()):
        return None
    release = re.search(r'REVISION ?= ?"?(\w+)', THREE.read_text(encoding="utf-8"))[1]
    text = THREE.read_text(encoding="utf-8").replace("</script", "<\\/script")
    return f"<script>/* three.js, release {release}\n{licence()}\n*/\n{text}</script>"


def view(files, tool):
    """The parts of the page that make the 3D view. files: {path: its name on the page}."""
    three = library()
    if three is None:
        print("without a 3D view: Debian's package libjs-three is not there", file=sys.stderr)
    heads, parts = [], [(HERE / "view.html").read_text(encoding="utf-8")]
    for k, (path, name) in enumerate(files.items() if three else []):
        head, block = packed(path, tool, ROOM / len(files))
        heads.append(head | {"block": f"frames-{k}", "name": name})
        parts.append(f'<script type="text/plain" id="frames-{k}">{block}</script>')
    data = {"files": heads, "sequential": colours("cividis"), "diverging": colours("RdBu_r"), "fragments": FRAGMENTS,
            "without": "This page was made without the 3D view: Debian's package libjs-three was not there. Numbers and figures follow."}
    text = json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")  # no name of a file ends the script
    parts.append(f'<script type="application/json" id="view-data">{text}</script>')
    options = "".join(f'<option value="{k}">{html.escape(head["name"])}</option>' for k, head in enumerate(heads))
    parts[0] = parts[0].replace('<select id="file"></select>', f'<select id="file">{options}</select>')
    return parts + [three or ""] + [f'<script>{(HERE / name).read_text(encoding="utf-8")}</script>' for name in ("shaders.js", "view.js")]


def table(head, rows, kind="result"):
    """Rows of text; the last column says where a number comes from."""
    cells = lambda row: "".join(f"<td>{html.escape(str(cell))}</td>" for cell in row[:-1]) + f'<td class="how">{html.escape(str(row[-1]))}</td>'
    body = "".join(f"<tr>{cells(row)}</tr>" for row in rows)
    return f'<div class="table"><table class="{kind}"><tr>{"".join(f"<th scope=col>{html.escape(h)}</th>" for h in head)}</tr>{body}</table></div>'


def numbers(results):
    return table(["", "value ± numerical error", "where the error is from"], [[r.title, r.text(), r.how] for r in results])


def again(info, scene):
    """How to make the file again, in words and commands."""
    p = info["provenance"]
    steps = []
    if p.get("parent"):
        steps.append(f"It continues <code>{html.escape(p['parent'])}</code> (SHA-256 <code>{html.escape(p.get('parent_sha256', ''))[:16]}…</code>).")
    changed = ", with changes that were not committed" if p["dirty"] else ""
    steps.append(f"Programs of commit <code>{html.escape(p['git'])}</code>{changed}: <code>git checkout {html.escape(p['git'][:12])} && make -C pipeline build</code>.")
    saved = "With the scene below under the name that the command has, in" if scene else "In"
    steps.append(f"{saved} the folder where the command ran:<pre>{html.escape(p['command'])}</pre>")
    return "<ol>" + "".join(f"<li>{step}</li>" for step in steps) + "</ol>"


def details(title, body):
    return f"<details><summary>{title}</summary>{body}</details>"


def section(path, name, info, results, folder):
    with h5py.File(path) as file:
        scene = {name: file[f"parameters/{name}"].asstr()[()] for name in ("input", "resolved") if f"parameters/{name}" in file}
    size = info["radius_nm"]
    spheres = headline.with_error(size["mean"], None, "nm") if size["smallest"] == size["largest"] else \
        f"{headline.with_error(size['smallest'], None, 'nm')} to {headline.with_error(size['largest'], None, 'nm')}"
    parts = [f'<h2>{html.escape(name)}: {STAGES[info["stage"]]}</h2>',
             f'<p>{info["particles"]} particles of radius {spheres}; {info["frames"]} frames, the last in state “{info["state"]}”, written by '
             f'{info["provenance"]["program"]} {info["provenance"]["version"]} on {info["provenance"]["created"][:10]}.</p>', numbers(results)]
    for name, caption in figures.drawn(path, folder / path.stem):
        parts.append(page.figure(name, caption))
    if info["stage"] != "breaker":  # its snapshots are a figure above
        picture.main(picture.command_line().parse_args([*(["--cut"] if info["frames"] == 1 else []), str(path), "-o", str(folder / f"{path.stem}.png")]))
        what = "Whole, and with the front half taken away" if info["frames"] == 1 else "Frames from first to last, the droplet as glass"
        parts.append(page.figure(folder / f"{path.stem}.png", f"{what}; bright: far from the middle. Radius of the particles {spheres}."))
    rows = [[key, value, ""] for key, value in info["provenance"].items()] + [[key, f"{value:g}", ""] for key, value in info["made_of"].items()]
    parts.append("<h3>How to make it again</h3>" + again(info, scene))
    parts += [details(title, f"<pre>{html.escape(scene[name])}</pre>") for name, title in
              (("input", "The scene as given"), ("resolved", "Every parameter as the run had it")) if name in scene]
    parts.append(details("Provenance and material", table(["", "", ""], rows, "provenance")))
    return parts


def comparison(files, folder):
    """Files of one kind in one table, a row a number; of three and more the mean with its interval in words, of two both values."""
    keys = [r.key for r in files[0][1] if all(any(o.key == r.key for o in results) for _, results in files)]
    rows = []
    for key in keys:
        found = [next(r for r in results if r.key == key) for _, results in files]
        values = [r.value for r in found]
        unit = found[0].unit
        summary = ""
        if len(values) > 2:
            mean, half = statistics.fmean(values), half_width(values)
            scale, unit = headline.in_unit(mean, unit)
            factor = scale / mean if mean else 1
            summary = f"{headline.number(float(scale))} ({headline.number(factor * (mean - half))} to {headline.number(factor * (mean + half))}) {unit}"
        rows.append([found[0].title, *(r.text() for r in found), summary])
    figures.compared(files, folder / "compared.svg")
    head = ["", *(name for name, _ in files), "mean (95 % interval over files)" if len(files) > 2 else ""]
    return [table(head, rows, "compared"), page.figure(folder / "compared.svg", "One point a file; bars: numerical error; crosses: none is stated.")]


def files_of(given):
    """{path: its name on the page} of files and of the folders of campaigns."""
    found = {}
    for path in given:
        found |= of_campaign.shown(path) if path.is_dir() else {path: path.name}
    return found


def made(given, tool, out):
    names = " ".join(str(path) for path in given)
    files = files_of(given)
    infos = [json.loads(run(tool, "info", path, "--json")) for path in files]  # refuses what is no result
    results = {path: headline.results(path, tool) for path in files}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        parts = [f"<h1>{html.escape(', '.join(path.resolve().stem for path in given[:4]) + (' …' if len(given) > 4 else ''))}</h1>",
                 "<p>Computed by Crumble, particle by particle. ± is on this page the numerical error that the file states for a number; how "
                 "granules scatter from seed to seed is another matter and stands in words. µγ̇: stress of the flow, viscosity times shear rate.</p>"]
        if len(files) == 1:
            parts.append(numbers(*results.values()))
        for path in given:
            parts += of_campaign.parts(path) if path.is_dir() else []
        parts += view(files, tool)
        # Granules that were chosen by their strength have no mean.
        kinds = {}
        for path in given:
            if not path.is_dir():
                kinds.setdefault(tuple(r.key for r in results[path]), []).append((path.stem, results[path]))
        for same in kinds.values():
            if len(same) > 1:
                parts += ["<h2>Side by side</h2>", *comparison(same, folder)]
        for (path, title), info in zip(files.items(), infos):
            parts += section(path, title, info, results[path], folder)
        parts.append(f"<h2>This page</h2><pre>make -C pipeline report FILES=\"{html.escape(names)}\"</pre>")
        page.write(out, "Crumble: " + ", ".join(path.resolve().stem for path in given), parts, (HERE / "view.css").read_text(encoding="utf-8"))


def command_line():
    parser = arguments.parser(__doc__, "the page", "FILE.html")
    parser.add_argument("files", type=arguments.file_or(of_campaign.is_one, "a campaign"), nargs="+", metavar="RESULT.h5", help="of any program, or the folder of a campaign")
    parser.add_argument("--tool", default="../build/release/bin/agglomerate", metavar="PROGRAM", help="the program agglomerate (%(default)s)")
    return parser


def main(options):
    made(options.files, options.tool, options.out)


if __name__ == "__main__":
    main(command_line().parse_args())
