#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds Meltpoint and runs its tests.
#
#   tests/run.sh [--no-install] [--all]
#
# The fast tests (labels unit, conformance, images, physics-short) take some minutes. --all adds builds by two compilers with
# warnings as errors, clang-tidy, the sanitizers, mutations of the source that must each turn a test red, and the long tests
# (labels physics, long, window): two hours or so. --no-install only checks, and exits with 2 where packages are missing.
# A stage that fails does not hide the later ones. Every stage's whole output is in build/logs.
set -euo pipefail
# shellcheck source=apps/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

install=yes
all=no
for argument in "$@"; do
    case $argument in
        --no-install) install=no ;;
        --all) all=yes ;;
        -h | --help)
            sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' tests/run.sh
            exit 0
            ;;
        *) fail "unknown argument '$argument': --all and --no-install are the only ones" ;;
    esac
done

packages=("${required_packages[@]}")
if [ "$all" = yes ]; then
    packages+=("${check_packages[@]}")
fi
set_up "$install" "${packages[@]}"
require_compiler
mkdir -p build/logs

# --- stages ------------------------------------------------------------------------------------------------------------

passed=0
failed=0
skipped=0
table=()

# stage NAME COMMAND...: runs it with its output shown and logged, and notes result, time and, for ctest, how many tests.
stage() {
    local name=$1 log=build/logs/${1// /-}.log start=$SECONDS code=0 result ok=0 bad=0 idle=0
    shift
    printf '\n== %s\n' "$name"
    "$@" 2>&1 </dev/null | tee "$log" || code=$?
    if grep -q '^No tests were found' "$log"; then
        result='no tests'
    elif grep -q '^[0-9]*% tests passed' "$log"; then
        read -r bad total < <(sed -n 's/^[0-9]*% tests passed, \([0-9]*\) tests failed out of \([0-9]*\)$/\1 \2/p' "$log" | tail -n 1)
        # A skipped test proves nothing: it is neither. Only what is optional may be skipped (ffmpeg, meshes to test with).
        idle=$(grep -cE '\((Skipped|Disabled)\)$' "$log" || true)
        ok=$((total - bad - idle))
        result="$ok passed, $bad failed"
        [ "$idle" -eq 0 ] || result+=", $idle skipped"
    elif [ "$code" -eq 0 ]; then
        ok=1
        result=passed
    fi
    if [ "$code" -ne 0 ] && [ "$bad" -eq 0 ]; then
        bad=1
        result="FAILED, see $log"
    fi
    passed=$((passed + ok))
    failed=$((failed + bad))
    skipped=$((skipped + idle))
    table+=("$(printf '%-22s %3d:%02d  %s' "$name" $(((SECONDS - start) / 60)) $(((SECONDS - start) % 60)) "$result")")
}

# ctest_labels FOLDER LABEL_REGEX [CTEST OPTION...]
ctest_labels() {
    ctest --test-dir "$1" --label-regex "^($2)\$" --parallel "$(nproc)" --output-on-failure "${@:3}"
}

build_release() {
    configure release && build build/release
}

# build_with_werror C++_COMPILER C_COMPILER [CMAKE OPTION...]
build_with_werror() {
    configure release -B "build/werror-$1" -DCMAKE_CXX_COMPILER="$1" -DCMAKE_C_COMPILER="$2" -DMELTPOINT_WERROR=ON "${@:3}" &&
        build "build/werror-$1" -- -k 0
}

# clang-tidy runs beside the compiler, so that a second run looks only at what has changed.
build_with_tidy() {
    build_with_werror clang++-16 clang-16 -DCMAKE_CXX_CLANG_TIDY="clang-tidy-16;--quiet"
}

build_sanitized() {
    configure asan && build build/asan
}

stage "release build" build_release
stage "fast tests" ctest_labels build/release 'unit|conformance|images|physics-short' --no-tests=error

if [ "$all" = yes ]; then
    stage "g++ -Werror" build_with_werror g++ gcc
    stage "clang++-16, clang-tidy" build_with_tidy
    stage "sanitizers: build" build_sanitized
    stage "sanitizers: unit" ctest_labels build/asan unit
    # The software driver itself leaks a few kilobytes.
    ASAN_OPTIONS=detect_leaks=0 stage "sanitizers: GPU" ctest_labels build/asan conformance
    stage "mutations" tests/mutate.sh
    stage "physics" ctest_labels build/release physics
    stage "long" ctest_labels build/release long
    stage "window" ctest_labels build/release window
fi

printf '\n%-22s %6s  %s\n' stage time result
printf '%s\n' "${table[@]}"
printf '%d min %02d s\n\n%d passed, %d failed, %d skipped\n' $((SECONDS / 60)) $((SECONDS % 60)) "$passed" "$failed" "$skipped"
[ "$failed" -eq 0 ]
