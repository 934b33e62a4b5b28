"""Scenes as tables of values: read, changed by dotted keys, written again; and which keys with which units a program knows."""

import copy
import json
import re
import subprocess
import tomllib


class Fault(Exception):
    """What a user can mend: names file and key."""


def read(path):
    try:
        with open(path, "rb") as file:
            return tomllib.load(file)
    except OSError as error:
        raise Fault(f"{path}: {error.strerror}") from None
    except tomllib.TOMLDecodeError as error:
        raise Fault(f"{path}: {error}") from None


def changed(scene, changes):
    """A copy with the dotted keys of `changes` set."""
    made = copy.deepcopy(scene)
    for key, value in changes.items():
        *sections, name = key.split(".")
        place = made
        for section in sections:
            place = place.setdefault(section, {})
        place[name] = value
    return made


def value_of(scene, key):
    """Of a dotted key; None where it is not set."""
    for name in key.split("."):
        if not isinstance(scene, dict) or name not in scene:
            return None
        scene = scene[name]
    return scene


def _value(value):
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return json.dumps(value)


def write(scene, heading=()):
    """As TOML; tables within tables and lists of tables as the programs have them."""
    lines = [f"# {line}" for line in heading]

    def table(values, name):
        plain = {key: value for key, value in values.items() if not _is_table(value)}
        if name and (plain or not values):
            lines.extend(["", f"[{name}]"])
        lines.extend(f"{key} = {_value(value)}" for key, value in plain.items())
        for key, value in values.items():
            place = f"{name}.{key}" if name else key
            if isinstance(value, dict):
                table(value, place)
            elif _is_table(value):
                for one in value:
                    lines.extend(["", f"[[{place}]]", *(f"{k} = {_value(v)}" for k, v in one.items())])

    table(scene, "")
    return "\n".join(lines) + "\n"


def _is_table(value):
    return isinstance(value, dict) or (isinstance(value, list) and bool(value) and all(isinstance(one, dict) for one in value))


def canonical(value):
    """The same bytes for the same meaning: 1 and 1.0 are one number, the order of keys does not count."""
    def plain(one):
        if isinstance(one, dict):
            return {key: plain(of) for key, of in one.items()}
        if isinstance(one, list):
            return [plain(of) for of in one]
        return one if isinstance(one, (bool, str)) or one is None else float(one)
    return json.dumps(plain(value), sort_keys=True)


# `key = value  # unit` and, where there is no default, `# key =   (required)  in unit`.
_LINE = re.compile(r"(?:# )?([a-z_]+) = (?:  \((?:required|not set)\)(?:  in (?P<wanted>.+))?|.*?(?:  # (?P<given>.+))?)$")


def units(program):
    """Every key that the program knows, with its unit ("" for a pure number)."""
    done = subprocess.run([program, "--print-defaults"], text=True, capture_output=True)
    if done.returncode:
        raise Fault(f"{program}: {done.stderr.strip()}")
    found, section = {}, ""
    for line in done.stdout.splitlines():
        if match := re.fullmatch(r"(?:# )?\[\[?([a-z_.]+)\]\]?", line):
            section = match[1]
        elif match := _LINE.fullmatch(line):
            found[f"{section}.{match[1]}"] = match["wanted"] or match["given"] or ""
    return found
