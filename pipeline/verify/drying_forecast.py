"""What `dryer` says a run will take, against what it takes: varied scenes on one core, forecast first, then the run.

The claim: at least nine of ten ranges hold the CPU seconds of the run, and none is missed by more than half.

    drying_forecast.py --only hollow "Pe = 10"
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "pipeline" / "report"))
import arguments  # noqa: E402
from table import print_markdown  # noqa: E402

HOLLOW, INTERMEDIATE, COMPACT, LARGE, ADHESIVE, MICROMETRE, SILICA, POLYMER = (
    str(ROOT / "pipeline" / "scenes" / f"{name}.toml")
    for name in ("hollow", "intermediate", "compact", "large", "adhesive", "micrometre", "silica", "polymer"))
SMALL = ["particle.number=30", "droplet.radius=137e-9"]
SCENES = {
    "hollow": (HOLLOW, []),
    "hollow, N = 30": (HOLLOW, SMALL + ["droplet.lifetime=8.5e-5"]),
    "hollow, E x 10": (HOLLOW, ["material.youngs_modulus=3.4e10"]),
    "hollow, surface energy x 4": (HOLLOW, ["material.surface_energy=19.2e-3"]),
    "hollow, surface tension of water": (HOLLOW, ["fluid.surface_tension=water", "fluid.viscosity=water"]),
    "hollow, surface tension x 10": (HOLLOW, ["fluid.surface_tension=1.75e-3"]),
    "hollow, lifetime / 10": (HOLLOW, ["droplet.lifetime=2.1e-5"]),
    "hollow, lifetime x 10": (HOLLOW, ["droplet.lifetime=2.1e-3"]),
    "hollow, no rolling or twisting": (HOLLOW, ["contact.rolling_limit_factor=0", "contact.twisting_limit_factor=0"]),
    "hollow, 20 % solids": (HOLLOW, ["droplet.radius=83e-9", "droplet.lifetime=3e-5"]),
    "hollow, crust": (HOLLOW, ["crust.relative_diffusivity=0.2"]),
    "lognormal 1.4, N = 300": (HOLLOW, ["particle.number=300", "droplet.radius=340e-9", "droplet.lifetime=5e-4",
                                        "particle.distribution=lognormal", "particle.geometric_standard_deviation=1.4"]),
    "bimodal 1 : 3": (HOLLOW, ["droplet.radius=400e-9", "particle.distribution=bimodal", "particle.second_radius=30e-9",
                               "particle.second_share=0.3"]),
    "a = 100 nm, N = 115": (HOLLOW, ["particle.radius=100e-9", "droplet.radius=2.15e-6", "droplet.lifetime=2.1e-3"]),
    "1 um, Table 3": (MICROMETRE, []),
    "N = 1000 of 150 nm": (LARGE, []),
    "N = 3000 of 150 nm": (LARGE, ["particle.number=3000", "droplet.radius=9.943e-6"]),
    "hollow, implicit": (HOLLOW, ["integrator.method=implicit"]),
    "hollow, N = 30, implicit": (HOLLOW, SMALL + ["droplet.lifetime=8.5e-5", "integrator.method=implicit"]),
    "hollow, cundall-strack": (HOLLOW, ["contact.law=cundall-strack"]),
    "hollow, inertial, lifetime / 100": (HOLLOW, ["integrator.method=inertial", "droplet.lifetime=2.1e-6"]),
    "Pe = 10": (INTERMEDIATE, []),
    "Pe = 100": (INTERMEDIATE, ["droplet.peclet=100"]),
    "Pe = 10, N = 30": (INTERMEDIATE, SMALL),
    "Pe = 10, E x 10, N = 30": (INTERMEDIATE, SMALL + ["material.youngs_modulus=3.4e10"]),
    "Pe = 10, surface energy x 4": (ADHESIVE, []),
    "Pe = 10, softening 1, N = 30": (INTERMEDIATE, SMALL + ["integrator.softening=1"]),
    "Pe = 1, N = 30": (COMPACT, SMALL),
    "Pe = 1000, a = 100 nm": (INTERMEDIATE, ["particle.radius=100e-9", "droplet.radius=2.15e-6", "droplet.peclet=1000"]),
    "Pe = 100, lognormal 1.3": (INTERMEDIATE, ["droplet.peclet=100", "particle.distribution=lognormal",
                                              "particle.geometric_standard_deviation=1.3"]),
    "silica in salt, N = 60": (SILICA, []),
    "silica in salt, Pe = 60, N = 30": (COMPACT, SMALL + ["droplet.peclet=60", "surface_forces.hamaker=4.6e-21",
                                                          "surface_forces.surface_potential=0.03", "surface_forces.ionic_strength=1"]),
    "polystyrene of 100 nm in salt": (POLYMER, []),
    "hollow, in salt": (HOLLOW, SMALL + ["droplet.lifetime=8.5e-5", "surface_forces.hamaker=9.85e-21",
                                         "surface_forces.surface_potential=0.03", "surface_forces.ionic_strength=10"]),
}
UNIT = {"s": 1, "min": 60, "h": 3600, "days": 86400}


def forecast(text):
    """Steps and the range of seconds of the line 'expected: ...'."""
    line = re.search(r"expected: about (\S+) steps, (?:(\S+) to )?(\S+) (s|min|h|days) on one core", text)
    steps, low, high, unit = line.groups()
    return float(steps), float(low or high) * UNIT[unit], float(high) * UNIT[unit]


def measure(dryer, scene, settings, folder):
    report = pathlib.Path(folder) / "run.json"
    command = [dryer, scene, "-o", str(pathlib.Path(folder) / "run.h5"), "--overwrite", "--report", str(report), "--threads", "1"]
    for setting in ["error.estimate=false", "output.frames=0", *settings]:
        command += ["--set", setting]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode:
        sys.exit(f"{' '.join(command)}\n{run.stderr}")
    found = json.loads(report.read_text())
    return *forecast(run.stderr), found["steps"], found["cpu_s"], found["results"]["particle_steps"]


def command_line():
    parser = arguments.parser(__doc__)
    parser.add_argument("--dryer", default=str(ROOT / "build" / "release" / "bin" / "dryer"), help="the program (default: of build/release)")
    parser.add_argument("--only", nargs="+", choices=SCENES, metavar="NAME", default=list(SCENES), help="scenes (default: all)")
    return parser


def main(options):
    rows, held, far = [], 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for name, (scene, settings) in SCENES.items():
            if name not in options.only:
                continue
            steps, low, high, taken, cpu, particle_steps = measure(options.dryer, scene, settings, folder)
            held += low <= cpu <= high
            far += not low / 1.5 <= cpu <= high * 1.5
            rows.append([name, f"{steps:.3g}", f"{taken:.3g}", f"{taken / steps:.2f}", f"{low:.3g} to {high:.3g}",
                         f"{cpu:.3g}", f"{cpu / (low * high) ** 0.5:.2f}", f"{1e9 * cpu / particle_steps:.3g}"])
            print(name, *rows[-1][1:], file=sys.stderr, flush=True)
    cpus = [line for line in open("/proc/cpuinfo") if line.startswith("model name")]
    print(f"\n{os.cpu_count()} cores, {cpus[0].split(':')[1].strip() if cpus else 'unknown processor'}\n")
    print_markdown(["scene", "steps, forecast", "taken", "ratio", "CPU s, forecast", "taken", "over the middle",
                    "ns a particle and step"], rows)
    print(f"\n{held} of {len(rows)} runs within their range, {far} missed by more than half.")
    sys.exit(held < 0.9 * len(rows) or far > 0)


if __name__ == "__main__":
    main(command_line().parse_args())
