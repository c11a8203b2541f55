#!/usr/bin/env bash
# check_format.sh SOURCE_DIR
#
# Fails on a C++ file that clang-format 19 would write differently; other versions format differently,
# so only 19 counts. Exit 77 (skipped) without it (package clang-format-19).
set -euo pipefail
formatter=
for name in clang-format-19 clang-format; do
  command -v "$name" >/dev/null || continue
  case $("$name" --version) in *" version 19."*) formatter=$name && break ;; esac
done
if [ -z "$formatter" ]; then
  echo "skipped: no clang-format 19 here (package clang-format-19)"
  exit 77
fi
cd "$1"
find src tests bench \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 "$formatter" --dry-run -Werror
echo "formatted as .clang-format says"
