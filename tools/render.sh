#!/usr/bin/env bash
# tools/render.sh [SCENE] [OPTION...]: installs what is missing, builds the Release program and
# renders. Without a scene: the bundled Cornell box. Without -o: out/NAME.png and out/NAME.exr.
# Every option of `yat render` (docs/command-line.md) passes through.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

scene=$root/scenes/cornell-box/cornell-box.lxs
case ${1:-} in
  '' | -*) ;;
  *)
    scene=$1
    shift
    ;;
esac

pictures=()
next_is_picture=
wants_help=
for argument in "$@"; do
  if [ -n "$next_is_picture" ]; then
    pictures+=("$argument")
    next_is_picture=
    continue
  fi
  case $argument in
    -o | --output) next_is_picture=yes ;;
    --output=*) pictures+=("${argument#--output=}") ;;
    -o?*) pictures+=("${argument#-o}") ;;
    -h | --help) wants_help=yes ;;
  esac
done
output=()
if [ ${#pictures[@]} -eq 0 ] && [ -z "$next_is_picture" ]; then
  name=$(basename "$scene")
  for kind in png exr; do
    pictures+=("$root/out/${name%.*}.$kind")
    output+=(-o "$root/out/${name%.*}.$kind")
  done
fi

"$root/tools/setup.sh"
# Building says something only when it fails.
log=$(mktemp)
trap 'rm -f "$log"' EXIT
printf 'building yat (Release) in %s\n' "$root/build/release" >&2
if ! (cd "$root" && cmake --preset release && cmake --build --preset release --target yat) >"$log" 2>&1; then
  cat "$log" >&2
  exit 3
fi

code=0
"$root/build/release/bin/yat" render "$scene" "${output[@]}" "$@" || code=$?
# 130: interrupted, with the picture so far written.
if { [ $code -eq 0 ] || [ $code -eq 130 ]; } && [ -z "$wants_help" ]; then
  printf 'Pictures:\n'
  printf '  %s\n' "${pictures[@]}"
fi
exit $code
