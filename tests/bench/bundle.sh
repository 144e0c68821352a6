#!/usr/bin/env bash
# Packs programs with their shared libraries into one folder that runs on any x86-64 Linux with a Vulkan driver: the program
# for a machine with a GPU and nothing else of ours, or the tests.
#
#   tests/bench/bundle.sh FOLDER PROGRAM...
#
# FOLDER/PROGRAM then starts each. Inside, bin/ holds the programs, lib/ their libraries with the Vulkan loader, which they
# open by themselves, but no driver: that is the machine's. lib/cxx/ and lib/c/ hold the libraries of C++ and C, which the
# machine's driver needs as well, and in a version at least its own: so the machine's are used where a program starts with
# them, and these only where it does not.
set -euo pipefail

fail() {
    echo "bundle.sh: $1" >&2
    exit "${2:-1}"
}

[ $# -ge 2 ] || fail "expected FOLDER PROGRAM..." 2
folder=$1
shift
for program in "$@"; do
    [ -x "$program" ] && [ -f "$program" ] || fail "$program is not a program" 2
done
if [ -e "$folder" ] && [ ! -f "$folder/bundle" ]; then
    fail "$folder exists and is not a bundle" 2
fi
rm -rf "$folder"
mkdir -p "$folder"/{bin,lib/cxx,lib/c}
echo "made by tests/bench/bundle.sh" >"$folder/bundle"

# libraries_of FILE: the paths of all shared libraries that it needs, the dynamic loader included.
libraries_of() {
    local listed
    listed=$(ldd "$1")
    if grep -q 'not found' <<<"$listed"; then
        fail "$1 lacks $(grep 'not found' <<<"$listed" | awk '{ print $1 }' | paste -sd ' ')"
    fi
    sed -nE 's/.*=> (\/[^ ]+) .*/\1/p; s/^[[:space:]]*(\/[^ ]*ld-linux[^ ]*) .*/\1/p' <<<"$listed"
}

# place_of LIBRARY: its folder in the bundle.
place_of() {
    case $(basename "$1") in
        ld-linux* | libc.so.* | libm.so.* | libdl.so.* | librt.so.* | libpthread.so.* | libresolv.so.* | libutil.so.* | libanl.so.* | libnsl.so.*) echo lib/c ;;
        libstdc++.so.* | libgcc_s.so.*) echo lib/cxx ;;
        *) echo lib ;;
    esac
}

loader=$(ldconfig -p 2>/dev/null | sed -nE 's/.*libvulkan\.so\.1 .*x86-64.*=> (.*)/\1/p' | head -n 1)
[ -n "$loader" ] || fail "there is no Vulkan loader (libvulkan.so.1) to bring along"
{
    echo "$loader"
    for file in "$@" "$loader"; do
        libraries_of "$file"
    done
} | sort -u | while read -r library; do
    cp -L "$library" "$folder/$(place_of "$library")/$(basename "$library")"
done

for program in "$@"; do
    name=$(basename "$program")
    cp "$program" "$folder/bin/$name"
    cat >"$folder/$name" <<'START'
#!/bin/sh
# Starts the program of this name in bin/ with the bundle's libraries; those of C and C++ are the machine's where they do.
here=$(cd "$(dirname "$(readlink -f "$0")")" && pwd) || exit 1
program=$here/bin/$(basename "$0")
rest=${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}

# starts PATH: whether all of the program's libraries are found, in versions that do.
starts() {
    ! LD_TRACE_LOADED_OBJECTS=1 LD_WARN=1 LD_BIND_NOW=1 LD_LIBRARY_PATH=$1 "$program" 2>&1 |
        grep -qE 'not found|undefined symbol|cannot|No such file'
}

for path in "$here/lib" "$here/lib:$here/lib/cxx"; do
    if [ -z "$MELTPOINT_BUNDLE_ALONE" ] && starts "$path"; then
        LD_LIBRARY_PATH=$path$rest exec "$program" "$@"
    fi
done
for loader in "$here"/lib/c/ld-linux*; do
    exec "$loader" --library-path "$here/lib:$here/lib/cxx:$here/lib/c$rest" "$program" "$@"
done
START
    chmod +x "$folder/$name"
done
echo "$folder: $(du -sh "$folder" | cut -f 1), $(find "$folder/lib" -type f | wc -l) libraries"
