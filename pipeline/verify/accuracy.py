#!/usr/bin/python3
"""Writes the pages ACCURACY.md: measured tables, each with its command, commit, date and processor.

From anywhere; programs are those of build/release. A page is declared in accuracy/PAGE.toml. Only the tables that are named are measured again; all others stay as they are on the page,
with the head under which they were measured. Without a name nothing is measured: texts are renewed and all tables are listed.

A declaration has `page` (path of the file), `title`, `about`, `closing` (Markdown before and after the tables) and one [[table]] for each question:

    name, question, text    text says how it was measured and what the columns are, in Markdown
    cost                    what it takes, in words
    target                  built before, if it is none of the four programs
    command                 run by bash in the top folder, one thread unless it says otherwise; with
      starting = ["| N |"]  of its output the Markdown tables whose heading begins so; without it all of them
    command, csv            the command writes a CSV file into the folder {out}: that is the table
    command, rows, columns  the command is run once a row, with the row's arguments; the row's numbers come from the report {out}.json
      rows = [{name = "seed 1", arguments = "--seed 1"}]
      columns = [["d_c, nm", "results.d_c_nm", ".2f"]]        heading, place in the report, Python's format; a fourth entry "percent":
                            the difference to the row that `reference` names, in per cent of it
    file, command, processor    a stored file that the command wrote; commit and date are those of its last change. Markdown and CSV as
                            they are, JSON by `columns`, one row a key

    accuracy.py dryer.methods dryer.continuum
"""

import csv
import datetime
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECLARED = pathlib.Path(__file__).resolve().parent / "accuracy"

sys.path.insert(0, str(ROOT / "pipeline/report"))
import arguments  # noqa: E402
import whole  # noqa: E402
from table import markdown  # noqa: E402

BEGIN, END = "<!-- measured: {} -->", "<!-- end -->"
# What decides a result: the programs and the scenes. The commit of a table is the last that changed one of them.
SOURCES = ["CMakeLists.txt", "CMakePresets.json", "common", "dryer", "breaker", "rigidstress", "pipeline/scenes", ":!*.md"]


def git(*arguments):
    done = subprocess.run(["git", "-C", ROOT, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return done.stdout.strip() if done.returncode == 0 else ""


def commit():
    found = git("log", "-1", "--format=%h", "--", *SOURCES) or "unknown"
    return found + (" and changes" if git("status", "--porcelain", "--untracked-files=no", "--", *SOURCES) else "")


def processor():
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    return next((line.split(":", 1)[1].strip() for line in text.splitlines() if line.startswith("model name")), "unknown processor")


def child_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def head(command, commit, date, processor, remark=""):
    return f"    {command}\n\nCommit {commit}, {date}, {processor}{remark}."


def run(command, messages=None):
    """What it prints. messages: where its messages go."""
    print(f"  {command}", file=sys.stderr, flush=True)
    environment = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"} | dict(os.environ)
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=ROOT, env=environment, stdout=subprocess.PIPE, stderr=messages, text=True)
    if done.returncode:
        sys.exit(f"exit code {done.returncode}: {command}\n{done.stderr or ''}")
    return done.stdout


def tables(text, starting):
    """The Markdown tables of a text; if their beginnings are given, those in that order."""
    found = re.findall(r"(?m)(?:^\|.*\n?)+", text)
    if starting:
        found = [next((t for t in found if t.startswith(s)), None) or sys.exit(f"no table begins with '{s}'") for s in starting]
    return "\n\n".join(t.strip() for t in found) or sys.exit("there is no table in what the command printed")


def at(report, place):
    for key in place.split("."):
        report = report[int(key) if isinstance(report, list) else key]
    return report


def cell(column, report, reference):
    _, place, form, *percent = column
    value = at(report, place)
    if value is None:
        return ""
    if percent:
        if report is reference:
            return ""
        value = 100 * (value / at(reference, place) - 1)
    return format(value, form)


def of_reports(table, reports, last=None):
    """reports: by the name of the row; last: heading and cells of a last column."""
    heading = [table.get("row", ""), *(column[0] for column in table["columns"]), *([last[0]] if last else [])]
    reference = reports.get(table.get("reference"))
    return markdown(heading, [[name, *(cell(column, report, reference) for column in table["columns"]), *([last[1][name]] if last else [])]
                              for name, report in reports.items()])


def run_rows(table):
    reports = {}
    with tempfile.TemporaryDirectory(prefix="accuracy-") as scratch:
        for k, row in enumerate(table["rows"]):
            out = f"{scratch}/{k}"
            run(f"{table['command']} {row['arguments']}".replace("{out}", out), subprocess.PIPE)
            reports[row["name"]] = json.loads(pathlib.Path(f"{out}.json").read_text(encoding="utf-8"))
    arguments = {row["name"]: f"`{row['arguments']}`" if row["arguments"] else "" for row in table["rows"]}
    return of_reports(table, reports, ("arguments", arguments))


def of_csv(text):
    heading, *rows = csv.reader(line for line in text.splitlines() if not line.startswith("#"))
    return markdown(heading, rows)


def run_csv(table):
    with tempfile.TemporaryDirectory(prefix="accuracy-") as out:
        run(table["command"].replace("{out}", out), subprocess.PIPE)
        return of_csv((pathlib.Path(out) / table["csv"]).read_text(encoding="utf-8"))


def from_file(table):
    path = ROOT / table["file"]
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".json":
        return of_reports(table, json.loads(text))
    if path.suffix == ".csv":
        return of_csv(text)
    return tables(text, table.get("starting"))


def measure(table):
    """Head and table. The commit is looked up first: the run may take long."""
    if "file" in table:
        changed = git("log", "-1", "--format=%h %cs", "--", table["file"]) or "unknown unknown"
        return head(table["command"], *changed.split(), table["processor"], f"; stored in `{table['file']}`") + "\n\n" + from_file(table)
    now, load, before = commit(), os.getloadavg()[0], child_seconds()
    if "target" in table:
        subprocess.run(["cmake", "--build", ROOT / "build/release", "--target", table["target"]], check=True, stdout=sys.stderr)
        before = child_seconds()
    if "rows" in table:
        body = run_rows(table)
    else:
        body = run_csv(table) if "csv" in table else tables(run(table["command"]), table.get("starting"))
    shown = table["command"].replace("{out}", "out") + (" ARGUMENTS" if "rows" in table else "")
    return head(shown, now, datetime.date.today(), processor(),
                f", load {load:.1f}; all of it took {child_seconds() - before:.3g} s of CPU") + "\n\n" + body


def kept(page):
    """What was measured before: table by name."""
    return dict(re.findall(r"(?s)" + BEGIN.format(r"(\S+)") + r"\n(.*?)\n" + END, page))


def full_name(name, table):
    return f"{name}.{table['name']}"


def render(name, declared, measured):
    parts = [f"# {declared['title']}",
             f"Written by `make -C pipeline accuracy` from `pipeline/verify/accuracy/{name}.toml`. Only the tables that it is asked for are measured\n"
             f"again, for example with `RUN={full_name(name, declared['table'][0])}`; all others stay with the head under which they were measured. The commit is the\n"
             "last one before the measurement that changed a program or a scene.", declared.get("about", "").strip()]
    waiting = []
    for table in declared["table"]:
        again = f"make -C pipeline accuracy RUN={full_name(name, table)}"
        if body := measured.get(table["name"]):
            parts += [f"## {table['question']}", table.get("text", "").strip(), BEGIN.format(table["name"]) + "\n" + body + "\n" + END]
        else:
            waiting.append(f"- {table['question']} `{again}`" + (f" ({table['cost']})" if "cost" in table else ""))
    parts.append(declared.get("closing", "").strip())
    if waiting:
        parts += ["## Not measured with these programs yet", "\n".join(waiting)]
    return "\n\n".join(part for part in parts if part) + "\n"


def declarations():
    return {path.stem: tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(DECLARED.glob("*.toml"))}


def write(path, text):
    whole.write_text(path, text)


def main(asked):
    pages = declarations()
    known = {full_name(name, table) for name, declared in pages.items() for table in declared["table"]}
    if unknown := [name for name in asked if name not in known and name not in pages]:
        sys.exit(f"no such table: {', '.join(unknown)}; there are {', '.join(sorted(known))}")
    for name, declared in pages.items():
        path = ROOT / declared["page"]
        measured = kept(path.read_text(encoding="utf-8")) if path.exists() else {}
        for table in declared["table"]:
            if name in asked or full_name(name, table) in asked:
                print(full_name(name, table), file=sys.stderr, flush=True)
                measured[table["name"]] = measure(table)
                write(path, render(name, declared, measured))  # at once: the next table may fail
            state = re.search(r"(?m)^Commit .*$", measured.get(table["name"], ""))
            if not asked:
                print(f"{full_name(name, table):32} {state[0] if state else 'not measured yet'}")
        write(path, render(name, declared, measured))


def command_line():
    parser = arguments.parser(__doc__)
    parser.add_argument("asked", nargs="*", metavar="PAGE.TABLE", help="tables to measure again; PAGE means all of its tables")
    return parser


if __name__ == "__main__":
    main(command_line().parse_args().asked)
