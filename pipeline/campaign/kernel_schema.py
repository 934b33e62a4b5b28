"""What kernel.json holds: the one table that the writer is checked against and that the manual shows."""

from scene_text import Fault

FORMAT = "crumble breakage kernel 1.0"
NUMBER, TEXT, LIST, TABLE, WHOLE = "number", "text", "list", "table", "whole number"
# (path, kind, unit, meaning); [] stands for each element, a name in <> for any; ? at the end: may be absent or null.
FIELDS = [
    ("format", TEXT, "", f'"{FORMAT}"'),
    ("campaign", TEXT, "", "file that the granules were made from"),
    ("commit", TEXT, "", "of the programs that made them"),
    ("granules_sha256", TEXT, "", "of critical_stress.csv"),
    ("material.particle_radius", NUMBER, "m", "a, of the loaded granules"),
    ("material.surface_energy", NUMBER, "J m-2", "gamma_s"),
    ("material.youngs_modulus", NUMBER, "Pa", "E"),
    ("material.poisson_ratio", NUMBER, "", "nu"),
    ("liquid.viscosity", NUMBER, "Pa s", "mu, for which the dictionaries are"),
    ("liquid.density", NUMBER, "kg m-3", "rho"),
    ("strength", TEXT, "", "which critical stress the fits are of, and in which flow"),
    ("numerical_error", NUMBER, "relative", "mean of what the runs state?"),
    ("classes[].point", TABLE, "", "values of the varied keys"),
    ("classes[].granules", WHOLE, "", "with a critical stress"),
    ("classes[].censored", WHOLE, "", "did not break up to the largest stress tried"),
    ("classes[].without_value", WHOLE, "", "have none, such as granules that settle nowhere"),
    ("classes[].failed", WHOLE, "", "of which the run ended with an error"),
    ("classes[].particles", NUMBER, "", "N, mean"),
    ("classes[].radius_of_gyration", NUMBER, "m", "R_g, mean, at the loaded size"),
    ("classes[].radius", NUMBER, "m", "R_c, half of the granule's diameter, mean, at the loaded size"),
    ("classes[].coordination", NUMBER, "", "contacts a particle, times two, mean"),
    ("classes[].mean", NUMBER, "Pa", "of the critical stress?"),
    ("classes[].mean_interval", LIST, "Pa", "95 %, bootstrap?"),
    ("classes[].quantiles.<share>.value", NUMBER, "Pa", "critical stress below which this share breaks?"),
    ("classes[].quantiles.<share>.interval", LIST, "Pa", "95 %; null on a side: the sample is too small to bound it"),
    ("classes[].weibull.modulus", NUMBER, "", "of the fit?"),
    ("classes[].weibull.modulus_interval", LIST, "", "95 %?"),
    ("classes[].weibull.scale", NUMBER, "Pa", "of the fit?"),
    ("classes[].weibull.scale_interval", LIST, "Pa", "95 %?"),
    ("classes[].weibull.covariance", LIST, "", "of ln modulus and ln scale?"),
    ("classes[].weibull.range", LIST, "Pa", "lowest and highest stress of the data?"),
    ("classes[].weibull.distance", NUMBER, "", "largest, of shares?"),
    ("classes[].weibull.p", NUMBER, "", "share of Weibull samples that lie farther from their fits?"),
    ("classes[].weibull.refused", TEXT, "", "why there is no fit?"),
    ("size_law.exponent", NUMBER, "", "p of sigma_cr = factor R_c^-p?"),
    ("size_law.exponent_interval", LIST, "", "95 %?"),
    ("size_law.factor", NUMBER, "Pa m^p", "?"),
    ("size_law.covariance", LIST, "", "of p and ln factor?"),
    ("size_law.range", LIST, "m", "smallest and largest R_c?"),
    ("size_law.misfit", NUMBER, "relative", "largest of a class?"),
    ("size_law.refused", TEXT, "", "why there is none?"),
    ("rate_law.exponent", NUMBER, "", "q of rate = factor (sigma_rms/sigma_cr)^q sqrt(epsilon/nu)?"),
    ("rate_law.exponent_interval", LIST, "", "95 %?"),
    ("rate_law.factor", NUMBER, "", "?"),
    ("rate_law.factor_interval", LIST, "", "95 %?"),
    ("rate_law.range", LIST, "", "lowest and highest sigma_rms/sigma_cr?"),
    ("rate_law.misfit", NUMBER, "relative", "largest in the range?"),
    ("rate_law.refused", TEXT, "", "why there is none?"),
    ("fragments.parents", WHOLE, "", "granules that broke?"),
    ("fragments.count", NUMBER, "", "fragments a breakup, mean?"),
    ("fragments.erosion_share", NUMBER, "", "of the mass, in pieces below a twentieth of the parent?"),
    ("fragments.moments", LIST, "", "b_k, k = 0 to 8, of L^k?"),
    ("fragments.fits", TABLE, "", "beta, schulz_zimm, erosive_quadratic: parameters and distance, or why refused?"),
    ("fragments.refused", TEXT, "", "why there is none?"),
    ("flexible_over_rigid.mean", NUMBER, "", "of the ratio of critical stresses in planar elongation?"),
    ("flexible_over_rigid.interval", LIST, "", "95 %, bootstrap?"),
    ("flexible_over_rigid.granules", WHOLE, "", "?"),
    ("flexible_over_rigid.refused", TEXT, "", "why there is none?"),
    ("dictionaries.openfoam", TEXT, "", "the file, or why there is none"),
    ("dictionaries.openqbmm", TEXT, "", "the file, or why there is none"),
    ("limits[]", TEXT, "", "what the kernel leaves out"),
]


def _found(tree, path):
    """All values at a path."""
    name, _, rest = path.partition(".")
    each = name.endswith("[]")
    name = name.removesuffix("[]")
    if not isinstance(tree, dict):
        return
    places = list(tree) if name.startswith("<") else [name]
    for place in places:
        values = tree.get(place)
        for value in (values if each and isinstance(values, list) else [values]):
            if rest:
                yield from _found(value, rest) if value is not None else [None]
            else:
                yield value


def _is(value, kind):
    if kind == WHOLE:
        return isinstance(value, int) and not isinstance(value, bool)
    if kind == NUMBER:
        return isinstance(value, (int, float)) and not isinstance(value, bool) and value == value and abs(value) != float("inf")
    return isinstance(value, {TEXT: str, LIST: list, TABLE: dict}[kind])


def _paths(tree, at=""):
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield from _paths(value, f"{at}.{key}" if at else key)
    elif isinstance(tree, list) and tree and isinstance(tree[0], dict):
        for value in tree:
            yield from _paths(value, f"{at}[]")
    else:
        yield at


def check(kernel, where):
    """Raises Fault that names the field."""
    if kernel.get("format") != FORMAT:
        raise Fault(f"{where}: format = {kernel.get('format')!r}: this reads {FORMAT!r}")
    known = []
    for path, kind, _, meaning in FIELDS:
        optional = meaning.endswith("?")
        known.append(path.replace("[]", "").split(".<")[0])
        values = list(_found(kernel, path))
        if not optional and (not values or None in values):
            raise Fault(f"{where}: {path} is missing")
        for value in values:
            if value is None and optional:
                continue
            if not _is(value, kind):
                raise Fault(f"{where}: {path} = {value!r}: must be a {kind}")
    for path in _paths(kernel):
        plain = path.replace("[]", "")
        if not any(plain == one or plain.startswith(one + ".") for one in known):
            raise Fault(f"{where}: {path} is not part of the format")


def page():
    """The table of the manual."""
    lines = ["| field | kind | unit | meaning |", "|---|---|---|---|"]
    for path, kind, unit, meaning in FIELDS:
        text = meaning.removesuffix("?")
        lines.append(f"| `{path}` | {kind}{' or absent' if meaning.endswith('?') else ''} | {unit} | {text} |")
    return "\n".join(lines) + "\n"
