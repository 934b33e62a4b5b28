"""Which points of the space of varied keys a campaign visits."""

import hashlib
import itertools
import math

import numpy

from scene_text import Fault, canonical

DESIGNS = ("grid", "together", "latin hypercube")
RANGE = {"from", "to", "count", "spacing"}


def _rounded(value):
    """Six digits: what stands in a scene can be read and typed."""
    return float(f"{value:.6g}")


def along(axis, share):
    """The value of a range a share of the way, 0 to 1, in equal differences or in equal ratios."""
    low, high = axis["from"], axis["to"]
    if axis.get("spacing", "linear") == "log":
        return _rounded(math.exp(math.log(low) + share * math.log(high / low)))
    value = _rounded(low + share * (high - low))
    return int(value) if isinstance(low, int) and isinstance(high, int) and value.is_integer() else value  # numbers of tracks, of particles


def _check_range(axis, where, design):
    if unknown := set(axis) - RANGE:
        raise Fault(f"{where}: {sorted(unknown)[0]}: not known in a range; there are from, to, count, spacing")
    for name in ("from", "to"):
        if not isinstance(axis.get(name), (int, float)):
            raise Fault(f"{where}: a range needs the number '{name}'")
    if axis.get("spacing", "linear") not in ("linear", "log"):
        raise Fault(f"{where}: spacing = \"{axis['spacing']}\": linear or log")
    if axis["to"] <= axis["from"]:
        raise Fault(f"{where}: 'to' must be above 'from'")
    if axis.get("spacing") == "log" and axis["from"] <= 0:
        raise Fault(f"{where}: a range with spacing = \"log\" begins above 0")
    if design == "latin hypercube":
        if "count" in axis:
            raise Fault(f"{where}: 'count' has no meaning in a latin hypercube: its 'points' says how many values there are")
    elif not isinstance(axis.get("count"), int) or axis["count"] < 2:
        raise Fault(f"{where}: a range needs 'count', two or more")


def _values(axis, where, design):
    if isinstance(axis, dict):
        _check_range(axis, where, design)
        return [along(axis, k / (axis["count"] - 1)) for k in range(axis["count"])]
    if not isinstance(axis, list) or not axis:
        raise Fault(f"{where}: must be a list of values, or a range {{from = 1, to = 10, count = 4, spacing = \"log\"}}")
    return axis


def _latin_hypercube(axes, count, where):
    """Every range is cut in `count` strata, and each is visited once (McKay, Beckman & Conover 1979); drawn from a hash of
    the design, so that it is the same on every machine."""
    drawn = numpy.random.Generator(numpy.random.Philox(int(hashlib.sha256(canonical([axes, count]).encode()).hexdigest()[:16], 16)))
    columns = []
    for key, axis in axes.items():
        shares = (drawn.permutation(count) + drawn.random(count)) / count
        if isinstance(axis, dict):
            _check_range(axis, f"{where}.\"{key}\"", "latin hypercube")
            columns.append([along(axis, share) for share in shares])
        else:
            listed = _values(axis, f"{where}.\"{key}\"", "latin hypercube")
            columns.append([listed[int(share * len(listed))] for share in shares])
    return zip(*columns)


def points(axes, design, count, where):
    """[{key: value}] of one block [[vary]]; where: file and block, for messages."""
    if design not in DESIGNS:
        raise Fault(f"{where}.design = \"{design}\": one of {', '.join(DESIGNS)}")
    if design == "latin hypercube":
        if not isinstance(count, int) or count < 1:
            raise Fault(f"{where}.points: how many points the latin hypercube has")
        rows = _latin_hypercube(axes, count, where)
    else:
        if count is not None:
            raise Fault(f"{where}.points has no meaning where design = \"{design}\"")
        columns = [_values(axis, f"{where}.\"{key}\"", design) for key, axis in axes.items()]
        if design == "together":
            if len(set(map(len, columns))) > 1:
                raise Fault(f"{where}: lists that go together must be of one length; they have "
                            + ", ".join(str(len(column)) for column in columns))
            rows = zip(*columns)
        else:
            rows = itertools.product(*columns)
    return [dict(zip(axes, row)) for row in rows]
