"""Plants the faults of faults.toml one at a time in a copy of the sources and tells which of them the tests do not notice.

    plant.py /tmp/faults                 # all of them: an hour or two on two cores
    plant.py /tmp/faults --only chebyshev

The copy is built in FOLDER/build. Prints a row for each fault as it is known, and keeps them in FOLDER/faults.csv: what stands there is not done again.
A fault is caught by the first test program that fails, ends by a signal, takes longer than ten minutes, or does not compile. Ends with 1 if one in twenty
or more is not caught.
"""
import argparse
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import time
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
COPIED = ("CMakeLists.txt", "CMakePresets.json", "common", "dryer", "breaker", "rigidstress", "tests", "data", "pipeline")
COLUMNS = ("file", "old", "new", "caught_by", "seconds")


def faults():
    for group in tomllib.loads((pathlib.Path(__file__).parent / "faults.toml").read_text(encoding="utf-8"))["group"]:
        for fault in group["faults"]:
            yield fault | {"tests": group["tests"]}


def make_copy(folder):
    for name in COPIED:
        target = folder / "source" / name
        if target.exists():
            continue
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, target, ignore=shutil.ignore_patterns("results", "__pycache__"))
        else:
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target)
    subprocess.run(["cmake", "-S", folder / "source", "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"], check=True, stdout=subprocess.DEVNULL)


def build(folder, target):
    return subprocess.run(["cmake", "--build", folder / "build", "--target", target], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def passes(folder, program):
    run = [folder / "build/bin" / program, "--gtest_brief=1", "--gtest_fail_fast"]
    try:
        return subprocess.run(run, cwd=folder / "build", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=600).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def catcher(folder, tests):
    for program in tests:
        if not build(folder, program):
            return "compiler"
        if not passes(folder, program):
            return program
    return ""


def planted(folder, fault):
    """The name of who catches it; the source is put back."""
    path = folder / "source" / fault["file"]
    text = path.read_text(encoding="utf-8")
    if text.count(fault["old"]) != 1:
        sys.exit(f"plant.py: {fault['file']}: {fault['old']!r} stands there {text.count(fault['old'])} times, not once")
    try:
        path.write_text(text.replace(fault["old"], fault["new"]), encoding="utf-8")
        return catcher(folder, fault["tests"])
    finally:
        path.write_text(text, encoding="utf-8")


def known(table):
    if not table.exists():
        return {}
    with table.open(encoding="utf-8", newline="") as file:
        return {(row["file"], row["old"], row["new"]): row for row in csv.DictReader(file)}


def command_line():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER", help="where the copy is made and built")
    parser.add_argument("--only", default="", metavar="PART", help="faults in files whose path has this part")
    parser.add_argument("--check", action="store_true", help="only look whether each fault can be planted: its text stands in its file once")
    return parser.parse_args()


def check():
    wrong = [f"{f['file']}: {f['old']}" for f in faults() if (ROOT / f["file"]).read_text(encoding="utf-8").count(f["old"]) != 1]
    count = sum(1 for _ in faults())
    print("\n".join(wrong) or f"{count} faults can be planted")
    return 1 if wrong or count < 60 else 0


def main():
    given = command_line()
    if given.check:
        return check()
    os.environ["CTEST_OUTPUT_ON_FAILURE"] = "0"
    make_copy(given.folder)
    table = given.folder / "faults.csv"
    done = known(table)
    chosen = [f for f in faults() if given.only in f["file"]]
    for test in sorted({t for f in chosen for t in f["tests"]}):
        if not build(given.folder, test) or (not done and not passes(given.folder, test)):
            sys.exit(f"plant.py: {test} fails without any fault")
    for fault in chosen:
        if (fault["file"], fault["old"], fault["new"]) in done:
            continue
        begin = time.monotonic()
        row = {k: fault[k] for k in ("file", "old", "new")} | {"caught_by": planted(given.folder, fault), "seconds": f"{time.monotonic() - begin:.0f}"}
        done[fault["file"], fault["old"], fault["new"]] = row
        first = not table.exists()
        with table.open("a", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS)
            if first:
                writer.writeheader()
            writer.writerow(row)
        print(f"{row['caught_by'] or 'NOT CAUGHT':24} {fault['file']}: {fault['old']} -> {fault['new']}", flush=True)
    rows = [done[f["file"], f["old"], f["new"]] for f in chosen]
    missed = [r for r, f in zip(rows, chosen) if not r["caught_by"] and "reason" not in f]
    print(f"{len(rows) - len(missed)} of {len(rows)} faults are caught or told to be none")
    return 1 if 20 * len(missed) > len(rows) else 0


if __name__ == "__main__":
    sys.exit(main())
