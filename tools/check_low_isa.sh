#!/usr/bin/env bash
# check_low_isa.sh CPU TEST_PROGRAM...
#
# Runs the per-instruction-set tests (suites Isa/...) of the test programs on an emulated old CPU, so
# that the lowest kernels, and the choice of them, are tested on what they are for: an instruction that
# the CPU lacks ends the program. Exit 77 (skipped) without qemu-x86_64 (package qemu-user).
set -euo pipefail
cpu=$1
shift

emulator=$(command -v qemu-x86_64 || command -v qemu-x86_64-static || true)
if [ -z "$emulator" ]; then
  echo "skipped: no qemu-x86_64 here (package qemu-user)"
  exit 77
fi
# Native: emulation is only for what is tested.
programs=()
for program in "$@"; do
  # Into a variable: a pipe to grep -q would end the program by SIGPIPE.
  tests=$("$program" --gtest_list_tests)
  case $tests in *Isa/*) programs+=("$program") ;; esac
done
if [ ${#programs[@]} -eq 0 ]; then
  echo "no test program has per-instruction-set tests"
  exit 77
fi
failed=0
for program in "${programs[@]}"; do
  echo "== $(basename "$program") on $cpu"
  log=$(mktemp)
  if "$emulator" -cpu "$cpu" "$program" --gtest_filter='Isa/*' --gtest_brief=1 >"$log" 2>&1; then
    tail -n 2 "$log"
  else
    tail -n 40 "$log"
    failed=1
  fi
  rm -f "$log"
done
exit $failed
