"""The scene that a result file was made from."""

import sys
import tomllib


def resolved(file):
    """Every parameter as the run had it: {section: {key: value}}; keys that nobody set are absent."""
    return tomllib.loads(file["parameters/resolved"].asstr()[()])


FORMER = {"fluid": "liquid"}  # section names of files before schema version 1.1


def number(scene, section, key):
    """Numbers that a scene may leave to a law have to be stated here."""
    if key not in scene.get(section, {}):
        section = FORMER.get(section, section)
    value = scene[section][key]
    if isinstance(value, str):
        sys.exit(f'{section}.{key} = "{value}": a number is needed here')
    return value
