#!/bin/bash
# packages.sh [SECTION...]: installs what is missing of packages.txt, of its head and of the sections that are named: as root,
# or with sudo where that asks for no password. Otherwise prints the command and fails. Says nothing when all is there.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
export PATH="$PATH:/usr/local/sbin:/usr/sbin:/sbin" LC_ALL=C.UTF-8  # dpkg needs ldconfig, which lives in sbin

list="$(dirname "$0")/packages.txt"
read -r -d '' -a wanted <<< "$(awk -v sections=" $* " '
  { sub(/#.*/, "") }
  /^\[/ { gsub(/[][ ]/, ""); outside = !index(sections, " " $0 " "); next }
  !outside' "$list")" || true

if ! command -v dpkg-query > /dev/null; then
  echo "This is not Debian. Crumble needs what Debian calls: ${wanted[*]}. Going on in the hope that it is there." >&2
  exit 0
fi

installed=" $(dpkg-query -W -f '${Package}=${db:Status-Status}\n' "${wanted[@]}" 2> /dev/null |
  sed -n 's/=installed$//p' | tr '\n' ' ' || true)"
missing=()
for package in "${wanted[@]}"; do
  [[ $installed == *" $package "* ]] || missing+=("$package")
done
((${#missing[@]})) || exit 0

# What this release does not have is left out, once apt's lists are there to say so: Ubuntu 24.04 has no MDAnalysis, and the
# one test that asks for it is skipped there. What cannot be done without, CMake names.
leave_out_unknown() {
  local known package found=()
  known=" $(apt-cache show "${wanted[@]}" 2> /dev/null | sed -n 's/^Package: //p' | tr '\n' ' ' || true)"
  [[ $known == *' g++ '* ]] || return 0
  for package in "${missing[@]}"; do
    if [[ $known == *" $package "* ]]; then found+=("$package"); else echo "This release has no $package" >&2; fi
  done
  missing=("${found[@]}")
  ((${#missing[@]})) || exit 0
}
leave_out_unknown

if [[ $(id -u) == 0 ]]; then
  root=(env)
elif command -v sudo > /dev/null && sudo -n true 2> /dev/null; then
  root=(sudo -n env)
else
  echo "Debian packages are missing and there is no right to install them. Run this, then make again:" >&2
  echo "  sudo apt-get update && sudo apt-get install --no-install-recommends -y ${missing[*]}" >&2
  exit 1
fi
echo "Installing Debian packages: ${missing[*]}" >&2
apt=("${root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=120)
"${apt[@]}" update
leave_out_unknown
"${apt[@]}" install --no-install-recommends -y "${missing[@]}"
