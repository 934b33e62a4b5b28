#!/usr/bin/env python3
"""Builds Crumble at several processor levels with several compilers, warnings being errors, runs the tests where this processor
can, and prints a table."""

import argparse
import datetime
import os
import pathlib
import platform
import re
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
LEVELS = ["x86-64-v2", "x86-64-v3", "x86-64-v4", "native"]
COMPILERS = ["g++", "clang++"]
PROGRAMS = ["dryer", "agglomerate", "rigidstress", "breaker"]
SKIPPED = 77
# What a processor must have beyond the level before (x86-64 psABI, "Micro-architecture levels"), as Linux names it.
NEEDED = {
    "x86-64-v2": {"cx16", "lahf_lm", "popcnt", "sse4_1", "sse4_2", "ssse3"},
    "x86-64-v3": {"avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "xsave"},
    "x86-64-v4": {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"},
}
# These test the pipeline, at the level of build/release.
PIPELINE_TESTS = r"^pipeline\.[a-z]+$"


def cpu_info(name):
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        key, _, value = line.partition(":")
        if key.strip() == name:
            return value.strip()
    return ""


def levels_here(flags):
    """The levels that a processor with these flags runs."""
    here = ["native"]
    for level, needed in NEEDED.items():
        if not needed <= flags:
            break
        here.append(level)
    return here


def level_elsewhere(here):
    """The level that most users have and this processor is not at; None where there are no such levels."""
    if "x86-64-v2" not in here:
        return None
    return "x86-64-v3" if "x86-64-v4" in here else "x86-64-v4"


def run(*command):
    """Output, return code, wall and CPU seconds of a command."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.time()
    done = subprocess.run(command, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.stdout, done.returncode, time.time() - start, cpu


def first_line(*command):
    return subprocess.run(command, cwd=ROOT, text=True, capture_output=True).stdout.strip().partition("\n")[0]


def try_out(compiler, level, targets, tested, jobs):
    """One row of the table, and the output of what failed."""
    row = {"compiler": compiler, "level": level, "builds": "no", "warnings": "-", "CPU s": "-", "tests": "not run", "tests s": "-"}
    if shutil.which(compiler) is None:
        return {**row, "builds": "not installed"}, ""
    folder = ROOT / "build" / "portability" / f"{pathlib.Path(compiler).name}-{level}"
    output, code, _, _ = run("cmake", "-S", ".", "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                             "-DCMAKE_CXX_FLAGS_RELEASE=-O3 -DNDEBUG", f"-DCMAKE_CXX_COMPILER={compiler}",
                             f"-DCRUMBLE_MARCH={level}", "-DCMAKE_COMPILE_WARNING_AS_ERROR=ON",
                             "-DCMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE=PRE_TEST",
                             "-DHELP2MAN=HELP2MAN-NOTFOUND")  # manual pages are made by running the programs
    if code:
        return row, output
    output, code, _, cpu = run("cmake", "--build", str(folder), "-j", str(jobs), *(["--target", *targets] if targets else []),
                               "--", "-k", "0")
    row["warnings"] = str(len(set(re.findall(r"^.*\[-W.*\]$", output, re.M))))
    row["CPU s"] = f"{cpu:.0f}"
    if code:
        return row, output
    row["builds"] = "yes"
    if not tested:
        return row, ""
    output, _, wall, _ = run("ctest", "--test-dir", str(folder), "-j", str(jobs), "-E", PIPELINE_TESTS, "--output-on-failure")
    row["tests s"] = f"{wall:.0f}"
    counted = re.search(r"(\d+) tests failed out of (\d+)", output)
    if counted is None:
        return {**row, "tests": "none ran"}, output
    failed, total = int(counted[1]), int(counted[2])
    row["tests"] = f"{total - failed} of {total}"
    return row, output if failed else ""


def table(rows):
    names = list(rows[0])
    widths = [max(len(name), *(len(row[name]) for row in rows)) for name in names]
    lines = [names, ["-" * width for width in widths], *([row[name] for name in names] for row in rows)]
    return "\n".join("| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths)) + " |" for line in lines) + "\n"


def heading(compilers):
    lines = ["# Compilers and processor levels", "",
             "Programs and tests, compiled with warnings as errors. CPU s: of compiling what was out of date, all cores together;",
             "tests s: wall seconds. Tests run at each level that the processor has.", "",
             "- command: `" + " ".join([pathlib.Path(sys.argv[0]).name, *sys.argv[1:]]) + "`",
             "- commit: " + first_line("git", "describe", "--always", "--dirty"),
             "- date: " + datetime.date.today().isoformat(),
             f"- processor: {cpu_info('model name') or platform.machine()}, model {cpu_info('model')}, {os.cpu_count()} cores",
             *(f"- {compiler}: {first_line(compiler, '--version')}" for compiler in compilers if shutil.which(compiler)), ""]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--levels", nargs="+", choices=LEVELS, default=LEVELS)
    parser.add_argument("--compilers", nargs="+", default=COMPILERS, help="default: %(default)s")
    parser.add_argument("--no-tests", action="store_true", help="compile the tests, but do not run them")
    parser.add_argument("--elsewhere", action="store_true", help="only the programs, with the first compiler, at the level that this "
                        "processor is not at: v3 where it has AVX-512, else v4")
    parser.add_argument("-j", "--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("-o", "--output", type=pathlib.Path, help="write the table to this file, too")
    arguments = parser.parse_args()

    here = levels_here(set(cpu_info("flags").split()))
    levels, compilers, targets = arguments.levels, arguments.compilers, []
    if arguments.elsewhere:
        elsewhere = level_elsewhere(here)
        if elsewhere is None:
            print("this processor is at no level of x86-64: nothing to compile")
            return SKIPPED
        levels, compilers, targets = [elsewhere], compilers[:1], PROGRAMS

    rows = []
    for level in levels:
        for compiler in compilers:
            # Native is one of the levels, the tests of which run here already.
            repeated = level == "native" and len(levels) > 1
            tested = level in here and not repeated and not arguments.no_tests and not targets
            row, failure = try_out(compiler, level, targets, tested, arguments.jobs)
            rows.append(row)
            print(f"{compiler} {level}: builds {row['builds']}, tests {row['tests']}", file=sys.stderr, flush=True)
            if failure:
                print(failure, file=sys.stderr)
    text = heading(compilers) + table(rows)
    print(text)
    if arguments.output:
        arguments.output.parent.mkdir(parents=True, exist_ok=True)
        arguments.output.write_text(text)

    def holds(row):
        passed = re.fullmatch(r"(\d+) of (\d+)", row["tests"])
        return row["builds"] == "yes" and (row["tests"] == "not run" or (passed is not None and passed[1] == passed[2]))

    return 0 if all(map(holds, rows)) else 1


if __name__ == "__main__":
    sys.exit(main())
