#!/bin/bash
# man.sh PAGE.1.gz COMMAND [SUBCOMMAND]: writes the manual page, from what the program says about itself: --help, --version and, where it takes
# scenes, --print-defaults.
set -euo pipefail
[[ ${1:-} != -h && ${1:-} != --help ]] || { sed -n '2,/^[^#]/s/^# //p' "$0"; exit 0; }
page=$1
shift
command=("$@")
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

# help2man runs one program without a subcommand, and calls it by its name.
name=$(basename "$1")${2:+-$2}
printf '#!/bin/bash\n[[ $1 != --version ]] || exec %q --version\nexec%s "$@"\n' "$1" "$(printf ' %q' "${command[@]}")" > "$folder/$name"
chmod +x "$folder/$name"

# Its first sentence, up to a colon, is the line that apropos finds.
"${command[@]}" --help > "$folder/help"
about=$(sed -n '1{s/[.:] .*//;s/[.:]$//;s/^\(.\)/\l\1/;p}' "$folder/help")

if ((${#command[@]} == 1)) && grep -q -e --print-defaults "$folder/help"; then
  # Nothing of it is for roff.
  { echo '[PARAMETERS]'; echo 'A scene with every key that --set takes, its meaning, unit and default:'; echo .PP; echo .nf
    "$1" --print-defaults | fmt -s -w 76 -p '#' | sed 's/\\/\\e/g; s/-/\\-/g; s/^/\\\&/'; echo .fi; } > "$folder/include"
fi
version=$("$1" --version | sed -n '1s/.* //p')
help2man --no-info --no-discard-stderr --name "$about" --source Crumble --manual Crumble \
  --version-string "$name $version" --opt-include "$folder/include" "$folder/$name" > "$folder/page"
gzip -9nc "$folder/page" > "$page.tmp"
mv "$page.tmp" "$page"
