"""What came out of each realisation: one row of a tidy table."""

import csv
import dataclasses
import json

import h5py

from plan import PROGRAMS
from table import write_csv


@dataclasses.dataclass(frozen=True)
class Quantity:
    name: str
    unit: str
    stage: str
    place: str          # in the results of the report
    error: str = ""     # its relative errors in the errors of the report, which add up
    above: str = ""     # where nothing happened: the largest value that was tried (censored)
    meaning: str = ""

    @property
    def heading(self):
        return f"{self.name} [{self.unit}]"


QUANTITIES = [
    Quantity("d_c", "nm", "dry", "d_c_nm", "d_c_relative", meaning="diameter of the granule"),
    Quantity("h_c_over_d_c", "1", "dry", "h_c_over_d_c", "h_c_over_d_c", meaning="crust over diameter"),
    Quantity("radius_of_gyration", "nm", "dry", "radius_of_gyration_nm"),
    Quantity("porosity", "1", "dry", "porosity"),
    Quantity("contacts", "1", "dry", "contacts", "contacts_relative"),
    Quantity("coordination", "1", "dry", "coordination"),
    Quantity("fragments", "1", "dry", "fragments", meaning="pieces after drying"),
    Quantity("critical_stress_elongation", "Pa", "stress", "elongation.critical_stress_settled_pa", "n_max_relative",
             meaning="rigid, planar elongation, settled"),
    Quantity("critical_stress_worst", "Pa", "stress", "elongation.critical_stress_worst_pa", "n_max_relative",
             meaning="rigid, elongation or shear, worst orientation"),
    Quantity("critical_stress_shear", "Pa", "stress", "shear.critical_stress_pa", "n_max_relative+shear_n_max_orbit_relative",
             meaning="rigid, shear, mean of the largest tensions of the orbits"),
    Quantity("critical_stress_uniaxial", "Pa", "stress", "uniaxial.critical_stress_settled_pa", "n_max_relative"),
    Quantity("critical_stress_biaxial", "Pa", "stress", "biaxial.critical_stress_settled_pa", "n_max_relative"),
    Quantity("n_max_elongation", "6 pi mu gamma_dot a^2", "stress", "elongation.n_max_settled", "n_max_relative"),
    Quantity("n_max_worst", "6 pi mu gamma_dot a^2", "stress", "elongation.n_max_worst", "n_max_relative"),
    Quantity("n_max_shear", "6 pi mu gamma_dot a^2", "stress", "shear.n_max_orbit", "n_max_relative+shear_n_max_orbit_relative"),
    Quantity("critical_stress_flexible", "Pa", "breakup", "critical_stress_pa", "critical_stress_relative", "largest_stress_pa",
             meaning="flexible, in the flow of its scene"),
    Quantity("breakup_time", "s", "breakup", "breakup_time_s", "breakup_time_relative", "followed_to_s", meaning="flexible, along a history"),
    Quantity("breakup_stress", "Pa", "breakup", "breakup_stress_pa", meaning="flexible, of the history where it broke the granule"),
    Quantity("first_rupture_stress", "Pa", "breakup", "first_rupture_stress_pa", "", "largest_stress_pa"),
]
BY_NAME = {quantity.name: quantity for quantity in QUANTITIES}


def within(tree, place):
    for name in place.split("."):
        if not isinstance(tree, dict) or name not in tree:
            return None, False
        tree = tree[name]
    return tree, True


@dataclasses.dataclass
class Row:
    realisation: object
    values: dict        # name of a quantity -> number; absent: not computed; None: has none (settles nowhere)
    above: dict         # name -> largest value tried, where nothing happened
    errors: dict        # name -> relative numerical error
    hashes: dict        # stage -> SHA-256 of its file
    reports: dict       # stage -> report
    failure: object     # runs.Failure, or None

    @property
    def point(self):
        return self.realisation.point

    @property
    def ids(self):
        """Stage -> id of its files, of those that are there."""
        return {run.stage: run.id for run in self.realisation.runs if run.stage in self.hashes}

    @property
    def id(self):
        return self.realisation.runs[0].id


def row(realisation, runs, sha256):
    found = Row(realisation, {}, {}, {}, {}, {}, None)
    for run in realisation.runs:
        if run.id in runs.failures:
            found.failure = runs.failures[run.id]
        elif runs.is_finished(run):
            found.reports[run.stage] = json.loads(runs.path(run, ".json").read_text())
            found.hashes[run.stage] = sha256(runs.path(run))
    for quantity in QUANTITIES:
        report = found.reports.get(quantity.stage)
        if report is None:
            continue
        value, known = within(report["results"], quantity.place)
        if not known:
            continue
        found.values[quantity.name] = value
        errors = [one for name in quantity.error.split("+") if (one := within(report["errors"], f"{name}.value")[0]) is not None]
        if errors:
            found.errors[quantity.name] = sum(errors)
        if value is None and quantity.above:
            found.above[quantity.name] = report["results"][quantity.above]
    return found


def present(rows):
    """Quantities that any row has."""
    return [quantity for quantity in QUANTITIES if any(quantity.name in row.values for row in rows)]


def _cell(value):
    return "" if value is None else f"{value:.9g}" if isinstance(value, float) else value


def write(path, plan, rows):
    """granules.csv: one row a realisation; units in brackets."""
    quantities = present(rows)
    failed = any(row.failure for row in rows)
    censored = [quantity for quantity in quantities if any(quantity.name in row.above for row in rows)]
    judged = [quantity for quantity in quantities if any(quantity.name in row.errors for row in rows)]
    stages = [stage for stage in PROGRAMS if any(stage in row.hashes for row in rows)]
    heading = ["id", "seed", *(f"{key} [{plan.unit(key) or '1'}]" for key in plan.varied), *(q.heading for q in quantities),
               *(f"{q.name}_above [{q.unit}]" for q in censored), *(f"{q.name}_error [relative]" for q in judged),
               *(f"{stage}_id" for stage in stages if stage != "dry"), *(f"{stage}_cpu [s]" for stage in stages), *(f"{stage}_sha256" for stage in stages), *(["failed"] if failed else [])]
    lines = []
    for row in rows:
        lines.append([row.id, row.realisation.runs[0].scene["run"]["seed"], *(_cell(row.point.get(key)) for key in plan.varied),
                      *(_cell(row.values.get(q.name)) for q in quantities), *(_cell(row.above.get(q.name)) for q in censored),
                      *(_cell(row.errors.get(q.name)) for q in judged), *(row.ids.get(stage, "") for stage in stages if stage != "dry"),
                      *(_cell(row.reports.get(stage, {}).get("cpu_s")) for stage in stages),
                      *(row.hashes.get(stage, "") for stage in stages),
                      *([f"{row.failure.stage}, exit code {row.failure.code}: {row.failure.words}" if row.failure else ""] if failed else [])])
    write_csv(path, heading, lines, [f"{plan.path.name}: one row a granule; an empty cell was not computed or has no value; "
                                            "_above: nothing broke up to there; _error: numerical, as each run states it"], keep=True)


def commits(rows, runs):
    """Commits of the programs that made the files, first found first."""
    found = {}
    for row in rows:
        for run in row.realisation.runs:
            if run.stage in row.hashes:
                with h5py.File(runs.path(run)) as file:
                    made = file["parameters/provenance"].attrs
                    found[str(made["git"])[:7] + (" with changes" if made["dirty"] else "")] = True
    return list(found)


def read(path):
    """The table again: [{heading: text}]."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))
