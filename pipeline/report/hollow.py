"""Table of hollow granules beside Table 2, row 1 of Vasquez Giuliano et al. (2022): hollow.py REPORT.json..."""

import json
import math
import statistics
import sys
import textwrap

# What the paper gives for Pe -> infinity. Contacts: 185 in the first description, 183 in the evolution (coordination
# 3.18 = 2 * 183 / 115).
PAPER = {"d_c_nm": "160", "h_c_over_d_c": "0.28", "contacts": "183-185", "coordination": "3.18"}

# key of the result, heading, format, key of its error in the report, whether that is a fraction of the value
COLUMNS = [
    ("d_c_nm", "d_c nm", "{:.1f}", "d_c_relative", True),
    ("h_c_over_d_c", "h_c/d_c", "{:.3f}", "h_c_over_d_c", False),
    ("contacts", "contacts", "{:.1f}", "contacts_relative", True),
    ("coordination", "coordination", "{:.2f}", "contacts_relative", True),
]


def largest_error(reports, key):
    """The largest of the runs, or None if any run has not estimated it."""
    values = [report["errors"].get(key, {}).get("value") for report in reports]
    return None if any(value is None for value in values) else max(abs(value) for value in values)


def error_cell(reports, mean, column):
    _, _, form, key, relative = column
    error = largest_error(reports, key)
    if error is None:
        return "?"
    error = error * abs(mean) if relative else error
    return "0" if error == 0 else "{:.1g}".format(error) if error < 0.1 else form.format(error)


def one_run(value, column):
    return str(value) if isinstance(value, int) else column[2].format(value)  # a count is whole, its mean is not


def table(reports):
    rows = [["seed"] + [column[1] for column in COLUMNS] + ["steps", "wall s", "cpu s"]]
    for report in sorted(reports, key=lambda r: r["seed"]):
        cells = [one_run(report["results"][column[0]], column) for column in COLUMNS]
        cost = [str(report["steps"]), f"{report['wall_s']:.2f}", f"{report['cpu_s']:.2f}"]
        rows.append([str(report["seed"])] + cells + cost)
    means = [statistics.fmean(r["results"][column[0]] for r in reports) for column in COLUMNS]
    rows.append(["mean"] + [column[2].format(mean) for column, mean in zip(COLUMNS, means)]
                + ["", "", f"{sum(r['cpu_s'] for r in reports):.2f}"])
    if len(reports) > 1:
        spread = [statistics.stdev(r["results"][column[0]] for r in reports) for column in COLUMNS]
        rows.append(["spread"] + [column[2].format(s) for column, s in zip(COLUMNS, spread)] + ["", "", ""])
    rows.append(["error"] + [error_cell(reports, mean, c) for c, mean in zip(COLUMNS, means)] + ["", "", ""])
    rows.append(["paper"] + [PAPER[column[0]] for column in COLUMNS] + ["", "", ""])
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
    lines.insert(1, "-" * max(len(line) for line in lines))
    lines.insert(2 + len(reports), lines[1])
    return lines


def notes(reports):
    first = reports[0]
    out = [
        "mean: over the seeds (cpu s: the sum). spread: standard deviation between seeds.",
        "error: numerical error, the largest of the seeds (?: not estimated).",
        "paper: Vasquez Giuliano et al. 2022, Table 2, Pe -> infinity, one realisation.",
    ]
    overlap = largest_error(reports, "largest_overlap_over_a")
    if overlap is not None:
        out.append(f"largest overlap of two particles: {overlap:.2g} a")
    keys_of = {}
    for key, error in first["errors"].items():
        keys_of.setdefault(error["how"], []).append(key)
    out += [f"{', '.join(keys)}: {how}" for how, keys in keys_of.items()]
    for text in first["left_out"]:
        out.append(f"left out: {text}")
    return [line for text in out for line in textwrap.wrap(text, 110, subsequent_indent="    ")]


def read(name):
    with open(name, encoding="utf-8") as file:
        report = json.load(file)
    for column in COLUMNS:
        value = report["results"].get(column[0])
        if not isinstance(value, (int, float)) or not math.isfinite(value):
            sys.exit(f"{name}: results/{column[0]}: expected a finite number, found {value!r}")
    return report


def main(names):
    if not names:
        sys.exit(__doc__)
    reports = [read(name) for name in names]
    granules = "granule" if len(reports) == 1 else "granules"
    print(f"{len(reports)} hollow {granules}, {reports[0]['program']} {reports[0]['version']}, {reports[0]['scene']}\n")
    print("\n".join(table(reports) + [""] + notes(reports)))


if __name__ == "__main__":
    main(sys.argv[1:])
