#!/usr/bin/python3
"""Time, memory and morphology against the number of particles.

Dries each droplet on all cores; up to 20,000 particles also on one thread, for the speed-up and to see that the granules are the same to the
bit. Cost: wall time on all cores a particle and evaluation, of awake particles. Growth: exponent of the wall time of an evaluation of the
droplet as it is, idle particles and all, between one number and the next; on one thread where both were dried on it. Bytes: peak memory of the
process above that of a droplet of ten.

    scale.py large.toml 1000 10000 --dryer build/release/bin/dryer --runs results/scale
"""

import hashlib
import json
import math
import os
import pathlib
import subprocess

import h5py

import arguments
from table import print_markdown

RADIUS_OF_100000 = 32e-6  # m
LARGEST_ON_ONE_THREAD = 20_000


def dry(dryer, scene, folder, number, threads):
    name = os.path.join(folder, f"{number}-{threads}")
    radius = RADIUS_OF_100000 * (number / 1e5) ** (1 / 3)
    if not os.path.exists(name + ".json") or os.path.getmtime(name + ".json") < os.path.getmtime(dryer):
        subprocess.run(
            [dryer, scene, "-o", name + ".h5", "--overwrite", "--report", name + ".json", "--threads", str(threads), "--set",
             f"particle.number={number}", "--set", f"droplet.radius={radius:.5g}"],
            check=True, stdout=subprocess.DEVNULL)
    with open(name + ".json") as file:
        report = json.load(file)
    with h5py.File(name + ".h5") as file:
        report["bits"] = hashlib.sha256(file["particles/all/position/value"][-1].tobytes()).hexdigest()
    return report


def growth(before, after):
    """before, after: (number, wall time of an evaluation by the number of threads)."""
    if before is None:
        return ""
    threads = min(before[1].keys() & after[1].keys())
    return f"{math.log(after[1][threads] / before[1][threads]) / math.log(after[0] / before[0]):.2f}"


def rows(dryer, scene, folder, numbers):
    cores = os.cpu_count()
    base = dry(dryer, scene, folder, 10, 1)["peak_rss_bytes"]
    before = None
    for number in sorted(numbers):
        many = dry(dryer, scene, folder, number, cores)
        result = many["results"]
        step = {cores: many["wall_s"] / many["steps"]}
        alone = ["", "", ""]
        if number <= LARGEST_ON_ONE_THREAD:
            one = dry(dryer, scene, folder, number, 1)
            step[1] = one["wall_s"] / one["steps"]
            alone = [f"{one['wall_s']:.1f}", f"{one['wall_s'] / many['wall_s']:.2f}",
                     "yes" if one["bits"] == many["bits"] else "NO"]
        yield [str(number), str(many["steps"]), f"{100 * (1 - result['particle_steps'] / many['steps'] / number):.0f}",
               f"{many['wall_s']:.1f}", f"{many['cpu_s']:.1f}", *alone, f"{1e9 * many['wall_s'] / result['particle_steps']:.1f}",
               growth(before, (number, step)), f"{(many['peak_rss_bytes'] - base) / number:.0f}",
               f"{result['d_c_nm'] / 1e3:.3f}", f"{result['h_c_over_d_c']:.3f}", str(result["contacts"]), str(result["fragments"])]
        before = (number, step)


def command_line():
    parser = arguments.parser(__doc__, "the table (default: printed)", required=False)
    parser.add_argument("--dryer", type=arguments.file, required=True, help="the program")
    parser.add_argument("--runs", type=pathlib.Path, metavar="FOLDER", required=True, help="where the runs go; those that are there are not repeated")
    parser.add_argument("scene", type=arguments.file, metavar="SCENE.toml")
    parser.add_argument("numbers", type=int, nargs="+", metavar="N", help="of particles")
    return parser


def main(options):
    heading = ["N", "evaluations", "idle %", f"wall s, {os.cpu_count()} threads", "CPU s", "wall s, 1 thread", "speed-up",
               "same bits", "ns a particle and evaluation", "growth", "bytes a particle", "d_c µm", "h_c/d_c", "contacts",
               "fragments"]
    with arguments.printing_to(options.out):
        print_markdown(heading, rows(options.dryer, options.scene, options.runs, options.numbers))


if __name__ == "__main__":
    main(command_line().parse_args())
