# shellcheck shell=bash
# Sourced by the scripts beside it: a Debian system in a folder, from the mirror that this machine's apt is set to.
set -euo pipefail
export PATH="$PATH:/usr/local/sbin:/usr/sbin:/sbin" LC_ALL=C.UTF-8
top="$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)"
failed=

# read_arguments NAME "$@": the release (trixie, unless said) and the folder (build/chroot/NAME-RELEASE, unless said).
read_arguments() {
  local usage="usage: ${0##*/} [RELEASE [FOLDER]]   (as root; default: trixie build/chroot/$1-trixie; takes 3 GB)"
  case ${2-} in
    -h | --help) sed -n '2,/^[^#]/s/^# //p' "$0" && echo "$usage" && exit 0 ;;
    -*) echo "$usage" >&2 && exit 2 ;;
  esac
  (($# <= 3)) || { echo "$usage" >&2 && exit 2; }
  release="${2:-trixie}" folder="${3:-$top/build/chroot/$1-${2:-trixie}}"
}

# make_system: $release in $folder, with make and git. One that is there already is kept with its packages.
make_system() {
  [[ $(id -u) == 0 ]] || { echo "this needs root: sudo $0" >&2 && exit 2; }
  command -v debootstrap > /dev/null || apt-get -q install --no-install-recommends -y debootstrap >&2
  if [[ -e $folder/etc/debian_version && ! -e $folder/debootstrap ]]; then
    echo "$folder: a system is there already"
  else
    local mirror
    mirror="$(apt-get indextargets --format '$(LABEL) $(REPO_URI)' 'Created-By: Packages' | awk '$1 == "Debian" { uri = $2 } END { print uri }')"
    [[ $mirror ]] || { echo "apt knows no Debian mirror on this machine" >&2 && exit 2; }
    mkdir -p "$folder"
    debootstrap --variant=minbase "$release" "$folder" "$mirror" > "$folder.log" 2>&1 || { tail "$folder.log" >&2 && exit 1; }
  fi
  in_system apt-get -q update > /dev/null
  install make git
}

# fresh_clone PATH: the last commit of this tree, in the system.
fresh_clone() {
  rm -rf "${folder:?}$1"
  git clone -q --no-hardlinks "$top" "$folder$1"
  commit="$(git -C "$top" rev-parse --short HEAD)"
}

# in_system COMMAND...: as root in the system, with nothing of this environment. The mounts end with the command.
in_system() {
  unshare --mount --pid --fork --kill-child bash -c '
    mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" && cp /etc/resolv.conf "$1/etc/"
    exec chroot "$1" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 "${@:2}"' bash "$folder" "$@"
}

install() {
  in_system env DEBIAN_FRONTEND=noninteractive apt-get -q install --no-install-recommends -y "$@" > "$folder.log" 2>&1 ||
    { tail "$folder.log" >&2 && exit 1; }
}

# step NAME COMMAND...: in the system; what it says goes to FOLDER/NAME.log, how it ended and its seconds are printed.
step() {
  local start=$SECONDS code=0
  in_system "${@:2}" > "$folder/$1.log" 2>&1 || code=$?
  printf '%-21s ended with %d after %d s\n' "$1" $code $((SECONDS - start))
  ((code == 0)) || { tail -n 30 "$folder/$1.log" && failed=1; }
}

# describe PACKAGE...: system, commit, processor, versions.
describe() {
  echo "Debian $(< "$folder/etc/debian_version"), commit $commit," \
    "$(sed -n 's/^model name.*: //p' /proc/cpuinfo | sort -u), $(nproc) cores"
  in_system dpkg-query -W -f '${Package} ${Version}\n' "$@" 2> /dev/null | paste -sd, | sed 's/,/, /g' | fold -sw 120 || true
}
