#!/usr/bin/python3
"""Time, memory and morphology against the number of particles: scale.py DRYER SCENE FOLDER N...

Dries each droplet on all cores, and on one thread for the speed-up and to see that the granules are the same to the bit. Cost: CPU time on
one thread a particle and evaluation, of awake particles. Growth: exponent of the cost of an evaluation of the whole droplet, at equal share
of awake ones, between one number and the next. Bytes: peak memory above that of a droplet of ten particles."""
import hashlib
import json
import math
import os
import subprocess
import sys

import h5py

RADIUS_OF_100000 = 32e-6  # m


def dry(dryer, scene, folder, number, threads):
    name = os.path.join(folder, f"{number}-{threads}")
    radius = RADIUS_OF_100000 * (number / 1e5) ** (1 / 3)
    if not os.path.exists(name + ".json") or os.path.getmtime(name + ".json") < os.path.getmtime(dryer):
        subprocess.run(
            [dryer, scene, "-o", name + ".h5", "--report", name + ".json", "--threads", str(threads), "--set",
             f"particle.number={number}", "--set", f"droplet.radius={radius:.5g}", "--set",
             "integrator.method=stabilised"],
            check=True, stdout=subprocess.DEVNULL)
    with open(name + ".json") as file:
        report = json.load(file)
    with h5py.File(name + ".h5") as file:
        report["bits"] = hashlib.sha256(file["particles/all/position/value"][-1].tobytes()).hexdigest()
    return report


def main():
    dryer, scene, folder, *numbers = sys.argv[1:]
    cores = os.cpu_count()
    print("| N | evaluations | idle %% | wall s, 1 thread | CPU s | wall s, %d threads | speed-up | same bits | ns a particle and evaluation"
          " | growth | bytes a particle | d_c um | h_c/d_c | contacts | fragments |" % cores)
    print("|" + "---|" * 15)
    base = dry(dryer, scene, folder, 10, 1)["peak_rss_bytes"]
    before = None
    for number in sorted(int(n) for n in numbers):
        many = dry(dryer, scene, folder, number, cores)
        one = dry(dryer, scene, folder, number, 1)
        result = one["results"]
        cost = one["cpu_s"] / result["particle_steps"]
        growth = f"{1 + math.log(cost / before[1]) / math.log(number / before[0]):.2f}" if before else ""
        print(f"| {number} | {one['steps']} | {100 * (1 - result['particle_steps'] / one['steps'] / number):.0f} |"
              f" {one['wall_s']:.1f} | {one['cpu_s']:.1f} | {many['wall_s']:.1f} | {one['wall_s'] / many['wall_s']:.2f} |"
              f" {'yes' if one['bits'] == many['bits'] else 'NO'} | {1e9 * cost:.1f} | {growth} |"
              f" {(one['peak_rss_bytes'] - base) / number:.0f} | {result['d_c_nm'] / 1e3:.3f} | {result['h_c_over_d_c']:.3f} |"
              f" {result['contacts']} | {result['fragments']} |", flush=True)
        before = (number, cost)


main()
