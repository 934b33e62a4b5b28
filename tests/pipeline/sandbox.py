"""A copy of pipeline/ in a temporary folder, with stand-ins for whatever it calls, in front of PATH."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Stands for cmake: "builds" the programs unless they are there.
CMAKE = """#!/bin/bash
echo "cmake $*" >> "$LOG"
[[ $1 == --build ]] || exit 0
mkdir -p build/release/bin
for program in dryer agglomerate rigidstress breaker; do
  [[ -f build/release/bin/$program ]] || { cp "$PROGRAMS/$program" build/release/bin/ && sleep 0.02; }
done
"""

# Stands for the dryer: writes the file and then the report.
DRYER = """#!/bin/bash
echo "115 particles in a droplet" >&2
echo "dryer $*" >> "$LOG"
scene=$1
seed=1
while (($#)); do
  case $1 in
    -o) out=$2 ;;
    --report) report=$2 ;;
    --seed) seed=$2 ;;
  esac
  shift
done
echo data > "$out"
cat > "$report" << EOF
{"program": "dryer", "version": "0", "scene": "$scene", "seed": $seed, "wall_s": 1.5, "cpu_s": 1.25,
 "peak_rss_bytes": 1, "steps": 10, "results": {"d_c_nm": 160, "h_c_over_d_c": 0.3, "contacts": 17$seed,
 "coordination": 3, "fragments": 1}, "errors": {"d_c_relative": {"value": 0.01, "how": "halving"}}, "left_out": []}
EOF
echo "seed $seed: a message" >&2
"""

AGGLOMERATE = """#!/bin/bash
echo "agglomerate $*" >> "$LOG"
exit "${CHECK_CODE:-0}"
"""

# Stands for rigidstress and its benchmark.
RIGIDSTRESS = """#!/bin/bash
echo "rigidstress $*" >> "$LOG"
while (($#)); do
  case $1 in
    -o | --report) echo data > "$2" ;;
  esac
  shift
done
"""


class Sandbox(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="crumble with blank ")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name) / "clone"
        shutil.copytree(ROOT / "pipeline", self.root / "pipeline", ignore=shutil.ignore_patterns("results"))
        self.bin = self.root.parent / "bin"
        self.programs = self.root.parent / "programs"
        self.log = self.root.parent / "log"
        for path in (self.bin, self.programs):
            path.mkdir()
        self.log.touch()
        self.stand_in("cmake", CMAKE)
        self.stand_in("ctest", '#!/bin/bash\necho "ctest $*" >> "$LOG"\necho "100% tests passed"\n')
        # Every package is there.
        self.stand_in("dpkg-query", '#!/bin/bash\nshift 3\nprintf "%s=installed\\n" "$@"\n')
        self.stand_in("dryer", DRYER, self.programs)
        self.stand_in("agglomerate", AGGLOMERATE, self.programs)
        self.stand_in("rigidstress", RIGIDSTRESS, self.programs)
        self.stand_in("breaker", RIGIDSTRESS.replace("rigidstress", "breaker"), self.programs)

    def stand_in(self, name, text, folder=None):
        path = (folder or self.bin) / name
        path.write_text(text)
        path.chmod(0o755)

    def run_in_sandbox(self, *command, **environment):
        # As cleared an environment as the stand-ins allow.
        env = {"PATH": f"{self.bin}:/usr/bin:/bin", "HOME": os.environ.get("HOME", "/"), "LOG": str(self.log),
               "PROGRAMS": str(self.programs), "PYTHONDONTWRITEBYTECODE": "1", **environment}
        return subprocess.run(command, cwd=self.root, env=env, text=True, capture_output=True, timeout=300)

    def make(self, *arguments, **environment):
        return self.run_in_sandbox("make", "-C", "pipeline", *arguments, **environment)

    def called(self, program):
        """The calls of a program since the last question."""
        lines = self.log.read_text().splitlines()
        return [line for line in lines if line.split()[0] == program]

    def forget(self):
        self.log.write_text("")
