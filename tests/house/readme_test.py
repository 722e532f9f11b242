"""The README does what it says.

Its blocks are run in order, in one shell that starts at the root of the checkout with an empty home
folder: console blocks as they stand, C++ blocks by writing the file that the text names before
them. What a console block shows after a command must be what the command prints. A comment
before a block may name a shorter form to run in its place (the same command with more options), and
`./dev test`, which runs this test, is not run again.
"""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

BLOCK = re.compile(r"(?:<!-- (run [^\n]*?) -->\n)?```(\w+)\n(.*?)```\n", re.DOTALL)
FILE_NAME = re.compile(r"`([\w.]+\.cpp)`")
THIS_RUN = "run by: ./dev test, which runs this very check"
END = "--- end of command ---"


def blocks():
    """(mark, language, text, text before) for every fenced block of the README."""
    readme = (ROOT / "README.md").read_text()
    return [(m[1], m[2], m[3], readme[: m.start()]) for m in BLOCK.finditer(readme)]


def steps(text: str):
    """(command, expected output) for every `$ ` line of a console block."""
    parts = re.split(r"^\$ ", text, flags=re.MULTILINE)
    if parts[0].strip():
        raise AssertionError(f"a console block starts with a command, not with {parts[0]!r}")
    return [tuple(part.split("\n", 1)) for part in parts[1:]]


class Readme(unittest.TestCase):
    def test_commands_and_programs(self):
        script, expected = ["set -e"], []
        for mark, language, text, before in blocks():
            if language == "cpp":
                name = FILE_NAME.findall(before)[-1]
                script.append(f"cat >{name} <<'{END}'\n{text}{END}")
            elif language == "console" and mark != THIS_RUN:
                for command, output in steps(text):
                    if mark:
                        self.assertTrue(mark.startswith(f"run as: {command} "), mark)
                        command = mark.removeprefix("run as: ")
                    script += [command, f"echo '{END}'"]
                    expected.append((command, output))
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "HOME": folder, "HARPOON_SKIP_PACKAGES": "1"}
            result = subprocess.run(["bash", "-c", "\n".join(script)], cwd=ROOT, env=environment,
                                    capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        outputs = result.stdout.split(END + "\n")
        self.assertGreaterEqual(len(expected), 6)
        self.assertEqual(len(outputs), len(expected) + 1)
        for (command, shown), printed in zip(expected, outputs):
            if shown:
                self.assertEqual(printed, shown, command)

    def test_only_this_run_is_left_out(self):
        left_out = [text for mark, _, text, _ in blocks() if mark == THIS_RUN]
        self.assertEqual(left_out, ["$ ./dev test\n"])

    def test_links_lead_somewhere(self):
        readme = (ROOT / "README.md").read_text()
        for target in re.findall(r"\]\(([^)#]+)\)", readme):
            if "://" not in target:
                self.assertTrue((ROOT / target).exists(), target)


if __name__ == "__main__":
    unittest.main()
