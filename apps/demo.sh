#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds Meltpoint and renders its default scene to PNG frames.
#
#   apps/demo.sh [--no-install] [option of `meltpoint render`...]
#
# --no-install only checks: it names the missing packages and exits with 2 if there are any.
set -euo pipefail
# shellcheck source=apps/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install=yes
frames=out/melt_teapot
video=out/melt_teapot.mp4
options=()
while [ $# -gt 0 ]; do
    case $1 in
        --no-install) install=no ;;
        --out=*) frames=${1#*=} ;;
        --video=*) video=${1#*=} ;;
        --out | --video)
            [ $# -ge 2 ] || fail "$1 needs a path"
            if [ "$1" = --out ]; then frames=$2; else video=$2; fi
            shift
            ;;
        -h | --help)
            sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' apps/demo.sh
            exit 0
            ;;
        *) options+=("$1") ;;
    esac
    shift
done
if command -v ffmpeg >/dev/null; then
    options+=(--video "$video")
else
    video=
fi

set_up "$install" "${required_packages[@]}"
require_compiler
echo "Building build/release"
mkdir -p build
configure release >build/configure.log 2>&1 || fail "cmake could not configure the build: see build/configure.log" 1
build build/release --target meltpoint_program || fail "the build failed: its first error stands above" 1

build/release/meltpoint render melt_teapot --out "$frames" --force "${options[@]}"
echo "Frames: $(realpath "$frames")/frame_0000.png and following"
if [ -n "$video" ]; then
    echo "Video:  $(realpath "$video")"
fi
