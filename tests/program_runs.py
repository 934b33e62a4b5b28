"""What the tests of several programs do with them: read what they wrote, and interrupt them."""
import subprocess
import time

import h5py


def contents(path):
    """All arrays of a file by path, without the provenance (time of creation, command)."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def seconds(command):
    """Runs a command to its end: the time from its first message on."""
    return timed(command)[1]


def interrupt(command, number, after):
    """Sends a signal so many seconds after the first message of a run: the code that it ends with."""
    return timed(command, number, after)[0]


def timed(command, number=None, after=0):
    with subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        process.stderr.readline()
        start = time.monotonic()
        if number is not None:
            time.sleep(after)
            process.send_signal(number)
        process.communicate(timeout=120)
        return process.returncode, time.monotonic() - start
