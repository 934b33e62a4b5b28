"""The programs, run from Python. What they compute is theirs alone; here their words go in and their reports come back."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile


class ProgramError(RuntimeError):
    """What a program said when it did not end with 0, and its exit code: 1 the run failed, 2 the scene or the command line is wrong, 3 a
    file is not what its format says, negative: it was ended by that signal.

    >>> import crumble
    >>> crumble.run("dryer", "pipeline/scenes/hollow.toml", set={"particle.raduis": 1e-8}, output="a.h5")
    Traceback (most recent call last):
    crumble.programs.ProgramError: --set: unknown key 'particle.raduis'; did you mean 'particle.radius'?
    """

    def __init__(self, program, code, message):
        super().__init__(message or f"{program} ended with {code}")
        self.program, self.code = program, code


def find(program):
    """Its file: in the folder that CRUMBLE_BIN names, beside this module (`bin` of an installation, `build/release/bin` of the sources), or in PATH."""
    here = pathlib.Path(__file__).resolve()
    folders = [os.environ["CRUMBLE_BIN"]] if "CRUMBLE_BIN" in os.environ else [
        *(folder / sub for folder in here.parents for sub in ("build/release/bin", "bin")), *os.get_exec_path()]
    for folder in folders:
        if found := shutil.which(program, path=str(folder)):
            return found
    raise FileNotFoundError(f"{program}: not found; build it (make -C pipeline build), or name its folder in CRUMBLE_BIN")


def words(options):
    """Keywords as options: seed=3 is --seed 3, overwrite=True is --overwrite, False and None are left out."""
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            yield option
        elif value is not None and value is not False:
            yield from (option, str(value))


def value_text(value):
    """As --set takes it."""
    return value if isinstance(value, str) else json.dumps(value)


def call(program, *arguments):
    """Its stdout. An interrupt reaches the program, too, and is passed on when it has saved its state."""
    with subprocess.Popen([find(program), *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True) as process:
        try:
            answer, message = process.communicate()
        except KeyboardInterrupt:
            process.wait()
            raise
    if process.returncode:
        raise ProgramError(program, process.returncode, message.strip())
    return answer


def run(program, scene, *inputs, output, set=None, report=None, **options):
    """Runs dryer, rigidstress or breaker and gives its report. `set` overrides keys of the scene; other keywords are options of the program.

    >>> import crumble
    >>> report = crumble.run("dryer", "pipeline/scenes/hollow.toml", output=folder / "small.h5", seed=1,
    ...                      set={"particle.number": 8, "droplet.radius": 88e-9})
    >>> report["program"], report["seed"], report["results"]["fragments"]
    ('dryer', 1, 1)
    >>> load = crumble.run("rigidstress", "pipeline/scenes/stress.toml", folder / "small.h5", output=folder / "load.h5",
    ...                    set={"hydrodynamics.method": "fts"})
    >>> load["results"]["elongation"]["critical_stress_worst_pa"] > 0
    True
    """
    with tempfile.TemporaryDirectory(prefix="crumble-") as folder:
        path = pathlib.Path(report or pathlib.Path(folder) / "report.json")
        settings = [word for key, value in (set or {}).items() for word in ("--set", f"{key}={value_text(value)}")]
        call(program, scene, *inputs, "-o", output, "--report", path, "--quiet", *settings, *words(options))
        return json.loads(path.read_text(encoding="utf-8"))


def agglomerate(verb, *files, **options):
    """The answer of the file tool: text, or with json=True what it means.

    >>> import crumble
    >>> shape = crumble.agglomerate("morphology", "data/hollow.h5", frame="last", json=True)["frames"][0]
    >>> round(shape["porosity"], 2)
    0.76
    """
    answer = call("agglomerate", verb, *files, *words(options))
    return json.loads(answer) if options.get("json") else answer
