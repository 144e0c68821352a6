#!/usr/bin/env python3
"""Holds the project's pages against what they speak of.

    check_pages.py SOURCE_DIR                     every file that a page links to or quotes exists, and quoted code is there
    check_pages.py SOURCE_DIR --follow PROGRAM    engine/follow_a_particle.md has the numbers that the program prints
    check_pages.py SOURCE_DIR --write PROGRAM     writes these numbers into the page
    check_pages.py --self-test                    feeds itself pages that are wrong
"""

import re
import subprocess
import sys
from pathlib import Path

PAGES = ["README.md", "third_party_notes.md", "apps/scenes/README.md", "engine/follow_a_particle.md"]
FOLLOW = "engine/follow_a_particle.md"
TOLERANCE = 0.01  # of a number: drivers round differently, and a step amplifies that

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
QUOTED_PATH = re.compile(r"`((?:engine|shaders|apps|tests|cmake)/[\w./-]+\.\w+)`")
CODE = re.compile(r"^```(glsl|cpp)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
RUN = re.compile(r"^```console\n\$ meltpoint ([^\n]+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?")


def links(text, folder):
    """(what is written, path from the top folder) of every link into the project and every quoted path."""
    for target in LINK.findall(text):
        if not re.match(r"[a-z]+:|#", target):
            yield target, (folder / target.split("#")[0]).as_posix()
    for path in QUOTED_PATH.findall(text):
        yield path, path


def normal(path):
    parts = []
    for part in path.split("/"):
        if part == "..":
            parts.pop()
        elif part != ".":
            parts.append(part)
    return "/".join(parts)


def check_page(page, text, exists, read):
    """The complaints about one page. Code is looked for in the files that its section links to (follow_a_particle.md only)."""
    folder = Path(page).parent
    found = [f"{page}: {written} does not exist" for written, path in links(text, folder) if not exists(normal(path))]
    if page != FOLLOW:
        return found
    for section in re.split(r"^## ", text, flags=re.MULTILINE):
        sources = [normal(path) for _, path in links(section, folder)]
        lines = {line.strip() for path in sources if exists(path) for line in read(path).splitlines()}
        for _, code in CODE.findall(section):
            found += [f"{page}: in no file of its section: {line.strip()}"
                      for line in code.splitlines() if line.strip() and line.strip() not in lines]
    return found


def differences(expected, printed):
    """Lines of two outputs that differ in their words, or in a number by more than rounding."""
    found = []
    old, new = expected.strip().splitlines(), printed.strip().splitlines()
    if len(old) != len(new):
        return [f"{len(old)} lines on the page, {len(new)} printed"]
    for a, b in zip(old, new):
        pairs = list(zip(NUMBER.findall(a), NUMBER.findall(b)))
        same_words = NUMBER.sub("#", a) == NUMBER.sub("#", b)
        if not same_words or any(abs(float(x) - float(y)) > TOLERANCE * max(abs(float(x)), 1e-3) for x, y in pairs):
            found.append(f"on the page: {a}\n   printed: {b}")
    return found


def run_program(program, arguments):
    result = subprocess.run([program, *arguments.split(), "--quiet"], capture_output=True, text=True, check=False)
    if result.returncode != 0 or result.stderr:
        sys.exit(f"{program} {arguments}: exit code {result.returncode}: {result.stderr}")
    return result.stdout


def check_all(root):
    exists = lambda path: (root / path).exists()
    read = lambda path: (root / path).read_text(encoding="utf-8") if (root / path).is_file() else ""
    found = [line for page in PAGES for line in check_page(page, read(page), exists, read)]
    print("\n".join(found), file=sys.stderr) if found else print(f"{len(PAGES)} pages speak of what there is")
    return 1 if found else 0


def check_follow(root, program, write):
    page = root / FOLLOW
    text = page.read_text(encoding="utf-8")
    match = RUN.search(text)
    if not match:
        sys.exit(f"{FOLLOW} shows no run of the program")
    printed = run_program(program, match[1])
    if write:
        page.write_text(text[:match.start(2)] + printed + text[match.end(2):], encoding="utf-8")
        return 0
    found = differences(match[2], printed)
    if found:
        print("\n".join(found), file=sys.stderr)
        print(f"if the numbers have changed for a reason: {sys.argv[0]} SOURCE_DIR --write PROGRAM, and read the page",
              file=sys.stderr)
    return 1 if found else 0


def self_test():
    exists = {"a.md", "engine/x.cpp", "engine/y.comp", FOLLOW}.__contains__
    read = {"engine/x.cpp": "int a;\n    int b;\n", "engine/y.comp": "void main()\n"}.get
    wrong = [
        ("README.md", "[there](b.md)", "a link to nothing"),
        ("README.md", "see `engine/z.cpp`", "a quoted path of nothing"),
        ("engine/sub/p.md", "[x](../y.comp) [up](../../b.md)", "a link upward to nothing"),
        (FOLLOW, "## A\n[x](x.cpp)\n```cpp\nint c;\n```\n", "code that is not there"),
        (FOLLOW, "## A\n[y](y.comp)\n```cpp\nint a;\n```\n## B\n[x](x.cpp)\n", "code of another section's file"),
    ]
    right = [
        ("README.md", "[a](a.md#part) [web](https://x.org) [here](#part) `engine/x.cpp`"),
        ("engine/sub/p.md", "[x](../y.comp) [up](../../a.md)"),
        (FOLLOW, "## A\n[x](x.cpp)\n```cpp\nint b;\n```\n"),
    ]
    failures = [f"not noticed: {why}" for page, text, why in wrong if len(check_page(page, text, exists, read)) != 1]
    failures += [f"wrongly noticed: {text}" for page, text in right if check_page(page, text, exists, read)]
    failures += [f"numbers: {a} and {b}" for a, b, differ in [
        ("p 1.000 m\n", "p 1.001 m\n", False), ("p 1.0 m\n", "p 1.1 m\n", True), ("p 1 m", "q 1 m", True),
        ("p -1 m", "p 1 m", True), ("p 1", "p 1\nq 1", True), ("v 1e-9 2", "v -2e-9 2", False),
    ] if bool(differences(a, b)) != differ]
    print("\n".join(failures), file=sys.stderr) if failures else print(f"{len(wrong)} wrong pages noticed")
    return 1 if failures else 0


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        sys.exit(self_test())
    if len(sys.argv) == 2:
        sys.exit(check_all(Path(sys.argv[1])))
    if len(sys.argv) != 4 or sys.argv[2] not in ("--follow", "--write"):
        sys.exit(__doc__)
    sys.exit(check_follow(Path(sys.argv[1]), sys.argv[3], sys.argv[2] == "--write"))
