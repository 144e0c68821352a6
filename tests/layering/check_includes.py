#!/usr/bin/env python3
"""Checks every #include in engine/, apps/, tests/ and shaders/ against the tables below.

Static libraries do not keep a direction (a call upward links), so this does.

    check_includes.py SOURCE_DIR     exit 1 and one line for each include that the tables do not allow
    check_includes.py --self-test    feeds itself sources that break each rule, and ones that keep them
"""

import re
import sys
from pathlib import Path

# --- the tables --------------------------------------------------------------------------------------------------------

# A folder may include itself, the folders it stands on here, and all that those stand on.
STANDS_ON = {
    "engine/core": [],
    "engine/geometry": ["engine/core"],
    "engine/particles": ["engine/geometry", "shaders/shared"],
    "engine/io": ["engine/particles"],
    "engine/reference": ["engine/particles"],
    "engine/scene": ["engine/core"],
    "engine/gpu": ["engine/core", "shaders/shared"],
    "engine/primitives": ["engine/gpu"],
    "engine/particle_buffers": ["engine/gpu", "engine/particles"],
    "engine/sim": ["engine/particle_buffers", "engine/primitives"],
    "engine/render": ["engine/particle_buffers", "engine/primitives"],
    "engine/run": ["engine/scene", "engine/io", "engine/sim", "engine/render"],
    "apps/meltpoint": ["engine/run"],
    "apps/viewer": ["engine/run"],
    "tests": ["engine/run", "engine/reference"],
    "shaders/shared": [],
    "shaders/include": ["shaders/shared"],
    "shaders/primitives": ["shaders/include"],
    "shaders/sim": ["shaders/include"],
    "shaders/render": ["shaders/include"],
}

# Only these include compiled shaders ("spirv/sim/density.comp.h", generated), and only in their .cpp files.
DISPATCHING = ["engine/primitives", "engine/sim", "engine/render"]

# Single files that may include one folder more.
EXTRA = {
    "apps/meltpoint/compare.cpp": ["engine/reference"],
}

GPU_FOLDERS = ["engine/gpu", "engine/primitives", "engine/particle_buffers", "engine/sim", "engine/render", "engine/run"]
EVERYWHERE = ["engine", "apps", "tests", "shaders"]

# Library headers by the beginning of their name, and the folders and files that may include them.
LIBRARIES = {
    "vulkan/": GPU_FOLDERS + ["tests"],
    "volk.h": GPU_FOLDERS + ["tests"],
    "spirv_cross/": ["engine/gpu"],
    "assimp/": ["engine/io/mesh_import.cpp"],
    "toml++/": ["engine/scene/scene_file.cpp"],
    "png.h": ["engine/io/image_write.cpp"],
    "spdlog/": ["engine/core/log.cpp"],
    "CLI/": ["apps/meltpoint"],
    "nlohmann/": ["apps/meltpoint", "tests"],
    "GLFW/": ["apps/viewer"],
    "imgui": ["apps/viewer"],
    "gtest/": ["tests"],
    "glm/": EVERYWHERE,
    "fmt/": EVERYWHERE,
    "tbb/": EVERYWHERE,
}
POSIX = re.compile(r"(unistd|fcntl|poll|signal|spawn)\.h|sys/\w+\.h")  # allowed everywhere, as is the standard library

# --- the check ---------------------------------------------------------------------------------------------------------

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', re.MULTILINE)
SUFFIXES = {".h", ".cpp", ".comp", ".vert", ".frag", ".glsl"}


def closure(folder):
    """All folders that `folder` may include."""
    seen, open_ones = set(), [folder]
    while open_ones:
        current = open_ones.pop()
        if current not in seen:
            seen.add(current)
            open_ones += STANDS_ON[current]
    return seen


def folder_of(path):
    """The row of STANDS_ON that holds a source file, or None."""
    parts = Path(path).parts
    row = parts[0] if parts[0] == "tests" else "/".join(parts[:2])
    return row if row in STANDS_ON and len(parts) > 1 else None


def target_of(header):
    """The row of STANDS_ON that an include names ("sim/density.h" is engine/sim), or None."""
    first, _, rest = header.partition("/")
    if not rest:
        return None
    for parent in ("engine", "shaders"):
        if f"{parent}/{first}" in STANDS_ON:
            return f"{parent}/{first}"
    return None


def standing_in(path, places):
    return any(path == place or path.startswith(place + "/") for place in places)


def complaint(path, quote, header, exists):
    """Why the file at `path` may not include `header`, or None if it may. `exists` tells whether a source file exists."""
    folder = folder_of(path)
    if folder is None:
        return "lies in no folder of the table"
    if ".." in header.split("/"):
        return f'includes "{header}": write it from engine/, shaders/ or tests/, without ".."'

    for prefix, places in LIBRARIES.items():
        if header.startswith(prefix):
            return None if standing_in(path, places) else f"includes <{header}>, which is for {', '.join(places)} only"

    # Files of its own folder first: tests/gpu/ has the same name as engine/gpu/.
    here = str(Path(path).parent)
    if quote == '"' and exists(f"{here}/{header}"):
        return None
    if folder == "tests" and exists(f"tests/{header}"):
        return None
    if header.startswith("spirv/"):
        if folder in DISPATCHING and path.endswith(".cpp"):
            return None
        return f'includes "{header}"; compiled shaders are for the .cpp files of {", ".join(DISPATCHING)} only'
    target = target_of(header)
    if target is not None:
        allowed = closure(folder).union(*(closure(extra) for extra in EXTRA.get(path, [])))
        if target in allowed:
            return None
        names = ", ".join(sorted(allowed - {folder})) or "nothing else of the project"
        return f'includes "{header}" of {target}; {folder} may include {names}'

    if quote == "<" and ("." not in header or POSIX.fullmatch(header)):
        return None
    return f"includes {header}, which is in no table of tests/layering/check_includes.py"


def check(sources, exists):
    """The complaints about (path, text) pairs, one line each."""
    found = []
    for path, text in sources:
        for match in INCLUDE.finditer(text):
            reason = complaint(path, match[1], match[2], exists)
            if reason:
                line = text.count("\n", 0, match.start(2)) + 1
                found.append(f"{path}:{line}: {reason}")
    return found


def check_tree(root):
    sources = [
        (str(file.relative_to(root)), file.read_text(encoding="utf-8"))
        for top in ("engine", "apps", "tests", "shaders")
        for file in sorted((root / top).rglob("*"))
        if file.suffix in SUFFIXES
    ]
    found = check(sources, lambda path: (root / path).is_file())
    print("\n".join(found), file=sys.stderr) if found else print(f"{len(sources)} files keep the layering")
    return 1 if found or not sources else 0


# --- the proof that it can fail ----------------------------------------------------------------------------------------

FORBIDDEN = [
    ("engine/core/log.h", '#include "geometry/point_cloud.h"'),
    ("engine/core/log.h", "#include <geometry/point_cloud.h>"),
    ("engine/core/log.h", '#include "shared/sph_params.h"'),
    ("engine/geometry/point_cloud.h", '#include "particles/particle_set.h"'),
    ("engine/sim/simulation.h", '#include "scene/scene.h"'),
    ("engine/sim/simulation.h", '#include "render/camera.h"'),
    ("engine/sim/simulation.h", '#include "run/runner.h"'),
    ("engine/sim/density.h", '#include "spirv/sim/density.comp.h"'),
    ("engine/render/camera.cpp", '#include "scene/scene.h"'),
    ("engine/run/runner.cpp", '#include "reference/density.h"'),
    ("engine/run/runner.cpp", '#include "spirv/sim/density.comp.h"'),
    ("apps/meltpoint/render.cpp", '#include "reference/density.h"'),
    ("apps/meltpoint/compare.cpp", "#include <volk.h>"),
    ("engine/scene/scene.h", "#include <vulkan/vulkan.h>"),
    ("engine/scene/scene.h", "#include <toml++/toml.h>"),
    ("engine/io/particle_export.cpp", "#include <assimp/scene.h>"),
    ("engine/io/particle_export.cpp", "#include <png.h>"),
    ("engine/gpu/context.cpp", "  #  include <spdlog/spdlog.h>"),
    ("engine/run/runner.h", "#include <GLFW/glfw3.h>"),
    ("engine/run/runner.h", "#include <imgui.h>"),
    ("engine/gpu/kernel.h", "#include <boost/any.hpp>"),
    ("engine/gpu/kernel.h", '#include "../core/log.h"'),
    ("engine/gpu/kernel.h", '#include "shared/../../engine/core/log.h"'),
    ("engine/new_folder/file.h", "#include <vector>"),
    ("engine/file.h", "#include <vector>"),
    ("shaders/shared/sph_params.h", '#include "include/kernels.glsl"'),
    ("shaders/include/kernels.glsl", '#include "sim/density.glsl"'),
]
ALLOWED = [
    ("engine/geometry/point_cloud.h", '#include <vector>\n#include <glm/glm.hpp>\n#include "core/aabb.h"'),
    ("engine/sim/density.cpp", '#include "sim/density.h"\n#include "spirv/sim/density.comp.h"\n#include "core/error.h"'),
    ("engine/run/runner.cpp", '#include "scene/scene.h"\n#include "primitives/prefix_scan.h"\n#include <volk.h>'),
    ("apps/meltpoint/compare.cpp", '#include "reference/density.h"\n#include <CLI/CLI.hpp>'),
    ("apps/meltpoint/main.cpp", '#include "options.h"\n#include <unistd.h>\n#include <sys/stat.h>'),
    ("tests/gpu/kernel_test.cpp", '#include "gpu/fixture.h"\n#include "reference/density.h"\n#include <gtest/gtest.h>'),
    ("shaders/sim/density.comp", '#include "shared/sph_params.h"\n#include "include/kernels.glsl"'),
]


def self_test():
    exists = {"apps/meltpoint/options.h", "tests/gpu/fixture.h"}.__contains__
    failures = [f"not noticed: {path}: {text}" for path, text in FORBIDDEN if len(check([(path, text)], exists)) != 1]
    failures += [f"wrongly noticed: {line}" for source in ALLOWED for line in check([source], exists)]
    located = check([("engine/core/log.h", '#include <vector>\n\n#include "gpu/context.h"\n')], exists)
    if not located or not located[0].startswith("engine/core/log.h:3: "):
        failures.append(f"wrong place: {located}")
    print("\n".join(failures), file=sys.stderr) if failures else print(
        f"{len(FORBIDDEN)} violations noticed, {len(ALLOWED)} clean sources passed")
    return 1 if failures else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(self_test() if sys.argv[1] == "--self-test" else check_tree(Path(sys.argv[1])))
