"""Rules about where things are: rooms, include edges, the picture, twins."""

import pathlib
import re

from tools.lint import rooms
from tools.lint.tree import CPP, SYSTEM_VERILOG, Tree, Violation

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SEARCH_FOLDERS = ("", "include", "src", "tests")


def resolve(tree: Tree, source: str, target: str) -> str | None:
    """The project's file that an include names, or None when it is not one of them."""
    known = set(tree.files)
    beside = (pathlib.PurePosixPath(source).parent / target).as_posix()
    candidates = [beside, *(f"{folder}/{target}".lstrip("/") for folder in SEARCH_FOLDERS)]
    return next((name for name in candidates if name in known), None)


def edges(tree: Tree):
    """Includes go one way, along the edges of rooms.ALLOWED."""
    for name in tree.files:
        room = rooms.room_of(name)
        if room is None:
            yield Violation(name, 0, "edges", "belongs to no room of tools/lint/rooms.py")
        elif name.endswith(CPP + SYSTEM_VERILOG):
            yield from _edges_of_file(tree, name, room)


def _edges_of_file(tree: Tree, name: str, room: str):
    for number, line in tree.lines(name):
        match = INCLUDE.match(line)
        if not match:
            continue
        target = match[2]
        used = resolve(tree, name, target)
        if used is None:
            yield from _third_party(name, number, room, match[1], target)
            continue
        used_room = rooms.room_of(used)
        allowed = rooms.ALLOWED.get(room, set())
        if used_room != room and allowed != rooms.ANY and used_room not in allowed:
            yield Violation(name, number, "edges", f"{room} must not include {used} ({used_room})")


def _third_party(name: str, number: int, room: str, bracket: str, target: str):
    for prefix, users in rooms.THIRD_PARTY.items():
        exact = prefix.isalnum() and not prefix.startswith(("verilated", "rapidcheck"))
        hit = target == prefix if exact else target.startswith(prefix)
        if hit and room not in users:
            yield Violation(name, number, "edges", f"{room} must not include <{target}>")
        if hit:
            return
    if bracket == '"' and not target.startswith("generated/") and room not in ("sim", "tests"):
        yield Violation(name, number, "edges", f'"{target}" is no file of the project')


def naming(tree: Tree):
    """src and include never name rtl or sim, and rtl never names C++: not even in a comment."""
    forbidden = {
        ("src/", "include/"): re.compile(r"\b(rtl|sim)/\w"),
        ("rtl/",): re.compile(r"\b(src|sim|include)/\w"),
    }
    for prefixes, pattern in forbidden.items():
        for name in tree.files:
            if not name.startswith(prefixes) or not name.endswith(CPP + SYSTEM_VERILOG):
                continue
            for number, line in tree.lines(name):
                if match := pattern.search(line):
                    yield Violation(
                        name, number, "naming", f"{rooms.room_of(name)} must not name {match[1]}/")


TABLE_ROW = re.compile(r"^\|\s*`([^`]+)`\s*\|([^|]*)\|")


def picture(tree: Tree):
    """The table of edges in ARCHITECTURE.md is rooms.ALLOWED, and its picture names every room."""
    document = "ARCHITECTURE.md"
    if document not in tree.files:
        yield Violation(document, 0, "picture", "is missing")
        return
    written: dict[str, set[str] | str] = {}
    for _, line in tree.lines(document):
        if match := TABLE_ROW.match(line):
            cell = match[2].strip()
            written[match[1]] = (
                rooms.ANY if cell.startswith("anything") else set(re.findall(r"`([^`]+)`", cell)))
    for room in sorted(set(written) | set(rooms.ALLOWED)):
        says, is_allowed = written.get(room), rooms.ALLOWED.get(room)
        if says != is_allowed:
            yield Violation(document, 0, "picture",
                            f"row {room} says {says}, tools/lint/rooms.py says {is_allowed}")
    drawing = (tree.text(document) or "").partition("```")[2].partition("```")[0]
    for room in rooms.ALLOWED:
        shown = re.search(rf"\b{room.split('/')[-1]}\b", drawing)
        if room not in ("tests", "examples") and not shown:
            yield Violation(document, 0, "picture", f"the picture does not show {room}")


TWIN_WAIVERS = "tests/twins.txt"


def twins(tree: Tree):
    """Every src/x/y.cpp has tests/x/y_test.cpp, or a line with a reason in tests/twins.txt."""
    waivers = {}
    if TWIN_WAIVERS in tree.files:
        for number, line in tree.lines(TWIN_WAIVERS):
            if line.strip() and not line.startswith("#"):
                source, _, reason = line.partition(":")
                waivers[source.strip()] = (number, reason.strip())
    for name in tree.files:
        if not name.startswith("src/") or not name.endswith(".cpp"):
            continue
        twin = re.sub(r"^src/(.*)\.cpp$", r"tests/\1_test.cpp", name)
        waiver = waivers.pop(name, None)
        if twin in tree.files:
            if waiver:
                yield Violation(TWIN_WAIVERS, waiver[0], "twins", f"{twin} exists, drop the line")
        elif not waiver:
            yield Violation(name, 0, "twins", f"has neither {twin} nor a line in {TWIN_WAIVERS}")
        elif not waiver[1]:
            yield Violation(TWIN_WAIVERS, waiver[0], "twins", "gives no reason")
    for source, (number, _) in waivers.items():
        yield Violation(TWIN_WAIVERS, number, "twins", f"{source} does not exist")
