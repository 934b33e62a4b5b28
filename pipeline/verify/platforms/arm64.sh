#!/bin/bash
# Programs and unit tests built for arm64 by Debian's cross compiler against Debian's arm64 libraries; the tests run under
# qemu-user, which is slow: those that compute long are left to a machine of that kind.
. "$(dirname "$0")/chroot.sh"
read_arguments arm64 "$@"

make_system
fresh_clone /crumble
in_system dpkg --add-architecture arm64
in_system apt-get -q update > /dev/null

# Libraries of the other architecture; those of headers alone are one package for all.
read -r -d '' -a development <<< "$(sed -n '/^\[/q; s/[ #].*//; /-dev$/p' "$top/pipeline/packages.txt")" || true
read -r -d '' -a libraries <<< "$(in_system apt-cache show --no-all-versions "${development[@]}" |
  awk '/^Package: / { name = $2 } /^Architecture: / { print name ($2 == "all" ? "" : ":arm64") }' | sort -u)" || true
install cmake ninja-build pkg-config g++-aarch64-linux-gnu qemu-user "${libraries[@]}"

tests=(test_numerics test_contact agglomerate_test test_scene test_file test_two_sphere test_data test_dryer_scene)
step configure env PKG_CONFIG_LIBDIR=/usr/lib/aarch64-linux-gnu/pkgconfig:/usr/share/pkgconfig \
  cmake -S /crumble -B /crumble/build/arm64 --preset portable \
  -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CROSSCOMPILING_EMULATOR=qemu-aarch64 \
  -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++
step build nice cmake --build /crumble/build/arm64 --target dryer agglomerate rigidstress breaker "${tests[@]}"
for test in "${tests[@]}"; do
  step "$test" qemu-aarch64 "/crumble/build/arm64/bin/$test"
  grep -E '^\[  (PASSED|FAILED) ' "$folder/$test.log" || true
done
describe g++-aarch64-linux-gnu qemu-user "${libraries[@]}"
[[ ! $failed ]]
