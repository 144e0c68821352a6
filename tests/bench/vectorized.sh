#!/usr/bin/env bash
# Requires that g++ vectorizes both loops over candidates of the yardstick, for both kernels, and loads the candidates as
# vectors, not one by one: a slow yardstick would flatter what is measured against it.
#
#   tests/bench/vectorized.sh COMPILER YARDSTICK_KERNELS.cpp
set -euo pipefail

assembly=$(mktemp)
trap 'rm -f "$assembly"' EXIT
report=$("$1" -std=c++20 -O3 -march=native -ffast-math -fopenmp-simd -fopt-info-vec -S -o "$assembly" "$2" 2>&1)
for loop in $(grep -n '#pragma omp simd' "$2" | cut -d : -f 1); do
    # Reported at the pragma's line or at one of the loop's two.
    vectorized=$(grep -cE "cpp:($loop|$((loop + 1))|$((loop + 2))):.*loop vectorized" <<<"$report" || true)
    echo "loop at line $loop: vectorized $vectorized times"
    [ "$vectorized" -ge 2 ]
done
one_by_one=$(grep -cE 'insertps|pinsr|gather|unpcklps' "$assembly" || true)
echo "vectors put together from single elements: $one_by_one"
[ "$one_by_one" -eq 0 ]
