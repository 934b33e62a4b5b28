"""One page with every table and figure of Vasquez Giuliano et al. (2022), ours beside theirs:

    paper.py RESULTS OUT.html NAME=SEED,...       NAME: hollow, intermediate, compact, adhesive; those of Table 2 and section 3.4

Reads what the other targets left in RESULTS; the numbers of the page also go to OUT.json. Figures are part of the page.
"""

import base64
import html
import json
import math
import pathlib
import re
import statistics
import sys

from interval import half_width

TITLES = {"hollow": "Pe → ∞, N = 115", "intermediate": "Pe = 10, N = 102", "compact": "Pe = 1, N = 85",
          "adhesive": "bond of 42 kT, Pe = 10, N = 85"}
# Table 2; contacts and coordination of section 3.3; critical stresses (flexible, rigid) of section 3.3.
PAPER = {"hollow": {"d_c_nm": 160, "h_c_over_d_c": 0.28, "coordination": 3.18, "stress": (2010, 1930), "hours": 30},
         "intermediate": {"d_c_nm": 132, "h_c_over_d_c": 0.43},
         "compact": {"d_c_nm": 132, "h_c_over_d_c": 0.44, "coordination": 4.16, "stress": (4040, 4120), "hours": 240}}
STORED = pathlib.Path(__file__).parent.parent / "verify" / "brownian.json"
BREAKUP_HOURS, BREAKUP_THREADS, RIGID_MINUTES = 168, 8, 5  # section 3.5: 7 days on 8 threads; "few minutes"

STYLE = """body{font:16px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}
table{border-collapse:collapse;margin:1rem 0;font-size:.85rem}td,th{border-bottom:1px solid #ccc;padding:.25rem .6rem;text-align:right}
th{border-bottom:2px solid #444}td:first-child,th:first-child{text-align:left}img,svg{max-width:100%;height:auto}
figure{margin:1rem 0}figcaption{font-size:.85rem;color:#444}.missing{color:#a00}"""


def load(path):
    return json.loads(path.read_text())


def mean(values):
    """Mean with half of its 95 % interval, to two digits of that."""
    if len(values) < 2:
        return f"{statistics.fmean(values):.4g}"
    half = half_width(values)
    digits = max(0, 1 - math.floor(math.log10(half))) if half > 0 else 0
    return f"{statistics.fmean(values):.{digits}f} ± {half:.{digits}f}"


def stored_error():
    """Of the rows with Brownian motion: found by `make verify` and kept."""
    d_c = load(STORED)["d_c_relative"]
    return f"d_c {100 * d_c['difference']:+.1f} ± {100 * d_c['interval_95']:.1f} % of full stiffness (stored)"


def table(head, rows):
    cell = lambda tag, values: "<tr>" + "".join(f"<{tag}>{html.escape(str(v))}</{tag}>" for v in values) + "</tr>"
    return "<table>" + cell("th", head) + "".join(cell("td", row) for row in rows) + "</table>"


def from_markdown(path):
    """The table of a .md file, and the lines after it."""
    if not path.exists():
        return missing(path)
    lines = path.read_text().strip().splitlines()
    rows = [[c.strip() for c in line.strip("|").split("|")] for line in lines if line.startswith("|")]
    rest = " ".join(line for line in lines if not line.startswith("|"))
    return table(rows[0], rows[2:]) + f"<p>{html.escape(rest)}</p>"


def missing(path):
    return f'<p class="missing">{html.escape(path.name)} was not made in this run.</p>'


def figure(path, caption):
    if not path.exists():
        return missing(path)
    if path.suffix == ".svg":
        # Ids must differ between the figures of a page.
        text = re.sub(r"^.*?(?=<svg)", "", path.read_text(), flags=re.S)
        tag = re.sub(r"\W", "", path.stem) + "-"
        text = re.sub(r'(id="|url\(#|href="#)', lambda m: m.group(1) + tag, text)
        body = text
    else:
        body = f'<img alt="" src="data:image/png;base64,{base64.b64encode(path.read_bytes()).decode()}">'
    return f"<figure>{body}<figcaption>{caption}</figcaption></figure>"


class Page:
    def __init__(self, results, seeds):
        self.results, self.seeds, self.numbers, self.parts = results, seeds, {}, []

    def add(self, *parts):
        self.parts += parts

    def granules(self, name):
        return [load(self.results / f"{name}-{seed}.json") for seed in self.seeds.get(name, [])]

    def table2(self):
        rows = []
        for name in ("hollow", "intermediate", "compact", "adhesive"):
            runs = self.granules(name)
            if not runs:
                continue
            values = {key: [run["results"][key] for run in runs] for key in ("d_c_nm", "h_c_over_d_c", "contacts", "coordination")}
            self.numbers[name] = {key: statistics.fmean(v) for key, v in values.items()} | {"granules": len(runs)}
            paper = PAPER.get(name, {})
            cells = [TITLES[name], len(runs)]
            for key in ("d_c_nm", "h_c_over_d_c", "coordination"):
                cells += [mean(values[key]), paper.get(key, "–")]
            rows.append(cells + [f"{statistics.fmean(run['cpu_s'] for run in runs):.3g}"])
        self.add("<h2>Table 2 and Fig. 3: the Péclet number</h2>",
                 table(["granules", "n", "d_c, nm", "paper", "h_c/d_c", "paper", "coordination", "paper", "CPU s each"], rows),
                 "<p>±: half of the 95 % interval of the mean over granules. The paper's values are of one granule each.</p>",
                 figure(self.results / "figure3.svg", "Fig. 3. Lines: mean over granules; bands: lowest and highest."),
                 figure(self.results / "drying-hollow.png", "Drying at Pe → ∞."),
                 *(figure(path, "Drying at a finite Péclet number.") for name in ("compact", "intermediate")
                   if name in self.seeds and (path := self.results / f"drying-{name}.png").exists()))

    def difference(self):
        if "compact" not in self.numbers or "adhesive" not in self.numbers:
            return
        ours, held = self.numbers["compact"], self.numbers["adhesive"]
        self.add(f"<p>At finite Pe our granules are denser than the paper's: coordination {ours['coordination']:.2f}, the paper "
                 f"{PAPER['compact']['coordination']}. A bond of the printed constants is worth 4.2 kT and lives nanoseconds, so thermal motion "
                 f"compacts the wet granule. With bonds that hold (42 kT) the coordination is {held['coordination']:.2f} and "
                 "what follows from it, brittle breakage near the rigid prediction included, is the paper's. The manual of "
                 "dryer shows one choice at a time.</p>")

    def strength(self):
        folder = self.results / "strength"
        rows = []
        for name in ("compact", "intermediate", "adhesive", "hollow"):
            reports = [load(path) for seed in self.seeds.get(name, []) if (path := folder / f"{name}-{seed}.json").exists()]
            if not reports:
                continue
            settled = [r["results"]["elongation"]["n_max_settled"] for r in reports]
            shear = [r["results"]["shear"]["n_max_orbit"] for r in reports]
            stress = [[r["results"][flow][key] for r in reports] for flow, key in
                      (("elongation", "critical_stress_settled_pa"), ("shear", "critical_stress_pa"))]
            theirs = {"compact": (2.89, 4120, 3.3, 3650), "hollow": (6.24, 1930, 5.1, 2360)}.get(name, ("–",) * 4)
            rows.append([TITLES[name], len(reports), mean(settled), theirs[0], mean(stress[0]), theirs[1],
                         mean(shear), theirs[2], mean(stress[1]), theirs[3],
                         f"{100 * max(r['errors']['n_max_relative']['value'] for r in reports):.1f} %"])
            self.numbers.setdefault(name, {})["n_max"] = {"settled": statistics.fmean(settled), "shear": statistics.fmean(shear)}
            self.rigid_cpu = statistics.fmean(r["cpu_s"] for r in reports)
        self.add("<h2>Section 3.4, Figs 8 and 9: rigid populations</h2>",
                 table(["granules", "n", "N_max elongation", "paper", "breaks at, Pa", "paper", "N_max shear", "paper",
                        "breaks at, Pa", "paper", "error of one"], rows),
                 "<p>N_max in 6πμγ̇a²; elongation in the orientation to which the granule settles; shear: largest over an orbit, mean over "
                 "orbits. Error: the largest that rigidstress states for one granule.</p>",
                 figure(folder / "fig8.svg", "Fig. 8. Tension of each contact in elongation. Open symbols: one granule of each kind; dots: all others."),
                 figure(folder / "fig9.svg", "Fig. 9. Largest tension in shear. Dotted: mean of the largest over each orbit."))

    def breakups(self):
        folder = self.results / "breakup"
        rows = []
        for path in sorted(folder.glob("*-[0-9]*.json")):
            name, _, seed = path.stem.partition("-")
            if path.stem.endswith("-rigid") or seed not in self.seeds.get(name, []):
                continue
            run, rigid = load(path), load(path.with_name(path.stem + "-rigid.json"))["results"]["elongation"]
            r, error = run["results"], run["errors"]["critical_stress_relative"]["value"]
            paper = PAPER.get(name, {}).get("stress", ("–", "–"))
            rows.append([path.stem, f"{r['critical_stress_pa']:.0f}" + (f" ± {error * r['critical_stress_pa']:.0f}" if error is not None else ""),
                         paper[0], f"{rigid['critical_stress_settled_pa']:.0f}", paper[1],
                         f"{r['contacts_initial']} → {r['contacts_at_breakup']}", f"{100 * r['rg_change_relative']:+.1f} %",
                         f"{100 * r['largest_semi_axis_change_relative']:+.1f} %", r["breakage"],
                         " ".join(map(str, r["fragments"][:4])), f"{run['cpu_s']:.0f}"])
            self.numbers.setdefault(name, {}).setdefault("critical_stress_pa", {})[path.stem] = r["critical_stress_pa"]
        self.add("<h2>Section 3.3, Figs 6 and 7: breakup of flexible granules</h2>",
                 table(["granule", "breaks at, Pa", "paper", "rigid, Pa", "paper", "contacts", "R_g", "largest semi-axis", "",
                        "fragments", "CPU s"], rows),
                 "<p>Changes are those at 1 % less stress. ±: difference to doubled tolerance.</p>")
        for row in rows:
            self.add(figure(folder / f"{row[0]}-strip.png", f"Fig. 6, {row[0]}: snapshots at growing flow stress."),
                     figure(folder / f"{row[0]}-course.svg", f"Fig. 7, {row[0]}."))
        self.breakup_cpu = {row[0].partition("-")[0]: float(row[-1]) for row in rows}

    def effort(self):
        rows = []
        for name, label in (("hollow", "drying, high Péclet number"), ("compact", "drying, low Péclet number")):
            runs = self.granules(name)
            if runs:
                cpu, wall = (statistics.fmean(run[key] for run in runs) for key in ("cpu_s", "wall_s"))
                errors = [run["errors"]["d_c_relative"]["value"] for run in runs]
                error = stored_error() if None in errors else f"d_c {100 * max(errors):.2g} %"
                rows.append([label, f"{PAPER[name]['hours']} h", f"{cpu:.3g} s", f"{wall:.3g} s",
                             f"{PAPER[name]['hours'] * 3600 / cpu:.2g}", error])
        for name, cpu in self.breakup_cpu.items():
            rows.append([f"breakup, {name}", f"{BREAKUP_HOURS} h on {BREAKUP_THREADS} threads", f"{cpu:.3g} s", "–",
                         f"{BREAKUP_HOURS * BREAKUP_THREADS * 3600 / cpu:.2g}", "critical stress, table above"])
        if hasattr(self, "rigid_cpu"):
            rows.append(["rigid analysis, all flows", "few minutes", f"{self.rigid_cpu:.3g} s", "–",
                         f"{60 * RIGID_MINUTES / self.rigid_cpu:.2g} (of {RIGID_MINUTES} min)", "N_max below 1 %"])
        self.add("<h2>Section 3.5: computational effort</h2>",
                 table(["one run", "paper", "ours, CPU", "ours, wall", "ratio of core time", "our error"], rows),
                 "<p>The paper: Intel Xeon E5-2630 v4. Ours: means of the runs of this page, side by side on the cores of this machine.</p>")


def main(results, out, populations):
    seeds = {name: [seed for seed in listed.split(",") if seed] for name, _, listed in (p.partition("=") for p in populations)}
    results, out = pathlib.Path(results), pathlib.Path(out)
    page = Page(results, seeds)
    page.add("<h1>Micromechanics and strength of agglomerates produced by spray drying, computed again</h1>",
             "<p>Every table and figure of Vasquez Giuliano, Buffo, Vanni and Frungieri (2022), JCIS Open 8, 100068, by Crumble, with our "
             "numbers and their errors beside the paper's.</p>",
             figure(results / "granules.png", "A hollow and a compact granule, whole and with the front half taken away."))
    page.table2()
    page.difference()
    page.add("<h2>Table 3 and Fig. 4: the lifetime at high Péclet numbers</h2>", from_markdown(results / "lifetime/table3.md"),
             figure(results / "lifetime/figure4.svg", "Fig. 4. Bars: standard deviation between granules."),
             "<h2>Fig. 5: particles and the continuum model</h2>", from_markdown(results / "figure5.md"),
             figure(results / "figure5.svg", "Fig. 5. Dashed: continuum, through the same estimator; bands and bars: two standard errors. Above as the "
                    "paper draws it, below on the radius that centres reach. Centres stay about 0.9 a inside the surface, "
                    "which raises all values above (continuum of points that fill the droplet)."))
    page.breakups()
    page.strength()
    page.effort()
    body = "\n".join(page.parts)
    text = f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Crumble: the paper</title><style>{STYLE}</style></head><body>{body}</body></html>\n'
    out.with_suffix(".json").write_text(json.dumps(page.numbers, indent=1) + "\n")
    temporary = out.with_suffix(".tmp")
    temporary.write_text(text)
    temporary.rename(out)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
