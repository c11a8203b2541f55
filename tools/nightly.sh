#!/usr/bin/env bash
# nightly.sh [TEST_BIAS [RUNS]]      (build/release/tests/test_bias, 20)
# nightly.sh --judge FILE
#
# Runs the proofs of no bias RUNS times with seeds from the clock. Each comparison of two pictures
# gives a p-value; of right pictures a share of at most .01 lies below .01, and of at most .001 below
# .001. Says how many do, and how probable as many are. Exit 1 where that is below 1/1000, or where
# something failed that no chance makes fail; --judge does this with p-values written before (lines of
# test, comparison, p-value).
set -euo pipefail

judge() {
  awk '
    $3 < 0 || $3 > 1 || NF != 3 { print "not a p-value: " $0; broken = 1; next }
    {
      ++n
      for (i = 1; i <= 2; ++i) below[i] += $3 < level[i]
      if ($3 < level[1]) { small[$1 " " $2] = small[$1 " " $2] " " $3; ++times[$1 " " $2] }
    }
    # P(at least k of n), each with chance a.
    function tail(k, n, a,    i, term, sum) {
      term = exp(n * log(1 - a))
      for (i = 0; i < k; ++i) { sum += term; term *= (n - i) / (i + 1) * a / (1 - a) }
      return k == 0 || sum < 0 ? 1 : (sum > 1 ? 0 : 1 - sum)
    }
    BEGIN { level[1] = .01; level[2] = .001 }
    END {
      if (!n) { print "no comparison was made"; exit 1 }
      for (i = 1; i <= 2; ++i) {
        p = tail(below[i] + 0, n, level[i])
        printf "%d of %d comparisons below %g, %.1f expected at most: probability of as many %.3g\n",
          below[i], n, level[i], n * level[i], p
        if (p < .001) bad = 1
      }
      for (name in small)
        printf "  %s:%s%s\n", name, small[name], (times[name] > 1 ? "  (more than once)" : "")
      if (bad) print "more than chance: something is biased"
      exit bad || broken
    }' "$1"
}

if [ "${1:-}" = --judge ]; then
  judge "$2"
  exit
fi

program=${1:-build/release/tests/test_bias} runs=${2:-20}
[ -x "$program" ] || { echo "no program $program: build the target test_bias" >&2; exit 2; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
other=0
for ((run = 1; run <= runs; ++run)); do
  seeds=$(date +%s%N)
  status=0
  YAT_FRESH_SEEDS=$seeds YAT_P_VALUES=$folder/p_values "$program" >"$folder/log" 2>&1 || status=$?
  # What fails beside p-values: noise that is too large, paths that must be the same, a crash.
  failures=$(grep -A 1 ': Failure$' "$folder/log" | grep -vcE ': Failure$|^--$|passes\(kProofLevel\)' || true)
  if [ "$failures" -gt 0 ] || [ "$status" -gt 1 ]; then
    other=1
    echo "run $run: repeat with YAT_FRESH_SEEDS=$seeds $program"
    grep -A 4 ': Failure$' "$folder/log" || tail -n 20 "$folder/log"
  fi
done
judge "$folder/p_values" || other=1
exit $other
