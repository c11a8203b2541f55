#!/usr/bin/env bash
# check_neon.sh SOURCE_DIR XSIMD_INCLUDE_DIR KERNEL_SOURCE...
#
# Reads every kernel source for AArch64 (NEON) and instantiates its templates, to see that nothing in
# them is for x86 alone; no code is generated, which would take ten times as long. Exit 77 (skipped)
# when there is no cross compiler here (package g++-aarch64-linux-gnu).
set -euo pipefail
source_dir=$1 xsimd_include=$2
shift 2

compiler=$(command -v aarch64-linux-gnu-g++ || true)
if [ -z "$compiler" ]; then
  echo "skipped: no aarch64-linux-gnu-g++ here (package g++-aarch64-linux-gnu)"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# xsimd alone: the folder it lies in may hold this machine's C library headers.
mkdir "$work/include"
for library in xsimd xtl; do
  [ ! -d "$xsimd_include/$library" ] || ln -s "$xsimd_include/$library" "$work/include/$library"
done

failed=0
for source in "$@"; do
  if "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -ffp-contract=off -fno-math-errno -fno-trapping-math -Wno-psabi \
    -DYAT_ISA=neon64 -DYAT_ARCH=xsimd::neon64 -Dxsimd=xsimd_neon64 \
    -I "$source_dir/src" -isystem "$work/include" "$source"; then
    echo "neon64: $(basename "$source") compiles"
  else
    echo "neon64: $(basename "$source") does not compile"
    failed=1
  fi
done
exit $failed
