"""Ctrl-C leaves a checkpoint; the same command goes on from it to the same bits, with 1 or 2 threads.

interrupt.py DRYER SCENE [KEY=VALUE ...]
"""

import os
import signal
import subprocess
import sys
import tempfile
import time

import numpy

from program_runs import contents, interrupt, seconds

dryer, scene = sys.argv[1:3]
options = [word for setting in ["error.estimate=false", *sys.argv[3:]] for word in ("--set", setting)]


def same(a, b):
    a, b = contents(a), contents(b)
    assert a.keys() == b.keys(), a.keys() ^ b.keys()
    for name in a:
        assert numpy.array_equal(a[name], b[name]), f"{name} differs"


def command(output, *more):
    return [dryer, scene, "-o", output, *options, *more]


with tempfile.TemporaryDirectory() as folder:
    whole = os.path.join(folder, "whole.h5")
    duration = seconds(command(whole))

    cut = os.path.join(folder, "cut.h5")
    for number, part in ((signal.SIGINT, 0.15), (signal.SIGTERM, 0)):
        code = interrupt(command(cut), number, part * duration)
        assert code == 128 + number, code
        assert os.path.exists(cut + ".checkpoint") and not os.path.exists(cut), "no checkpoint, or a half file"

    refused = subprocess.run(command(cut, "--seed", "2"), capture_output=True, text=True)
    assert refused.returncode == 2 and "another scene" in refused.stderr, refused

    subprocess.run(command(cut, "--restart"), check=True, stdout=subprocess.DEVNULL)
    assert not os.path.exists(cut + ".checkpoint") and not os.path.exists(cut + ".tmp"), os.listdir(folder)
    same(whole, cut)
    refused = subprocess.run(command(cut, "--restart"), capture_output=True, text=True)
    assert refused.returncode == 2 and "there is no " in refused.stderr, refused
    same(whole, cut)

    # Two signals at once, as from a scheduler and from the command that it runs, are one request to keep the state.
    both = os.path.join(folder, "both.h5")
    process = subprocess.Popen(command(both), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(0.15 * duration)
    process.send_signal(signal.SIGTERM)
    process.send_signal(signal.SIGINT)
    assert process.wait() in (130, 143) and os.path.exists(both + ".checkpoint"), process.returncode
    subprocess.run(command(both), check=True, stdout=subprocess.DEVNULL)
    same(whole, both)

    two = os.path.join(folder, "two.h5")
    subprocess.run(command(two, "--threads", "2"), check=True, stdout=subprocess.DEVNULL)
    same(whole, two)
print("interrupted twice; all arrays equal")
