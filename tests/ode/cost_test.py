"""What the drop-in costs whole programs, in instructions counted by callgrind.

    python3 cost_test.py PROGRAM DROP_IN [NAME...]

PROGRAM is ode_cost_program, DROP_IN the library to be preloaded. Runs each subject twice, prints
the ratio of all instructions of the process, start to end, and fails where the drop-in takes more
than 1.02 of stock's, or more than is said below. Instructions depend on no other process.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

LIMIT = 1.02

# Name, space, geoms, steps, limit: the programs and worlds of `bench ode`, and sizes near each of
# the drop-in's thresholds. So many steps that loading the engine, 5 M instructions, is little.
# In sweep-and-prune spaces of middling size Harpoon runs more instructions than libode, but fewer
# that processors guess wrong: it takes half the time (docs/ode.md).
MIDDLING = 1.25
SUBJECTS = [
    ("diamond10", "-", 0, 12, LIMIT), ("pile", "-", 400, 40, LIMIT),
    ("sleeping", "-", 1000, 200, LIMIT), ("planner", "-", 0, 150, LIMIT),
    ("clutter", "-", 0, 20, LIMIT),
    *(("packed", space, 42, 6000, LIMIT) for space in ("simple", "hash", "sap", "quadtree")),
    *(("packed", space, 1000, 100, LIMIT) for space in ("simple", "hash", "sap", "quadtree")),
    *(("packed", "sap", geoms, 6000, LIMIT) for geoms in (32, 33, 48, 64)),
    *(("packed", "sap", geoms, 1500, MIDDLING) for geoms in (65, 128)),
    ("packed", "sap", 500, 300, MIDDLING),
    *(("packed", "hash", geoms, 8000, LIMIT) for geoms in (8, 16, 32)),
    *(("packed", "simple", geoms, 1000, LIMIT) for geoms in (160, 200)),
    ("gas", "hash", 2000, 100, LIMIT), ("gas", "sap", 1000, 400, LIMIT),
    ("gas", "sap", 4000, 60, LIMIT), ("mixed", "hash", 1000, 60, LIMIT),
    ("mixed", "sap", 1000, 60, LIMIT), ("asleep", "sap", 2000, 100, LIMIT),
    ("asleep", "quadtree", 1000, 200, LIMIT), ("chain", "sap", 50000, 150, LIMIT),
    ("chain", "sap", 1000, 800, LIMIT), ("chain", "hash", 2000, 100, LIMIT),
    ("fallen", "sap", 10000, 30, LIMIT), ("fallen", "sap", 700, 500, MIDDLING),
    ("fallen", "hash", 2000, 100, LIMIT), ("fallen", "simple", 300, 200, LIMIT),
    *(("cars", space, 200, 8000, LIMIT) for space in ("sap", "hash", "simple")),
    ("cars", "sap", 1000, 1500, MIDDLING),
    *(("cars", space, 1000, 1500, LIMIT) for space in ("hash", "simple")),
]


def count(program, subject, preload):
    """Instructions of one run, and what it printed."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "HARPOON_STATS": "0"}
        if preload:
            environment["LD_PRELOAD"] = preload
        out = pathlib.Path(folder) / "callgrind.out"
        result = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", program,
             *map(str, subject)],
            env=environment, check=True, capture_output=True, text=True)
        return int(re.search(r"^summary: (\d+)", out.read_text(), re.MULTILINE)[1]), result.stdout


def main():
    program, drop_in, *names = sys.argv[1:]
    failed = []
    for *subject, limit in SUBJECTS:
        title = " ".join(map(str, subject[:3]))
        if names and not any(re.fullmatch(name, title) for name in names):
            continue
        stock, expected = count(program, subject, None)
        ours, printed = count(program, subject, drop_in)
        ratio = ours / stock
        print(f"{title}: {stock / 1e6:.0f} M instructions, with the drop-in {ratio:.3f} of them",
              flush=True)
        if ratio > limit or printed != expected:
            failed.append(title)
    for title in failed:
        print(f"FAILED: {title}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
