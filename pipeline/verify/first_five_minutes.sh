#!/bin/bash
# A visitor's first five minutes, as README tells them: a fresh clone, the first command, its page opened, one key of a scene changed, run
# again, both compared in the terminal and on a page. Pages are opened in headless Chromium, where it is installed (pipeline/packages.sh browser).
# Words behind the name go to make: BUILD=FOLDER takes programs that are built, SEEDS="1" KINDS=hollow dries less, VIEW=: installs nothing.
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

SECONDS=0
passed() { echo "[$SECONDS s] $1"; }

# shown PAGE TEXT...: it opens in a browser without a complaint, draws, and says this.
shown() {
  PYTHONPATH=pipeline/verify /usr/bin/python3 -B - "$@" << 'EOF'
import sys
from browser import Browser, there
if not there():
    sys.exit(print("not opened: there is no chromium"))
with Browser() as browser:
    if not browser.open(sys.argv[1]):
        sys.exit(f"{sys.argv[1]}: does not open")
    said = browser.js("document.body.innerText")
    if wrong := browser.complaints + [f"does not say: {text}" for text in sys.argv[2:] if text not in said]:
        sys.exit(f"{sys.argv[1]}: {'; '.join(wrong)}")
    view = browser.js("document.documentElement.dataset.view === 'ready' ? `a view of ${document.getElementById('file').options.length} file(s)` : 'no view'")
    print(f"{sys.argv[1]}: opened in Chromium, {view}")
EOF
}

make -C pipeline "$@" > ../first.log 2> ../first.err || { tail -n 30 ../first.log ../first.err >&2 && exit 1; }
said ../first.log paper
tail -n 12 ../first.log
passed "the first command"
make -C pipeline report FILES=pipeline/results/hollow-1.h5 OUT=first.html "$@" > ../page.log 2>&1 || { tail -n 30 ../page.log >&2 && exit 1; }
shown first.html "outer diameter d_c" "How to make it again"
passed "its page"

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
make -C pipeline report FILES="pipeline/results/hollow-1.h5 my.h5" OUT=both.html "$@" > ../page.log 2>&1 || { tail -n 30 ../page.log >&2 && exit 1; }
shown both.html "Side by side" hollow-1.h5 my.h5
passed "one key changed, both compared"
