#!/bin/bash
# Tests that CI runs in a small version, at full length: 1e5 particles, the bonded share of a pair, the drag of dry particles,
# first passages of a pair with surface forces, how long it stays in a secondary minimum.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
cd "$(dirname "$0")/../.."
cmake --preset release > /dev/null
cmake --build --preset release --target test_dryer test_dryer_brownian test_dryer_surface_forces > /dev/null
export CRUMBLE_TEST_LONG=1 OMP_NUM_THREADS=1
build/release/bin/test_dryer --gtest_filter='HardCases.a_large_droplet*'
build/release/bin/test_dryer_brownian --gtest_filter='Softening/*:Brownian.the_drag_that_dry_particles_keep*'
build/release/bin/test_dryer_surface_forces --gtest_filter='*FirstPassage*:*SecondaryMinimum*:*Boltzmann*'
