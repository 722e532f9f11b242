"""What the drop-in costs whole programs, in instructions counted by callgrind.

    python3 cost_test.py PROGRAM DROP_IN [NAME...]

PROGRAM is ode_cost_program, DROP_IN the library to be preloaded. Runs each subject twice, prints
the ratio of all instructions of the process, start to end, and fails where the drop-in takes more
than 1.02 of stock's. Numbers of instructions depend on no other process.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

LIMIT = 1.02

# Name, space, geoms, steps: the programs and worlds of `bench ode`, and sizes near each of the
# drop-in's thresholds.
SUBJECTS = [
    ("diamond10", "-", 0, 12), ("pile", "-", 400, 40), ("sleeping", "-", 1000, 60),
    ("planner", "-", 0, 150), ("clutter", "-", 0, 20),
    *(("packed", space, geoms, steps) for space in ("simple", "hash", "sap", "quadtree")
      for geoms, steps in ((42, 400), (1000, 30))),
    *(("packed", "sap", geoms, 400) for geoms in (32, 33, 40, 48, 56, 64, 80, 128)),
    *(("packed", "hash", geoms, 400) for geoms in (8, 16, 32)),
    *(("packed", "simple", geoms, 100) for geoms in (160, 200)),
    ("gas", "hash", 2000, 20), ("gas", "sap", 2000, 20), ("mixed", "hash", 1000, 10),
    ("mixed", "sap", 1000, 10), ("asleep", "sap", 2000, 20), ("asleep", "quadtree", 1000, 20),
    ("chain", "sap", 50000, 12), ("chain", "sap", 1000, 60), ("chain", "hash", 2000, 30),
    ("fallen", "sap", 10000, 12), ("fallen", "sap", 700, 60), ("fallen", "hash", 2000, 20),
    ("fallen", "simple", 300, 40),
    *(("cars", space, geoms, 60) for space in ("sap", "hash", "simple") for geoms in (200, 1000)),
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
    for subject in SUBJECTS:
        title = " ".join(map(str, subject[:3]))
        if names and not any(re.fullmatch(name, title) for name in names):
            continue
        stock, expected = count(program, subject, None)
        ours, printed = count(program, subject, drop_in)
        ratio = ours / stock
        print(f"{title}: {stock / 1e6:.0f} M instructions, with the drop-in {ratio:.3f} of them",
              flush=True)
        if ratio > LIMIT or printed != expected:
            failed.append(title)
    for title in failed:
        print(f"FAILED: {title}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
