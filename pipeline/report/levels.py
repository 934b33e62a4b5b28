#!/usr/bin/python3
"""CPU seconds of the programs built for x86-64-v3 (AVX2) and x86-64-v4 (AVX-512), in turn on one core of this machine.

Each run is repeated and the least CPU time taken; runs of the two levels alternate. The error is that which the report states, else what
its text says; "d_c or stress" shows what the numbers of the levels make of the same run: with noise runs part, their difference is then of
two realisations, not an error.

    levels.py --runs hollow "Pe = 10" --repeat 3
"""

import datetime
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import arguments
from table import print_markdown

ROOT = pathlib.Path(__file__).resolve().parents[2]
LEVELS = ["x86-64-v3", "x86-64-v4"]
NEEDED = {"x86-64-v3": {"avx2", "bmi2", "fma"}, "x86-64-v4": {"avx512f", "avx512bw", "avx512dq", "avx512vl"}}
BARE = ["--set", "error.estimate=false"]
SEED = ["--seed", "1"]
# name: program, arguments, result to compare
RUNS = {
    "hollow": ("dryer", ["pipeline/scenes/hollow.toml", *SEED], "d_c_nm"),
    "hollow, no estimate": ("dryer", ["pipeline/scenes/hollow.toml", *SEED, *BARE], "d_c_nm"),
    "Pe = 10": ("dryer", ["pipeline/scenes/intermediate.toml", *SEED, *BARE], "d_c_nm"),
    # A fifth of the lifetime of the paper's droplet, and a larger part of it with contacts.
    "Pe = 1 from 100 nm": ("dryer", ["pipeline/scenes/compact.toml", *SEED, *BARE, "--set", "droplet.radius=100e-9"], "d_c_nm"),
    "N = 1000": ("dryer", ["pipeline/scenes/large.toml", *SEED], "d_c_nm"),
    "breakup, tolerance 0.04": ("breaker", ["pipeline/scenes/breakup.toml", "data/hollow.h5", *BARE, "--set", "integrator.tolerance=0.04"],
                                "critical_stress_pa"),
    "rigidstress": ("rigidstress", ["pipeline/scenes/stress-elongation.toml", "data/hollow.h5"], None),
}


def command_line():
    parser = arguments.parser(__doc__, "the table (default: printed)", required=False)
    parser.add_argument("--levels", nargs="+", choices=LEVELS, default=LEVELS, help="default: those that this processor runs")
    parser.add_argument("--runs", nargs="+", choices=RUNS, default=list(RUNS), help="default: all")
    parser.add_argument("--repeat", type=int, default=2, help="times that each run is done (default: %(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="of the compiler (default: all processors)")
    return parser


def output(*command):
    return subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def processor():
    """Its name and what it can do."""
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    value = lambda key: next((line.split(":", 1)[1].strip() for line in text.splitlines() if line.startswith(key)), "")
    return value("model name") or "unknown processor", set(value("flags").split())


def folder(level):
    return ROOT / "build" / level


def build(level, jobs):
    done = subprocess.run(["cmake", "-S", ROOT, "-B", folder(level), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                           f"-DCRUMBLE_MARCH={level}"], stdout=subprocess.DEVNULL)
    programs = sorted({program for program, _, _ in RUNS.values()})
    if done.returncode or subprocess.run(["cmake", "--build", folder(level), "-j", str(jobs), "--target", *programs],
                                         stdout=sys.stderr).returncode:
        sys.exit(f"{level}: the programs do not build")


def run(level, name, scratch):
    """The report."""
    program, given, _ = RUNS[name]
    command = [folder(level) / "bin" / program, *given, "--threads", "1", "--quiet", "-o", scratch / "out.h5", "--report",
               scratch / "report.json"]
    for left in scratch.iterdir():  # a checkpoint, too
        left.unlink()
    done = subprocess.run(command, cwd=ROOT, env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    report = json.loads((scratch / "report.json").read_text(encoding="utf-8"))
    print(f"  {name}, {level}: {report['cpu_s']:.2f} s", file=sys.stderr, flush=True)
    return report


def error(report):
    """The first relative error of the report that has a value, else why there is none."""
    relative = {name: e for name, e in report["errors"].items() if name.endswith("_relative")}
    for name, e in relative.items():
        if e["value"] is not None:
            return f"{name.removesuffix('_relative')} {100 * e['value']:.2g} %"
    return next((e["how"] for e in relative.values()), "")


def row(name, levels, repeat, scratch):
    reports = [[run(level, name, scratch) for level in levels] for _ in range(repeat)]
    seconds = [min(of_level["cpu_s"] for of_level in times) for times in zip(*reports)]
    key = RUNS[name][2]
    return [name, *(f"{s:.3g}" for s in seconds), *([f"{seconds[0] / seconds[1]:.2f}"] if len(levels) > 1 else []),
            error(reports[0][0]), ", ".join(f"{report['results'][key]:.5g}" for report in reports[0]) if key else ""]


def main(options):
    model, flags = processor()
    levels = [level for level in LEVELS if level in options.levels and NEEDED[level] <= flags]
    if not levels:
        sys.exit(f"{model} runs none of {', '.join(options.levels)}")
    for level in levels:
        build(level, options.jobs)
    commit = output("git", "describe", "--always", "--dirty").strip()
    command = "make -C pipeline bench-levels"
    with tempfile.TemporaryDirectory(prefix="bench-levels-") as scratch, arguments.printing_to(options.out):
        print(f"{command}: commit {commit}, {datetime.date.today()}, {model}, load {os.getloadavg()[0]:.1f}\n")
        print_markdown(["run", *(f"CPU s, {level}" for level in levels), *(["ratio"] if len(levels) > 1 else []), "stated error",
                        "d_c nm or stress Pa"],
                       [row(name, levels, options.repeat, pathlib.Path(scratch)) for name in options.runs])


if __name__ == "__main__":
    main(command_line().parse_args())
