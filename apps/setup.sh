# Sourced by apps/demo.sh and tests/run.sh: the packages of Debian 12 that Meltpoint is built from, and the functions that
# install them and build a preset. Sourcing it does nothing but define things and go to the top folder.
# shellcheck shell=bash disable=SC2034 # the arrays are used by the scripts that source this

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2

# --- the packages: third_party_notes.md says more about each -----------------------------------------------------------

required_packages=(
    g++                        # the compiler, C++20
    cmake                      # the build, 3.25 or later
    ninja-build                # what the presets build with
    glslang-tools              # glslangValidator: shaders to SPIR-V
    libvulkan-dev              # Vulkan headers and loader
    libvulkan-volk-dev         # Vulkan entry points loaded per device
    libspirv-cross-c-shared-dev  # reflection of compiled shaders (it holds the C++ library too)
    mesa-vulkan-drivers        # lavapipe, the Vulkan device of machines without a GPU
    vulkan-validationlayers    # render --validate, and the tests that must see no message
    libglm-dev                 # vectors and matrices
    libfmt-dev                 # text formatting
    libspdlog-dev              # messages
    libtbb-dev                 # parallel loops on the CPU
    libassimp-dev              # mesh files
    libeigen3-dev              # planes through points
    libnanoflann-dev           # nearest neighbors
    libtomlplusplus-dev        # scene files
    libpng-dev                 # frames
    libcli11-dev               # command line
    nlohmann-json3-dev         # --json
    libgtest-dev               # the tests
    python3                    # tests/layering
)

# Only tests/run.sh --all needs these.
check_packages=(
    clang-16                   # the second compiler
    clang-tidy-16              # static analysis
    doxygen                    # the reference of the public headers
    gmsh                       # opens what `meltpoint sample` writes (tests/apps/readers.py)
    python3-vtk9               # the same, with what ParaView reads with
)

# --- functions ---------------------------------------------------------------------------------------------------------

# fail SENTENCE [CODE]: the one sentence a user sees when a script cannot go on. 2: the machine is not ready, 1: anything else.
fail() {
    echo "${0##*/}: $1" >&2
    exit "${2:-2}"
}

# missing_packages PACKAGE...: those that are not installed, one a line.
missing_packages() {
    local installed # dpkg-query fails where it does not know a package, and still lists the others
    installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p') || true
    comm -23 <(printf '%s\n' "$@" | sort) <(sort <<<"$installed")
}

# as_root COMMAND...: runs it as root, through sudo where needed.
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    else
        sudo "$@"
    fi
}

# set_up INSTALL PACKAGE...: makes sure that the packages are there. INSTALL=no only checks.
set_up() {
    local install=$1
    shift
    [ -x /usr/bin/dpkg-query ] ||
        fail "this system is not Debian 12, so the set-up cannot install what Meltpoint needs: see third_party_notes.md and build with 'cmake --preset release'"

    local missing
    mapfile -t missing < <(missing_packages "$@")
    [ "${#missing[@]}" -gt 0 ] || return 0
    [ "$install" = yes ] ||
        fail "these packages are missing: ${missing[*]}"

    local name=unknown version=''
    # shellcheck disable=SC1091
    [ -r /etc/os-release ] && { name=$(. /etc/os-release && echo "$ID") && version=$(. /etc/os-release && echo "${VERSION_ID:-}"); }
    [ "$name $version" = "debian 12" ] ||
        fail "this system is $name $version and the set-up knows Debian 12 only; install these yourself: ${missing[*]}"
    [ "$(id -u)" -eq 0 ] || command -v sudo >/dev/null ||
        fail "you are not root and there is no sudo; as root run: apt-get install ${missing[*]}"

    # apt's package lists are fetched only where they are absent, or so old that the mirror has moved on.
    echo "Installing ${missing[*]}"
    local log=build/setup.log get=(env DEBIAN_FRONTEND=noninteractive apt-get --quiet --quiet --option Dpkg::Use-Pty=0)
    local install_missing=("${get[@]}" install --yes --no-install-recommends "${missing[@]}")
    mkdir -p build
    if ! { "${get[@]}" --simulate install "${missing[@]}" && as_root "${install_missing[@]}"; } >"$log" 2>&1; then
        { as_root "${get[@]}" update && as_root "${install_missing[@]}"; } >"$log" 2>&1 ||
            fail "apt-get could not install the missing packages, most likely for want of a network (all it said is in $log): $(grep -m 1 '^[EW]: ' "$log" || tail -n 1 "$log")"
    fi
}

# require_compiler: says so at once where the compiler that CMake would take is too old.
require_compiler() {
    [ -f build/release/CMakeCache.txt ] && return
    local compiler=${CXX:-c++}
    # std::views is what older compilers lack, among them Debian's clang 14 with its libstdc++ 12.
    # shellcheck disable=SC2086 # CXX may carry a launcher: "ccache g++"
    $compiler -std=c++20 -fsyntax-only -x c++ - >/dev/null 2>&1 <<'CPP' ||
#include <concepts>
#include <ranges>
int main() { int n = 0; for (int i : std::views::iota(0, 4) | std::views::reverse) { n += i; } return n - 6; }
CPP
        fail "the compiler '$compiler' cannot build C++20: set CXX to g++ 12 or later, or to clang++-16 or later"
}

# configure PRESET [CMAKE OPTION...]: through ccache where it is installed.
configure() {
    local preset=$1
    shift
    cmake --preset "$preset" -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache)" "$@"
}

# build FOLDER [CMAKE --build OPTION...]
build() {
    cmake --build "$1" --parallel "$(nproc)" "${@:2}"
}
