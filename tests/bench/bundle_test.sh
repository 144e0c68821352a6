#!/usr/bin/env bash
# Makes a bundle of the program, moves it elsewhere as an archive and starts it there without any environment: with the
# machine's libraries of C and C++, and with the bundle's own.
#
#   tests/bench/bundle_test.sh PROGRAM
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

fail() {
    echo "bundle_test.sh: $1" >&2
    exit 1
}

"$here/bundle.sh" "$scratch/bundle" "$1"
tar -C "$scratch" -czf "$scratch/bundle.tar.gz" bundle
rm -r "$scratch/bundle"
mkdir "$scratch/else where"
tar -C "$scratch/else where" -xzf "$scratch/bundle.tar.gz"
bundle="$scratch/else where/bundle"

for library in libvulkan.so.1 c/libc.so.6 cxx/libstdc++.so.6; do
    [ -f "$bundle/lib/$library" ] || fail "$library is not in the bundle"
done
if find "$bundle" -name '*lvp*' -o -name '*nvidia*' -o -name '*radeon*' | grep -q .; then
    fail "a driver is in the bundle"
fi

name=$(basename "$1")
# No environment but where programs are, and what a sanitizer was told.
bare=(env -i PATH=/usr/bin:/bin ${ASAN_OPTIONS:+"ASAN_OPTIONS=$ASAN_OPTIONS"})
expected=$("$1" info --json)
for alone in "" 1; do
    found=$("${bare[@]}" MELTPOINT_BUNDLE_ALONE=$alone "$bundle/$name" info --json)
    [ "$found" = "$expected" ] || fail "info from the bundle (alone: '$alone') says: $found"
done
# The loader of the bundle, and not the machine's, is the one it opens.
opened=$("${bare[@]}" LD_DEBUG=libs "$bundle/$name" info 2>&1 | grep -E 'calling init: .*libvulkan' || true)
grep -qF "$bundle/lib/libvulkan.so.1" <<<"$opened" || fail "the Vulkan loader was taken from: $opened"
if "${bare[@]}" "$bundle/$name" no_such_subcommand 2>"$scratch/err"; then
    fail "a mistake in the arguments went unnoticed"
fi

"$here/bundle.sh" "$scratch/not_made" "$scratch/no_such_program" 2>/dev/null && fail "a missing program was packed"
mkdir "$scratch/precious"
"$here/bundle.sh" "$scratch/precious" "$1" 2>/dev/null && fail "a folder that is no bundle was replaced"
[ -d "$scratch/precious" ] || fail "a folder that is no bundle was removed"
echo "the bundle runs elsewhere"
