"""The real OpenFOAM reads the dictionaries of a kernel: every key and value, dimensions among them, as they were written.

Reads with foamDictionary of Debian's package openfoam, by default dictionaries with made numbers. Debian's OpenFOAM is that of OpenCFD, 1912, whose
populationBalance has exponential, powerLaw and LaakkonenAlopaeusAittamaa but not yet Kusters, and OpenQBMM is not in Debian: that a solver takes the keys is
not tried; a test compares them with the public sources.
Ends with 77 where the program is missing.

    openfoam.py pipeline/results/kernel/kernel/openfoam.breakupModels pipeline/results/kernel/kernel/openqbmm.breakupKernel
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "pipeline/report"), str(ROOT / "pipeline/campaign")]
import arguments  # noqa: E402
import dictionaries  # noqa: E402

SHARE = pathlib.Path("/usr/share/openfoam")  # where its own settings are


def asked(path, entry, *more):
    done = subprocess.run(["foamDictionary", path, "-entry", entry, "-precision", "15", *more], text=True, capture_output=True,
                          env={**os.environ, "WM_PROJECT_DIR": str(SHARE)})
    if done.returncode:
        raise SystemExit(f"{path}: {entry}: {done.stderr.strip()}")
    return done.stdout


def words(text):
    """Numbers by value, everything else by its letters; without comments."""
    found = re.findall(r"[{}()\[\];]|[^\s{}()\[\];]+", re.sub(r"//[^\n]*", "", text))
    return [float(word) if re.fullmatch(r"[-+]?[0-9.]+(e[-+]?[0-9]+)?", word) else word for word in found]


def compared(path):
    """As the program prints it, against what stands in the file."""
    text = path.read_text(encoding="utf-8")
    first = words(text)[0]
    printed = words(asked(path, first))
    return first, printed == words(text), len([word for word in printed if isinstance(word, float)])


def made(folder):
    (folder / "openfoam").write_text(dictionaries.openfoam(dictionaries.Kusters(4.123456, 2e-7, 1.1, 2.8, 3.9, 4.1, 0.02), ["range; words"]), encoding="utf-8")
    (folder / "openqbmm").write_text(dictionaries.openqbmm(dictionaries.PowerKernel(3.25e-11, 1.7, 0.7, 2.123456789), "uniform", ["range"]), encoding="utf-8")
    return [folder / "openfoam", folder / "openqbmm"]


def command_line():
    parser = arguments.parser(__doc__)
    parser.add_argument("files", type=arguments.file, nargs="*", metavar="DICTIONARY", help="of a kernel (default: of made numbers)")
    return parser


def main():
    options = command_line().parse_args()
    if shutil.which("foamDictionary") is None:
        print("not tried: Debian package openfoam is missing (pipeline/packages.sh openfoam)", file=sys.stderr)
        return 77
    failed = False
    with tempfile.TemporaryDirectory() as temporary:
        for path in options.files or made(pathlib.Path(temporary)):
            first, same, numbers = compared(path)
            failed |= not same
            print(f"{path.name}: {first} with {numbers} numbers {'is read as it was written' if same else 'is read as something else'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
