"""Runs of the dryer side by side, and tables of what they gave: what the drying checks share."""

import concurrent.futures
import datetime
import json
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import sys

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[3]
DRYER = "build/release/bin/dryer"
SCENE = "pipeline/scenes/hollow.toml"
RESULTS = "pipeline/results/verify"

sys.path.insert(0, str(ROOT / "pipeline/report"))  # intervals and tables of the checks are those of the reports
from arguments import parser as parser_of  # noqa: E402
from table import write_csv  # noqa: E402

# Checks that measure CPU seconds run without the companion run that estimates the error, and keep two frames only.
BARE = {"error.estimate": "false", "output.frames": "0"}


def arguments(doc, seeds, rows=None):
    """rows: of Table 2, if the check has several and can do some of them."""
    parser = parser_of(doc)
    if rows:
        parser.add_argument("--rows", nargs="+", choices=rows, default=rows, help="of Table 2 (default: all)")
    parser.add_argument("--seeds", type=int, nargs="+", default=seeds, help="random starts (default: %(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="runs side by side (default: all processors)")
    return parser


def run(name, seed, settings, scene=SCENE):
    """Dries one droplet; what the report and the file say, the file's contacts counted at two gaps."""
    out = f"{RESULTS}/{name}-{seed}"
    command = [DRYER, scene, "--seed", str(seed), "--threads", "1", "--quiet", "--overwrite"]
    command += ["-o", f"{out}.h5", "--report", f"{out}.json"]
    for key, value in {**BARE, **settings}.items():
        command += ["--set", f"{key}={value}"]
    # A checkpoint of an interrupted run would make the CPU time too small.
    (ROOT / f"{out}.h5.checkpoint").unlink(missing_ok=True)
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}")
    report = json.loads((ROOT / f"{out}.json").read_text(encoding="utf-8"))
    results, seconds = report["results"], report["cpu_s"]
    print(f"  {name}, seed {seed}: {results['contacts']} contacts, {seconds:.1f} s", file=sys.stderr, flush=True)
    last = last_frame(ROOT / f"{out}.h5")
    within = {f"within_{gap}_a".replace(".", "_"): pairs_within(*last, gap) for gap in (0.02, 0.05)}
    overlap = report["errors"]["largest_overlap_over_a"]["value"]
    return {**results, **within, "overlap": overlap, "seed": seed, "cpu_s": seconds}


def last_frame(name):
    """Positions and radii, nm."""
    with h5py.File(name) as file:
        return file["particles/all/position/value"][-1], file["particles/all/radius"][:]


def pairs_within(position, radius, fraction):
    """Pairs with a gap below this fraction of the mean radius, bonded or not."""
    i, j = numpy.triu_indices(len(position), 1)
    gap = numpy.linalg.norm(position[i] - position[j], axis=1) - radius[i] - radius[j]
    return int(numpy.count_nonzero(gap < fraction * radius.mean()))


def diameter(position, radius):
    """d_c of section 3.1 of the paper for equal particles: twice the mean distance of the farthest tenth plus a radius."""
    r = numpy.sort(numpy.linalg.norm(position - position.mean(axis=0), axis=1))
    return 2 * (r[-max(1, (len(r) + 5) // 10):].mean() + radius[0])


def run_all(cases, seeds, jobs, scene=SCENE):
    """cases: {name: settings}. The runs of each name in the order of the seeds; the longest cases first keep both
    processors busy, so give them in that order."""
    (ROOT / RESULTS).mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        futures = {name: [pool.submit(run, name, seed, settings, scene) for seed in seeds] for name, settings in cases.items()}
        try:
            return {name: [future.result() for future in rows] for name, rows in futures.items()}
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def mean(rows, key):
    return statistics.fmean(row[key] for row in rows)


def spread(rows, key):
    """Standard deviation between the starts; nothing for a single one."""
    return statistics.stdev(row[key] for row in rows) if len(rows) > 1 else math.nan


def machine():
    """Date, processor, load and commit of the program, so that a table of CPU seconds can be judged later."""
    with open("/proc/cpuinfo", encoding="utf-8") as info:
        names = [line.split(":", 1)[1].strip() for line in info if line.startswith("model name")]
    version = subprocess.run([DRYER, "--version"], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout
    model = names[0] if names else "unknown processor"
    return (f"{datetime.date.today()}, {model}, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f}, "
            + " ".join(version.splitlines()[:2]))


def store(name, comment, heading, rows):
    """As CSV among the results, with what it is and on which machine it was found."""
    path = ROOT / RESULTS / name
    path.parent.mkdir(parents=True, exist_ok=True)
    write_csv(path, heading, rows, [comment, machine()])
    print(f"written: {path.relative_to(ROOT)}")


def judge(claims):
    """claims: [(text, holds)]. Prints each; ends the program with 1 if one does not hold."""
    for text, holds in claims:
        print(f"{'holds ' if holds else 'FAILED'}  {text}")
    if not all(holds for _, holds in claims):
        sys.exit(1)


def require_programs():
    if not shutil.which(str(ROOT / DRYER)):
        sys.exit(f"{DRYER} is missing; `make -C pipeline build` builds it")
