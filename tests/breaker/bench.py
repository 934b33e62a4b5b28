"""Time against error of the breaker: tolerances, ramp rates and integrators, 2 to 115 particles.

    bench.py BREAKER AGGLOMERATE [SMALLEST LARGEST]      (only clusters of so many particles)

The granules are those of data/, dried at 10 nm and scaled to 100 nm. Times are CPU seconds of one core. The error is that of the critical stress against the finest run of the same ramp.
"""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

from coil import coil

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "pipeline" / "scenes" / "breakup.toml"
PAPER = 5000  # Pa/s at 1 Pa s


def agglomerate_of(centres, agglomerate, folder):
    """File of 100 nm spheres at the given centres in nm, bonded where they touch."""
    table, start = folder / "centres.csv", folder / "start.h5"
    table.write_text("\n".join(["x,y,z"] + [",".join(f"{v:.12g}" for v in x) for x in centres]) + "\n")
    start.unlink(missing_ok=True)
    subprocess.run([agglomerate, "import", str(table), "-o", str(start), "--radius", "100", "--contact-tolerance", "0.005"],
                   check=True, capture_output=True)
    return start


def main():
    first, _, rest = __doc__.strip().partition("\n")
    parser = argparse.ArgumentParser(description=first, epilog=rest, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("breaker", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("agglomerate", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("smallest", nargs="?", type=int, default=2, help="clusters of so many particles (%(default)s)")
    parser.add_argument("largest", nargs="?", type=int, default=115, help="to so many (%(default)s)")
    options = parser.parse_args()
    breaker, agglomerate, smallest, largest = options.breaker, options.agglomerate, options.smallest, options.largest
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    # rate over the paper's, tolerances; the explicit integrator where it takes minutes at most
    plan = {"doublet 2": ([[0, 0, 0], [200, 0, 0]], [(1, [0.03, 0.01, 0.003, 0.001]), (100, [0.01, 0.001, "explicit"])]),
            "coil 20": (coil(20), [(1, [0.03, 0.01, 0.003, 0.001]), (1000, [0.03, 0.01, 0.001, "explicit"])]),
            "compact 85": (ROOT / "data" / "compact.h5", [(1, [0.02, 0.01, 0.005]), (10, [0.01])]),
            "hollow 115": (ROOT / "data" / "hollow.h5", [(1, [0.02, 0.01, 0.005]), (10, [0.01])])}
    print("| cluster | rate / 5000 Pa/s | control | CPU s | steps | breaks at Pa | error % |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="bench-breaker-") as folder:
        folder = pathlib.Path(folder)
        for name, (centres, ramps) in plan.items():
            if not smallest <= int(name.split()[-1]) <= largest:
                continue
            start = agglomerate_of(centres, agglomerate, folder) if isinstance(centres, list) else centres
            for rate, controls in ramps:
                rows = []
                for control in controls:
                    settings = [f'protocol.stage=[{{kind="rest", duration=0.1}}, {{kind="hold", stress=2, duration=0.1}}, {{kind="ramp", rate={PAPER * rate}}}]', "error.estimate=false"]
                    settings.append("integrator.method=explicit" if control == "explicit" else
                                    f"integrator.tolerance={control}")
                    if rate > 1:
                        settings[0] = f'protocol.stage=[{{kind="ramp", rate={PAPER * rate}}}]'
                    report = folder / "report.json"
                    subprocess.run([breaker, str(SCENE), str(start), "-o", str(folder / "out.h5"), "--overwrite", "--report",
                                    str(report), "--quiet", *[a for s in settings for a in ("--set", s)]],
                                   check=True, capture_output=True)
                    found = json.loads(report.read_text())
                    rows.append((control, found["cpu_s"], found["steps"], found["results"]["critical_stress_pa"]))
                finest = min((r for r in rows if r[0] != "explicit"), key=lambda r: r[0])[3]
                for control, cpu, steps, stress in rows:
                    error = f"{100 * (stress / finest - 1):+.3f}" if len(rows) > 1 else ""
                    label = control if control == "explicit" else f"tolerance {control}"
                    print(f"| {name} | {rate} | {label} | {cpu:.3g} | {steps} | {stress:.1f} | {error} |", flush=True)


if __name__ == "__main__":
    main()
