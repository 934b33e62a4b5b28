#!/bin/bash
# The Debian package as on a new machine: judged by lintian, then installed with apt-get in a fresh Debian system, where a user runs
# crumble-demo and asks for a manual page. Ten minutes, most of them to build it.
. "$(dirname "$0")/chroot.sh"
read_arguments package "${@:-bookworm}"

make -C "$top/pipeline" package
package=$(ls -t "$top"/build/portable/crumble_*.deb | head -1)
commit="$(git -C "$top" rev-parse --short HEAD)"
lintian --fail-on error "$package" || failed=1

make_system
cp "$package" "$folder/tmp/"
step install env DEBIAN_FRONTEND=noninteractive apt-get -q install --no-install-recommends -y "/tmp/$(basename "$package")" man-db bash-completion
in_system useradd --create-home visitor 2> /dev/null || true
as_visitor=(setpriv --reuid visitor --regid visitor --clear-groups env HOME=/home/visitor bash -euc)
# shellcheck disable=SC2016
step demo "${as_visitor[@]}" 'cd && rm -rf crumble-results && crumble-demo'
sed -n '/seed/,$p' "$folder/demo.log"
step load "${as_visitor[@]}" 'cd && crumble stress /usr/share/crumble/pipeline/scenes/stress.toml crumble-results/hollow-1.h5 -o load.h5 --overwrite'
step python "${as_visitor[@]}" 'cd && python3 -c "import crumble; print(crumble.read(\"load.h5\")); print(crumble.run(\"dryer\", \"/usr/share/crumble/pipeline/scenes/hollow.toml\", output=\"a.h5\", overwrite=True)[\"results\"][\"contacts\"])"'
step man "${as_visitor[@]}" 'man dryer | grep -q brownian_motion && man agglomerate-export | grep -q OVITO'
# shellcheck disable=SC2016
step completion "${as_visitor[@]}" '. /usr/share/bash-completion/bash_completion; _completion_loader dryer || true; COMP_LINE="dryer --fit" COMP_POINT=11; _crumble dryer
  test "${COMPREPLY[*]}" = --fit-to'
step remove env DEBIAN_FRONTEND=noninteractive apt-get -q remove -y crumble
[[ ! -e $folder/usr/share/crumble ]] || { echo "something of it is left in /usr/share/crumble" >&2 && failed=1; }
describe libc6 libhdf5-103-1 libopenblas0-pthread python3-h5py
[[ ! $failed ]]
