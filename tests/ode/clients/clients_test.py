"""libharpoon_ode under a program that another library drives: with and without the preload.

    python3 clients_test.py PATH_OF_LIBHARPOON_ODE PATH_OF_PROGRAM
"""

import os
import pathlib
import re
import subprocess
import sys
import unittest

PROGRAM = pathlib.Path(sys.argv.pop(2))
LIBRARY = sys.argv.pop(1)
# Arguments, lines printed at least, calls that Harpoon must have answered at least.
CASES = {"dart_pile": (("80", "1000"), 81, 1000), "ompl_push": (("3000",), 100, 2000)}


def run(preload, **variables):
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith("HARPOON_")}
    environment.update(variables)
    if preload:
        environment["LD_PRELOAD"] = LIBRARY
    return subprocess.run([PROGRAM, *CASES[PROGRAM.name][0]], env=environment, check=False,
                          capture_output=True, text=True)


class Client(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.stock = run(preload=False)

    def test_end_states_are_equal_to_the_last_bit(self):
        _, least_lines, least_searched = CASES[PROGRAM.name]
        ours = run(preload=True, HARPOON_STATS="1")
        self.assertEqual(self.stock.returncode, 0, self.stock.stderr)
        self.assertEqual(ours.returncode, 0, ours.stderr)
        self.assertGreaterEqual(len(self.stock.stdout.splitlines()), least_lines)
        self.assertEqual(ours.stdout, self.stock.stdout)
        counts = re.search(r"(\d+) searched, .* dCollide: (\d+) from batches", ours.stderr)
        self.assertIsNotNone(counts, ours.stderr)
        searched, batched = map(int, counts.groups())
        self.assertGreaterEqual(searched, least_searched)
        self.assertGreater(batched, 1000)

    def test_verification_passes_and_says_nothing(self):
        verified = run(preload=True, HARPOON_VERIFY="1")
        self.assertEqual(verified.returncode, 0, verified.stderr)
        self.assertEqual(verified.stderr, "")
        self.assertEqual(verified.stdout, self.stock.stdout)

    def test_the_states_tell_other_contacts(self):
        other = run(preload=True, HARPOON_PRECISION="f32")
        self.assertEqual(other.returncode, 0, other.stderr)
        self.assertNotEqual(other.stdout, self.stock.stdout)


if __name__ == "__main__":
    unittest.main()
