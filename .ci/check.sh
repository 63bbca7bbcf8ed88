#!/bin/sh
# The checks to pass before a merge: layers, format, headers that compile alone, sanitizers.
# check.sh [quick]: quick leaves the sanitizers out.
set -eu
cd "$(dirname "$0")/.."
jobs=$(nproc)

echo "== layers"
python3 -B .ci/check_layers.py .

echo "== format"
if command -v clang-format >/dev/null; then
  git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run --Werror
else
  echo "skipped: clang-format is not installed"
fi

echo "== headers"
cmake --preset dev >/dev/null
cmake --build --preset dev -j "$jobs" --target header_checks

[ "${1:-}" = quick ] && exit 0
echo "== sanitizers"
cmake --preset sanitize >/dev/null
cmake --build --preset sanitize -j "$jobs"
ctest --preset sanitize -j "$jobs"
