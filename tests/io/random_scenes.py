"""Random valid and invalid scenes for dryer, breaker and rigidstress: every run ends as the manual says.

    random_scenes.py FOLDER_OF_THE_PROGRAMS [--scenes N] [--seed N] [--only PROGRAM]

Keys, ranges and words are those that the programs print with --print-reference, so a new key is tried without a change
here. No exit code but 0, 1, 2, 3, 130 and 143, no internal error, no number in a file or a report that is not finite, no
file that `agglomerate check` refuses; what takes longer than PATIENCE is stopped, and must end then.
"""
import argparse
import collections
import json
import math
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile

import h5py
import numpy

parser = argparse.ArgumentParser()
parser.add_argument("programs", type=lambda p: pathlib.Path(p).resolve())
parser.add_argument("--scenes", type=int, default=50)
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--only")
options = parser.parse_args()

PATIENCE = 1.0  # s of a run, which is then stopped
LATENCY = 20.0  # s that it may take to end, on a machine with other work
CODES = (0, 1, 2, 3, 130, 143)
Key = collections.namedtuple("Key", "name default range")

# What a scene needs to be small, and what decides how long it takes.
FIXED = {
    "dryer": {"particle.radius": lambda c: wide(c, 1e-8, 30), "particle.number": lambda c: c.choice([1, 2, 3, 8, 20, 40]),
              "droplet.lifetime": lambda c: wide(c, 1e-5, 30)},
    "breaker": {"protocol.strain": lambda c: wide(c, 5, 10)},
    "rigidstress": {"flow.strain": lambda c: wide(c, 10, 10), "hydrodynamics.order": lambda c: c.choice([1, 2, 3])},
}
# Three ways to say one thing exclude each other; a history is a file; the stages of a protocol come by themselves.
LEFT_OUT = re.compile(r"particle\.(solids_fraction|second_|geometric_|distribution)|droplet\.|flow\.(history|orientation)|protocol\.|"
                      r"crust\.|output\.(theta|checkpoint)|hydrodynamics\.memory|integrator\.step")


def wide(choose, middle, factor):
    return middle * math.exp(choose.uniform(-1, 1) * math.log(factor))


def reference(program):
    page = subprocess.run([str(options.programs / program), "--print-reference"], capture_output=True, text=True, check=True)
    rows = re.findall(r"^\| `([a-z_.]+)` \| (.*?) \| .*? \| (.*?) \| ", page.stdout, re.M)
    return [Key(*row) for row in rows]


def words(key):
    return re.split(r", | or ", key.range) if not re.search(r"[<>=]|\d to \d|^$", key.range) else []


def valid_value(key, choose):
    """A value in the range of the key as the page states it, mostly not far from the default."""
    if words(key):
        word = choose.choice(words(key))
        return word if word in ("true", "false") else f'"{word}"'
    whole = re.fullmatch(r"-?\d+", key.default) is not None
    try:
        default = float(key.default.strip('"'))
    except ValueError:
        default = 1.0
    bounds = re.search(r"(-?[\d.e+-]+) to (-?[\d.e+-]+)", key.range)
    low = high = None
    if bounds:
        low, high = map(float, bounds.groups())
    for sign, number in re.findall(r"([<>]=?) (-?[\d.e+-]+)", key.range):
        if sign[0] == ">":
            low = float(number) + (0 if "=" in sign else 1e-12)
        else:
            high = float(number) * (1 if "=" in sign else 0.999)
    if choose.random() < 0.1 and (low is not None or high is not None):
        value = choose.choice([b for b in (low, high) if b is not None])
    else:
        value = wide(choose, default or 1.0, 10 if choose.random() < 0.8 else 1e3)
    value = max(value, low) if low is not None else value
    value = min(value, high) if high is not None else value
    return str(round(value)) if whole else repr(value)


def invalid_value(key, choose):
    wrong = ["nan", "inf", "-inf", '"word"', "[]", "[1, 2]", "true", "1e400", "-1e300", "2020-01-01", "{a = 1}", '""', "''"]
    return choose.choice(wrong)


def scene(program, keys, choose, valid):
    """Lines `key = value` in sections; a broken one has a value, a key or a syntax that is wrong."""
    values = {name: repr(value(choose)) for name, value in FIXED[program].items()}
    if program == "dryer":
        solids = float(values["particle.number"]) * choose.choice([1.0, 3.0, 10.0, 100.0]) * 4
        values["droplet.radius"] = repr(float(values["particle.radius"]) * max(solids, 8) ** (1 / 3))
    for key in choose.sample(keys, choose.randint(0, min(8, len(keys)))):
        if key.name not in values and not LEFT_OUT.match(key.name):
            values[key.name] = valid_value(key, choose)
    if not valid:
        for key in choose.sample(keys, choose.randint(1, 2)):
            values[key.name] = invalid_value(key, choose)
    text = ""
    for section in sorted({name.rsplit(".", 1)[0] for name in values}):
        text += f"[[{section}]]\n" if section == "protocol.stage" else f"[{section}]\n"
        text += "".join(f"{name.rsplit('.', 1)[1]} = {v}\n" for name, v in values.items() if name.rsplit(".", 1)[0] == section)
    if not valid and choose.random() < 0.3:
        place = choose.randrange(len(text))
        text = text[:place] + choose.choice(["", "\x00", "[", "=", '"', "\n\n[", "é", "#", "}"]) + text[place + choose.randint(0, 5):]
    return text


def agglomerates(folder, choose):
    """Chains, a raft and pieces, of equal and unequal particles."""
    made = []
    shapes = {"pair": [(0, 0), (1, 0)], "chain": [(k, 0) for k in range(7)], "raft": [(k % 3, k // 3) for k in range(9)],
              "pieces": [(0, 0), (1, 0), (5, 0), (6, 0)], "one": [(0, 0)]}
    for name, places in shapes.items():
        rows = "".join(f"{20 * x},{20 * y},{0}\n" for x, y in places)
        (folder / f"{name}.csv").write_text("x,y,z\n" + rows)
        ran = subprocess.run([str(options.programs / "agglomerate"), "import", f"{name}.csv", "--radius", "10.02",
                              "-o", f"{name}.h5"], cwd=folder, capture_output=True, text=True)
        assert ran.returncode == 0, ran.stderr
        made.append(f"{name}.h5")
    return made


def run(command, folder):
    """The code, the messages and whether the run had to be stopped."""
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          errors="replace") as process:
        try:
            _, messages = process.communicate(timeout=PATIENCE)
            return process.returncode, messages, False
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGTERM)
        try:
            _, messages = process.communicate(timeout=LATENCY)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
        return process.returncode, messages, True


def require_finite(folder):
    def look(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
            assert numpy.isfinite(item[()]).all(), f"{name} is not finite"
    with h5py.File(folder / "o.h5") as file:
        file.visititems(look)
    def refuse(word):
        raise AssertionError(f"{word} in the report")
    json.loads((folder / "o.json").read_text(), parse_constant=refuse)


def try_scenes(program, folder, choose):
    keys, count = reference(program), collections.Counter()
    inputs = agglomerates(folder, choose) if program != "dryer" else []
    for number in range(options.scenes):
        valid = number % 3 != 0
        text = scene(program, keys, choose, valid)
        (folder / "scene.toml").write_text(text)
        command = [str(options.programs / program), "scene.toml", *([choose.choice(inputs)] if inputs else []),
                   "-o", "o.h5", "--report", "o.json", "--threads", "1", "--quiet"]
        try:
            code, messages, stopped = run(command, folder)
            assert code in CODES and (code in (130, 143)) <= stopped, f"exit code {code}"
            assert "internal error" not in messages, "internal error"
            assert code == 0 or messages.strip(), "ended without a reason"
            if code == 0:
                require_finite(folder)
                check = subprocess.run([str(options.programs / "agglomerate"), "check", "o.h5"], cwd=folder,
                                       capture_output=True, text=True)
                assert check.returncode == 0, check.stdout + check.stderr
        except (AssertionError, subprocess.TimeoutExpired) as problem:
            print(f"{program}, scene {number} of seed {options.seed}: {problem}\n{' '.join(command)}\n{text}")
            count["wrong"] += 1
            continue
        finally:
            for left in folder.glob("o.*"):
                left.unlink()
        count[f"{'valid' if valid else 'invalid'} {code}"] += 1
    print(f"{program}: {options.scenes} scenes, " + ", ".join(f"{k}: {v}" for k, v in sorted(count.items())))
    return count["wrong"]


with tempfile.TemporaryDirectory() as name:
    wrong = sum(try_scenes(program, pathlib.Path(name), random.Random(f"{program} {options.seed}"))
                for program in FIXED if options.only in (None, program))
sys.exit(1 if wrong else 0)
