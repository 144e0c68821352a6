#!/usr/bin/env bash
# Requires that g++ vectorizes both loops over candidates of the yardstick, for both kernels: a slow yardstick would flatter
# what is measured against it.
#
#   tests/bench/vectorized.sh COMPILER YARDSTICK_KERNELS.cpp
set -euo pipefail

report=$("$1" -std=c++20 -O3 -march=native -ffast-math -fopenmp-simd -fopt-info-vec -S -o /dev/null "$2" 2>&1)
for loop in $(grep -n '#pragma omp simd' "$2" | cut -d : -f 1); do
    # Reported at the pragma's line or at one of the loop's two.
    vectorized=$(grep -cE "cpp:($loop|$((loop + 1))|$((loop + 2))):.*loop vectorized" <<<"$report" || true)
    echo "loop at line $loop: vectorized $vectorized times"
    [ "$vectorized" -ge 2 ]
done
