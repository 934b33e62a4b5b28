"""Runs that are killed, stopped twice, or whose checkpoint is damaged: nothing is lost, nothing goes on to other numbers.

    killed_runs.py FOLDER_OF_THE_PROGRAMS SCENES DATA [--seed N] [--kills N]

Every scene runs undisturbed once. Then it is ended at random moments by SIGKILL, by SIGTERM and SIGKILL some
milliseconds later, or by SIGINT twice, and the same command started again until it ends with 0: the file must hold the
same bits. Without --kills a few times each, as in CI.
"""
import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import numpy

from program_runs import contents

parser = argparse.ArgumentParser()
parser.add_argument("programs", type=lambda p: pathlib.Path(p).resolve())
parser.add_argument("scenes", type=lambda p: pathlib.Path(p).resolve())
parser.add_argument("data", type=lambda p: pathlib.Path(p).resolve())
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--kills", type=int, default=20)
options = parser.parse_args()
choose = random.Random(options.seed)

# In memory: a checkpoint may take a part in two hundred of the time, and a disk would leave few of them a second.
memory = pathlib.Path("/dev/shm")
folder = pathlib.Path(tempfile.mkdtemp(prefix="killed-", dir=memory if os.access(memory, os.W_OK) else None))
LATENCY = 5.0  # s: ten times what is aimed at, for a machine with other work


def settings(*words):
    return [w for word in words for w in ("--set", word)]


def dryer(*words):
    return [options.programs / "dryer", folder / "scene.toml", "-o", "o.h5", "--threads", 1,
            *settings("output.checkpoint_interval=0.01", *words)]


def breaker(threads, *words):
    return [options.programs / "breaker", options.scenes / "breakup.toml", "chain.h5", "-o", "o.h5", "--threads", threads,
            *settings("output.checkpoint_interval=0.01", "fluid.viscosity=1e-3", *words)]


def rigidstress(*words, agglomerate="chain.h5"):
    return [options.programs / "rigidstress", options.scenes / "stress-elongation.toml", agglomerate, "-o", "o.h5",
            "--threads", 1, *settings("output.checkpoint_interval=0.01", *words)]


RUNS = {
    "dryer, with its error estimate": dryer("particle.number=40"),
    "dryer, Brownian motion": dryer("particle.brownian_motion=true", "particle.number=8", "droplet.radius=80e-9"),
    "dryer, implicit": dryer("integrator.method=implicit", "particle.number=40", "error.estimate=false"),
    "breaker, beside its companion": breaker(2),
    "breaker, then its companion": breaker(1),
    "rigidstress": rigidstress("flow.orbits=60", "flow.uniaxial=true", "flow.starts=512", "hydrodynamics.method=multipole"),
}


def start(command):
    return subprocess.Popen([str(w) for w in command], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                            text=True)


def ended(process):
    try:
        _, messages = process.communicate(timeout=120)
    except subprocess.TimeoutExpired:
        process.kill()
        raise
    return process.returncode, messages


def left():
    return sorted(p.name for p in folder.iterdir() if p.name.startswith("o.h5"))


def forget():
    for name in left():
        (folder / name).unlink()


def same(whole):
    found = contents(folder / "o.h5")
    assert found.keys() == whole.keys(), found.keys() ^ whole.keys()
    for name in whole:
        assert numpy.array_equal(found[name], whole[name]), f"{name} differs"


def end_early(process, within):
    """Ends a run in one of three ways at a random moment: what was done, and the code."""
    time.sleep(choose.uniform(0, within))
    way = choose.choice(["KILL", "TERM, KILL", "INT, INT"])
    first, second = {"KILL": (signal.SIGKILL, None), "TERM, KILL": (signal.SIGTERM, signal.SIGKILL),
                     "INT, INT": (signal.SIGINT, signal.SIGINT)}[way]
    process.send_signal(first)
    if second is not None:
        time.sleep(choose.choice([0, 0.001, 0.004, 0.008, 0.02]))
        process.send_signal(second)
    code, messages = ended(process)
    # A signal may come before the program listens, or after it is done.
    assert code in (0, 130, 143, -first, -(second or first)), (way, code, messages)
    return way, code


def undisturbed(command):
    began = time.monotonic()
    code, messages = ended(start(command))
    assert code == 0, messages
    assert left() == ["o.h5"], left()
    whole = contents(folder / "o.h5")
    forget()
    return whole, time.monotonic() - began


def kill(name, command, whole, duration, times):
    resumed = 0
    while times > 0:
        for _ in range(min(times, 3)):
            way, code = end_early(start(command), duration)
            times -= 1
            if code == 0:
                break
        if code != 0:
            resumed += (folder / "o.h5.checkpoint").exists()
            code, messages = ended(start(command))
            assert code == 0, (name, way, messages)
        assert left() == ["o.h5"], left()
        same(whole)
        forget()
    return resumed


def damage(name, command, whole, duration, positions):
    """Every byte of what a restart reads is either refused with 3, or of no account."""
    for attempt in range(20):
        process = start(command)
        time.sleep(duration * 0.5 * 0.8 ** attempt)
        process.send_signal(signal.SIGTERM)
        code, messages = ended(process)
        if code == 143 and (folder / "o.h5.checkpoint").exists():
            break
        forget()
    assert code == 143, (code, messages)
    kept = {n: (folder / n).read_bytes() for n in left()}
    refused = 0
    for file, content in kept.items():
        places = [0, len(content) - 1, *(choose.randrange(len(content)) for _ in range(positions))] if content else []
        for changed in [*(content[:k] + bytes([content[k] ^ choose.randrange(1, 256)]) + content[k + 1:] for k in places),
                        content[:len(content) // 2]]:
            if changed == content:
                continue
            for n, c in kept.items():
                (folder / n).write_bytes(changed if n == file else c)
            code, messages = ended(start(command))
            assert code in (0, 3), (file, code, messages)
            refused += code == 3
            if code == 3:
                assert file in messages and "to start anew" in messages, messages
            else:
                same(whole)
            for n in left():
                (folder / n).unlink()
    for n, c in kept.items():
        if n != "o.h5.frames":
            (folder / n).write_bytes(c)
    if "o.h5.frames" in kept:
        code, messages = ended(start(command))
        assert code == 3 and "o.h5.frames: is missing" in messages, (code, messages)
        (folder / "o.h5.frames").write_bytes(kept["o.h5.frames"])
    code, messages = ended(start([*command, "--restart"]))
    assert code == 0, messages
    same(whole)
    forget()
    return refused


def stop(name, command, after, keeps):
    """How long a run takes to end after a signal."""
    process = start(command)
    time.sleep(after)
    assert process.poll() is None, (name, "it was over before the signal", process.communicate())
    number = choose.choice([signal.SIGINT, signal.SIGTERM])
    began = time.monotonic()
    process.send_signal(number)
    code, messages = ended(process)
    took = time.monotonic() - began
    print(f"{name}: ended {took:.2f} s after the signal: {messages.strip().splitlines()[-1]}")
    assert code == 128 + number, (name, code, messages)
    assert took < LATENCY, (name, took)
    if keeps:
        assert "the same command goes on from there" in messages, messages
        assert (folder / "o.h5.checkpoint").exists()
    else:
        assert [n for n in left() if not n.endswith((".checkpoint", ".frames"))] == [], left()
    forget()


def prepare():
    (folder / "scene.toml").write_text("[particle]\nradius = 10e-9\n[droplet]\nradius = 140e-9\nlifetime = 4e-5\n")
    rows = ["x,y,z", *(f"{18 * k},{8.7178 * (k % 2)},0" for k in range(14))]
    (folder / "chain.csv").write_text("\n".join(rows) + "\n")
    rows = ["x,y,z", *(f"{20 * (k % 60)},{20 * (k // 60 % 60)},{20 * (k // 3600)}" for k in range(150000))]
    (folder / "many.csv").write_text("\n".join(rows) + "\n")
    subprocess.run([str(options.programs / "agglomerate"), "import", "chain.csv", "--radius", "10", "-o", "chain.h5"],
                   cwd=folder, check=True, capture_output=True)


def crawl():
    """Contacts that open as soon as they are made leave no steps that bring the front on: a reason, not a run for ever."""
    for words in (["material.poisson_ratio=-0.79", "contact.law=cundall-strack"],
                  ["droplet.lifetime=100", "integrator.method=implicit"]):
        code, messages = ended(start([*dryer()[:6], *settings("particle.number=8", "error.estimate=false", *words)]))
        print(f"{' '.join(words)}: {code}, {messages.strip().splitlines()[-1]}")
        assert code == 0 or code == 1 and "does not bring this scene to an end" in messages, (code, messages)
        forget()


def phases():
    slow = settings("droplet.lifetime=100", "particle.number=20", "error.estimate=false")
    base = dryer()[:6]
    yield "dryer, one long stabilised step", [*base, *slow], 1.0, True
    yield "dryer, error estimate", [*base, *settings("droplet.lifetime=1e-2", "particle.number=100")], 1.0, True
    yield "dryer, filling a large droplet", [*base, *settings("particle.number=1000000", "droplet.radius=2e-6")], 1.5, False
    hollow = options.data / "hollow.h5"
    yield "rigidstress, high multipoles", rigidstress("hydrodynamics.method=multipole", "hydrodynamics.order=6",
                                                      "error.estimate=false", agglomerate=hollow), 1.0, False
    yield "rigidstress, orbits", rigidstress("flow.orbits=20000", "hydrodynamics.method=fts"), 1.0, True
    yield "agglomerate import", [options.programs / "agglomerate", "import", "many.csv", "--radius", 10, "-o", "o.h5"], 0.3, False


try:
    prepare()
    lengths = {}
    for name, command in RUNS.items():
        whole, duration = undisturbed(command)
        resumed = kill(name, command, whole, duration, -(-options.kills // len(RUNS)))
        refused = damage(name, command, whole, duration, 4 if options.kills < 100 else 40)
        print(f"{name}: {duration:.2f} s undisturbed; {resumed} times gone on from a checkpoint; {refused} damaged files refused")
    crawl()
    for name, command, after, keeps in phases():
        stop(name, command, after, keeps)
finally:
    shutil.rmtree(folder)
