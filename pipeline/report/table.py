"""What all tables share: CSV files that are whole or absent, and Markdown."""

import csv

import whole


def write_csv(path, heading, rows, comments=(), keep=False):
    """keep: a file that holds this already stays as old as it is."""
    with whole.replacing(path, keep) as temporary, open(temporary, "w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {comment}\n" for comment in comments)
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heading)
        writer.writerows(rows)


def write_records(path, records):
    """Dictionaries with the same keys."""
    write_csv(path, records[0].keys(), (record.values() for record in records))


def markdown(heading, rows):
    """Aligned, to be read as it stands or put into a page."""
    rows = list(rows)
    widths = [max(len(row[k]) for row in [heading, *rows]) for k in range(len(heading))]
    line = lambda cells: "| " + " | ".join(cell.ljust(width) for cell, width in zip(cells, widths)) + " |"
    return "\n".join([line(heading), "|" + "|".join("-" * (width + 2) for width in widths) + "|", *map(line, rows)])


def print_markdown(heading, rows):
    print(markdown(heading, rows))
