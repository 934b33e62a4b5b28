"""Which choice decides the granule at Pe = 10? One choice changed at a time, means over the same seeds.

The paper's compact granule (Pe = 1, one realisation) has coordination 4.16 and d_c = 132 nm.

    brownian_choices.py --seeds 1 2 --jobs 2
"""

from drying import runs
from interval import difference
from table import print_markdown

# name of the files: (what is chosen, settings); the longest first
CHOICES = {
    "brownian_fine": ("half the step", {"integrator.contact_step": 0.075}),
    "brownian_tension_x3": ("surface tension x 3", {"fluid.surface_tension": 5.25e-4}),
    "brownian_everything": ("noise on dry particles, too", {"dry.everything_acts": "true"}),
    "brownian_adhesive_4": ("surface energy x 4, bond of 42 kT", {"material.surface_energy": 19.2e-3}),
    "brownian_adhesive_2": ("surface energy x 2, bond of 13 kT", {"material.surface_energy": 9.6e-3}),
    "brownian_default": ("defaults", {}),
    # E/8 and surface energy x 8^(-2/5) keep the 4.2 kT of the bond, which becomes 2.3 times as wide and so holds pairs longer.
    "brownian_energy": ("softened at the same bond energy", {"integrator.softening": 1, "material.youngs_modulus": 4.25e8,
                                                             "material.surface_energy": 2.089e-3}),
    "brownian_rolling": ("rolling limit x 0.44", {"contact.rolling_limit_factor": 0.44}),
    "brownian_endless": ("rolling and twisting unlimited", {"contact.rolling_limit_factor": 1e6,
                                                            "contact.twisting_limit_factor": 1e6}),
    "brownian_free": ("no rolling or twisting resistance", {"contact.rolling_limit_factor": 0,
                                                            "contact.twisting_limit_factor": 0}),
    "brownian_fast": ("Pe = 100: lifetime / 10", {"droplet.peclet": 100}),
}


def command_line():
    return runs.arguments(__doc__, [1, 2, 3])


def main(options):
    runs.require_programs()
    results = runs.run_all({name: settings for name, (_, settings) in CHOICES.items()}, options.seeds, options.jobs,
                           "pipeline/scenes/intermediate.toml")
    default = results["brownian_default"]
    print(f"\n{runs.machine()}\n")
    rows = []
    for name, (what, _) in CHOICES.items():
        found = results[name]
        row = [what, str(len(found)), f"{runs.mean(found, 'd_c_nm'):.1f} ± {runs.spread(found, 'd_c_nm'):.1f}",
               f"{runs.mean(found, 'h_c_over_d_c'):.3f}",
               f"{runs.mean(found, 'contacts'):.0f} ± {runs.spread(found, 'contacts'):.0f}"]
        shift, half = difference([r["contacts"] for r in found], [r["contacts"] for r in default])
        row.append("" if found is default else f"{100 * shift / runs.mean(default, 'contacts'):+.0f} ± "
                                               f"{100 * half / runs.mean(default, 'contacts'):.0f}")
        rows.append(row + [f"{runs.mean(found, 'coordination'):.2f}", f"{runs.mean(found, 'fragments'):.1f}",
                           f"{runs.mean(found, 'cpu_s'):.1f}"])
    heading = ["choice", "seeds", "d_c nm", "h_c/d_c", "contacts", "contacts, change %", "coordination", "fragments", "CPU s"]
    print_markdown(heading, rows)
    runs.store("brownian_choices.csv", __doc__.splitlines()[0], heading, rows)
    of = {name: runs.mean(found, "contacts") for name, found in results.items()}
    usual = of["brownian_default"]
    runs.judge([("rolling resistance changes the contacts by less than 5 %",
                 all(abs(of[name] / usual - 1) < 0.05 for name in ("brownian_rolling", "brownian_endless"))),
                ("half the step changes the contacts by less than 3 %", abs(of["brownian_fine"] / usual - 1) < 0.03),
                ("every granule of the defaults is one piece", all(r["fragments"] == 1 for r in default))])


if __name__ == "__main__":
    main(command_line().parse_args())
