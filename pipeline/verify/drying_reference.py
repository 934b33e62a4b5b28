"""The fast integrator of the dryer against the reference: overdamped and inertial, same start, lifetime and law.

Both at the full JKR stiffness and the defaults of pipeline/scenes/hollow.toml (N = 115, Pe -> infinity). An inertial
run takes minutes.

    drying_reference.py --seeds 1 2 --jobs 2
"""

from drying import runs
from table import print_markdown

METHODS = ["inertial", "overdamped"]  # the long runs first
QUANTITIES = [("d_c_nm", "d_c nm", ".2f"), ("h_c_over_d_c", "h_c/d_c", ".4f"), ("contacts", "contacts", "d")]


def percent(fast, reference, key):
    return 100 * (fast[key] / reference[key] - 1)


def table(results, form):
    out = []
    for fast, reference in zip(results["reference_overdamped"], results["reference_inertial"]):
        row = [str(fast["seed"])]
        for key, _, digits in QUANTITIES:
            row += [form(fast[key], digits), form(reference[key], digits), form(percent(fast, reference, key), "+.2f")]
        seconds, reference_seconds = fast["cpu_s"], reference["cpu_s"]
        row += [form(seconds, ".2f"), form(reference_seconds, ".1f"), form(reference_seconds / seconds, ".0f")]
        out.append(row)
    return out


def claims(results):
    out = []
    for fast, reference in zip(results["reference_overdamped"], results["reference_inertial"]):
        d_c, contacts = percent(fast, reference, "d_c_nm"), percent(fast, reference, "contacts")
        out.append((f"seed {fast['seed']}: d_c differs by {d_c:+.2f} %, less than 1 %", abs(d_c) < 1))
        out.append((f"seed {fast['seed']}: contacts differ by {contacts:+.2f} %, less than 5 %", abs(contacts) < 5))
    return out


def command_line():
    return runs.arguments(__doc__, [1, 2, 3, 4, 5])


def main(options):
    runs.require_programs()
    cases = {f"reference_{method}": {"integrator.method": method} for method in METHODS}
    results = runs.run_all(cases, options.seeds, options.jobs)
    print(f"\n{runs.machine()}\n")
    heading = ["seed"]
    columns = ["seed"]
    for key, title, _ in QUANTITIES:
        heading += [title, "inertial", "%"]
        columns += [f"{key}_overdamped", f"{key}_inertial", f"{key}_difference_percent"]
    print_markdown(heading + ["CPU s", "inertial", "ratio"], table(results, lambda x, digits: f"{x:{digits}}"))
    print("\nFor each quantity: overdamped, inertial, difference; last the CPU seconds of both and their ratio.\n")
    runs.store("drying_reference.csv", "overdamped against inertial, same starts",
                   columns + ["cpu_s_overdamped", "cpu_s_inertial", "cpu_ratio"],
                   table(results, lambda x, _: f"{x:.6g}"))
    runs.judge(claims(results))


if __name__ == "__main__":
    main(command_line().parse_args())
