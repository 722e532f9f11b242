"""Line coverage of the RTL by its tests: runs them on models built to tell, prints, and judges.

    coverage.py --unreachable FILE --folder FOLDER PROGRAM[=GTEST_FILTER] ...

Every program writes what it reached into FOLDER (Verilator's coverage points of --coverage-line). A
point is a branch or a block; it counts for the line that it begins on, in whichever module instance
and parameter set. Prints a line for every file and the sum. Fails when a point was not reached,
unless FILE names it: "path:line text: reason", text being what stands on that line; also fails when
FILE names a line that was reached or that reads differently.
"""

import argparse
import collections
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORD = re.compile(r"^C '([^']*)' (\d+)$", re.M)
Point = tuple[str, int, str]   # file below rtl/, line, sort of branch


def run(program: str) -> bool:
    command, _, chosen = program.partition("=")
    options = [f"--gtest_filter={chosen}"] if chosen else []
    result = subprocess.run([command, "--gtest_brief=1", *options], capture_output=True, text=True,
                            check=False)
    if result.returncode != 0:
        print(f"{command} failed:\n{result.stdout[-3000:]}{result.stderr[-2000:]}")
    return result.returncode == 0


def reached(folder: pathlib.Path) -> dict[Point, int]:
    """How often each point was reached, summed over files, instances and parameter sets."""
    points: dict[Point, int] = collections.Counter()
    for file in sorted(folder.rglob("*.dat")):
        for key, count in RECORD.findall(file.read_text(errors="replace")):
            fields = dict(part.split("\x02", 1) for part in key.split("\x01") if "\x02" in part)
            path = pathlib.PurePath(fields["f"])
            if "rtl" not in path.parts and not path.parent.name.endswith("_rtl"):
                continue
            name = source_of(path)
            if name is not None:
                points[name, int(fields["l"]), fields.get("o", "")] += int(count)
    return points


def source_of(path: pathlib.PurePath) -> str | None:
    """The file below rtl/ that a model was made from; None for a test's own top."""
    found = sorted((ROOT / "rtl").rglob(path.name))
    return str(found[0].relative_to(ROOT)) if found else None


def known_unreachable(file: pathlib.Path) -> dict[tuple[str, int], str]:
    """By file and line; a line that reads differently than the list says is an error."""
    known = {}
    for entry in file.read_text().splitlines():
        if not entry or entry.startswith("#"):
            continue
        match = re.fullmatch(r"(\S+):(\d+) `(.*)`: (.+)", entry)
        if not match:
            raise SystemExit(f"coverage: cannot read {entry!r} in {file}")
        path, line, text, _ = match.groups()
        actual = (ROOT / path).read_text().splitlines()[int(line) - 1].strip()
        if actual != text:
            raise SystemExit(f"coverage: {path}:{line} reads {actual!r}, {file.name} says {text!r}")
        known[path, int(line)] = entry
    return known


def judge(points: dict[Point, int], known: dict[tuple[str, int], str]) -> bool:
    by_file: dict[str, list[int]] = collections.defaultdict(lambda: [0, 0, 0])
    good = True
    missed_known = set()
    for (path, line, sort), count in sorted(points.items()):
        sums = by_file[path]
        if count == 0 and (path, line) in known:
            sums[2] += 1
            missed_known.add((path, line))
            continue
        sums[0] += count != 0
        sums[1] += 1
        if count == 0:
            text = (ROOT / path).read_text().splitlines()[line - 1].strip()
            print(f"NOT REACHED  {path}:{line} `{text}` ({sort})")
            good = False
    for place in sorted(set(known) - missed_known):
        print(f"REACHED      {place[0]}:{place[1]}, listed as unreachable")
        good = False
    for path, (hit, reachable, unreachable) in sorted(by_file.items()):
        print(f"{path:36} {hit:4} of {reachable:4}" +
              (f", {unreachable} unreachable" if unreachable else ""))
    hit, reachable, unreachable = (sum(column) for column in zip(*by_file.values()))
    print(f"RTL: {hit} of {reachable} reachable points reached, {100 * hit / reachable:.1f} %; "
          f"{unreachable} unreachable, each with its reason")
    for entry in known.values():
        print(f"unreachable  {entry}")
    return good


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--unreachable", type=pathlib.Path, required=True)
    parser.add_argument("--folder", type=pathlib.Path, required=True)
    parser.add_argument("programs", nargs="+")
    arguments = parser.parse_args()
    shutil.rmtree(arguments.folder, ignore_errors=True)
    arguments.folder.mkdir(parents=True)
    good = all([run(program) for program in arguments.programs])
    points = reached(arguments.folder)
    if not points:
        print("coverage: no program wrote anything")
        return 1
    good &= judge(points, known_unreachable(arguments.unreachable))
    expected = {str(file.relative_to(ROOT)) for file in (ROOT / "rtl").rglob("*.sv")
                if re.search(r"^ *always", file.read_text(), re.M)}
    for name in sorted(expected - {path for path, _, _ in points}):
        print(f"NOT BUILT    {name}: no model of it was run")
        good = False
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
