"""Table of granules beside Table 2 of Vasquez Giuliano et al. (2022).

Its rows are hollow (Pe -> infinity), intermediate (Pe = 10) and compact (Pe = 1).

    granules.py results/table2/granules.csv -o granules.txt
    granules.py hollow=hollow-1.json,hollow-2.json compact=compact-1.json -o granules.txt
"""

import json
import math
import pathlib
import statistics
import sys
import textwrap

import arguments
import published
from interval import half_width

# Differences of means to contacts of full stiffness, found by `make verify` and kept.
STORED = pathlib.Path(__file__).parent.parent / "verify" / "brownian.json"

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


def stored_errors(row):
    return json.loads(STORED.read_text(encoding="utf-8")).get(row)


def error_cell(row, reports, mean, column):
    _, _, form, key, relative = column
    error = largest_error(reports, key)
    if error is None and stored_errors(row):
        error = abs(stored_errors(row)[key]["difference"])
    if error is None:
        return "?"
    error = error * abs(mean) if relative else error
    return "0" if error == 0 else "{:.1g}".format(error) if error < 0.1 else form.format(error)


def one_run(value, column):
    return str(value) if isinstance(value, int) else column[2].format(value)  # a count is whole, its mean is not


def paper_cell(row, column):
    value = published.GRANULES[row].get(column[0])
    return "-" if value is None else column[2].format(value)


def place_cell(row, reports, column):
    """Where the paper's one value lies among ours, in standard deviations from the mean."""
    value = published.GRANULES[row].get(column[0])
    values = [r["results"][column[0]] for r in reports]
    if value is None or len(values) < 3 or statistics.stdev(values) == 0:
        return "-"
    return f"{(value - statistics.fmean(values)) / statistics.stdev(values):+.1f}"


def table(row, reports):
    rows = [["seed"] + [column[1] for column in COLUMNS] + ["fragments", "steps", "wall s", "cpu s"]]
    for report in sorted(reports, key=lambda r: r["seed"]):
        cells = [one_run(report["results"][column[0]], column) for column in COLUMNS]
        cost = [str(report["results"]["fragments"]), str(report["steps"]), f"{report['wall_s']:.2f}",
                f"{report['cpu_s']:.2f}"]
        rows.append([str(report["seed"])] + cells + cost)
    blank = ["", "", "", ""]
    means = [statistics.fmean(r["results"][column[0]] for r in reports) for column in COLUMNS]
    if len(reports) > 1:
        total = ["", "", "", f"{sum(r['cpu_s'] for r in reports):.2f}"]
        # A spread of two says nothing.
        two = (("lowest", min), ("highest", max))
        for name, of in two if len(reports) == 2 else (("mean", statistics.fmean), ("spread", statistics.stdev), ("±95%", half_width)):
            figures = [of([r["results"][column[0]] for r in reports]) for column in COLUMNS]
            rows.append([name] + [column[2].format(figure) for column, figure in zip(COLUMNS, figures)] + (total if name in ("mean", "highest") else blank))
    rows.append(["error"] + [error_cell(row, reports, mean, c) for c, mean in zip(COLUMNS, means)] + blank)
    rows.append(["paper"] + [paper_cell(row, column) for column in COLUMNS] + blank)
    if len(reports) > 2:
        rows.append(["place"] + [place_cell(row, reports, column) for column in COLUMNS] + blank)
    widths = [max(len(cells[i]) for cells in rows) for i in range(len(rows[0]))]
    lines = ["  ".join(cell.rjust(width) for cell, width in zip(cells, widths)).rstrip() for cells in rows]
    lines.insert(1, "-" * max(len(line) for line in lines))
    lines.insert(2 + len(reports), lines[1])
    return lines


def notes(row, reports):
    first = reports[0]
    out = []
    overlap = largest_error(reports, "largest_overlap_over_a")
    if overlap is not None:
        out.append(f"largest overlap of two particles: {overlap:.2g} a")
    stored = stored_errors(row)
    if stored and largest_error(reports, "d_c_relative") is None:
        out.append(f"error, from stored results of `make -C pipeline verify`: {stored['how']}")
    else:
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


def show(rows):
    for row, reports in rows.items():
        granules = "granule" if len(reports) == 1 else "granules"
        program = f"{reports[0]['program']} {reports[0]['version']}"
        print(f"{len(reports)} {row} {granules} ({published.GRANULES[row]['title']}), {program}\n")
        print("\n".join(table(row, reports) + [""] + notes(row, reports)) + "\n")
    print("mean: over the seeds (cpu s: the sum). spread: standard deviation between seeds. ±95%: half of the 95 % interval\n"
          "    of the mean; of two granules stand the lowest and the highest.\n"
          "error: numerical error, the largest of the seeds (?: not estimated).\n"
          "paper: Vasquez Giuliano et al. 2022, Table 2 and sections 3.1, 3.3, one realisation; place: where it lies\n"
          "    among ours, in spreads from the mean.")


def command_line():
    parser = arguments.parser(__doc__, "the table (default: printed)", required=False)
    arguments.add_groups(parser, "rows of Table 2, each with its reports of dryer", names=published.GRANULES, campaign=("dry", ".json"))
    return parser


def main(options):
    rows = {row: [read(name) for name in names] for row, names in options.groups.items()}
    with arguments.printing_to(options.out):
        show(rows)


if __name__ == "__main__":
    main(command_line().parse_args())
