#!/bin/sh
# fuzz.sh BUILD CORPUS SECONDS [NAME ...]: the fuzzers of the preset `fuzz`, one after another, each
# for so many seconds. CORPUS/NAME holds what each starts from and finds; what brings a reader down
# lies in CORPUS as NAME-crash-..., -leak-..., -timeout-... or -oom-...
build=$1 corpus=$2 seconds=$3
shift 3
[ $# -gt 0 ] || set -- b3dm city_json city_jsonl glb gltf gml hbjson materials obj ply rad sensors \
  stl store tileset weather
for name; do
  mkdir -p "$corpus/$name"
  echo "== $name"
  "$build/tests/robustness/fuzz/fuzz_$name" -max_total_time="$seconds" -rss_limit_mb=1024 -timeout=10 \
    -max_len=20000 -artifact_prefix="$corpus/$name-" -print_final_stats=1 -print_funcs=0 -verbosity=0 "$corpus/$name"
done
