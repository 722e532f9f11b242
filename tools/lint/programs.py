"""Rules that other programs judge: clang-format, shellcheck, the compilers, clang-tidy, Verilator.
Versions are those of Debian 12, so that every machine says the same."""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess

from tools.lint.tree import CPP, Tree, Violation

JOBS = int(os.environ.get("HARPOON_JOBS", 0)) or os.cpu_count() or 1
DIAGNOSTIC = re.compile(r"^(.+?):(\d+):\d+: (?:fatal )?(?:error|warning): (.*)$")


def _run(command: list[str], root: pathlib.Path, **options) -> subprocess.CompletedProcess:
    return subprocess.run(command, cwd=root, capture_output=True, text=True, check=False, **options)


def _all(work, items):
    """Runs work on every item, JOBS at a time, and yields what each run returned."""
    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        for found in pool.map(work, items):
            yield from found


def _diagnostics(tree: Tree, rule: str, name: str, result: subprocess.CompletedProcess):
    """The violations in a compiler's output; the whole output when it failed without any."""
    found = []
    for line in (result.stdout + result.stderr).splitlines():
        if match := DIAGNOSTIC.match(line):
            path = pathlib.Path(match[1])
            absolute = (tree.root / path).resolve()
            inside = absolute.is_relative_to(tree.root.resolve())
            shown = str(absolute.relative_to(tree.root.resolve())) if inside else match[1]
            found.append(Violation(shown, int(match[2]), rule, match[3]))
    if result.returncode != 0 and not found:
        found.append(Violation(name, 0, rule, (result.stdout + result.stderr).strip()[:2000]))
    return found


def formatting(tree: Tree):
    """clang-format 14 would change nothing."""
    names = [name for name in tree.matching(CPP)]
    batches = [names[first : first + 16] for first in range(0, len(names), 16)]

    def work(batch):
        result = _run(["clang-format-14", "--dry-run", "--Werror", *batch], tree.root)
        return _diagnostics(tree, "formatting", batch[0], result)

    yield from _all(work, batches)


def scripts(tree: Tree):
    """shellcheck finds nothing in the shell scripts."""
    names = [
        name for name in tree.files
        if name.endswith(".sh") or re.match(r"#!.*\b(ba)?sh\b", (tree.text(name) or "")[:40])
    ]
    if names:
        result = _run(["shellcheck", "--format=gcc", *names], tree.root)
        text = result.stdout.replace(" note: ", " warning: ")
        result = subprocess.CompletedProcess(result.args, result.returncode, text, result.stderr)
        yield from _diagnostics(tree, "scripts", names[0], result)


def headers(tree: Tree):
    """Every header compiles alone: public ones with g++ and clang++, the others with clang++."""
    flags = ["-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion",
             "-Wshadow", "-Werror", "-Iinclude", "-Isrc", "-I.", "-Itests",
             "-Ibuild/release/include", "-xc++", "-"]
    public = [name for name in tree.matching((".hpp",)) if name.startswith("include/")]
    private = [name for name in tree.matching((".hpp",)) if name.startswith("src/")]
    jobs = [("g++", name) for name in public]
    jobs += [("clang++-14", name) for name in public + private]

    def work(job):
        compiler, name = job
        twice = f'#include "{name}"\n#include "{name}"\n'
        result = _run([compiler, *flags], tree.root, input=twice)
        return _diagnostics(tree, "headers", name, result)

    yield from _all(work, jobs)


TIDY_DATABASE = "build/lint"
TIDY_ROOMS = ("src/", "apps/", "bench/", "examples/", "sim/")


def tidy(tree: Tree):
    """clang-tidy 14 finds nothing in the sources of the product (.clang-tidy names the checks).

    A source that several targets compile is read once, as the first of them does: the others may
    need what only their build generates. A clean result is remembered under the user's cache folder
    by the hash of everything it depends on (checks, command, preprocessed text), so a run looks
    again only at what changed.
    """
    database = tree.root / "build/release/compile_commands.json"
    if not database.exists():
        yield Violation("build/release", 0, "tidy", "is not configured; run ./dev lint")
        return
    entries = {}
    for entry in json.loads(database.read_text()):
        path = pathlib.Path(entry["file"])
        if path.is_relative_to(tree.root):
            name = str(path.relative_to(tree.root))
            if name.startswith(TIDY_ROOMS) and name in tree.files:
                entries.setdefault(name, entry)
    chosen = tree.root / TIDY_DATABASE
    chosen.mkdir(parents=True, exist_ok=True)
    (chosen / "compile_commands.json").write_text(json.dumps(list(entries.values())))
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache")
    cache = cache / "harpoon-tidy"
    cache.mkdir(parents=True, exist_ok=True)
    yield from _all(lambda item: _tidy_one(tree, cache, *item), sorted(entries.items()))


def _tidy_one(tree: Tree, cache: pathlib.Path, name: str, entry: dict):
    remembered = cache / _tidy_key(tree, entry)
    if remembered.exists():
        return []
    command = ["clang-tidy-14", "--quiet", "-p", TIDY_DATABASE, name]
    found = _diagnostics(tree, "tidy", name, _run(command, tree.root))
    if not found:
        remembered.touch()
    return found


def _tidy_key(tree: Tree, entry: dict) -> str:
    arguments = [word for word in shlex.split(entry["command"]) if not word.endswith("ccache")]
    while arguments and not re.search(r"(\+\+|cc|clang)[-\d.]*$", arguments[0]):
        arguments.pop(0)
    if "-o" in arguments:
        at = arguments.index("-o")
        del arguments[at : at + 2]
    result = _run([*arguments, "-E"], pathlib.Path(entry["directory"]))
    root = str(tree.root)
    parts = [(tree.root / ".clang-tidy").read_text(), " ".join(arguments), result.stdout]
    if result.returncode != 0:
        parts.append(os.urandom(8).hex())
    return hashlib.sha256("\0".join(parts).replace(root, "").encode()).hexdigest()


VERILATOR_MESSAGE = re.compile(r"%\S+: (\S+?):(\d+):(?:\d+:)? (.*)")


def verilog(tree: Tree):
    """Verilator -Wall finds nothing in any module of rtl/, each read as a top of its own, with all
    packages; what is waived stands with its reason in rtl/waivers.vlt."""
    sources = [name for name in tree.matching((".sv",)) if name.startswith("rtl/")]
    if not sources:
        return
    folders = sorted({str(pathlib.PurePosixPath(name).parent) for name in sources})
    packages = [name for name in sources if name.endswith("_pkg.sv")]
    command = ["verilator", "--lint-only", "-Wall"]
    command += [word for folder in folders for word in ("-y", folder, f"-I{folder}")]
    command += [name for name in ("rtl/waivers.vlt",) if name in tree.files]

    def work(name: str):
        result = _run([*command, *packages, name], tree.root)
        if result.returncode == 0:
            return []
        lines = [line for line in result.stderr.splitlines()
                 if line.startswith("%") and "Exiting due to" not in line]
        matches = [(line, VERILATOR_MESSAGE.match(line)) for line in lines]
        return [Violation(match[1], int(match[2]), "verilog", match[3]) if match
                else Violation(name, 0, "verilog", line) for line, match in matches]

    yield from _all(work, [name for name in sources if name not in packages])
