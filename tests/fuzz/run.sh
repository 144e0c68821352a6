#!/usr/bin/env bash
# Builds the fuzzers with clang-16 and runs each for some seconds, at low priority.
#
#   tests/fuzz/run.sh SECONDS [NAME...]
#
# NAME is one of scene, obj, ply, stl, gltf, glb, off, points_ply, xyz; all by default. What they found before is kept in
# build/fuzz/corpus and carried on from. An input that crashes, hangs for 20 s, leaks or takes more than 2 GiB is left in
# build/fuzz/findings, and the exit code is 1.
set -euo pipefail
# shellcheck source=apps/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../apps/setup.sh"

[[ ${1:-} =~ ^[1-9][0-9]*$ ]] || fail "tests/fuzz/run.sh SECONDS [NAME...]: SECONDS is how long each fuzzer runs"
seconds=$1
shift
names=("$@")
[ ${#names[@]} -gt 0 ] || names=(scene obj ply stl gltf glb off points_ply xyz)

configure fuzz && build build/fuzz --target make_seeds "${names[@]/#/fuzz_}"
build/fuzz/tests/fuzz/make_seeds build/fuzz/seeds
mkdir -p build/fuzz/findings

failed=0
for name in "${names[@]}"; do
    mkdir -p "build/fuzz/corpus/$name"
    log=build/fuzz/$name.log
    result='no finding'
    nice -n 10 "build/fuzz/tests/fuzz/fuzz_$name" "build/fuzz/corpus/$name" "build/fuzz/seeds/$name" -max_total_time="$seconds" \
        -timeout=20 -rss_limit_mb=2048 -max_len=4096 -artifact_prefix="build/fuzz/findings/$name-" >"$log" 2>&1 || {
        result="FOUND $(grep -m 1 '^SUMMARY' "$log" || tail -n 1 "$log")"
        failed=1
    }
    printf '%-12s %10s runs  %s\n' "$name" "$(sed -n 's/^#\([0-9][0-9]*\).*/\1/p' "$log" | tail -n 1)" "$result"
done
exit $failed
