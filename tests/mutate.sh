#!/usr/bin/env bash
# Changes one constant, sign or barrier at a time in a scratch copy of the source, and requires that a test goes red.
#
#   tests/mutate.sh [--list] [--only N]...
#
# The scratch copy and its build are build/mutations; the source itself is never touched. A mutation fails if no test
# notices it, if its original text is not in the file exactly once, or if the mutated source does not build.
set -euo pipefail
# shellcheck source=apps/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../apps/setup.sh"

descriptions=() files=() originals=() replacements=() programs=() filters=()

# mutation DESCRIPTION FILE ORIGINAL REPLACEMENT PROGRAM FILTER: the test program and the tests of it (a GoogleTest filter)
# that should notice. ORIGINAL is literal text, whole lines or parts of them.
mutation() {
    descriptions+=("$1") files+=("$2") originals+=("$3") replacements+=("$4") programs+=("$5") filters+=("$6")
}

# --- the mutations ------------------------------------------------------------------------------------------------------

mutation "barriers: none before a read of what was written" \
    engine/gpu/commands.cpp \
    'written && !visible' \
    'false && !visible' \
    conformance_tests 'ContextTest.SynchronizationValidationSeesASuppressedBarrier'
mutation "kernel: paper viscosity 2 % too strong" \
    engine/reference/forces.cpp \
    'static_cast<double>(settings.params.viscosity) * volume' \
    '1.02 * static_cast<double>(settings.params.viscosity) * volume' \
    unit_tests '*ReferenceForces*'

mutation "scan: block sums without those of earlier rounds" \
    shaders/primitives/prefix_scan_blocks.comp \
    'carry += total' \
    'carry = total' \
    conformance_tests '*PrefixScan*'
mutation "scan: no barrier between reading and overwriting" \
    shaders/include/workgroup_scan.glsl \
    'barrier(); // before the next call' \
    '// before the next call' \
    conformance_tests '*PrefixScan*'
mutation "dispatch: the second axis of workgroups is ignored" \
    shaders/include/invocation.glsl \
    'gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x' \
    'gl_WorkGroupID.x' \
    conformance_tests 'PrefixScanTest.MoreWorkgroups*'
mutation "sort: order within a key left to the atomics" \
    shaders/primitives/counting_sort_order.comp \
    'order[place]' \
    'order[slot]' \
    conformance_tests '*CountingSort*'
mutation "sort: a key is crowded one element too early" \
    shaders/primitives/counting_sort_order.comp \
    '> CROWDED_KEY' \
    '>= CROWDED_KEY' \
    conformance_tests 'CountingSortTest.*Crowded*'
mutation "sort: the highest digit is not sorted" \
    shaders/primitives/counting_sort_crowded.comp \
    'shift < 32u' \
    'shift < 28u' \
    conformance_tests 'CountingSortTest.*'
mutation "sort: no barrier between two digits" \
    shaders/primitives/counting_sort_crowded.comp \
    'memoryBarrierBuffer();
    barrier();' \
    '' \
    conformance_tests 'CountingSortTest.*'
mutation "sort: keys out of range are counted" \
    shaders/primitives/counting_sort_count.comp \
    ' && keys[i] < params.key_count' \
    '' \
    conformance_tests 'CountingSortTest.ElementsBeyond*'

# --- the machinery ------------------------------------------------------------------------------------------------------

source_dir=build/mutations/source
build_dir=build/mutations/build
log=build/mutations/log

# list_files FOLDER: its source files.
list_files() {
    (cd "$1" && find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -type f -print)
}

# copy_source: makes the scratch copy equal to the source. Only what differs is written: then its time is new and the build
# notices, also after a run that was interrupted in the middle of a mutation.
copy_source() {
    local file
    mkdir -p "$source_dir"
    while read -r file; do
        cmp --quiet "$file" "$source_dir/$file" || install -D "$file" "$source_dir/$file"
    done < <(list_files .)
    while read -r file; do
        [ -f "$file" ] || rm "$source_dir/$file"
    done < <(list_files "$source_dir")
}

# rebuild PROGRAM...
rebuild() {
    build "$build_dir" --target "$@" >"$log" 2>&1
}

# run_tests PROGRAM FILTER: a mutation may well hang or crash the program, which is red as well.
run_tests() {
    timeout 300 "$build_dir/tests/$1" --gtest_filter="$2" --gtest_fail_fast --gtest_brief=1 >"$log" 2>&1 </dev/null
}

# replace FILE ORIGINAL REPLACEMENT: fails unless the original is there exactly once.
replace() {
    local text rest
    text=$(<"$1")
    rest=${text#*"$2"}
    [[ "$rest" != "$text" && "$rest" != *"$2"* ]] || return 1
    printf '%s\n' "${text/"$2"/"$3"}" >"$1"
}

# try N: applies mutation N to the scratch copy and says in `verdict` who noticed. Fails if nobody did.
try() {
    local file=$source_dir/${files[$1]}
    if ! { [ -f "$file" ] && replace "$file" "${originals[$1]}" "${replacements[$1]}"; }; then
        verdict="DOES NOT APPLY: its original text is not in ${files[$1]} exactly once"
    elif ! rebuild "${programs[$1]}"; then
        verdict="DOES NOT BUILD: $(grep -m 1 -i error "$log")"
    elif run_tests "${programs[$1]}" "${filters[$1]}"; then
        verdict="SURVIVED ${filters[$1]}"
    else
        verdict=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$log" | head -n 1)
        verdict=${verdict:-${programs[$1]} crashed or hung}
        return 0
    fi
    return 1
}

chosen=()
while [ $# -gt 0 ]; do
    case $1 in
        --list)
            for n in "${!descriptions[@]}"; do
                printf '%3d  %-48s %s\n' "$n" "${files[n]}" "${descriptions[n]}"
            done
            exit 0
            ;;
        --only)
            [[ ${2:-} =~ ^[0-9]+$ && $2 -lt ${#descriptions[@]} ]] || fail "--only takes a number that --list shows"
            chosen+=("$2")
            shift
            ;;
        *) fail "unknown argument '$1': --list and --only N are the only ones" ;;
    esac
    shift
done
[ ${#chosen[@]} -gt 0 ] || chosen=("${!descriptions[@]}")

copy_source
cmake -G Ninja -S "$source_dir" -B "$build_dir" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache)" >build/mutations/configure.log

# Unmutated, all is green: else red would mean nothing.
for program in $(for n in "${chosen[@]}"; do echo "${programs[n]}"; done | sort -u); do
    filter=$(for n in "${chosen[@]}"; do [ "${programs[n]}" != "$program" ] || echo "${filters[n]}"; done | sort -u | paste -sd :)
    rebuild "$program" || fail "the unmutated source does not build: see $log" 1
    run_tests "$program" "$filter" || fail "the unmutated source fails its tests: see $log" 1
done

missed=0
for n in "${chosen[@]}"; do
    started=$SECONDS
    try "$n" || missed=$((missed + 1))
    printf '%3d  %3d s  %-56s %s\n' "$n" $((SECONDS - started)) "${descriptions[n]}" "$verdict"
    if [ -f "${files[n]}" ]; then
        cp "${files[n]}" "$source_dir/${files[n]}"
    fi
done
printf '%d mutations in %d min %02d s, %d not noticed\n' ${#chosen[@]} $((SECONDS / 60)) $((SECONDS % 60)) $missed
[ $missed -eq 0 ]
