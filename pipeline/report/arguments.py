"""How every script takes its arguments: groups of files as NAME=FILE,FILE,..., what is written as -o, --help with an example.

The docstring of a script is its manual: the first line says what it does, the rest, with an example on an indented line, stands
below the options.
"""

import argparse
import atexit
import contextlib
import os
import pathlib
import sys

import campaign_files
import whole

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "python"))  # the module crumble; installed it is found anyway


def parser(doc, writes=None, metavar="FILE", required=True, default=None):
    """writes: what goes to -o; without it the script writes nothing that could have another name. Not required: the terminal,
    or the default."""
    first, _, rest = doc.strip().partition("\n")
    made = argparse.ArgumentParser(description=first, epilog=rest.strip("\n"), allow_abbrev=False,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)
    if writes:
        made.add_argument("-o", dest="out", type=pathlib.Path, metavar=metavar, required=required and default is None, default=default,
                          help=writes if default is None else f"{writes} (default: {os.path.relpath(default)})")
    return made


def file(text):
    path = pathlib.Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"{text}: no such file")
    return path


def file_or(is_folder, of):
    """Type of an argument that is a file or a folder of this kind."""
    def found(text):
        path = pathlib.Path(text)
        if path.is_dir() and not is_folder(path):
            raise argparse.ArgumentTypeError(f"{text}: not a folder of {of}")
        return path if path.is_dir() else file(text)
    return found


def group(text):
    """NAME=FILE,FILE,... as (name, [path])."""
    name, equals, names = text.partition("=")
    if not name or not equals:
        raise argparse.ArgumentTypeError(f"'{text}': expected NAME=FILE,FILE,... as in hollow=a.h5,b.h5")
    if not names:
        raise argparse.ArgumentTypeError(f"{name}=: names no file")
    return name, [file(one) for one in names.split(",")]


def groups_or_table(text, of):
    """A group, or from the table of a campaign one or all kinds of granules: files of a stage with an ending, of = ("dry", ".json")."""
    if of is None or not text.endswith(".csv"):
        return [group(text)]
    wanted, _, name = text.rpartition("=")
    stage, ending = of
    found = campaign_files.by_kind(file(name), stage)
    return [(kind, [granule.file(stage, ending) for granule in found.get(kind, [])]) for kind in ([wanted] if wanted else found)]


class Groups(argparse.Action):
    """Gathers groups in a dictionary, in their order."""

    def __init__(self, *given, names=None, **more):
        super().__init__(*given, **more)
        self.names = names

    def __call__(self, parser, namespace, values, option_string=None):
        found = {}
        for name, files in (one for several in values for one in several):
            if self.names is not None and name not in self.names:
                raise argparse.ArgumentError(self, f"{name}: not known; there are {', '.join(self.names)}")
            if name in found:
                raise argparse.ArgumentError(self, f"{name}: named twice")
            found[name] = files
        setattr(namespace, self.dest, found)


def add_groups(parser, of, name="groups", names=None, campaign=None):
    """name: of the option, if it is one; names: those that a group may have, if not all; campaign: (stage, ending) of the files to take where the
    table of a campaign is given."""
    parser.add_argument(name, type=lambda text: groups_or_table(text, campaign), nargs="+", action=Groups, names=names, metavar="NAME=FILE,...",
                        **({"default": {}} if name.startswith("-") else {}),
                        help=of + (f"; NAME is one of {', '.join(names)}" if names else "") + ("; or the table granules.csv of a campaign, NAME= for one kind alone" if campaign else ""))


def add_files(parser, of, name="FILE"):
    parser.add_argument("files", type=file, nargs="+", metavar=name, help=of)


@contextlib.contextmanager
def printing_to(out):
    """What is printed goes to this file, which is whole or as it was; without one to the terminal."""
    if out is None:
        yield
        return
    with whole.replacing(out) as temporary, open(temporary, "w", encoding="utf-8") as text, contextlib.redirect_stdout(text):
        yield


def _told(kind, error, trace):
    """What stops a script from outside is told in a line: which file and why, not where in the script."""
    if issubclass(kind, OSError) and error.strerror:
        print(f"{pathlib.Path(sys.argv[0]).name}: {error.filename or 'stdout'}: {error.strerror}", file=sys.stderr)
    elif issubclass(kind, KeyboardInterrupt):
        print(f"{pathlib.Path(sys.argv[0]).name}: stopped", file=sys.stderr)
    else:
        sys.__excepthook__(kind, error, trace)


sys.excepthook = _told


@atexit.register
def _flush():
    """What is still to be printed when a script ends has an end like its other output, not one of Python's own."""
    try:
        if sys.stdout is not None:  # closed by whoever started it, who wants to read nothing
            sys.stdout.flush()
    except BrokenPipeError:
        os._exit(1)  # whoever reads has read enough
    except OSError as error:
        _told(OSError, error, None)
        os._exit(1)
