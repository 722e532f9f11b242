"""libharpoon_ode under a real program: python3-pyode runs a pile with and without the preload.

    python3 preload_test.py PATH_OF_LIBHARPOON_ODE
"""

import os
import pathlib
import re
import subprocess
import sys
import unittest

LIBRARY = sys.argv.pop(1)
PILE = pathlib.Path(__file__).with_name("pyode_pile.py")
KINDS = ("simple", "hash", "quadtree")  # pyode has no sweep-and-prune spaces
PYTHON = "/usr/bin/python3"  # the one that Debian's modules are for


def run(kind, preload, **variables):
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith("HARPOON_")}
    environment.update(variables)
    if preload:
        environment["LD_PRELOAD"] = LIBRARY
    return subprocess.run([PYTHON, PILE, kind, "120", "150"], env=environment, check=False,
                          capture_output=True, text=True)


class Preload(unittest.TestCase):
    def test_end_states_are_equal_to_the_last_bit(self):
        for kind in KINDS:
            with self.subTest(kind):
                stock = run(kind, preload=False)
                ours = run(kind, preload=True, HARPOON_STATS="1", HARPOON_MIN_GEOMS="12")
                self.assertEqual(stock.returncode, 0, stock.stderr)
                self.assertEqual(ours.returncode, 0, ours.stderr)
                self.assertEqual(len(stock.stdout.splitlines()), 120)
                self.assertEqual(ours.stdout, stock.stdout)
                counts = re.search(r"(\d+) searched, .* (\d+) left to libode", ours.stderr)
                self.assertIsNotNone(counts, ours.stderr)
                searched, left = map(int, counts.groups())
                self.assertGreater(left if kind == "quadtree" else searched, 100)

    def test_verification_passes_and_says_nothing(self):
        for kind in KINDS:
            with self.subTest(kind):
                verified = run(kind, preload=True, HARPOON_VERIFY="1")
                self.assertEqual(verified.returncode, 0, verified.stderr)
                self.assertEqual(verified.stderr, "")

    def test_wrong_options_are_named_and_the_program_runs_as_stock(self):
        wrong = run("hash", preload=True, HARPOON_ODE="fastest")
        self.assertEqual(wrong.returncode, 0)
        self.assertIn("HARPOON_ODE=fastest", wrong.stderr)
        self.assertEqual(wrong.stdout, run("hash", preload=False).stdout)

    def test_programs_without_ode_do_not_notice(self):
        done = subprocess.run(["/bin/echo", "hello"], env={"LD_PRELOAD": LIBRARY}, check=False,
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "hello\n", ""))


if __name__ == "__main__":
    unittest.main()
