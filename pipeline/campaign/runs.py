"""The runs of a campaign: side by side, each once, going on after any interruption.

A run is finished if its file, under the name of its identity, holds the scene that is asked for and the parent as it is now, and its
report stands beside it. An unfinished one is given to its program again, which goes on from the checkpoint if there is one.
"""

import collections
import concurrent.futures
import dataclasses
import hashlib
import os
import signal
import subprocess
import sys
import threading
import time
import tomllib

import h5py

import scene_text
import whole
from plan import PROGRAMS
from scene_text import Fault

CLUSTER_WORDS = ("srun: ", "slurmstepd: ")  # what Slurm adds to the words of a program


@dataclasses.dataclass
class Failure:
    stage: str
    code: int
    words: str


def sha256(path):
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


class Runs:
    def __init__(self, folder, programs, launcher=(), fresh=False):
        """launcher: words before every program, as of a cluster; fresh: what is older than its program is made again."""
        self.folder, self.programs, self.launcher, self.fresh = folder, programs, list(launcher), fresh
        self.lock, self.running, self.stopped = threading.Lock(), set(), None
        self.making = collections.defaultdict(threading.Lock)  # id: a granule that two points share is made once
        self.failures = {}  # id -> Failure
        self.messages = collections.Counter()  # line that runs which ended well said -> of how many
        self.described = set()  # kinds of granules
        self.done = 0       # runs made now

    def path(self, run, ending=".h5"):
        return self.folder / run.stage / f"{run.id}{ending}"

    def is_finished(self, run):
        file, report = self.path(run), self.path(run, ".json")
        if not file.is_file() or not report.is_file() or report.stat().st_mtime_ns < file.stat().st_mtime_ns:
            return False
        if self.fresh and file.stat().st_mtime_ns < (self.programs / PROGRAMS[run.stage]).stat().st_mtime_ns:
            return False
        try:
            with h5py.File(file) as found:
                scene = tomllib.loads(found["parameters/input"].asstr()[()])
                parent = found["parameters/provenance"].attrs.get("parent_sha256")
        except (OSError, KeyError, tomllib.TOMLDecodeError):
            return False
        return scene_text.canonical(scene) == scene_text.canonical(run.scene) and (
            run.parent is None or (self.path(run.parent).is_file() and parent == sha256(self.path(run.parent))))

    def command(self, run, *more):
        parent = [str(self.path(run.parent))] if run.parent else []
        return [*self.launcher, str(self.programs / PROGRAMS[run.stage]), str(self.path(run, ".toml")), *parent, *more]

    def write_scene(self, run, heading):
        path = self.path(run, ".toml")
        path.parent.mkdir(parents=True, exist_ok=True)
        text = scene_text.write(run.scene, heading)
        if not path.is_file() or path.read_text() != text:
            whole.write_text(path, text)

    def make(self, realisation):
        """All runs of a granule; those after one that failed are left out. Whether any had to be made."""
        started = False
        for run in realisation.runs:
            with self.lock:
                making = self.making[run.id]
            with making:
                if self.stopped is not None:
                    break
                if run.id in self.failures or (run.parent is not None and run.parent.id in self.failures):
                    continue
                if not self.is_finished(run):
                    self.write_scene(run, [f"{run.stage} {run.id}, granule {realisation.replicate + 1} of its point",
                                           *(f"{key} = {value}" for key, value in realisation.point.items())])
                    self.start(run)
                    started = True
        return started

    def start(self, run):
        command = self.command(run, "-o", str(self.path(run)), "--report", str(self.path(run, ".json")), "--threads", "1",
                               "--overwrite", "--quiet")
        with self.lock:
            if self.stopped is not None:
                return
            # In a group of its own: Ctrl-C is told to it by us, once.
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                       errors="replace", start_new_session=True, env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
            self.running.add(process)
        said = process.communicate()[1]
        there = process.returncode == 0 and self.appears(run)
        with self.lock:
            self.running.discard(process)
            if self.stopped is not None:
                return
            self.done += 1
            lines = said.strip().splitlines()
            own = [line for line in lines if not line.startswith(CLUSTER_WORDS)]
            if process.returncode or not there:
                self.path(run, ".json").unlink(missing_ok=True)  # whatever it left is not finished
                self.failures[run.id] = Failure(run.stage, process.returncode, (own or lines or ["said nothing" if process.returncode else "ended well and left no file"])[-1])
            else:
                self.messages.update(own)

    def appears(self, run):
        """srun ends with 0 where its node went down; and a shared disk may show late what another node wrote."""
        for _ in range(100 if self.launcher else 1):
            if all(self.path(run, ending).is_file() for ending in (".h5", ".json")):
                return True
            time.sleep(0.1)
        return False

    def stop(self, signum, _=None):
        with self.lock:
            self.stopped = signum
            for process in self.running:
                # Leaves a checkpoint. srun hands SIGINT on to its task, and kills it on SIGTERM.
                process.send_signal(signal.SIGINT if self.launcher else signal.SIGTERM)

    def make_all(self, realisations, jobs, say):
        was = {one: signal.signal(one, self.stop) for one in (signal.SIGINT, signal.SIGTERM)}
        try:
            with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
                waiting = [pool.submit(self.make, one) for one in realisations]
                found = 0
                for number, one in enumerate(concurrent.futures.as_completed(waiting), 1):
                    found += not one.result()
                    say(number, len(waiting), number - found)
        finally:
            for one, handler in was.items():
                signal.signal(one, handler)
        if self.stopped is not None:
            complete = sum(all(self.is_finished(run) for run in one.runs) for one in realisations)
            print(f"stopped; {complete} of {len(realisations)} granules are there, the others go on from where they are with the same command", file=sys.stderr)
            raise SystemExit(128 + self.stopped)

    def check(self, realisation, granule):
        """The scenes of one point are right before anything runs; granule: any, for the stages that take one. What each scene means is said once."""
        for run in realisation.runs:
            if self.is_finished(run):
                continue
            self.write_scene(run, [f"{run.stage} {run.id}"])
            command = [str(self.programs / PROGRAMS[run.stage]), str(self.path(run, ".toml")), *([str(granule)] if run.parent else []), "--check"]
            done = subprocess.run(command, text=True, capture_output=True)
            if not done.returncode and not run.parent and realisation.kind not in self.described:
                self.described.add(realisation.kind)
                print(done.stderr, end="", file=sys.stderr)
            if done.returncode == 2:
                words = done.stderr.strip().splitlines()
                point = ", ".join(f"{key} = {value}" for key, value in realisation.point.items()) or "the base scene"
                raise Fault(f"[{run.stage}] at {point}: {words[-1] if words else 'refused'}")
