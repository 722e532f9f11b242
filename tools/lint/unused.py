"""Rules about what nothing uses: an edge that is drawn, a room that is not there, a file that
nobody names. A use is what a tool would follow (an include, an import, a line of CMake, a link, a
module that is instantiated), not a mention in prose."""

import fnmatch
import pathlib
import re

from tools.lint import rooms
from tools.lint.structure import INCLUDE, resolve
from tools.lint.tree import CPP, SYSTEM_VERILOG, Tree, Violation

TABLE = "tools/lint/rooms.py"


def drawn(tree: Tree):
    """Every edge of rooms.ALLOWED is used by an include, or by the CMake of its room, which names a
    folder of the other; every room is there, and has what it may use."""
    used = _edges_in_use(tree)
    there = {rooms.room_of(name) for name in tree.files}
    for room, targets in rooms.ALLOWED.items():
        if room not in there:
            yield Violation(TABLE, 0, "drawn", f"{room} is drawn, but there is no such room")
        elif targets != rooms.ANY:
            for target in sorted(targets):
                if (room, target) not in used:
                    yield Violation(TABLE, 0, "drawn", f"nothing in {room} uses {target}")


def _edges_in_use(tree: Tree) -> set[tuple[str | None, str | None]]:
    used = set()
    for name in tree.files:
        room = rooms.room_of(name)
        if name.endswith(CPP + SYSTEM_VERILOG):
            used |= {(room, rooms.room_of(target)) for target in _included(tree, name)}
        elif name.endswith("CMakeLists.txt"):
            text = _code(tree, name)
            used |= {(room, other) for other in rooms.ALLOWED
                     if re.search(rf"(?:^|[\s/}}]){re.escape(other)}(?:[/)\s]|$)", text)}
    return used


def _included(tree: Tree, name: str):
    for _, line in tree.lines(name):
        if match := INCLUDE.match(line):
            if target := resolve(tree, name, match[2]):
                yield target


# A file that is used by what its own name says, or read by a program that looks for that name.
FOUND_BY_NAME = re.compile(
    r"(^|/)(CMakeLists\.txt|CMakePresets\.json|README\.md|__init__\.py|__main__\.py|LICENSE|dev"
    r"|package(-lock)?\.json|tsconfig\.json)$|(^|/)\.[^/]+(/run)?$|^[A-Z]+\.md$")
WAIVERS = "tools/lint/unused.txt"
WORD = re.compile(r"[\w@.*+-]+")
PATH = re.compile(r"[\w@.*/+-]+")
PYTHON_IMPORT = re.compile(r"^\s*(?:from ([\w.]+) )?import (.+)$")


def unused(tree: Tree):
    """Every file is used by another one, or has a line with a reason in tools/lint/unused.txt:
    headers are included, sources built, modules instantiated or named as a top, scripts run or
    imported, pages linked, data read."""
    waivers = _waivers(tree)
    uses = _Uses(tree)
    for name in tree.files:
        if FOUND_BY_NAME.search(name) or name == WAIVERS:
            continue
        is_used = uses.of(name)
        waiver = waivers.pop(name, None)
        if waiver and is_used:
            yield Violation(WAIVERS, waiver[0], "unused", f"{name} is used, drop the line")
        elif waiver and not waiver[1]:
            yield Violation(WAIVERS, waiver[0], "unused", "gives no reason")
        elif not waiver and not is_used:
            yield Violation(name, 0, "unused", f"nothing uses it, and {WAIVERS} does not name it")
    for name, (number, _) in waivers.items():
        yield Violation(WAIVERS, number, "unused", f"{name} does not exist")


def _waivers(tree: Tree) -> dict[str, tuple[int, str]]:
    waivers = {}
    if WAIVERS in tree.files:
        for number, line in tree.lines(WAIVERS):
            if line.strip() and not line.startswith("#"):
                name, _, reason = line.partition(":")
                waivers[name.strip()] = (number, reason.strip())
    return waivers


def _code(tree: Tree, name: str) -> str:
    """The file's text without comments to the end of a line."""
    marks = r"//" if name.endswith(CPP + SYSTEM_VERILOG + (".ts", ".mjs")) else r"(?:^|\s)#"
    if name.endswith((".md", ".json", ".html", ".css")):
        return tree.text(name) or ""
    return re.sub(rf"{marks}.*$", "", tree.text(name) or "", flags=re.MULTILINE)


def _tails(path: str) -> list[str]:
    """"a/b/c" as "b/c" and "c"."""
    parts = path.split("/")
    return ["/".join(parts[first:]) for first in range(1, len(parts))]


class _Uses:
    """Who names whom. Texts are read once."""

    def __init__(self, tree: Tree):
        self.tree = tree
        self.included = {target for name in tree.matching(CPP + SYSTEM_VERILOG)
                         for target in _included(tree, name) if target != name}
        self.scripts = self._words(lambda name: name.endswith((".cmake", "CMakeLists.txt", ".in"))
                                   or name in ("dev", ".ci/run", "web/test/run")
                                   or name.endswith((".json", ".py", ".mjs")), PATH)
        self.modules = self._words(lambda name: name.endswith(
            SYSTEM_VERILOG + ("CMakeLists.txt", ".cmake", ".py", ".vlt", "_test.cpp")), WORD)
        self.pages = self._links()
        self.web = self._words(lambda name: name.startswith("web/") and name.endswith(
            (".ts", ".mjs", ".html", ".json", "/run", "CMakeLists.txt")), PATH)
        self.imports = self._imports()
        self.strings = self._words(lambda name: name.endswith(CPP + (".py", ".ts", ".mjs")), PATH)

    def _words(self, chosen, pattern: re.Pattern) -> dict[str, set[str]]:
        """The words of each chosen file; of a path also its last parts, as a path that begins with
        a variable names no folder of ours."""
        words = {}
        for name in self.tree.files:
            if chosen(name):
                found = set(pattern.findall(_code(self.tree, name)))
                words[name] = found | {
                    tail for word in found for tail in _tails(word) if "/" in tail}
                words[name] |= {re.sub(r"^(\.{0,2}/)+", "", word) for word in found}
        return words

    def _links(self) -> set[str]:
        """Files and folders that a page links to."""
        linked = set()
        for name in self.tree.files:
            if name.endswith(".md"):
                folder = pathlib.PurePosixPath(name).parent
                for target in re.findall(r"\]\(([^)#]+)[^)]*\)", self.tree.text(name) or ""):
                    parts: list[str] = []
                    for part in (folder / target).parts:
                        parts = parts[:-1] if part == ".." else [*parts, part]
                    linked.add("/".join(parts))
        return linked

    def _imports(self) -> set[str]:
        """Module names that Python files import, each with those of its package."""
        imported = set()
        for name in self.tree.matching((".py",)):
            for _, line in self.tree.lines(name):
                if match := PYTHON_IMPORT.match(line):
                    for part in match[2].split("#")[0].split(","):
                        imported.add(part.split(" as ")[0].strip().split(".")[-1])
                    imported.update((match[1] or "").split("."))
        return imported

    def of(self, name: str) -> bool:
        path = pathlib.PurePosixPath(name)
        if name.endswith((".hpp", ".h", ".inl")):
            return name in self.included
        if name.endswith(".cpp"):
            return name in self.included or self._named(self.scripts, path, stems=True)
        if name.endswith(".svh"):
            return name in self.included or self._is_word(self.modules, name, path.stem, path.name)
        if name.endswith(".sv"):
            return self._is_word(self.modules, name, path.stem, path.name)
        if name.endswith(".py"):
            return path.stem in self.imports or self._named(self.scripts, path)
        if name.startswith("web/"):
            return self._named(self.web, path) or self._named(self.scripts, path)
        if name.startswith("docs/"):
            return (name in self.pages or any(str(folder) in self.pages for folder in path.parents)
                    or self._named(self.scripts, path))
        return (name in self.pages or self._named(self.scripts, path)
                or self._named(self.strings, path) or self._belongs_to_source(path))

    @staticmethod
    def _is_word(texts: dict[str, set[str]], name: str, *words: str) -> bool:
        return any(word in found for user, found in texts.items() if user != name for word in words)

    @staticmethod
    def _named(texts: dict[str, set[str]], path: pathlib.PurePosixPath,
               stems: bool = False) -> bool:
        """Whether a text names the file: by its path, from the root or from the text's own folder,
        by the last parts of it, two at least, or by a pattern; with `stems` also by its name
        without the ending, in the same folder."""
        whole = str(path)
        tails = {whole, *_tails(whole)} - {path.name}
        module = whole.removesuffix(".py").replace("/", ".")  # python3 -m tools.lint
        for user, words in texts.items():
            if user == whole:
                continue
            folder = "" if "/" not in user else user.rpartition("/")[0] + "/"
            here = whole.removeprefix(folder)
            wanted = tails | {here, module}
            if stems and here == path.name:
                wanted.add(path.stem)
            if not wanted.isdisjoint(words):
                return True
            if any(fnmatch.fnmatch(here, word) or fnmatch.fnmatch(whole, "*/" + word)
                   for word in words if "*" in word and "." in word):
                return True
        return False

    def _belongs_to_source(self, path: pathlib.PurePosixPath) -> bool:
        """The output that an example is compared with, and the corpus of a fuzz target."""
        beside = str(path.with_suffix(".cpp"))
        target = f"{path.parent.parent.parent}/{path.parent.name}.cpp"
        return beside in self.tree.files or (
            path.parent.parent.name == "corpus" and target in self.tree.files)
