"""Campaigns on a cluster: munged, slurmctld and slurmd from Debian's packages, as plain processes on loopback, run small campaigns.

A task is killed, the node is drained and goes down, a job is put back into the queue: each time the failure has to be reported, nothing half-written
may stay, and a rerun has to end with the bits of a run without a cluster. Then the cost of a task, from as many that do nothing. The table goes to
cluster.md. Ends with 77 where packages are missing.

    cluster.py --tasks 1000 -o results/verify
"""

import datetime
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "pipeline/report"), str(ROOT / "pipeline/verify/cluster")]
import arguments  # noqa: E402
import slurm  # noqa: E402
from slurm import until  # noqa: E402

import h5py  # noqa: E402
import numpy  # noqa: E402

CPUS = 2
CAMPAIGN = """seeds = 6

[dry]
scene = "{root}/pipeline/scenes/hollow.toml"
set = {{"particle.number" = 80, "droplet.radius" = 190.5e-9}}

[stress]
scene = "{root}/pipeline/scenes/stress-elongation.toml"
set = {{"particle.fragments" = "each", "hydrodynamics.method" = "fts"}}
flows = ["elongation"]
"""
TASKS = """SHELL := {shell}
.SHELLFLAGS := -euo pipefail -c
all: $(addprefix {folder}/,{names})
{folder}/%:
\t@: > $@
"""


class Verdicts:
    def __init__(self):
        self.lines, self.failed = [], False

    def claim(self, words, holds, seen):
        self.failed |= not holds
        self.lines.append(f"| {words} | {'yes' if holds else '**no**'} | {seen} |")
        print(self.lines[-1], flush=True)


class Campaigns:
    """One campaign, run in several ways into folders of their own."""

    def __init__(self, folder, programs, cluster):
        self.folder, self.programs, self.cluster = folder, programs, cluster
        self.path = folder / "small.toml"
        self.path.write_text(CAMPAIGN.format(root=ROOT))

    def words(self, name, *more):
        return ["make", "-C", ROOT / "pipeline", "campaign", f"CAMPAIGN={self.path}", f"OUT={self.folder / name}", f"BUILD={os.path.relpath(self.programs.parent, ROOT / 'pipeline')}", *more]

    def local(self, name):
        return self.cluster.call(*self.words(name, "-j2"))

    def start(self, name):
        run = subprocess.Popen([str(word) for word in self.words(name, "-j4", "CLUSTER=slurm")], env=self.cluster.environment, text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.cluster.started.append(run)
        return run

    def running(self, name, program="", cpu=0.0):
        """Processes of programs, or of one, that write into this folder, children of Slurm's step daemon, and that took so many seconds."""
        found = []
        for place in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (place / "cmdline").read_bytes().split(b"\0")
                state = (place / "stat").read_text().rpartition(")")[2].split()
                parent, used = int(state[1]), (int(state[11]) + int(state[12])) / os.sysconf("SC_CLK_TCK")
                if pathlib.Path(words[0].decode()).name in ((program,) if program else ("dryer", "rigidstress")) and used >= cpu and any(str(self.folder / name) in word.decode() for word in words) and \
                        "slurmstepd" in pathlib.Path(f"/proc/{parent}/comm").read_text():
                    found.append(int(place.name))
            except (OSError, ValueError, UnicodeDecodeError):
                continue
        return found

    def contents(self, name):
        """{file: what it holds} but for what differs between any two runs: when and where it was made, and how long it took."""
        found = {}
        for path in sorted((self.folder / name).rglob("*.h5")):
            found[path.relative_to(self.folder / name)] = values = {}

            def keep(place, node, values=values):
                if "provenance" in place:
                    return
                values.update({f"{place} {key}": bits(value) for key, value in node.attrs.items()})
                if isinstance(node, h5py.Dataset):
                    values[place] = bits(node[()])
            with h5py.File(path) as file:
                file.visititems(keep)
        return found

    def names(self, name):
        return sorted(str(path.relative_to(self.folder / name)) for stage in ("dry", "stress") for path in (self.folder / name / stage).glob("*"))

    def half_written(self, name):
        """Files that look finished and are not."""
        bad = []
        for path in (self.folder / name).rglob("*.h5"):
            valid = self.cluster.call(self.programs / "agglomerate", "check", path).returncode == 0
            if not valid or not path.with_suffix(".json").is_file():
                bad.append(path.name)
        return bad

    def table(self, name):
        path = self.folder / name / "granules.csv"
        return path.read_text() if path.exists() else ""


def bits(value):
    """What is stored, of strings and references their text."""
    value = numpy.asarray(value)
    return repr(value.tolist()) if value.dtype.hasobject else value.tobytes()


def made_now(text):
    return int(found[1]) if (found := re.search(r"(\d+) runs made now", text)) else None


def nothing_half_written(campaigns, name, verdicts):
    verdicts.claim("nothing half-written stays", not campaigns.half_written(name), f"{len(campaigns.contents(name))} files of 12, each valid with its report")


def same_bits(campaigns, name, verdicts, how):
    again = campaigns.start(name)
    said = again.communicate()[0]
    same = campaigns.contents(name) == campaigns.contents("local")
    left = set(campaigns.names(name)) ^ set(campaigns.names("local"))
    verdicts.claim(f"{how}: a rerun ends with the bits of the local run, and no other file", again.returncode == 0 and same and not left,
                   f"exit code {again.returncode}, {made_now(said)} of 12 runs made in it")


def killed(campaigns, verdicts):
    run = campaigns.start("killed")
    os.kill(until(lambda: campaigns.running("killed"), "running task")[0], signal.SIGKILL)
    said = run.communicate()[0]
    failed = [line.rpartition(",")[2] for line in campaigns.table("killed").splitlines() if "exit code" in line]
    verdicts.claim("a task killed with SIGKILL is reported, the others are made", run.returncode == 2 and len(failed) == 1 and "Failed:" in said,
                   f"exit code {run.returncode}; {(re.findall(r'exit code .*', campaigns.table('killed')) or ['nothing said'])[0]}".replace('"', ""))
    nothing_half_written(campaigns, "killed", verdicts)
    same_bits(campaigns, "killed", verdicts, "killed")


def drained(campaigns, verdicts):
    cluster = campaigns.cluster
    run = campaigns.start("drained")
    until(lambda: campaigns.running("drained"), "running task")
    cluster.state("drain")
    until(lambda: not campaigns.running("drained") and not cluster.jobs("-t", "R,CG"), "end of what runs")
    waiting = len(cluster.jobs("-t", "PD"))
    run.terminate()
    said = run.communicate(timeout=300)[0]
    until(lambda: not cluster.jobs(), "empty queue")
    verdicts.claim("a drained node ends what it runs and takes nothing new; make stopped by SIGTERM leaves no job in the queue", waiting > 0 and run.returncode != 0,
                   f"{waiting} jobs waited; make: {(re.findall(r'Error.*|Terminated.*', said) or ['?'])[-1]}")
    nothing_half_written(campaigns, "drained", verdicts)
    cluster.state("resume")
    same_bits(campaigns, "drained", verdicts, "drained")


def down(campaigns, verdicts):
    cluster = campaigns.cluster
    run = campaigns.start("down")
    until(lambda: campaigns.running("down"), "running task")
    cluster.state("down")
    until(lambda: not campaigns.running("down"), "end of the tasks")
    cluster.state("resume")
    run.communicate()
    words = re.findall(r"exit code [^,\n]*", campaigns.table("down"))
    verdicts.claim("a node that goes down with its tasks is reported", run.returncode == 2 and bool(words), f"exit code {run.returncode}; {len(words)} failed: {words[:1]}")
    nothing_half_written(campaigns, "down", verdicts)
    same_bits(campaigns, "down", verdicts, "down")


def submit(campaigns, *words):
    done = campaigns.cluster.call("sbatch", "--parsable", f"--output={campaigns.folder}/%j.out", *words, cwd=ROOT)
    return done.stdout.strip()


def batch(campaigns, verdicts, name):
    """sbatch.sh, put back into the queue while it runs."""
    cluster = campaigns.cluster
    job = submit(campaigns, f"--ntasks={CPUS}", ROOT / "pipeline/cluster/sbatch.sh", *campaigns.words(name)[3:])
    until(lambda: campaigns.running(name, "dryer", 0.1), "running task with something to go on from")
    cluster.call("scontrol", "requeue", job)
    until(lambda: not campaigns.running(name), "end of the tasks")
    kept = len(list((campaigns.folder / name).rglob("*.checkpoint")))
    until(lambda: "PENDING" in cluster.says("squeue", "-h", "-j", job, "-o", "%T"), "job in the queue again")
    cluster.call("scontrol", "update", f"jobid={job}", "starttime=now")
    until(lambda: not cluster.jobs("-j", job, "-t", "PD,R,CG,CF"), "end of the job", 900)
    said = (campaigns.folder / f"{job}.out").read_text()
    same = campaigns.contents(name) == campaigns.contents("local") and set(campaigns.names(name)) == set(campaigns.names("local"))
    verdicts.claim("sbatch.sh: a job that is put back into the queue goes on from its checkpoints and ends with the bits of the local run", same and kept > 0,
                   f"{kept} checkpoints; {made_now(said)} of 12 runs made after it")


def array(campaigns, verdicts):
    job = submit(campaigns, "--array=1-3%2", ROOT / "pipeline/cluster/array.sh", campaigns.path, "-o", campaigns.folder / "array", "--programs", campaigns.programs)
    until(lambda: not campaigns.cluster.jobs("-j", job, "-t", "PD,R,CG,CF"), "end of the array", 900)
    said = campaigns.cluster.call(*campaigns.words("array")).stderr
    verdicts.claim("array.sh: three jobs make all files, make the tables; the bits are those of the local run", made_now(said) == 0 and
                   campaigns.contents("array") == campaigns.contents("local"), f"{made_now(said)} of 12 runs left to make")


def allocation(campaigns, verdicts):
    done = campaigns.cluster.call(ROOT / "pipeline/cluster/salloc.sh", CPUS, *campaigns.words("allocation")[3:])
    verdicts.claim("salloc.sh: steps of one allocation make all; the bits are those of the local run",
                   done.returncode == 0 and campaigns.contents("allocation") == campaigns.contents("local"), f"exit code {done.returncode}, {made_now(done.stderr)} runs")


def overhead(folder, cluster, tasks, verdicts):
    """Seconds a task, wall and of all processes' CPU but the daemons'."""
    for words, shell, before, side in (("make alone", "/bin/bash", [], CPUS), ("jobs: make -j8 CLUSTER=slurm", ROOT / "pipeline/cluster/slurm", [], 8),
                                       (f"steps in salloc -n{CPUS}", ROOT / "pipeline/cluster/slurm", ["salloc", "--quiet", f"-n{CPUS}"], CPUS)):
        place = folder / "tasks"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir()
        (folder / "tasks.mk").write_text(TASKS.format(shell=shell, folder=place, names=" ".join(map(str, range(tasks)))))
        load, start, cpu = os.getloadavg()[0], time.monotonic(), os.times()
        done = cluster.call(*before, "make", "-s", f"-j{side}", "-f", folder / "tasks.mk")
        seconds, now = time.monotonic() - start, os.times()
        used = now.children_user + now.children_system - cpu.children_user - cpu.children_system
        verdicts.claim(f"{tasks} tasks that do nothing, {words}", done.returncode == 0 and len(list(place.iterdir())) == tasks,
                       f"{seconds / tasks:.3f} s a task, {used / tasks:.4f} s of CPU where make runs; {seconds:.0f} s in all, load {load:.0f} before")


def provenance():
    git = lambda *words: subprocess.run(["git", "-C", ROOT, *words], text=True, capture_output=True).stdout.strip()
    from levels import processor
    return f"Commit {git('rev-parse', '--short', 'HEAD')}, {datetime.date.today()}, {processor()[0]}, {os.cpu_count()} cores; {subprocess.run(['slurmd', '-V'], text=True, capture_output=True, env={'PATH': slurm.PATH}).stdout.strip()}."


def command_line():
    parser = arguments.parser(__doc__, "where cluster.md goes", metavar="FOLDER", default=ROOT / "pipeline/results/verify")
    parser.add_argument("--only", choices=["campaigns", "tasks"], help="one part alone: campaigns, or tasks that do nothing")
    parser.add_argument("--tasks", type=int, default=1000, help="tasks that do nothing (default: %(default)s)")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin", help="folder of the programs (default: %(default)s)")
    return parser


def main():
    options = command_line().parse_args()
    if missing := slurm.missing():
        print(f"not tried: Debian packages are missing: {', '.join(missing)} (pipeline/packages.sh cluster)", file=sys.stderr)
        return 77
    verdicts = Verdicts()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # the daemons end with it
    with tempfile.TemporaryDirectory(prefix="crumble-cluster-") as temporary:
        folder = pathlib.Path(temporary)
        with slurm.Slurm(folder / "slurm", CPUS) as cluster:
            if options.only != "campaigns":
                overhead(folder, cluster, options.tasks, verdicts)
            if options.only != "tasks":
                campaigns_hold(Campaigns(folder, options.bin.resolve(), cluster), verdicts)
    write(options, verdicts)
    return 1 if verdicts.failed else 0


def campaigns_hold(campaigns, verdicts):
    verdicts.claim("a local run makes all", campaigns.local("local").returncode == 0, f"{len(campaigns.contents('local'))} files of 12")
    run = campaigns.start("plain")
    run.communicate()
    verdicts.claim("CLUSTER=slurm changes nothing else: the bits are those of the local run", run.returncode == 0 and campaigns.contents("plain") == campaigns.contents("local"),
                   f"exit code {run.returncode}")
    for check in (killed, drained, down):
        check(campaigns, verdicts)
    batch(campaigns, verdicts, "batch")
    array(campaigns, verdicts)
    allocation(campaigns, verdicts)


def write(options, verdicts):
    options.out.mkdir(parents=True, exist_ok=True)
    command = " ".join(["/usr/bin/python3 pipeline/verify/cluster.py", *([f"--only {options.only}"] if options.only else []), f"--tasks {options.tasks}"])
    text = "\n".join(["# Campaigns on a cluster", "", f"`{command}`. {provenance()}", "", "| claim | holds | seen |", "|---|---|---|", *verdicts.lines, ""])
    (options.out / "cluster.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
