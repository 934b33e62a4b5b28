#!/bin/bash
# What CI does with few kills and few random scenes, at full length: 200 kills, a hundred damaged bytes, a thousand scenes of each program.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
cd "$(dirname "$0")/../.."
export PYTHONPATH=tests
/usr/bin/python3 tests/io/killed_runs.py build/release/bin pipeline/scenes data --kills 200
/usr/bin/python3 tests/io/random_scenes.py build/release/bin --scenes 1000
