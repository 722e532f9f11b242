"""Rules about what a file says: nothing outside the project, nothing left over, clean text."""

import os
import pathlib
import re

from tools.lint.tree import CPP, SYSTEM_VERILOG, Tree, Violation

CODE = CPP + SYSTEM_VERILOG + (".py", ".sh", ".cmake", ".ts", ".mjs", ".js", ".css")

SCRIPTS = ("dev", ".ci/run")

# Absolute paths that exist on every Debian machine may be named; a person's or a job's may not.
PRIVATE_PATH = re.compile(
    r"(?<![\w.$}/:*-])/(?:work|home|root|tmp|mnt|media|srv|opt|Users)(?:/[\w.-]*|\b(?!/))")
CLIMBING_PATH = re.compile(r"(?<![\w./])((?:\.\./)+)[\w.]")


def outside(tree: Tree):
    """No file names anything outside the project: no private absolute path, no path that climbs out
    of the tree, no word of $HARPOON_LINT_WORDS (a pattern for names that only mean something in the
    place where one works)."""
    words = os.environ.get("HARPOON_LINT_WORDS")
    local_words = re.compile(words, re.IGNORECASE) if words else None
    for name in tree.files:
        if local_words and local_words.search(name):
            yield Violation(name, 0, "outside", "is named after something outside the project")
        depth = len(pathlib.PurePosixPath(name).parent.parts)
        for number, line in tree.lines(name):
            if match := PRIVATE_PATH.search(line):
                yield Violation(name, number, "outside", f"names the path {match[0]}")
            for match in CLIMBING_PATH.finditer(line):
                if match[1].count("../") > depth:
                    yield Violation(name, number, "outside", f"climbs out of the tree: {match[1]}")
            if local_words and (match := local_words.search(line)):
                yield Violation(name, number, "outside", f"names {match[0]}")


# What looks at every result of a read and a write, and nothing else does either.
STREAMS = re.compile(r"\b(?:fmt::print|std::(?:cout|cerr|clog|printf|puts|fopen|\w*fstream))\b")
READER_AND_WRITER = ("apps/files.cpp", "apps/output.cpp", "apps/output.hpp", "apps/signals.cpp")


def streams(tree: Tree):
    """The command reads and writes in one place, where failures are errors."""
    for name in tree.files:
        if not name.startswith("apps/") or not name.endswith(CPP) or name in READER_AND_WRITER:
            continue
        for number, line in tree.lines(name):
            if match := STREAMS.search(line):
                yield Violation(name, number, "streams",
                                f"{match[0]}: print with apps/output.hpp, open with apps/files.hpp")


MARKER = re.compile(r"\b(TO" r"DO|FIX" r"ME|X" r"XX|HA" r"CK)\b")
C_COMMENT = re.compile(r"^\s*//+\s?(.*)$")
HASH_COMMENT = re.compile(r"^\s*#\s?(.*)$")
C_CODE = (
    re.compile(r"^(?:[\w:<>*&]+\s+){0,2}[\w:.\->\[\]*]+(?:\(|\s*[-+|&*/<]?=\s)[^`]*;\s*$"),
    re.compile(r"^(?:if|for|while|switch)\s*\(.*\)\s*\{?\s*$"),
    re.compile(r"^(?:return|break|continue|using|assign)\b[^`]*;\s*$"),
    re.compile(r"^(?:\}\s*else\s*\{|\}\s*;?|#include\s+[<\"].*)\s*$"),
    re.compile(r"^(?:always_ff|always_comb)\b.*$"),
)
HASH_CODE = (
    re.compile(r"^(?:if|for|while|def|class)\b.*(?::|; then|; do)\s*$"),
    re.compile(r"^(?:import \w+|from \w[\w.]* import .*|return\b.*\(.*\))\s*$"),
    re.compile(r"^(?:add_library|add_executable|add_test|target_\w+|find_package|set)\(.*\)?\s*$"),
    re.compile(r"^\w+ ?= ?[\w\"'\[({].*[\])}\"']\s*$"),
)


def leftovers(tree: Tree):
    """No work left for later and no code kept as a comment."""
    for name in tree.files:
        for number, line in tree.lines(name):
            if match := MARKER.search(line):
                yield Violation(name, number, "leftovers", f"{match[0]}: do it or file it")
        if name.endswith(CPP + SYSTEM_VERILOG + (".ts", ".mjs", ".js")):
            yield from _commented_code(tree, name, C_COMMENT, C_CODE)
        elif name.endswith((".py", ".sh", ".cmake", "CMakeLists.txt")) or name in SCRIPTS:
            yield from _commented_code(tree, name, HASH_COMMENT, HASH_CODE)


def _commented_code(tree: Tree, name: str, comment: re.Pattern, code: tuple[re.Pattern, ...]):
    for number, line in tree.lines(name):
        match = comment.match(line)
        if match and any(pattern.match(match[1]) for pattern in code):
            yield Violation(name, number, "leftovers", "looks like code in a comment")


GENERATED = re.compile(
    r"(^|/)(generated|corpus|golden|dist|template)/|\.(csv|svg|json)$")


def clean(tree: Tree):
    """Text ends in one newline, has no trailing blanks, no tabs, no carriage returns; code keeps to
    100 columns."""
    for name in tree.files:
        text = tree.text(name)
        if not text or GENERATED.search(name):
            continue
        if not text.endswith("\n") or text.endswith("\n\n"):
            yield Violation(name, 0, "clean", "must end in exactly one newline")
        for number, line in tree.lines(name):
            if line != line.rstrip():
                yield Violation(name, number, "clean", "ends in blanks")
            if "\t" in line:
                yield Violation(name, number, "clean", "holds a tab")
            if len(line) > 100 and (name.endswith(CODE) or name in SCRIPTS):
                yield Violation(name, number, "clean", f"is {len(line)} columns wide, not 100")
