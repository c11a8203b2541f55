#!/usr/bin/env bash
# bench/run_all.sh [OPTION...]: every measurement and its report, in about 15 minutes.
#
#   -o FOLDER        where results go (bench/results)
#   --build FOLDER   a Release build (build/release)
#   --room FILE.ply  a mesh to place in a closed room; repeatable
#   --open FILE.ply  a mesh as it is, seen from its middle; repeatable
#   --scene FILE.lxs a scene whose rays are recorded; repeatable
#   --minutes N      for everything together (15); what a step has not done by then is left out
#
# YAT_BENCH_ROOM, YAT_BENCH_OPEN and YAT_BENCH_SCENE name files too, separated by colons. A generated
# hall of 1.5 million triangles is always measured, last. Quiet machines measure best.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

output=bench/results build=build/release minutes=15
rooms=() opens=() scenes=()
split() { # split NAME LIST: appends the files of a colon-separated list
  local -n to=$1
  local IFS=: file
  for file in $2; do to+=("$file"); done
}
split rooms "${YAT_BENCH_ROOM:-}"
split opens "${YAT_BENCH_OPEN:-}"
split scenes "${YAT_BENCH_SCENE:-}"
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help)
      sed -n '2,/^set/{/^set/!s/^# \{0,1\}//p}' "$0"
      exit 0
      ;;
    -o | --build | --room | --open | --scene | --minutes)
      if [ $# -lt 2 ]; then
        echo "run_all.sh: $1 needs a value" >&2
        exit 2
      fi
      case $1 in
        -o) output=$2 ;;
        --build) build=$2 ;;
        --room) rooms+=("$2") ;;
        --open) opens+=("$2") ;;
        --scene) scenes+=("$2") ;;
        --minutes) minutes=$2 ;;
      esac
      shift 2
      ;;
    *)
      echo "run_all.sh: no such option: $1 (see --help)" >&2
      exit 2
      ;;
  esac
done
if ! [[ $minutes =~ ^[1-9][0-9]*$ ]]; then
  echo "run_all.sh: --minutes $minutes: give a number above 0" >&2
  exit 2
fi
files=()
for file in "${rooms[@]}" "${opens[@]}" "${scenes[@]}"; do
  if ! [ -r "$file" ]; then
    echo "run_all.sh: $file: error: cannot be read; check the name" >&2
    exit 1
  fi
  files+=("$(realpath "$file")")
done
mkdir -p "$output"
output=$(realpath --relative-to="$root" "$output")
cd "$root"
for program in bench_traversal bench_build bench_kernels bench_render yat; do
  if ! [ -x "$build/bin/$program" ]; then
    echo "run_all.sh: no $build/bin/$program: cmake --preset release && cmake --build --preset release" >&2
    exit 1
  fi
done

# Arguments of bench_traversal for the files.
traced=(--scenes hall)
for ((i = 0; i < ${#files[@]}; ++i)); do
  if ((i >= ${#rooms[@]} && i < ${#rooms[@]} + ${#opens[@]})); then traced+=(--open); fi
  traced+=("${files[i]}")
done
sets=$((7 * (${#files[@]} + 1)))

commands=() missing=()
shown() { # a command as the README shows it: no folders of this machine
  local word text=
  for word in "$@"; do
    case $word in
      /*) word=$(basename "$word") ;;
      "$build"/bin/*) word=${word##*/} ;;
    esac
    text+=" ${word/"$output/"/}"
  done
  echo "${text# }"
}
step() { # step NAME PERCENT COMMAND...: within its share of the time
  local name=$1 seconds=$((minutes * 60 * $2 / 100)) code=0
  shift 2
  printf '== %s (at most %d s)\n' "$name" "$seconds" >&2
  rm -f "$output/$name.json"
  # In the foreground, so that an interrupt reaches the benchmark, too.
  timeout --foreground "$seconds" "$@" >&2 || code=$?
  case $code in
    0) ;;
    124) missing+=("$name was cut off after $seconds s") ;;
    *) missing+=("$name ended with $code (bench_traversal ends with 1 where answers are wrong: the report counts them)") ;;
  esac
  commands+=("$(shown "$@")")
}
bin=$build/bin
per_set() { echo $((minutes * 60 * $1 / 100 / sets * 7 / 10)); }

step traversal 44 "$bin/bench_traversal" "${traced[@]}" --threads 2 --repetitions 9 \
  --seconds "$(per_set 44)" --json "$output/traversal.json"
step instruction-sets 17 "$bin/bench_traversal" "${traced[@]}" --isa sse42,avx2 --resolution 256 \
  --repetitions 3 --seconds "$(per_set 17)" --json "$output/instruction-sets.json"
step kd-tree 7 "$bin/bench_traversal" "${traced[@]}" --tree auto,kd --no-embree --resolution 256 \
  --repetitions 5 --seconds "$(per_set 7)" --json "$output/kd-tree.json"
step scalar 7 "$bin/bench_traversal" "${traced[@]}" --isa sse42 --kernels render,scalar --no-embree \
  --resolution 256 --repetitions 3 --seconds "$(per_set 7)" --json "$output/scalar.json"
step build 15 "$bin/bench_build" --repetitions 5 --seconds $((minutes * 60 * 15 / 100 / 32)) \
  --json "$output/build.json"
step kernels 4 "$bin/bench_kernels" --benchmark_min_time=0.01 \
  --benchmark_out="$output/kernels.json" --benchmark_out_format=json
step render 5 "$bin/bench_render" --benchmark_min_time=0.1 --benchmark_repetitions=3 \
  --benchmark_out="$output/render.json" --benchmark_out_format=json
step cornell-box 1 "$bin/yat" render scenes/cornell-box/cornell-box.lxs --spp 64 -q \
  -o out/bench/cornell-box.png --stats "$output/cornell-box.json"

# The name of a machine is nobody's business.
sed -i '/"host_name"/d' "$output"/*.json

results=()
for name in traversal instruction-sets kd-tree scalar build kernels render cornell-box; do
  # A benchmark that was cut off leaves half a file.
  if python3 -c 'import json, sys; json.load(open(sys.argv[1]))' "$output/$name.json" 2>/dev/null; then
    results+=("$output/$name.json")
  else
    rm -f "$output/$name.json"
  fi
done
rm -f "$output"/*.svg
tools/bench_report "${results[@]}" -o "$output"

field() { LC_ALL=C lscpu | sed -nE "s/^ *$1: *//p" | head -n 1; }
{
  printf '# Results of one machine\n\n[report.md](report.md) shows them; the JSON files hold every '
  printf 'repetition. Made by `bench/run_all.sh` on %s.\n\n' "$(date -u +%Y-%m-%d)"
  printf '| | |\n|---|---|\n'
  printf '| processor | %s, %s cores, L2 %s, L3 %s |\n' "$(field 'Model name')" "$(nproc)" \
    "$(field 'L2 cache')" "$(field 'L3 cache')"
  printf '| memory | %s MB |\n' "$(awk '/^MemTotal/ { print int($2 / 1024) }' /proc/meminfo)"
  printf '| system | %s, Linux %s |\n' \
    "$(. /etc/os-release && echo "$PRETTY_NAME")" "$(uname -r | cut -d- -f1)"
  printf '| compiler | %s |\n' \
    "$(cat "$output"/*.json | sed -nE 's/^ *"compiler": "(.*)",/\1/p' | head -n 1)"
  printf '| load at the end | %s (1, 5, 15 minutes): other programs ran unless it is near 1 |\n\n' \
    "$(cut -d' ' -f1-3 /proc/loadavg)"
  printf 'Commands, in this order:\n\n'
  printf '    %s\n' "${commands[@]}"
  if [ ${#missing[@]} -gt 0 ]; then
    printf '\nNot all went through:\n\n'
    printf -- '- %s\n' "${missing[@]}"
  fi
} >"$output/README.md"
if [ ${#missing[@]} -gt 0 ]; then printf '%s\n' "${missing[@]}" >&2; fi
printf '%s/README.md\n' "$output"
