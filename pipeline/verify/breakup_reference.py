"""The default integrator of breaker against the explicit one on a cluster of 20.

The critical stress is the same within 0.5 %, and at 50 common stresses up to 95 % of it every gap is within 1e-2 of the pull-off gap.
The ramp is faster than the paper's, the same for both, so that the explicit one takes minutes.

    breakup_reference.py
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "breaker"), str(ROOT / "pipeline" / "report")]
import arguments  # noqa: E402
from bench import coil  # noqa: E402
from table import write_csv  # noqa: E402

BIN = ROOT / "build" / "release" / "bin"
SCENE = ROOT / "pipeline" / "scenes" / "breakup.toml"
RATE = 5e6
PULL_OFF_GAP = 0.0745864  # nm


def gaps(path, pairs, stress):
    """Of the given pairs at frames of the given stress, nm; only while the pair is bonded."""
    with h5py.File(path) as file:
        x, offset = file["particles/all/position/value"][:], file["contacts/offset"][:]
        bonds, seen = file["contacts/pair"][:], file["observables/flow_stress/value"][:]
        rows = []
        for value in stress:
            k = int(abs(seen - value).argmin())
            assert abs(seen[k] - value) < 1e-6 * value, (seen[k], value)
            bonded = {tuple(p) for p in bonds[offset[k]:offset[k + 1]]}
            rows.append([numpy.linalg.norm(x[k, j] - x[k, i]) - 200 if (i, j) in bonded else numpy.nan for i, j in pairs])
        return numpy.array(rows)


def command_line():
    return arguments.parser(__doc__)


def main():
    os.environ.update(OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    with tempfile.TemporaryDirectory(prefix="verify-breakup-") as folder:
        folder = pathlib.Path(folder)
        table = folder / "centres.csv"
        table.write_text("\n".join(["x,y,z"] + [",".join(f"{v:.12g}" for v in x) for x in coil(20)]) + "\n")
        start = folder / "start.h5"
        subprocess.run([BIN / "agglomerate", "import", table, "-o", start, "--radius", "100", "--contact-tolerance",
                        "0.005"], check=True, capture_output=True)

        def run(name, stages, *settings):
            report = folder / f"{name}.json"
            chosen = ["protocol.stage=[" + ", ".join(stages) + "]", "error.estimate=false", *settings]
            subprocess.run([BIN / "breaker", SCENE, start, "-o", folder / f"{name}.h5", "--report", report, "--quiet",
                            *[a for s in chosen for a in ("--set", s)]], check=True, capture_output=True)
            return json.loads(report.read_text())

        estimate = run("estimate", [f'{{kind="ramp", rate={RATE}}}'])["results"]["critical_stress_pa"]
        stresses = [0.95 * estimate * k / 50 for k in range(1, 51)]
        # A stage for every common stress, so that both integrators stop there; frames at each.
        stages, before = [], 0
        for stress in stresses:
            stages.append(f'{{kind="ramp", rate={RATE}, from={before!r}, to={stress!r}}}')
            before = stress
        stages.append(f'{{kind="ramp", rate={RATE}, from={before!r}}}')
        frames = "output.frame_interval=1e-3"
        fast = run("implicit", stages, frames, "integrator.tolerance=0.001")
        slow = run("explicit", stages, "output.frame_interval=1", "integrator.method=explicit")
        with h5py.File(start) as file:
            pairs = [tuple(p) for p in file["contacts/pair"][:]]
        difference = abs(gaps(folder / "implicit.h5", pairs, stresses) - gaps(folder / "explicit.h5", pairs, stresses))
        worst = float(numpy.nanmax(difference)) / PULL_OFF_GAP
        ratio = fast["results"]["critical_stress_pa"] / slow["results"]["critical_stress_pa"]
        rows = [["integrator", "critical_stress_pa", "steps", "cpu_s"]]
        rows += [[name, f"{r['results']['critical_stress_pa']:.2f}", r["steps"], f"{r['cpu_s']:.3g}"]
                 for name, r in (("implicit, tolerance 0.001", fast), ("explicit", slow))]
    results = ROOT / "pipeline" / "results" / "verify"
    results.mkdir(parents=True, exist_ok=True)
    write_csv(results / "breakup_reference.csv", rows[0], rows[1:])
    for row in rows:
        print(" | ".join(map(str, row)))
    print(f"ratio of critical stresses {ratio:.5f}; worst gap of a contact differs by {worst:.2g} pull-off gaps")
    return 0 if abs(ratio - 1) < 5e-3 and worst < 1e-2 else 1


if __name__ == "__main__":
    command_line().parse_args()
    sys.exit(main())
