"""One page with every table and figure of Vasquez Giuliano et al. (2022), ours beside theirs.

Tables and figures that other scripts wrote are taken from the folder of FILE.html; all of them become part of the page.

    paper.py results/table2/granules.csv results/strength/granules.csv results/broken/granules.csv -o results/paper.html
"""

import json
import math
import pathlib
import statistics

import arguments
import breakups
import campaign_files
import published
from interval import half_width
from page import as_html, figure, from_markdown, write

TITLES = {name: row["title"] for name, row in published.GRANULES.items()} | {"adhesive": "bond of 42 kT, Pe = 10, N = 85"}
STORED = pathlib.Path(__file__).parent.parent / "verify" / "brownian.json"


def load(path):
    return json.loads(path.read_text())


def mean(values):
    """Mean with half of its 95 % interval, to two digits of that; two granules as lowest and highest."""
    if len(values) < 3:
        return " to ".join(f"{value:.4g}" for value in sorted({*map(float, values)}))
    half = half_width(values)
    digits = max(0, 1 - math.floor(math.log10(half))) if half > 0 else 0
    return f"{statistics.fmean(values):.{digits}f} ± {half:.{digits}f}"


def stored_error(row):
    """Of a row with Brownian motion: kept from comparisons with contacts of full stiffness."""
    d_c = load(STORED)[row]["d_c_relative"]
    low, high = (100 * (d_c["difference"] + side * d_c["interval_95"]) for side in (-1, 1))
    return f"d_c {low:+.1f} to {high:+.1f} % of full stiffness (stored)"




class Page:
    def __init__(self, results, table2, strength, broken):
        """Tables of campaigns. Of kinds that Table 2 has not, those that were loaded stand for it."""
        dried = campaign_files.by_kind(strength) | campaign_files.by_kind(table2)
        self.results, self.dried, self.loaded, self.broken, self.parts = results, dried, list(campaign_files.read(strength, "stress")), \
            list(campaign_files.read(broken, "stress", "breakup")), []

    def add(self, *parts):
        self.parts += parts

    def granules(self, name):
        return [load(granule.file("dry", ".json")) for granule in self.dried.get(name, [])]

    def table2(self):
        rows = []
        for name in ("hollow", "intermediate", "compact", "adhesive"):
            runs = self.granules(name)
            if not runs:
                continue
            values = {key: [run["results"][key] for run in runs] for key in ("d_c_nm", "h_c_over_d_c", "coordination")}
            paper = published.GRANULES.get(name, {})
            cells = [TITLES[name], len(runs)]
            for key in ("d_c_nm", "h_c_over_d_c", "coordination"):
                cells += [mean(values[key]), paper.get(key, "–")]
            rows.append(cells + [f"{statistics.fmean(run['cpu_s'] for run in runs):.3g}"])
        self.add("<h2>Table 2 and Fig. 3: the Péclet number</h2>",
                 as_html(["granules", "n", "d_c, nm", "paper", "h_c/d_c", "paper", "coordination", "paper", "CPU s each"], rows),
                 "<p>±: half of the 95 % interval of the mean over granules; two granules are given as lowest to highest. The paper's values are of one "
                 "granule each.</p>",
                 figure(self.results / "figure3.svg", "Fig. 3. Lines: mean over granules; bands: lowest and highest."),
                 figure(self.results / "drying-hollow.png", "Drying at Pe → ∞."),
                 *(figure(path, "Drying at a finite Péclet number.") for name in ("compact", "intermediate")
                   if name in self.dried and (path := self.results / f"drying-{name}.png").exists()))

    def difference(self):
        ours, held = ([run["results"]["coordination"] for run in self.granules(name)] for name in ("compact", "adhesive"))
        if not ours or not held:
            return
        broken = [breakups.load(granule) for granule in self.broken if granule.kind == "adhesive"]
        ends = "".join(f" One of them breaks {found['results']['breakage']}, at {found['results']['critical_stress_pa'] / rigid:.2f} "
                       "of its rigid prediction." for found, rigid in broken if rigid is not None)
        self.add(f"<p>Coordination at Pe = 1: {statistics.fmean(ours):.2f}, the paper {published.GRANULES['compact']['coordination']}. "
                 "A bond of the printed constants is worth 4.2 kT and lives nanoseconds, so thermal motion rearranges the wet granule. "
                 f"With bonds that hold (42 kT) the coordination is {statistics.fmean(held):.2f}.{ends} The manual of "
                 "dryer shows one choice at a time.</p>")

    def strength(self):
        folder = self.results / "strength"
        self.add("<h2>Section 3.4, Figs 8 and 9: rigid populations</h2>", from_markdown(folder / "table.md"),
                 "<p>N_max in 6πμγ̇a². Elongation in the orientation to which the granule settles and in the worst; shear: largest over an "
                 "orbit, mean over orbits.</p>",
                 figure(folder / "fig8.svg", "Fig. 8. Tension of each contact in elongation. Open symbols: one granule of each kind; dots: all others."),
                 figure(folder / "fig9.svg", "Fig. 9. Largest tension in shear. Dotted: mean of the largest over each orbit, band: its 95 % interval; of two granules lowest and highest."))

    def breakups(self):
        folder = self.results / "broken"
        self.add("<h2>Section 3.3, Figs 6 and 7: breakup of flexible granules</h2>", from_markdown(folder / "table.md"),
                 "<p>Changes are those at 1 % less stress. Error: difference to doubled tolerance.</p>")
        for granule in self.broken:
            self.add(figure(folder / f"{granule.name}-strip.png", f"Fig. 6, {granule.name}: snapshots at growing flow stress."),
                     figure(folder / f"{granule.name}-course.svg", f"Fig. 7, {granule.name}."))

    def effort(self):
        rows = []
        for name, label in (("hollow", "drying, high Péclet number"), ("compact", "drying, low Péclet number")):
            runs = self.granules(name)
            if runs:
                cpu, wall = (statistics.fmean(run[key] for run in runs) for key in ("cpu_s", "wall_s"))
                errors = [run["errors"]["d_c_relative"]["value"] for run in runs]
                error = stored_error(name) if None in errors else f"d_c {100 * max(errors):.2g} %"
                rows.append([label, f"{published.DRYING_HOURS[name]} h", f"{cpu:.3g} s", f"{wall:.3g} s",
                             f"{published.DRYING_HOURS[name] * 3600 / cpu:.2g}", error])
        for granule in self.broken:
            run = load(granule.file("breakup", ".json"))
            cpu, error = run["cpu_s"], run["errors"]["critical_stress_relative"]["value"]
            rows.append([f"breakup, {granule.name}", f"{published.BREAKUP_HOURS} h on {published.BREAKUP_THREADS} threads", f"{cpu:.3g} s",
                         f"{run['wall_s']:.3g} s", f"{published.BREAKUP_HOURS * published.BREAKUP_THREADS * 3600 / cpu:.2g}",
                         "not estimated" if error is None else f"critical stress {100 * error:.1g} %"])
        rigid = [load(granule.file("stress", ".json")) for granule in self.loaded]
        if rigid:
            cpu = statistics.fmean(run["cpu_s"] for run in rigid)
            rows.append(["rigid analysis, all flows", "few minutes", f"{cpu:.3g} s", "–",
                         f"{60 * published.RIGID_MINUTES / cpu:.2g} (of {published.RIGID_MINUTES} min)",
                         f"N_max {100 * max(run['errors']['n_max_relative']['value'] for run in rigid):.2g} %"])
        self.add("<h2>Section 3.5: computational effort</h2>",
                 as_html(["one run", "paper", "ours, CPU", "ours, wall", "ratio of core time", "our error"], rows),
                 "<p>The paper: Intel Xeon E5-2630 v4. Ours: means of the runs of this page, side by side on the cores of this machine.</p>")


def command_line():
    parser = arguments.parser(__doc__, "the page", "FILE.html")
    for name, of in (("table2", "Table 2"), ("strength", "section 3.4"), ("broken", "section 3.3")):
        parser.add_argument(name, type=arguments.file, metavar=f"{name.upper()}.csv", help=f"table of the granules of {of}")
    return parser


def main(options):
    out, results = options.out, options.out.parent
    page = Page(results, options.table2, options.strength, options.broken)
    page.add("<h1>Micromechanics and strength of agglomerates produced by spray drying, computed again</h1>",
             "<p>Every table and figure of Vasquez Giuliano, Buffo, Vanni and Frungieri (2022), JCIS Open 8, 100068, by Crumble, with our "
             "numbers and their errors beside the paper's.</p>",
             figure(results / "granules.png", "A hollow and a compact granule, whole and with the front half taken away."),
             '<p><a href="granules.html">Turn them, cut them open and see them break</a>: a page with a 3D view.</p>')
    page.table2()
    page.difference()
    page.add("<h2>Table 3 and Fig. 4: the lifetime at high Péclet numbers</h2>", from_markdown(results / "table3/table3.md"),
             figure(results / "table3/table3.svg", "Fig. 4. Bars: 95 % interval of the mean; of two granules lowest and highest."),
             "<h2>Fig. 5: particles and the continuum model</h2>", from_markdown(results / "figure5.md"),
             figure(results / "figure5.svg", "Fig. 5. Dashed: continuum, through the same estimator; bands and bars: two standard errors. Above as the "
                    "paper draws it, below on the radius that centres reach. Centres stay about 0.9 a inside the surface, "
                    "which raises all values above (continuum of points that fill the droplet)."))
    page.breakups()
    page.strength()
    page.effort()
    write(out, "Crumble: the paper", page.parts)


if __name__ == "__main__":
    main(command_line().parse_args())
