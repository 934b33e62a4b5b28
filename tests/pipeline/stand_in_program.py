#!/usr/bin/python3
"""Stands for dryer, rigidstress and breaker, by the name it is called by: a file with the scene it was given and a report with
numbers that follow from seed and scene. `particle.number = 13` fails; in the folder of the file, `hold` makes it wait after a
checkpoint, which the next call goes on from. Every call is a line in `calls` beside the program, every end another. In the environment:
SCENE_CODE, how a check ends; BREAK, a seed that fails after it wrote its files; AWAIT, how many wait for each other."""

import hashlib
import json
import math
import os
import pathlib
import signal
import sys
import time
import tomllib

KEYS = {
    "dryer": "[particle]\nnumber = 100\n# radius =   (required)  in m\nbrownian_motion = false\n\n"
             "[droplet]\n# radius =   (required)  in m\n# lifetime =   (not set)  in s\n# peclet =   (not set)\n\n[output]\ntheta = []\n\n[run]\nseed = 1\n",
    "rigidstress": "[particle]\nfragments = \"refuse\"\n\n[flow]\nelongation = true\nshear = true\nuniaxial = false\nbiaxial = false\n# history =   (not set)\n\n[run]\nseed = 1\n",
    "breaker": "[flow]\nkind = \"elongation\"\n# history =   (not set)\n# track =   (not set)\n\n[protocol]\n# largest_stress =   (not set)  in Pa\n",
}


def share(*parts):
    """Uniform in (0, 1), a pure function."""
    return (int(hashlib.sha256(repr(parts).encode()).hexdigest()[:12], 16) + 0.5) / 16.0**12


def main():
    me, words = pathlib.Path(sys.argv[0]), sys.argv[1:]
    if words == ["--print-defaults"]:
        print(KEYS[me.name])
        return 0
    inputs = []
    for word in words:
        if word.startswith("-"):
            break
        inputs.append(word)
    text = pathlib.Path(inputs[0]).read_text()
    scene = tomllib.loads(text)
    for section, keys in scene.items():
        for key in keys:
            if f"{key} =" not in KEYS[me.name]:
                print(f"{me.name}: {inputs[0]}: unknown key '{section}.{key}'", file=sys.stderr)
                return 2
    if "--check" in words:
        print("115 particles in a droplet", file=sys.stderr)
        return int(os.environ.get("SCENE_CODE", 0))
    with open(me.parent / "calls", "a") as calls:
        calls.write(f"{me.name} {' '.join(words)}\n")
    for _ in range(200):
        if (me.parent / "calls").read_text().count("--report") >= int(os.environ.get("AWAIT", 0)):
            break
        time.sleep(0.05)
    out, report = (pathlib.Path(words[words.index(name) + 1]) for name in ("-o", "--report"))
    checkpoint = pathlib.Path(f"{out}.checkpoint")
    if checkpoint.exists():
        with open(me.parent / "calls", "a") as calls:
            calls.write(f"resumed {out.name}\n")
    elif (out.parent / "hold").exists():
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
        checkpoint.write_text("state")
        time.sleep(60)
    if scene.get("particle", {}).get("number") == 13:
        print("not finite: step 5\nparticle 3 left the droplet", file=sys.stderr)
        return 1
    import h5py
    seed = scene.get("run", {}).get("seed", 1)
    strength = 3000 * (-math.log(share("strength", *(pathlib.Path(name).name for name in inputs[1:]), seed))) ** 0.2
    results, errors, parent = {}, {}, None
    if me.name == "dryer":
        results = {"d_c_nm": 100 + 10 * share("d", seed), "h_c_over_d_c": 0.3, "contacts": 170 + seed % 10, "fragments": 1, "coordination": 3.0, "inputs": {"number": scene["particle"]["number"]}}
        errors = {"d_c_relative": {"value": 0.001, "how": "stands in"}}
    else:
        parent = hashlib.sha256(pathlib.Path(inputs[1]).read_bytes()).hexdigest()
    if me.name == "rigidstress":
        results = {"elongation": {"critical_stress_settled_pa": strength, "critical_stress_worst_pa": 0.7 * strength,
                   "device_settled": "a device at rest", "device_worst": "a device of the worst"}, "particles": 100,
                   "particle_radius_nm": 100.0, "scaled_by": 10.0}
        errors = {"n_max_relative": {"value": 0.01, "how": "stands in"}}
    if me.name == "breaker":
        largest = scene.get("protocol", {}).get("largest_stress", 1e9)
        broke = 1.2 * strength < largest
        results = {"critical_stress_pa": 1.2 * strength if broke else None, "largest_stress_pa": largest, "fragments": [60, 30, 10] if broke else [100]}
        errors = {"critical_stress_relative": {"value": 0.02 if broke else None, "how": "stands in"}}
    with h5py.File(f"{out}.tmp", "w") as file:
        file["parameters/input"] = text
        made = file.create_group("parameters/provenance")
        made.attrs.update({"git": "0123456789", "dirty": 0, "seed": seed, **({"parent_sha256": parent} if parent else {})})
    pathlib.Path(f"{out}.tmp").replace(out)
    report.write_text(json.dumps({"program": me.name, "version": "0", "seed": seed, "steps": 10, "wall_s": 1.5, "left_out": [], "inputs": {"fluid": {"viscosity": 1e-3, "density": 997.0}, "material": {"surface_energy": 4.8e-3,
        "youngs_modulus": 3.4e9, "poisson_ratio": 0.5}}, "results": results, "errors": errors, "cpu_s": 0.5}))
    checkpoint.unlink(missing_ok=True)
    with open(me.parent / "calls", "a") as calls:
        calls.write("end\n")
    if os.environ.get("BREAK") == str(seed):
        return 1
    print(f"seed {seed}: a message", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
