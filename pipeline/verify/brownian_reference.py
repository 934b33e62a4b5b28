"""What softened contacts do to a granule that dries at Pe = 10: against full stiffness, means over seeds.

    /usr/bin/python3 pipeline/verify/brownian_reference.py [--seeds 1 2 ... 8] [--jobs 2]

With noise, two runs of one seed part after a while, so only means can be compared: the difference of each quantity with
its 95 % interval (Welch). Also writes pipeline/verify/brownian.json, from which the tables of `make -C pipeline` take the
errors of their rows with Brownian motion. Compact granules (Pe = 1) take eight times as long; their row borrows the
differences found here.
"""

import json

from drying import runs
from interval import difference
from table import print_markdown

SCENE = "pipeline/scenes/intermediate.toml"
CASES = {"brownian_full": {"integrator.softening": 1}, "brownian_soft_1.25": {"integrator.softening": 1.25}}
DEFAULT_SEEDS = range(1, 26)  # the default is cheap: many seeds narrow the interval
# key of the result, title, format, key in brownian.json, whether that is a fraction of the value
QUANTITIES = [("d_c_nm", "d_c nm", ".2f", "d_c_relative", True), ("h_c_over_d_c", "h_c/d_c", ".4f", "h_c_over_d_c", False),
              ("contacts", "contacts", ".1f", "contacts_relative", True)]


def values(rows, key):
    return [row[key] for row in rows]


def main():
    options = runs.arguments(__doc__.splitlines()[0], [1, 2, 3, 4, 5, 6, 7, 8])
    runs.require_programs()
    results = runs.run_all(CASES, options.seeds, options.jobs, SCENE)
    results |= runs.run_all({"brownian_default": {}}, DEFAULT_SEEDS, options.jobs, SCENE)
    full = results["brownian_full"]
    print(f"\n{runs.machine()}\n")
    rows = []
    for name, found in results.items():
        row = [name.removeprefix("brownian_").replace("_", " "), str(len(found))]
        for key, _, digits, _, _ in QUANTITIES:
            row.append(f"{runs.mean(found, key):{digits}} +- {runs.spread(found, key):{digits}}")
            shift, half = (100 * x / runs.mean(full, key) for x in difference(values(found, key), values(full, key)))
            row.append("" if found is full else f"{shift:+.1f} +- {half:.1f}")
        rows.append(row + [f"{runs.mean(found, 'cpu_s'):.1f}"])
    heading = ["contacts of", "seeds"]
    for _, title, *_ in QUANTITIES:
        heading += [title, "difference %"]
    print_markdown(heading + ["CPU s"], rows)
    runs.store("brownian_reference.csv", __doc__.splitlines()[0], heading + ["cpu_s"], rows)

    default = results["brownian_default"]
    stored = {"rows": ["intermediate", "compact"],
              "how": f"difference of means to contacts of full stiffness at Pe = 10, N = 102, {len(default)} and {len(full)} "
                     "seeds (95 % interval in pipeline/verify/README.md)"}
    claims = []
    for key, title, _, name, relative in QUANTITIES:
        shift, half = difference(values(default, key), values(full, key))
        scale = runs.mean(full, key) if relative else 1
        stored[name] = {"difference": round(shift / scale, 5), "interval_95": round(half / scale, 5)}
        bound = {"d_c_nm": 0.02, "contacts": 0.05}.get(key)
        if bound:
            claims.append((f"{title}: 95 % interval of the difference, {100 * (shift - half) / scale:+.1f} to "
                           f"{100 * (shift + half) / scale:+.1f} %, within +-{100 * bound:g} %",
                           abs(shift) + half < bound * scale))
    path = runs.ROOT / "pipeline/verify/brownian.json"
    path.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")
    print(f"written: {path.relative_to(runs.ROOT)}")
    runs.judge(claims)


if __name__ == "__main__":
    main()
