"""The ramp that follows from the granule, against one ten times as slow: does either break without a key set by hand?

Prints the table of ramp.md; without granules it dries one of 60 particles.

    ramp.py hollow.h5 -o ramps

Each granule is loaded twice as two materials: 24 nm silica-like (E = 70 GPa, surface energy 0.05 J/m2) and 2 um of weak bonds (1 GPa,
4.8e-4 J/m2). Reports that FOLDER has already are not made again.
"""
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "pipeline" / "report"))
import arguments  # noqa: E402

MATERIALS = {"strong": ("24e-9", "7e10", "0.2", "0.05"), "weak": ("2e-6", "1e9", "0.4", "4.8e-4")}
KEYS = ("particle.radius", "material.youngs_modulus", "material.poisson_ratio", "material.surface_energy")
STRAINS = (500, 5000)  # the default, and the slow one


def broken(breaker, granule, material, strain, folder):
    name = folder / f"{granule.stem}-{material}-{strain}"
    report = name.with_suffix(".json")
    if not report.exists():
        settings = [f"{key}={value}" for key, value in zip(KEYS, MATERIALS[material])]
        settings += ["error.estimate=false", "particle.fragments=largest"] + ([] if strain == STRAINS[0] else [f"protocol.strain={strain}"])
        run = subprocess.run([breaker, "/dev/null", granule, "-o", name.with_suffix(".h5"), "--report", report, "--threads", "1",
                              *(word for s in settings for word in ("--set", s))], check=True, capture_output=True, text=True)
        forecast = re.search(r"^expected: (.*) for one run$", run.stderr, re.MULTILINE)
        name.with_suffix(".forecast").write_text(forecast[1] if forecast else "")
    forecast = name.with_suffix(".forecast")
    return json.loads(report.read_text()), forecast.read_text() if forecast.exists() else ""


def dried(programs, folder):
    """60 particles at the solids and front speed of the paper's first row."""
    granule = folder / "hollow-60.h5"
    if not granule.exists():
        settings = ("particle.number=60", "droplet.radius=1.731e-7", "droplet.lifetime=1.69e-4", "error.estimate=false", "output.frames=0")
        subprocess.run([programs / "dryer", ROOT / "pipeline/scenes/hollow.toml", "-o", granule, "--threads", "1", "--quiet",
                        *(word for s in settings for word in ("--set", s))], check=True, stdout=subprocess.DEVNULL)
    return granule


def command_line():
    parser = arguments.parser(__doc__, "folder of the runs", metavar="FOLDER", default=ROOT / "pipeline/results/verify")
    parser.add_argument("granules", nargs="*", type=arguments.file, metavar="GRANULE.h5", help="granules to load")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin", help="folder of the programs (default: %(default)s)")
    return parser


def main():
    given = command_line().parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    print("| granule | material | particles | rigid, Pa | breaks at, Pa | ten times as slow, Pa | difference | contacts | steps | a contact | CPU s | forecast of the first |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for granule in given.granules or [dried(given.bin, given.out)]:
        for material in MATERIALS:
            found = [broken(given.bin / "breaker", granule, material, strain, given.out) for strain in STRAINS]
            runs, forecast = [run for run, _ in found], found[0][1]
            (one, slow), r = (run["results"]["critical_stress_pa"] for run in runs), runs[0]["results"]
            print(f"| {granule.stem} | {material} | {sum(r['fragments'])} | {r['rigid_prediction_pa']:.4g} | {one:.5g} | {slow:.5g} | "
                  f"{100 * (one / slow - 1):+.2f} % | {r['contacts_initial']} | {runs[0]['steps']}, {runs[1]['steps']} | "
                  f"{runs[0]['steps'] / r['contacts_initial']:.0f}, {runs[1]['steps'] / r['contacts_initial']:.0f} | "
                  f"{runs[0]['cpu_s']:.1f}, {runs[1]['cpu_s']:.1f} | {forecast} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
