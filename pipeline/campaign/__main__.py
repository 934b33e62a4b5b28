"""Campaigns: many granules from one file, their strengths with intervals, and what others make of them.

    campaign run my.toml -o results/my
    campaign run my.toml -o results/my --more-until "critical_stress 5 %"
    campaign kernel my.toml -o results/my
    campaign strength my.toml -o results/my --liquid "syrup 0.1 Pa s 1200 kg/m3"

README.md beside this script explains the keys of my.toml.
"""

import contextlib
import fcntl
import os
import pathlib
import re
import sys
import time

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(1, str(FOLDER.parent / "report"))

import answer  # noqa: E402
import arguments  # noqa: E402
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
    run.add_argument("--fresh", action="store_true", help="make again what is older than its program")
    run.add_argument("--files", type=pathlib.Path, metavar="FOLDER", help="files of granules stand there, shared with other campaigns: what two of them want is made once")
    run.add_argument("--names", type=pathlib.Path, metavar="FOLDER", help="links with names that can be read, as hollow-1.h5 and breakup/hollow-1.h5")
    run.add_argument("--part", metavar="K/N", help="make the files of one of N parts (K = 1 ... N) and no tables, as one task of an array of jobs does")
    run.add_argument("--more-until", metavar='"QUANTITY N %"', help="add granules until half of the 95 %% interval of this mean is N %% of it, at every point")
    return parser


def add_kernel(verbs):
    verb = verbs.add_parser("kernel", help="breakage kernel of the granules: FOLDER/kernel; makes what is missing", allow_abbrev=False)
    add_common(verb)


def add_strength(verbs):
    verb = verbs.add_parser("strength", help="at which shear rate in which liquid and device 10, 50, 90 %% of the granules break; makes what is missing", allow_abbrev=False)
    add_common(verb)
    verb.add_argument("--liquid", action="append", default=[], metavar='"NAME VISCOSITY Pa s DENSITY kg/m3"', help="beside that of the scene and blood")
    verb.add_argument("--break-at", type=float, metavar="PA", help="also say which value of the varied key makes granules of which half break at this stress")


def add_common(verb):
    verb.add_argument("campaign", type=arguments.file, metavar="CAMPAIGN.toml")
    verb.add_argument("-o", dest="out", type=pathlib.Path, metavar="FOLDER", required=True, help="where results go")
    verb.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bin", metavar="FOLDER", help="with dryer, rigidstress and breaker")
    verb.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)), help="runs side by side (default: the number of processors)")
    verb.add_argument("--set", dest="settings", action="append", default=[], metavar="KEY=VALUE",
                      help="in place of what the file says: a key of the campaign or of a scene, as in seeds=5 or dry.particle.number=40")
    verb.add_argument("--launcher", type=arguments.file, metavar="COMMAND", help="begins the command of every run: pipeline/cluster/slurm makes it a job")
    verb.set_defaults(more_until=None, fresh=False, files=None, names=None, part=None)


def link(place, source):
    """A link that can be moved with the folder of both."""
    place.parent.mkdir(parents=True, exist_ok=True)
    target = os.path.relpath(source, place.parent)
    if not place.is_symlink() or os.readlink(place) != target:
        place.unlink(missing_ok=True)
        place.symlink_to(target)


@contextlib.contextmanager
def sharing(options, stages):
    """The folders of the stages are those of all campaigns that share them. One campaign at a time is at work there."""
    if options.files is None:
        yield
        return
    for stage in stages:
        (options.files / stage).mkdir(parents=True, exist_ok=True)
        link(options.out / stage, options.files / stage)
    with open(options.files / "lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def link_names(folder, runs, realisations):
    for one in realisations:
        for run in one.runs:
            for ending in (".h5", ".json") if run.stage != "stress" else ():
                place = folder / ("" if run.stage == "dry" else run.stage) / f"{one.kind}-{one.number}{ending}"
                if runs.path(run, ending).exists() and run.id not in runs.failures:
                    link(place, runs.path(run, ending))
                else:
                    place.unlink(missing_ok=True)


def part(text, realisations):
    """K/N of them; those that share a dried granule stay together."""
    match = re.fullmatch(r"([0-9]+)/([0-9]+)", text)
    if not match or not 1 <= int(match[1]) <= int(match[2]):
        raise Fault(f"--part '{text}': must be K/N with K = 1 ... N, as in 3/100")
    return [one for one in realisations if int(one.runs[0].id, 16) % int(match[2]) == int(match[1]) - 1]


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
    plan, histories = plans.read(options.campaign, options.programs, options.settings)
    wanted = precision.wish(options.more_until) if options.more_until else None
    if wanted and any(isinstance(seeds, list) for _, seeds in plan.points):
        raise Fault(f"{options.campaign}: seeds: a list cannot grow; --more-until needs a number of granules")
    options.out.mkdir(parents=True, exist_ok=True)
    options.owned.enter_context(folder.own(options.out, options.part is not None))
    options.owned.enter_context(sharing(options, plan.stages))
    for name, source in histories.items():
        link(options.out / name, source.resolve())
    runs = running.Runs(options.out, options.programs, [options.launcher.resolve()] if options.launcher else [], options.fresh)
    more = {}
    for point, seeds in plan.points:
        try:
            runs.check(plans.realisation(plan, point, seeds, 0), ROOT / "data/hollow.h5")
        except Fault as fault:
            raise Fault(f"{options.campaign}: {fault}") from None
    while True:
        realisations = plans.realisations(plan, more)
        runs.make_all(part(options.part, realisations) if options.part else realisations, options.jobs, Progress())
        if options.names:
            link_names(options.names, runs, realisations)
        rows = [outcome.row(one, runs, running.sha256) for one in realisations]
        more = precision.more(wanted, plan, rows) if wanted else {}
        if not more:
            return plan, runs, rows
        print(f"{wanted.name}: the interval is too wide at {len(more)} of {len(plan.points)} points; going on with up to {max(more.values())} granules each",
              file=sys.stderr)


def run(options):
    plan, runs, rows = granules(options)
    for words, count in runs.messages.items():
        print(f"{count} runs: {words}", file=sys.stderr)
    if options.part:
        return 1 if runs.failures else 0
    outcome.write(options.out / "granules.csv", plan, rows)
    with_settings = "".join(f"# with {one}\n" for one in options.settings)
    whole.write_text(options.out / "campaign.toml", options.campaign.read_text(encoding="utf-8") + with_settings)
    summary_of = options.out / "summary.md"
    if not summary_of.exists() or summary_of.stat().st_mtime_ns < max(path.stat().st_mtime_ns for path in (options.out / "granules.csv", *FOLDER.glob("*.py"))):
        summarise(options, plan, rows, runs)
    print(summary_of.read_text(encoding="utf-8"), end="")
    print(f"{runs.done} runs made now, {len(runs.failures)} of them failed; granules.csv, summary.csv and figures are in {options.out}", file=sys.stderr)
    return 1 if any(row.failure for row in rows) else 0


def summarise(options, plan, rows, runs):
    try:
        import drawing  # an installation may have no matplotlib
    except ImportError as why:
        print(f"There are no figures: {why}", file=sys.stderr)
    else:
        draw(drawing, options, plan, rows)
    made = f"by the programs of commit {', '.join(outcome.commits(rows, runs)) or 'unknown'}."
    summary.write(options.out, plan, rows, made)


def draw(drawing, options, plan, rows):
    for quantity in outcome.present(rows):
        if quantity.name.startswith("critical_stress"):
            drawing.strengths(plan, rows, quantity, options.out / f"{quantity.name}.svg")
    drawing.responses(plan, rows, options.out / "response.svg")


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
