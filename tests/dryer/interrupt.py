"""Ctrl-C leaves a checkpoint; the same command goes on from it to the same bits, with 1 or 2 threads.

interrupt.py DRYER SCENE
"""

import os
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy

dryer, scene = sys.argv[1:3]
options = ["--set", "error.estimate=false", "--set", "integrator.largest_displacement=0.05", "--quiet"]


def contents(path):
    """All arrays of a file by path, without the provenance (time of creation, command)."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def same(a, b):
    a, b = contents(a), contents(b)
    assert a.keys() == b.keys(), a.keys() ^ b.keys()
    for name in a:
        assert numpy.array_equal(a[name], b[name]), f"{name} differs"


def command(output, *more):
    return [dryer, scene, "-o", output, *options, *more]


with tempfile.TemporaryDirectory() as folder:
    whole = os.path.join(folder, "whole.h5")
    subprocess.run(command(whole), check=True, stdout=subprocess.DEVNULL)

    cut = os.path.join(folder, "cut.h5")
    interrupted = 0
    for number in (signal.SIGINT, signal.SIGTERM):
        process = subprocess.Popen(command(cut), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(0.4)
        process.send_signal(number)
        code = process.wait(timeout=60)
        assert code in (0, 128 + number), code
        if code:
            interrupted += 1
            assert os.path.exists(cut + ".checkpoint") and not os.path.exists(cut), "no checkpoint, or a half file"
    assert interrupted, "the run ended before it could be interrupted"

    refused = subprocess.run(command(cut, "--seed", "2"), capture_output=True, text=True)
    assert refused.returncode == 2 and "another scene" in refused.stderr, refused

    subprocess.run(command(cut), check=True, stdout=subprocess.DEVNULL)
    assert not os.path.exists(cut + ".checkpoint") and not os.path.exists(cut + ".tmp"), os.listdir(folder)
    same(whole, cut)

    two = os.path.join(folder, "two.h5")
    subprocess.run(command(two, "--threads", "2"), check=True, stdout=subprocess.DEVNULL)
    same(whole, two)
print("interrupted", interrupted, "times; all arrays equal")
