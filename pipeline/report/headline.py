"""The numbers of one file that a page begins with, each with the error that the file states for it.

Values are those of `agglomerate morphology` and of the file; the relative errors are /errors and /response/error.
"""

import json
import math

import h5py

from packed import run

SHAPE = (("d_c_nm", "outer diameter d_c", "nm", "d_c"), ("h_c_over_d_c", "crust over diameter h_c/d_c", "", "h_c_over_d_c"),
         ("contacts", "contacts", "", "contacts"), ("coordination", "mean coordination", "", "contacts"),
         ("porosity", "porosity", "", None), ("radius_of_gyration_nm", "radius of gyration", "nm", None),
         ("fragments", "fragments", "", None))
FLOWS = {"elongation": "elongation, settled", "shear": "shear, worst orbit", "uniaxial": "uniaxial extension, settled",
         "biaxial": "biaxial extension, settled"}


def flow_title(name):
    base = name.removesuffix("-worst")
    return FLOWS.get(name, f"{base}, worst orientation" if name != base else name)


def number(value):
    """Counts whole, everything else to four digits."""
    return f"{value:,}".replace(",", "\u202f") if isinstance(value, int) else f"{value:.4g}" if abs(value) < 1e4 else f"{value:.0f}"


def in_unit(value, unit):
    """Lengths from a micrometre on in µm, stresses from 10 kPa on in kPa."""
    if unit == "nm" and abs(value) >= 1000:
        return value / 1000, "µm"
    if unit == "Pa" and abs(value) >= 10000:
        return value / 1000, "kPa"
    return value, unit


def with_error(value, relative, unit=""):
    """Value ± error, both to the second digit of the error at most; without an error the value alone."""
    scaled, unit = in_unit(value, unit)
    tail = f" {unit}" if unit else ""
    if relative is None or isinstance(value, float) and not math.isfinite(value):
        return number(scaled) + tail
    error = abs(relative * scaled)
    if error == 0:
        return f"{number(scaled)} ± 0{tail}"
    if isinstance(value, int):
        return f"{number(scaled)} ± {error:.2g}{tail}"
    digits = min(6, max(0, 1 - math.floor(math.log10(error))))
    return f"{scaled:.{digits}f} ± {error:.{digits}f}{tail}"


class Result:
    """One number: key, title, value, unit, relative error or None, how that was found."""

    def __init__(self, key, title, value, unit="", relative=None, how="not estimated"):
        self.key, self.title, self.value, self.unit, self.relative = key, title, value, unit, relative
        self.how = "counted in this frame" if isinstance(value, int) and relative is None else how

    def text(self):
        return with_error(self.value, self.relative, self.unit)


def stated(file, name):
    """Relative error of a result and how it was found."""
    if name is None or f"errors/{name}" not in file:
        return None, "not estimated"
    return float(file[f"errors/{name}"][()]), file[f"errors/{name}"].attrs.get("method", "stated in the file")


def of_shape(file, tool, path):
    shape = json.loads(run(tool, "morphology", path, "--json"))["frames"][-1]
    for key, title, unit, name in SHAPE:
        yield Result(key, title, shape[key], unit, *stated(file, name))


def of_breakup(file):
    if "breakup/critical_stress" in file:
        yield Result("critical_stress_pa", "critical stress (µγ̇)", float(file["breakup/critical_stress"][()]), "Pa", *stated(file, "critical_stress"))
    course = file["observables"]
    if "breakup/stress" in file:  # along a history
        yield Result("breakup_time_s", "breaks at", float(file["breakup/time"][()]), "s", *stated(file, "breakup_time"))
        yield Result("breakup_stress_pa", "stress then (µγ̇)", float(file["breakup/stress"][()]), "Pa")
    yield Result("largest_stress_pa", "largest stress reached", float(course["flow_stress/value"][:].max()), "Pa")
    for k, when in ((0, "first"), (-1, "last")):
        yield Result(f"contacts_{when}", f"contacts, {when} frame", int(course["contact_count/value"][k]))
    yield Result("fragments", "fragments, last frame", int(course["fragment_count/value"][-1]))
    yield Result("largest_fragment", "particles in the largest, last frame", int(course["largest_fragment/value"][-1]))


def of_loads(file):
    relative = float(file["response/error"][()]) if "response/error" in file else None
    how = "of the largest tension, by the hydrodynamics" if relative is not None else "not estimated"
    for name, group in file["flows"].items():
        if "critical_stress" in group:
            yield Result(f"{name}.critical_stress_pa", f"breaks at (µγ̇): {flow_title(name)}", float(group["critical_stress"][()]), "Pa",
                         relative, how)


def results(path, tool):
    """What a reader of this file asks for first comes first."""
    with h5py.File(path) as file:
        if "breakup" in file or "observables/flow_stress" in file:
            return list(of_breakup(file))
        loads = list(of_loads(file)) if "flows" in file else []
        return loads + list(of_shape(file, tool, path))
