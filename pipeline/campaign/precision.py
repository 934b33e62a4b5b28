"""How many more granules until an interval is narrow enough."""

import dataclasses
import math
import re

from outcome import BY_NAME
from scene_text import Fault, canonical
from summary import by_point, record

FEWEST = 5   # a spread from fewer says too little
MOST = 1000  # granules of a point


@dataclasses.dataclass
class Wish:
    """Half of the 95 % interval of the mean, over the mean."""
    name: str
    relative: float


def wish(text):
    """"critical_stress 5 %"; the name may stand for the first quantity that it begins."""
    match = re.fullmatch(r"\s*(\w+)\s+([0-9.]+(?:e-?[0-9]+)?)\s*%\s*", text)
    if not match:
        raise Fault(f"--more-until '{text}': must be a quantity and a percentage, as in \"critical_stress 5 %\"")
    if not any(name.startswith(match[1]) for name in BY_NAME):
        raise Fault(f"--more-until '{text}': there is no quantity '{match[1]}'; there are {', '.join(BY_NAME)}")
    relative = float(match[2]) / 100
    if not 0.001 <= relative <= 1:
        raise Fault(f"--more-until '{text}': between 0.1 % and 100 %")
    return Wish(match[1], relative)


def quantity_of(wanted, rows):
    for name, quantity in BY_NAME.items():
        if name.startswith(wanted.name) and any(row.values.get(name) is not None for row in rows):
            return quantity
    return None


def more(wanted, plan, rows):
    """{canonical point: granules it should have} for points whose interval is too wide; {} when all are narrow enough. The
    error falls as the root of the number; never more than twice as many at once, for the spread is only an estimate."""
    quantity = quantity_of(wanted, rows)
    if quantity is None:
        raise Fault(f"--more-until: no granule has a {wanted.name}")
    found = {}
    for point, of in by_point(plan, rows):
        known = record(plan, point, of, quantity)
        count, relative = len(of), known["sampling_error_relative"]
        if count >= FEWEST and relative is not None and relative <= wanted.relative:
            continue
        if known["censored"]:
            raise Fault(f"--more-until: at {point or 'the base scene'} {known['censored']} granules did not break: the mean of {quantity.name} is not known")
        if count >= MOST:
            raise Fault(f"--more-until: {count} granules at {point or 'the base scene'} and the interval of {quantity.name} still is {100 * (relative or math.nan):.2g} %")
        wanted_count = 2 * count if relative is None else math.ceil(1.05 * count * (relative / wanted.relative) ** 2)
        found[canonical(point)] = min(MOST, max(FEWEST, count + 1, min(wanted_count, 2 * count)))
    return found
