"""What softened contacts do to a granule that dries at Pe = 10: against full stiffness, means over seeds.

    /usr/bin/python3 pipeline/verify/brownian_reference.py [--seeds 1 2 ... 8] [--jobs 2]

With noise, two runs of one seed part after a while, so only means can be compared: the difference of each quantity with
its 95 % interval (Welch). Also writes pipeline/verify/brownian.json, from which the tables of `make -C pipeline` take the
errors of their rows with Brownian motion. Compact granules (Pe = 1) take ten times as long; their row borrows the
differences found here.
"""

import json
import math

from drying import runs

CASES = {"brownian_full": {"integrator.softening": 1}, "brownian_default": {},
         "brownian_soft_2": {"integrator.softening": 2}}
QUANTITIES = [("d_c_nm", "d_c nm", ".2f"), ("h_c_over_d_c", "h_c/d_c", ".4f"), ("contacts", "contacts", ".1f")]
T95 = [math.nan, 12.71, 4.30, 3.18, 2.78, 2.57, 2.45, 2.36, 2.31, 2.26, 2.23]


def difference(rows, reference, key):
    """Difference of means and half of its 95 % interval."""
    half = T95[min(len(rows) + len(reference) - 2, 10)] * math.sqrt(
        runs.spread(rows, key) ** 2 / len(rows) + runs.spread(reference, key) ** 2 / len(reference))
    return runs.mean(rows, key) - runs.mean(reference, key), half


def main():
    options = runs.arguments(__doc__.splitlines()[0], [1, 2, 3, 4, 5, 6, 7, 8])
    runs.require_programs()
    results = runs.run_all(CASES, options.seeds, options.jobs, "pipeline/scenes/intermediate.toml")
    full = results["brownian_full"]
    print(f"\n{runs.machine()}\n")
    rows = []
    for name, found in results.items():
        row = [name.removeprefix("brownian_").replace("_", " "), str(len(found))]
        for key, _, digits in QUANTITIES:
            row.append(f"{runs.mean(found, key):{digits}} +- {runs.spread(found, key):{digits}}")
            if found is not full:
                shift, half = difference(found, full, key)
                row.append(f"{100 * shift / runs.mean(full, key):+.1f} +- {100 * half / runs.mean(full, key):.1f}")
            else:
                row.append("")
        rows.append(row + [f"{runs.mean(found, 'cpu_s'):.1f}"])
    heading = ["contacts of", "seeds"]
    for _, title, _ in QUANTITIES:
        heading += [title, "difference %"]
    runs.print_table(heading + ["CPU s"], rows)
    runs.write_csv("brownian_reference.csv", [__doc__.splitlines()[0], runs.machine()], heading + ["cpu_s"], rows)

    default = results["brownian_default"]
    how = (f"difference of means to contacts of full stiffness at Pe = 10, N = 102, {len(default)} seeds each "
           "(95 % interval in pipeline/verify/README.md)")
    stored = {"how": how}
    for key, error in (("d_c_nm", "d_c_relative"), ("h_c_over_d_c", "h_c_over_d_c"), ("contacts", "contacts_relative")):
        shift, half = difference(default, full, key)
        scale = 1 if key == "h_c_over_d_c" else runs.mean(full, key)
        stored[error] = {"difference": round(shift / scale, 5), "interval_95": round(half / scale, 5)}
    path = runs.ROOT / "pipeline/verify/brownian.json"
    path.write_text(json.dumps({"intermediate": stored, "compact": stored}, indent=1) + "\n", encoding="utf-8")
    print(f"written: {path.relative_to(runs.ROOT)}")
    d_c, d_half = (100 * x / runs.mean(full, "d_c_nm") for x in difference(default, full, "d_c_nm"))
    contacts, half = (100 * x / runs.mean(full, "contacts") for x in difference(default, full, "contacts"))
    runs.judge([(f"d_c differs by {d_c:+.2f} +- {d_half:.2f} %, less than 2 %", abs(d_c) < 2),
                (f"contacts differ by {contacts:+.2f} +- {half:.2f} %, less than 5 %", abs(contacts) < 5)])


if __name__ == "__main__":
    main()
