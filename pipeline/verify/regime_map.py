"""What a droplet becomes over Peclet number and capillary force over pull-off force: the boundaries of dryer/regime.cpp.

Writes FOLDER/regime.csv, as it is stored beside this script, in two minutes of CPU.

    regime_map.py -o regime-map

115 particles of 10 nm in 215 nm as in the first row of Table 2 of Vasquez Giuliano et al. (2022); the force is changed by the
surface tension, so that bonds stay what they are. Runs that FOLDER has already are not repeated.
"""
import csv
import json
import pathlib
import statistics
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "report"))
import arguments  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = ROOT / "build/release/bin"
PECLET = ("inf", "3000", "1000", "300", "100", "30")
TENSION = (0.25, 1, 4, 20, 100)  # in that of the paper, 1.75e-4 N/m
SEEDS = {"30": (1,)}  # where a granule takes many seconds; three elsewhere
SCENE = "[particle]\nradius = 10e-9\nnumber = 115\n[droplet]\nradius = 215e-9\n"
COLUMNS = ("peclet", "force_ratio", "front_over_capillary_speed", "packed_front_over_capillary_speed", "granules", "h_c_over_d_c",
           "h_c_over_d_c_lowest", "h_c_over_d_c_highest", "d_c_nm", "porosity", "coordination", "fragments", "cpu_s")


def dry(dryer, folder, peclet, tension, seed):
    report = folder / f"{peclet}_{tension:g}_{seed}.json"
    if not report.exists():
        scene, out = folder / "map.toml", folder / "map.h5"
        scene.write_text(SCENE)
        out.unlink(missing_ok=True)
        speed = ("droplet.lifetime=2.1e-4",) if peclet == "inf" else ("particle.brownian_motion=true", f"droplet.peclet={peclet}")
        subprocess.run([dryer, scene, "-o", out, "--report", report, "--seed", str(seed), "--threads", "1", "--quiet",
                        *(word for key in ("error.estimate=false", "output.frames=0", f"fluid.surface_tension={1.75e-4 * tension}",
                                           *speed) for word in ("--set", key))], check=True, stdout=subprocess.DEVNULL)
    return json.loads(report.read_text())


def row(peclet, tension, reports):
    results = [report["results"] for report in reports]
    given = results[0]["inputs"]
    mean = lambda name: statistics.fmean(r[name] for r in results)
    crust = [r["h_c_over_d_c"] for r in results]
    solids = given["solids_fraction"]
    packed = given["front_speed_m_per_s"] / min(1, (2 * solids) ** (1 / 3))
    pull_off = 1.5 * 3.141592653589793 * 4.8e-3 * 10e-9
    return (peclet, f"{2 * 3.141592653589793 * 1.75e-4 * tension * 10e-9 / pull_off:.3g}",
            f"{given['front_speed_m_per_s'] / given['capillary_speed_limit_m_per_s']:.3g}",
            f"{packed / given['capillary_speed_limit_m_per_s']:.3g}", len(results), f"{statistics.fmean(crust):.3f}", f"{min(crust):.3f}",
            f"{max(crust):.3f}", f"{mean('d_c_nm'):.1f}", f"{mean('porosity'):.3f}", f"{mean('coordination'):.2f}",
            f"{mean('fragments'):.1f}", f"{statistics.fmean(report['cpu_s'] for report in reports):.2g}")


def command_line():
    parser = arguments.parser(__doc__, "folder of the runs and the table", metavar="FOLDER", default=ROOT / "pipeline/results/verify")
    parser.add_argument("--dryer", type=pathlib.Path, default=BIN / "dryer", help="the program (default: %(default)s)")
    return parser


def main():
    given = command_line().parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    with open(given.out / "regime.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for peclet in PECLET:
            for tension in TENSION:
                writer.writerow(row(peclet, tension, [dry(given.dryer, given.out, peclet, tension, seed) for seed in SEEDS.get(peclet, (1, 2, 3))]))
                file.flush()


if __name__ == "__main__":
    sys.exit(main())
