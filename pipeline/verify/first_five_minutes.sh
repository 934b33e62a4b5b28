#!/bin/bash
# A visitor's first five minutes, as README tells them: a fresh clone, the first command, one key of a scene changed, run again, both compared.
# Words behind the name go to make: BUILD=FOLDER takes programs that are built, SEEDS="1" COMPACT= dries less.
set -euo pipefail
if [[ ${1-} == -h || ${1-} == --help ]]; then
  sed -n '2,/^[^#]/s/^# //p' "$0"
  exit 0
fi
top=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
programs=../build/release
for word in "$@"; do
  if [[ $word == BUILD=* ]]; then programs=${word#BUILD=}; fi
done

git -c safe.directory="$top" clone -q --no-hardlinks "$top" "$folder/crumble"
cd "$folder/crumble"
said() { # said FILE TEXT: it was printed
  grep -qF -- "$2" "$1" || { echo "not printed: $2" >&2 && cat "$1" >&2 && exit 1; }
}

make -C pipeline "$@" > ../first.log 2> ../first.err || { tail -n 30 ../first.err >&2 && exit 1; }
said ../first.log paper
tail -n 12 ../first.log

# A key with a mistake is answered with the right one, the right one is taken.
cp pipeline/scenes/hollow.toml my.toml
sed -i 's/^number = 115/nunber = 100/' my.toml
if make -C pipeline dry SCENE=my.toml OUT=my.h5 SEED=1 "$@" > ../wrong.log 2>&1; then echo "a misspelt key was taken" >&2 && exit 1; fi
said ../wrong.log "did you mean 'particle.number'?"
sed -i 's/^nunber/number/' my.toml
make -C pipeline dry SCENE=my.toml OUT=my.h5 SEED=1 "$@" > ../second.log 2>&1 || { tail -n 30 ../second.log >&2 && exit 1; }

# 1: a result differs.
code=0
(cd pipeline && "$programs/bin/agglomerate" compare results/hollow-1.h5 ../my.h5) > ../compared.log || code=$?
((code == 1)) || { echo "compare ended with $code" >&2 && cat ../compared.log >&2 && exit 1; }
said ../compared.log particle.number
cat ../compared.log
