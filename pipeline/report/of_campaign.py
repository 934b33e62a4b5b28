"""A campaign's folder as a part of a page: summary, figures, granules, file; and which of its granules to look into."""

import csv
import html

import page

SHARES = (("weakest", 0.0), ("middle", 0.5), ("strongest", 1.0))
STAGES = (("dry", "id", "dried"), ("stress", "stress_id", "loaded"), ("breakup", "breakup_id", "broken"))


def is_one(path):
    return (path / "granules.csv").is_file() and (path / "summary.md").is_file()


def granules(folder):
    with (folder / "granules.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def shown(folder):
    """{file: what it is called on the page}: weakest, middle and strongest granule, or first, middle and last where none was loaded."""
    rows = granules(folder)
    stress = next((name for name in rows[0] if name.startswith("critical_stress") and name.endswith("[Pa]") and any(row[name] for row in rows)), None)
    words = SHARES
    if stress:
        rows = sorted((row for row in rows if row[stress]), key=lambda row: float(row[stress]))
    else:
        words = (("first", 0.0), ("middle", 0.5), ("last", 1.0))
    found = {}
    for word, share in words[:len(rows)]:
        row = rows[round(share * (len(rows) - 1))]
        for stage, key, done in STAGES:
            path = folder / stage / f"{row.get(key)}.h5"
            if path.is_file() and path not in found:
                found[path] = f"{word} granule, {done}"
    return found


def table(folder):
    rows = granules(folder)
    columns = [name for name in rows[0] if not name.endswith(("sha256", "[relative]", "_id"))]
    digits = lambda text: f"{float(text):.4g}" if "." in text or "e" in text else text
    cells = [[row[name] if name in ("id", "seed") or not row[name].lstrip("-")[:1].isdigit() else digits(row[name]) for name in columns] for row in rows]
    return page.as_html(columns, cells)


# Of summary.md, in the order of the page; the keys that were varied stand before them.
HEADLINE = ("quantity", "granules", "mean", "spread", "50 %", "sampling error", "numerical error")


def headline(folder):
    lines = [line for line in (folder / "summary.md").read_text(encoding="utf-8").splitlines() if line.startswith("|")]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    kept = [*range(rows[0].index("quantity")), *(rows[0].index(name) for name in HEADLINE)]
    head, _, *rest = [[row[k] for k in kept] for row in rows]
    return f'<div class="campaign">{page.as_html(head, rest)}</div>'


def parts(folder):
    name = folder.resolve().name
    out = [f"<h2>Campaign {html.escape(name)}</h2>", headline(folder),
           "<p>In brackets: 95 % intervals; spread: standard deviation between granules; 50 %: median. Sampling error: half of the interval of the mean. "
           "Numerical error: mean of what the runs state. A question mark: too few granules to bound it on that side; two granules stand as lowest to highest.</p>",
           f'<details><summary>Everything that the campaign says</summary><div class="campaign">{page.from_markdown(folder / "summary.md")}</div></details>']
    for path in sorted(folder.glob("*.svg")):
        what = "Means over what was varied." if path.stem == "response" else \
            f"{path.stem.replace('_', ' ').capitalize()}: share of granules that break below a stress; a Weibull distribution is a straight line. Band: 95 % interval of each share."
        out.append(page.figure(path, what))
    out.append(f"<details><summary>All {len(granules(folder))} granules</summary>{table(folder)}</details>")
    head = next(line for line in (folder / "summary.md").read_text(encoding="utf-8").splitlines() if "granules at" in line)
    out.append(f"<h3>How to make it again</h3><p>{html.escape(head)} With the file below under the name that it has there, in the folder where it was:</p>"
               f"<pre>make -C pipeline campaign CAMPAIGN={html.escape(head.split(' of ')[1].split(';')[0])}</pre>")
    if (folder / "campaign.toml").is_file():
        out.append(f'<details><summary>The file of the campaign</summary><pre>{html.escape((folder / "campaign.toml").read_text(encoding="utf-8"))}</pre></details>')
    return out
