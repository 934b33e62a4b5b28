"""What a campaign file asks for: stages, points, seeds. Its keys are explained in README.md."""

import dataclasses
import difflib
import hashlib
import pathlib
import tomllib

import design
import scene_text
from scene_text import Fault, canonical

# Stage of a campaign file -> program. In the order in which they follow each other.
PROGRAMS = {"dry": "dryer", "stress": "rigidstress", "breakup": "breaker"}
KEYS = {"name", "seeds", *PROGRAMS, "vary"}
STAGE_KEYS = {"scene", "set", "flows", "count"}
FLOWS = ("elongation", "shear", "uniaxial", "biaxial")


@dataclasses.dataclass
class Run:
    """One file of one stage. Its identity is what it is made from; its place in a list does not count."""
    stage: str
    scene: dict
    id: str
    parent: "Run | None"


@dataclasses.dataclass
class Realisation:
    point: dict           # varied keys and their values
    replicate: int        # 0, 1, ... within the point
    kind: str             # of granule: the name of its first scene
    number: int           # its seed in a list, or its number within the point from 1
    runs: list            # in the order in which they follow each other


@dataclasses.dataclass
class Plan:
    path: pathlib.Path
    name: str
    stages: dict          # stage -> {"scene": table, "count": of how many granules a point}
    points: list          # (values, seeds: a number or a list)
    units: dict           # stage -> {key: unit}

    @property
    def varied(self):
        """Keys that are varied somewhere, in the order of the file."""
        return list(dict.fromkeys(key for point, _ in self.points for key in point))

    def unit(self, key):
        stage, _, name = key.partition(".")
        return self.units[stage].get(name, "")  # the name of a scene has none


def identity(*parts):
    return hashlib.sha256("\n".join(map(canonical, parts)).encode()).hexdigest()[:12]


def seed_of(id):
    """1 to 2147483647, from the identity alone."""
    return 1 + int(hashlib.sha256(f"seed of {id}".encode()).hexdigest()[:8], 16) % 2147483647


def _nearest(word, known):
    found = difflib.get_close_matches(word, known, 1)
    return f"; did you mean '{found[0]}'?" if found else ""


def _refuse_unknown(keys, known, where):
    for key in keys:
        if key not in known:
            raise Fault(f"{where}: unknown key '{key}'{_nearest(key, sorted(known))}")


def _content(path):
    """Of a file, or of all files of a folder with their names."""
    digest = hashlib.sha256()
    for file in sorted(path.iterdir()) if path.is_dir() else [path]:
        with open(file, "rb") as data:
            digest.update(f"{file.name if path.is_dir() else ''} {hashlib.file_digest(data, 'sha256').hexdigest()}\n".encode())
    return digest.hexdigest()[:12]


def changed(given, settings):
    """The campaign with settings KEY=VALUE in place of what its file says: seeds=[1,2], stress.count=3, dry.particle.number=40."""
    for text in settings:
        key, equals, value = text.partition("=")
        try:
            value = tomllib.loads(f"value = {value}")["value"]
        except tomllib.TOMLDecodeError:
            pass  # a word
        head, _, name = key.partition(".")
        if not equals or head not in KEYS:
            raise Fault(f"--set '{text}': must be a key of a campaign or of a stage's scene and its value, as in seeds=5 or dry.particle.number=40")
        if head in PROGRAMS and name not in STAGE_KEYS:
            given = {**given, head: {**given.get(head, {}), "set": {**given.get(head, {}).get("set", {}), name: value}}}
        elif head in PROGRAMS:
            given = {**given, head: {**given.get(head, {}), name: value}}
        else:
            given = {**given, key: value}
    return given


def _stage(stage, given, path, units, histories, name=None):
    """name: of a scene beside the base scene, in its place."""
    where = f"{path}: [{stage}]"
    _refuse_unknown(given, STAGE_KEYS, where)
    if not isinstance(given.get("scene"), str):
        raise Fault(f"{where}: needs 'scene', the file of the base scene")
    base = path.parent / given["scene"]
    if name is not None:
        base = base.with_name(f"{name}.toml")
    scene = scene_text.read(base)
    for key in given.get("set", {}):
        if key not in units:
            raise Fault(f"{where}.set: unknown key '{key}' of {PROGRAMS[stage]}{_nearest(key, sorted(units))}")
    scene = scene_text.changed(scene, given.get("set", {}))
    if "flows" in given:
        if stage != "stress":
            raise Fault(f"{where}.flows: the flow of {PROGRAMS[stage]} stands in its scene, flow.kind")
        _refuse_unknown(given["flows"], FLOWS, f"{where}.flows")
        scene = scene_text.changed(scene, {f"flow.{flow}": flow in given["flows"] for flow in FLOWS})
    count = given.get("count")
    if count is not None and (stage == "dry" or not isinstance(count, int) or count < 1):
        raise Fault(f"{where}.count: of how many granules at each point, 1 or more; not of the dryer, whose number 'seeds' says")
    history = scene_text.value_of(scene, "flow.history")
    if history is not None:  # under the name of its content: another history is another run
        source = (path if "flow.history" in given.get("set", {}) else base).parent / history
        if not source.exists():
            raise Fault(f"{where}: flow.history = \"{history}\": no such file or folder")
        digest = _content(source)
        histories[f"{stage}/{digest}{source.suffix}"] = source
        scene = scene_text.changed(scene, {"flow.history": f"{digest}{source.suffix}"})
    return {"scene": scene, "count": count, "name": base.stem}


def _seeds(value, where):
    if isinstance(value, int) and not isinstance(value, bool) and value > 0:
        return value
    if isinstance(value, list) and value and all(isinstance(one, int) for one in value) and len(set(value)) == len(value):
        return value
    raise Fault(f"{where}: must be a number of granules, or a list of different seeds")


def _points(given, path, stages, units):
    found = {}
    blocks = given.get("vary", [{}])
    if isinstance(blocks, dict):
        blocks = [blocks]
    for number, block in enumerate(blocks, 1):
        where = f"{path}: vary {number}" if len(blocks) > 1 else f"{path}: [vary]"
        axes = {key: axis for key, axis in block.items() if key not in ("design", "points", "seeds")}
        for key in axes:
            stage, _, name = key.partition(".")
            if stage not in stages:
                raise Fault(f"{where}.\"{key}\": must begin with a stage of this campaign: {', '.join(stages)}")
            if name != "scene" and name not in units[stage]:
                raise Fault(f"{where}: unknown key '{name}' of {PROGRAMS[stage]}{_nearest(name, sorted(units[stage]))}")
        seeds = _seeds(block.get("seeds", given.get("seeds", 1)), f"{where}.seeds" if "seeds" in block else f"{path}: seeds")
        for point in design.points(axes, block.get("design", "grid"), block.get("points"), where):
            found.setdefault(canonical(point), (point, seeds))  # a point that two blocks share is visited once
    return list(found.values())


def read(path, programs, settings=()):
    """programs: the folder with the programs; settings: KEY=VALUE in place of what the file says. Returns the plan and the histories it
    names: {stage/name: source}."""
    path = pathlib.Path(path)
    given = changed(scene_text.read(path), settings)
    _refuse_unknown(given, KEYS, path)
    if "dry" not in given:
        raise Fault(f"{path}: needs [dry], the stage that makes the granules")
    units = {stage: scene_text.units(programs / program) for stage, program in PROGRAMS.items() if stage in given}
    histories = {}
    stages = {stage: _stage(stage, given[stage], path, units[stage], histories) for stage in PROGRAMS if stage in given}
    name = given.get("name", path.stem)
    points = _points(given, path, stages, units)
    for stage in stages:
        names = {point[key]: None for point, _ in points if (key := f"{stage}.scene") in point}
        stages[stage]["scenes"] = {name: _stage(stage, given[stage], path, units[stage], histories, name) for name in names}
    return Plan(path, name, stages, points, units), histories


def realisation(plan, point, seeds, replicate):
    """The runs of granule `replicate` of a point. With a number of seeds, every run has a seed of its own from its identity."""
    runs, parent = [], None
    for stage, of in plan.stages.items():
        if of["count"] is not None and replicate >= of["count"]:
            continue
        prefix = f"{stage}."
        varied = {key.removeprefix(prefix): value for key, value in point.items() if key.startswith(prefix)}
        of = of["scenes"][varied.pop("scene")] if "scene" in varied else of
        scene = scene_text.changed(of["scene"], varied)
        if stage == "dry" and isinstance(seeds, list):
            scene = scene_text.changed(scene, {"run.seed": seeds[replicate]})
            id = identity(stage, scene)
        elif stage == "dry":
            id = identity(stage, scene_text.changed(scene, {"run.seed": None}), replicate)
            scene = scene_text.changed(scene, {"run.seed": seed_of(id)})
        else:
            id = identity(stage, scene, runs[0].id)
            if stage == "stress" and scene_text.value_of(scene, "run.seed") is None:  # of its random orientations
                scene = scene_text.changed(scene, {"run.seed": seed_of(id)})
        runs.append(Run(stage, scene, id, runs[0] if runs else None))
    number = seeds[replicate] if isinstance(seeds, list) else replicate + 1
    return Realisation(point, replicate, point.get("dry.scene", plan.stages["dry"]["name"]), number, runs)


def realisations(plan, more=None):
    """All of them; more: {canonical point: number of granules} where it is larger than what the file says."""
    made = []
    for point, seeds in plan.points:
        count = seeds if isinstance(seeds, int) else len(seeds)
        if more:
            count = max(count, more.get(canonical(point), 0))
        made += [realisation(plan, point, seeds, k) for k in range(count)]
    return made
