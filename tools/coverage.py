"""Line coverage of src/ and include/ by the tests that have run in an instrumented build.

    python3 -m tools.coverage BUILD_FOLDER [--lines]

Reads gcov's JSON for every object of the library and merges the lines, so that a header compiled
into several objects, or a kernel compiled once per instruction set, counts a line once. Prints a
row per file and the total; --lines names the lines that were not reached. It sets no threshold.
"""

import collections
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROOMS = ("src/", "include/")


def counts_by_line(build: pathlib.Path) -> dict[str, dict[int, int]]:
    """Execution counts by file (relative to the root) and line."""
    files: dict[str, dict[int, int]] = collections.defaultdict(dict)
    data = sorted(path.resolve() for path in (build / "src").rglob("*.gcno"))
    if not data:
        sys.exit(f"coverage: no instrumented object under {build}")
    for first in range(0, len(data), 20):
        command = ["gcov", "--json-format", "--stdout", *map(str, data[first : first + 20])]
        result = subprocess.run(command, check=True, capture_output=True, text=True, cwd=build)
        for document in result.stdout.splitlines():
            for entry in json.loads(document)["files"]:
                path = (build / entry["file"]).resolve()
                if not path.is_relative_to(ROOT):
                    continue
                name = str(path.relative_to(ROOT))
                if not name.startswith(ROOMS):
                    continue
                for line in entry["lines"]:
                    number = line["line_number"]
                    files[name][number] = files[name].get(number, 0) + line["count"]
    return files


def main(arguments: list[str]) -> None:
    build = pathlib.Path(arguments[0]).resolve()
    files = counts_by_line(build)
    covered_lines = all_lines = 0
    print("line coverage of src and include")
    for name, lines in sorted(files.items()):
        missed = sorted(number for number, count in lines.items() if count == 0)
        covered = len(lines) - len(missed)
        covered_lines += covered
        all_lines += len(lines)
        print(f"  {100 * covered / len(lines):5.1f} %  {covered:5d} of {len(lines):5d}  {name}")
        if missed and "--lines" in arguments:
            print("           not reached:", ", ".join(map(str, missed)))
    print(f"coverage: {100 * covered_lines / all_lines:.1f} % of {all_lines} lines")


if __name__ == "__main__":
    main(sys.argv[1:])
