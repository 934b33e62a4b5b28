"""Campaigns: many granules from one file, their strengths with intervals, and what others make of them.

    campaign run my.toml -o results/my
    campaign run my.toml -o results/my --more-until "critical_stress 5 %"
    campaign kernel my.toml -o results/my
    campaign strength my.toml -o results/my --liquid "syrup 0.1 Pa s 1200 kg/m3"

README.md beside this script explains the keys of my.toml.
"""

import contextlib
import pathlib
import sys
import time

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(1, str(FOLDER.parent / "report"))

import answer  # noqa: E402
import arguments  # noqa: E402
import drawing  # noqa: E402
import folder  # noqa: E402
import kernel  # noqa: E402
import outcome  # noqa: E402
import plan as plans  # noqa: E402
import precision  # noqa: E402
import runs as running  # noqa: E402
import size_law  # noqa: E402
import summary  # noqa: E402
import whole  # noqa: E402
from scene_text import Fault  # noqa: E402

ROOT = FOLDER.parents[1]


def command_line():
    parser = arguments.parser(__doc__)
    verbs = parser.add_subparsers(dest="verb", required=True)
    add_kernel(verbs)
    add_strength(verbs)
    run = verbs.add_parser("run", help="make what is missing, then tables and figures", allow_abbrev=False)
    add_common(run)
    run.add_argument("--jobs", type=int, help="runs side by side (default: the key 'jobs', else the number of processors)")
    run.add_argument("--more-until", metavar='"QUANTITY N %"', help="add granules until half of the 95 %% interval of this mean is N %% of it, at every point")
    return parser


def add_kernel(verbs):
    verb = verbs.add_parser("kernel", help="breakage kernel of the granules: FOLDER/kernel; makes what is missing", allow_abbrev=False)
    add_common(verb)
    verb.add_argument("--jobs", type=int)
    verb.set_defaults(more_until=None)


def add_strength(verbs):
    verb = verbs.add_parser("strength", help="at which shear rate in which liquid and device 10, 50, 90 %% of the granules break; makes what is missing", allow_abbrev=False)
    add_common(verb)
    verb.add_argument("--jobs", type=int)
    verb.add_argument("--liquid", action="append", default=[], metavar='"NAME VISCOSITY Pa s DENSITY kg/m3"', help="beside that of the scene and blood")
    verb.add_argument("--break-at", type=float, metavar="PA", help="also say which value of the varied key makes granules of which half break at this stress")
    verb.set_defaults(more_until=None)


def add_common(verb):
    verb.add_argument("campaign", type=arguments.file, metavar="CAMPAIGN.toml")
    verb.add_argument("-o", dest="out", type=pathlib.Path, metavar="FOLDER", required=True, help="where results go")
    verb.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bin", metavar="FOLDER", help="with dryer, rigidstress and breaker")


def link_histories(histories, folder):
    for name, source in histories.items():
        place = folder / name
        place.parent.mkdir(parents=True, exist_ok=True)
        if not place.exists():
            place.unlink(missing_ok=True)
            place.symlink_to(source.resolve())


class Progress:
    """A line on stderr: how many granules are there, and how long the others take if they are like those made so far."""

    def __init__(self):
        self.start = self.said = time.monotonic()

    def __call__(self, number, of, made):
        now, terminal = time.monotonic(), sys.stderr.isatty()
        if number != of and now - self.said < (0.5 if terminal else 30):
            return
        self.said = now
        left = (now - self.start) / made * (of - number) if made else 0
        words = f"{number} of {of} granules" + (f", some {left / 60:.0f} min to go" if left > 90 else f", some {left:.0f} s to go" if left > 2 else "")
        print(f"\r{words}\033[K" if terminal else words, end="\n" if number == of or not terminal else "", file=sys.stderr, flush=True)


def granules(options):
    """The plan and a row for every granule that is asked for, after making what is missing."""
    plan, histories = plans.read(options.campaign, options.programs)
    wanted = precision.wish(options.more_until) if options.more_until else None
    if wanted and any(isinstance(seeds, list) for _, seeds in plan.points):
        raise Fault(f"{options.campaign}: seeds: a list cannot grow; --more-until needs a number of granules")
    options.out.mkdir(parents=True, exist_ok=True)
    options.owned.enter_context(folder.own(options.out))
    link_histories(histories, options.out)
    runs = running.Runs(options.out, options.programs)
    more = {}
    for point, seeds in plan.points:
        try:
            runs.check(plans.realisation(plan, point, seeds, 0), ROOT / "data/hollow.h5")
        except Fault as fault:
            raise Fault(f"{options.campaign}: {fault}") from None
    while True:
        realisations = plans.realisations(plan, more)
        runs.make_all(realisations, options.jobs or plan.jobs, Progress())
        rows = [outcome.row(one, runs, running.sha256) for one in realisations]
        more = precision.more(wanted, plan, rows) if wanted else {}
        if not more:
            return plan, runs, rows
        print(f"{wanted.name}: the interval is too wide at {len(more)} of {len(plan.points)} points; going on with up to {max(more.values())} granules each",
              file=sys.stderr)


def run(options):
    plan, runs, rows = granules(options)
    outcome.write(options.out / "granules.csv", plan, rows)
    whole.write_text(options.out / "campaign.toml", options.campaign.read_text(encoding="utf-8"))
    made = f"by the programs of commit {', '.join(outcome.commits(rows, runs)) or 'unknown'}."
    summary.write(options.out, plan, rows, made)
    for quantity in outcome.present(rows):
        if quantity.name.startswith("critical_stress"):
            drawing.strengths(plan, rows, quantity, options.out / f"{quantity.name}.svg")
    drawing.responses(plan, rows, options.out / "response.svg")
    print((options.out / "summary.md").read_text(encoding="utf-8"), end="")
    print(f"{runs.done} runs made now, {len(runs.failures)} of them failed; granules.csv, summary.csv and figures are in {options.out}", file=sys.stderr)
    return 1 if any(row.failure for row in rows) else 0


def make_kernel(options):
    plan, runs, rows = granules(options)
    try:
        found = kernel.write(options.out / "kernel", plan, rows, runs)
    except size_law.Refusal as why:
        raise Fault(f"{options.campaign}: {why}") from None
    for part in ("size_law", "rate_law", "fragments", "flexible_over_rigid"):
        print(f"{part}: {'refused: ' + found[part]['refused'] if 'refused' in found[part] else 'in kernel.json'}")
    for name, words in found["dictionaries"].items():
        print(f"{name}: {words}")
    print(f"kernel.json and its tables are in {options.out / 'kernel'}", file=sys.stderr)
    return 0


def tell_strength(options):
    liquids = [answer.liquid(text) for text in options.liquid]
    plan, _, rows = granules(options)
    text = answer.text(plan, rows, liquids)
    if options.break_at is not None:
        text += "\n" + answer.how_to_make(plan, rows, options.break_at)
    with arguments.printing_to(options.out / "strength.md"):
        print(text, end="")
    print(text, end="")
    return 0


def main():
    options = command_line().parse_args()
    try:
        with contextlib.ExitStack() as options.owned:
            return {"run": run, "kernel": make_kernel, "strength": tell_strength}[options.verb](options)
    except Fault as fault:
        print(fault, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
