"""The pages of `make -C pipeline report` in headless Chromium: they load without a complaint, draw, answer to controls and keys, fit a phone, print.

Pages of a drying, a breakup, a campaign, of four kinds of files together, of ten thousand spheres, both pages of `make -C pipeline paper` (from tiny
granules), and one without WebGL. Ends with 1 if a claim does not hold; prints how long a draw of ten thousand takes with software rendering.

    report_view.py -o results/verify
"""

import json
import pathlib
import subprocess
import sys
import time

PIPELINE = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PIPELINE / "report"))
import arguments
import numpy
import report
from browser import Browser, there
from table import write_csv

ROOT = PIPELINE.parent
SAMPLES = ROOT / "data/samples"
PICTURE = "(() => { const c = document.getElementById('canvas'); return c.toDataURL(); })()"
# Share of the pixels that are not white, and how many colours there are.
INK = """(() => { const c = document.getElementById('canvas'), d = document.createElement('canvas'); d.width = c.width; d.height = c.height;
const x = d.getContext('2d'); x.drawImage(c, 0, 0); const p = x.getImageData(0, 0, c.width, c.height).data; let ink = 0; const seen = new Set();
for (let k = 0; k < p.length; k += 4) if (p[k] + p[k + 1] + p[k + 2] < 750) { ++ink; seen.add(p[k] << 16 | p[k + 1] << 8 | p[k + 2]); }
return [4 * ink / p.length, seen.size]; })()"""


class Claims:
    def __init__(self):
        self.rows, self.held = [], True

    def __call__(self, page, claim, holds, found=""):
        self.held &= bool(holds)
        self.rows.append([page, claim, "holds" if holds else "FAILS", found])
        print(f"{'holds' if holds else 'FAILS':6} {page:12} {claim} {found}", flush=True)


def settled(browser):
    """After the last draw, at full fineness."""
    browser.js("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    browser.until("crumbleView.resting")


def picture(browser):
    settled(browser)
    return browser.js(PICTURE)


def set_value(browser, name, value, event):
    what = "checked" if isinstance(value, bool) else "value"
    browser.js(f"(() => {{ const e = document.getElementById('{name}'); e.{what} = {json.dumps(value)}; e.dispatchEvent(new Event('{event}')); }})()")


def changed(browser, claim, page, what, act):
    before = picture(browser)
    act()
    claim(page, f"{what} changes the picture", picture(browser) != before)


def controls(browser, claim, page):
    for name, value, event in (("cut", 50, "input"), ("cut-along", "x", "change"), ("size", 30, "input"), ("bonds", True, "change")):
        changed(browser, claim, page, f"{name} = {value}", lambda: set_value(browser, name, value, event))
    colours(browser, claim, page)
    if browser.js("crumbleView.state.file.frames.length") > 1:
        other = 0 if browser.js("crumbleView.state.frame") else 1
        changed(browser, claim, page, f"frame = {other}", lambda: set_value(browser, "frame", other, "input"))
    changed(browser, claim, page, "Zoom in", lambda: browser.js("document.getElementById('closer').click()"))
    browser.js("document.getElementById('canvas').scrollIntoView()")
    x, y = browser.js("(r => [r.left + r.width / 2, r.top + r.height / 2])(document.getElementById('canvas').getBoundingClientRect())")
    changed(browser, claim, page, "a drag", lambda: browser.mouse(("Pressed", x, y), ("Moved", x + 40, y + 25), ("Released", x + 40, y + 25)))
    changed(browser, claim, page, "the wheel", lambda: browser.wheel(x, y, 120))


def colours(browser, claim, page):
    """Each has a picture and a legend of its own."""
    seen, legends = [], []
    for value in browser.js("[...document.getElementById('colour').options].map(o => o.value)"):
        set_value(browser, "bonds", False, "change")
        set_value(browser, "colour", value, "change")
        seen.append(picture(browser))
        legends.append(browser.js("document.getElementById('legend').innerText"))
        claim(page, f"colour = {value} has a legend", len(legends[-1]) > 3, legends[-1].replace("\n", " ")[:60])
    claim(page, "every colour is another picture", len(set(seen)) == len(seen))


def keys(browser, claim, page):
    browser.js("document.getElementById('reset').click(); document.getElementById('canvas').focus()")
    many = browser.js("crumbleView.state.file.frames.length") > 1
    step = [] if not many else [","] if browser.js("crumbleView.state.frame") else ["."]
    for key in ("ArrowLeft", "ArrowUp", "+", "c", "b", *step):
        # One step of a cut may go through nothing.
        changed(browser, claim, page, f"key {key}", lambda: [browser.key(key) for _ in range(6 if key == "c" else 1)])
    set_value(browser, "find", 2, "change")
    claim(page, "a particle that is named tells its numbers", "particle\t2" in browser.js("document.getElementById('details').innerText"))
    if many:
        browser.key(" ")
        at = browser.js("crumbleView.state.frame")
        claim(page, "space plays the frames", browser.until(f"crumbleView.state.frame !== {at}", 30))
        browser.key(" ")
        claim(page, "space stops them", browser.js("crumbleView.state.playing") is False)
    browser.key("Tab")
    claim(page, "Tab leads from the view to the next control", browser.js("document.activeElement.id") == "file")


# The coloured pixel that is nearest to the middle of the picture, among those that were white in the picture before.
MIDDLE = """(() => { const c = document.getElementById('canvas'), r = c.getBoundingClientRect(), d = document.createElement('canvas'), w = c.width;
d.width = w; d.height = c.height; const x = d.getContext('2d'); x.drawImage(c, 0, 0); const p = x.getImageData(0, 0, w, c.height).data, was = window.before;
window.before = p; let best = null, least = 1e9; const white = (q, k) => q[k] + q[k + 1] + q[k + 2] > 750;
for (let v = 0; v < c.height; ++v) for (let u = 0; u < w; ++u) { const k = 4 * (v * w + u), away = Math.hypot(u - w / 2, v - c.height / 2);
if (p[k] + p[k + 1] + p[k + 2] < 720 && away < least && (!was || white(was, k))) { least = away; best = [u, v]; } }
return best && [r.left + (best[0] + 0.5) * r.width / w, r.top + (best[1] + 0.5) * r.height / c.height]; })()"""


def click(browser, what):
    """On what came into the picture since it was looked at last; what the page then tells."""
    browser.mouse(*((kind, *what) for kind in ("Pressed", "Released")))
    return browser.js("document.getElementById('details').innerText")


def clicks(browser, claim, page):
    """A click tells the numbers of what is there: of a particle, and of a contact where there was nothing without contacts."""
    browser.js("document.getElementById('reset').click(); document.getElementById('canvas').scrollIntoView(); window.before = null")
    last = browser.js("document.getElementById('frame').max")  # where there are contacts: a drying begins without any
    for name, value, event in (("frame", last, "input"), ("find", "", "change"), ("bonds", False, "change"), ("size", 100, "input")):
        set_value(browser, name, value, event)
    settled(browser)
    said = click(browser, browser.js(MIDDLE))
    claim(page, "a click on a particle tells its numbers", said.startswith("particle") and "radius" in said and "nm" in said, said.split("\n")[0].replace("\t", " "))
    set_value(browser, "size", 40, "input")
    set_value(browser, "find", "", "change")
    settled(browser)
    browser.js(MIDDLE)
    set_value(browser, "bonds", True, "change")
    set_value(browser, "size", 40, "input")
    settled(browser)
    said = click(browser, browser.js(MIDDLE))
    claim(page, "a click on a contact tells its numbers", said.startswith("contact of") and "tension" in said and "gap" in said, said.split("\n")[0].replace("\t", " "))


def width_of(browser):
    return browser.js("[document.documentElement.scrollWidth, window.innerWidth]")


def paper_and_phone(browser, claim, page, path, out):
    browser.pdf(out / f"{page}.pdf")
    claim(page, "prints", (out / f"{page}.pdf").read_bytes().startswith(b"%PDF") and (out / f"{page}.pdf").stat().st_size > 50_000)
    browser.resize(360, 740, mobile=True)
    browser.open(path)
    wide, window = width_of(browser)
    claim(page, "fits a phone of 360 pixels", wide <= window == 360, f"{wide} wide")
    browser.screenshot(out / f"{page}-phone.png")


def quiet(browser, claim, page):
    requests = [url for url in browser.js("performance.getEntriesByType('resource').map(e => e.name)") if not url.startswith(("data:", "blob:"))]
    claim(page, "asks for no other file", not requests, " ".join(requests))
    claim(page, "has no complaint in the console", not browser.complaints, "; ".join(browser.complaints)[:200])


def one_page(claim, page, path, out, full=False):
    text = path.read_text(encoding="utf-8")
    claim(page, "is below ten million bytes", len(text.encode()) < 10_000_000, f"{len(text.encode()) / 1e6:.2f} MB")
    claim(page, "holds the licence of what draws it", "Permission is hereby granted, free of charge" in text)
    with Browser(1000, 1200) as browser:
        claim(page, "opens from disk", browser.open(path))
        claim(page, "has its view", browser.js("document.documentElement.dataset.view") == "ready")
        settled(browser)
        ink, colours = browser.js(INK)
        claim(page, "draws", ink > 0.02 and colours > 50, f"{100 * ink:.0f} % of the pixels, {colours} colours")
        browser.screenshot(out / f"{page}.png")
        if full:
            controls(browser, claim, page)
            keys(browser, claim, page)
            clicks(browser, claim, page)
        for k in range(browser.js("document.getElementById('file').options.length")):
            set_value(browser, "file", str(k), "change")
            found = browser.until(f"crumbleView.state.file.block === 'frames-{k}' && document.getElementById('view-note').hidden")
            settled(browser)
            claim(page, f"shows file {k}", found and browser.js(INK)[0] > 0.01, browser.js("document.getElementById('file').selectedOptions[0].text"))
        if page == "spheres":
            smooth(browser, claim, page)
        if full:
            paper_and_phone(browser, claim, page, path, out)
        quiet(browser, claim, page)


def smooth(browser, claim, page):
    claim(page, "holds ten thousand spheres", browser.js("crumbleView.state.file.radius.length") >= 10_000)
    set_value(browser, "bonds", True, "change")
    settled(browser)
    claim(page, "all spheres are one call of the graphics chip, all contacts another", browser.js("crumbleView.calls") == 2)
    for contacts, part in ((False, 1), (True, 1), (False, 0.3)):
        set_value(browser, "bonds", contacts, "change")
        set_value(browser, "size", 100, "input")
        settled(browser)
        begun = browser.cpu_seconds()
        wall = browser.js(f"crumbleView.time(5, {part})") / 1000
        cost = (browser.cpu_seconds() - begun) / 5
        print(f"one draw of {browser.js('crumbleView.state.file.radius.length')} spheres{' and their contacts' if contacts else ''}: "
              f"{cost:.2f} s of CPU, {wall:.2f} s (software rendering, {browser.js('document.getElementById(`canvas`).width')} pixels wide)")


def tables_and_figures(claim, page, path, out):
    """The page of `paper`: no view, a link to the one that has it."""
    with Browser(1000, 1200) as browser:
        claim(page, "opens from disk", browser.open(path, "document.querySelectorAll('figure').length > 5"))
        there = browser.js("[...document.querySelectorAll('a')].map(a => a.getAttribute('href'))")
        claim(page, "leads to the page with the view, beside it", "granules.html" in there and (path.parent / "granules.html").is_file())
        claim(page, "has every figure and table", browser.js("document.querySelectorAll('.missing').length") == 0)
        paper_and_phone(browser, claim, page, path, out)
        quiet(browser, claim, page)


def without_webgl(claim, path):
    with Browser(800, 600, flags=("--disable-gpu", "--disable-webgl", "--disable-webgl2", "--disable-3d-apis")) as browser:
        browser.open(path)
        claim("no WebGL", "a message stands where the view would be", "no WebGL" in browser.js("document.getElementById('view-note').innerText"))
        claim("no WebGL", "its controls are not shown", browser.js("getComputedStyle(document.getElementById('controls')).display") == "none")


def lattice(path):
    """22 x 22 x 22 spheres of 10 nm that touch, a ball-shaped hole in the middle: 1e4 and some."""
    x = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(22.0)], indexing="ij"), -1).reshape(-1, 3) * 20
    write_csv(path, ["x", "y", "z", "radius"], ([*row, 10] for row in x[numpy.linalg.norm(x - 210, axis=1) > 90].tolist()))


def campaign(out, programs):
    """Six granules of 48 particles, loaded and two of them broken."""
    (out / "campaign.toml").write_text(f"""seeds = 6
[dry]
scene = "{ROOT}/pipeline/scenes/hollow.toml"
set = {{"particle.number" = 48, "droplet.radius" = 161e-9, "error.estimate" = false}}
[stress]
scene = "{ROOT}/pipeline/scenes/stress-elongation.toml"
flows = ["elongation"]
[breakup]
scene = "{ROOT}/pipeline/scenes/breakup.toml"
set = {{"integrator.tolerance" = 0.1, "error.estimate" = false}}
count = 2
""")
    made("-B", ROOT / "pipeline/campaign", "run", out / "campaign.toml", "-o", out / "campaign", "--programs", programs)
    return out / "campaign"


def made(*words):
    subprocess.run([sys.executable, *words], check=True, stdout=subprocess.DEVNULL)


def command_line():
    parser = arguments.parser(__doc__, "pages and screenshots", "FOLDER", default=ROOT / "pipeline/results/verify")
    parser.add_argument("--tool", default=ROOT / "build/release/bin/agglomerate", type=pathlib.Path, metavar="PROGRAM", help="the program agglomerate")
    return parser


def main(options):
    if not there():
        print("there is no chromium: pipeline/packages.sh browser", file=sys.stderr)
        return 77
    out, tool, claim = options.out, options.tool, Claims()
    out.mkdir(parents=True, exist_ok=True)
    lattice(out / "spheres.csv")
    (out / "spheres.h5").unlink(missing_ok=True)
    subprocess.run([tool, "import", out / "spheres.csv", "-o", out / "spheres.h5"], check=True, stdout=subprocess.DEVNULL)
    samples = {name: SAMPLES / f"{name}-1.2.h5" for name in ("dryer", "breaker", "rigidstress", "import")}
    files = {"hollow": [ROOT / "data/hollow.h5"], "breakup": [samples["breaker"]], "campaign": [campaign(out, tool.parent)], "all": list(samples.values()),
             "spheres": [out / "spheres.h5"]}
    for name, of in files.items():
        begun = time.process_time()
        report.made(of, str(tool), out / f"{name}.html")
        print(f"page {name}: {time.process_time() - begun:.1f} s of CPU")
        one_page(claim, name, out / f"{name}.html", out, full=name not in ("all", "spheres"))
    without_webgl(claim, out / "hollow.html")
    subprocess.run(["make", "-C", ROOT / "pipeline", "tiny"], check=True, stdout=subprocess.DEVNULL)
    tables_and_figures(claim, "paper", ROOT / "pipeline/results/tiny/paper.html", out)
    one_page(claim, "paper 3D", ROOT / "pipeline/results/tiny/granules.html", out, full=True)
    write_csv(out / "report_view.csv", ["page", "claim", "verdict", "found"], claim.rows)
    return 0 if claim.held else 1


if __name__ == "__main__":
    sys.exit(main(command_line().parse_args()))
