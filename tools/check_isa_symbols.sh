#!/usr/bin/env bash
# check_isa_symbols.sh NM ISA OBJECT...
#
# Lists the weak (mergeable) symbols of kernel objects built for one instruction set and fails on any
# outside yat::ISA and xsimd_ISA: the linker keeps one copy of an inline function for the whole
# program, and a copy made with AVX-512 flags would kill the program on a CPU without it.
set -euo pipefail
nm=$1 isa=$2
shift 2
bad=$("$nm" -C "$@" | sed -nE 's/^[0-9a-f]* +[WVuv] (.*)$/\1/p' |
  grep -vE "yat::${isa}::|xsimd_${isa}::|^DW\.ref\.__gxx_personality_v0$" | sort -u || true)
if [ -n "$bad" ]; then
  printf 'mergeable symbols outside yat::%s and xsimd_%s:\n%s\n' "$isa" "$isa" "$bad"
  exit 1
fi
echo "no mergeable symbol outside yat::$isa and xsimd_$isa"
