"""Time against error of the breaker: tolerances, ramp rates and integrators, 2 to 115 particles.

    bench.py BREAKER AGGLOMERATE [LARGEST]      (LARGEST: skip clusters with more particles)

Times are CPU seconds of one core. The error is that of the critical stress against the finest run of the same ramp.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from coil import coil

HERE = pathlib.Path(__file__).resolve().parent
SCENE = HERE.parents[1] / "pipeline" / "scenes" / "breakup.toml"
PAPER = 5000  # Pa/s at 1 Pa s


def dried(name):
    """Centres in nm of a cluster of tests/hydro/dried."""
    rows = [line.split() for line in (HERE.parent / "hydro" / "dried" / name).read_text().splitlines()
            if not line.startswith("#")]
    count = int(rows[0][0])
    return [[100 * float(v) for v in row] for row in rows[1:1 + count]]


def main():
    breaker, agglomerate = (str(pathlib.Path(p).resolve()) for p in sys.argv[1:3])
    largest = int(sys.argv[3]) if len(sys.argv) > 3 else 115
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    # rate over the paper's, tolerances; the explicit integrator where it takes minutes at most
    plan = {"doublet 2": ([[0, 0, 0], [200, 0, 0]], [(1, [0.03, 0.01, 0.003, 0.001]), (100, [0.01, 0.001, "explicit"])]),
            "coil 20": (coil(20), [(1, [0.03, 0.01, 0.003, 0.001]), (1000, [0.03, 0.01, 0.001, "explicit"])]),
            "compact 85": (dried("compact_85.txt"), [(1, [0.03, 0.01, 0.003]), (10, [0.01])]),
            "hollow 115": (dried("hollow_115.txt"), [(1, [0.03, 0.01, 0.003]), (10, [0.01])])}
    print("| cluster | rate / 5000 Pa/s | control | CPU s | steps | breaks at Pa | error % |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="bench-breaker-") as folder:
        folder = pathlib.Path(folder)
        for name, (centres, ramps) in plan.items():
            if int(name.split()[-1]) > largest:
                continue
            table = folder / "centres.csv"
            table.write_text("\n".join(["x,y,z"] + [",".join(f"{v:.12g}" for v in x) for x in centres]) + "\n")
            start = folder / "start.h5"
            start.unlink(missing_ok=True)
            subprocess.run([agglomerate, "import", str(table), "-o", str(start), "--radius", "100",
                            "--contact-tolerance", "0.005"], check=True, capture_output=True)
            for rate, controls in ramps:
                rows = []
                for control in controls:
                    settings = [f"protocol.stages=rest 0.1; hold 2 for 0.1; ramp {PAPER * rate}", "error.estimate=false"]
                    settings.append("integrator.method=explicit" if control == "explicit" else
                                    f"integrator.tolerance={control}")
                    if rate > 1:
                        settings[0] = f"protocol.stages=ramp {PAPER * rate}"
                    report = folder / "report.json"
                    subprocess.run([breaker, str(SCENE), str(start), "-o", str(folder / "out.h5"), "--report",
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
