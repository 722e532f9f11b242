"""./dev installs just what is missing, says so, and fails with a remedy.

A copy of the script runs in a folder of its own, with stand-ins for the package tools that log how
they were called.
"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
TOOLS = ("bash", "cat", "cksum", "date", "dirname", "env", "grep", "mkdir", "nproc", "sed", "tail",
         "touch", "wc")


class Dev(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        shutil.copy(ROOT / "dev", self.folder / "dev")
        shutil.copy(ROOT / "CMakePresets.json", self.folder / "CMakePresets.json")
        self.bin = self.folder / "bin"
        self.bin.mkdir()
        for tool in TOOLS:
            (self.bin / tool).symlink_to(shutil.which(tool))

    def stand_in(self, name: str, body: str):
        path = self.bin / name
        path.write_text(f'#!/usr/bin/env bash\necho "{name} $*" >>"{self.folder}/calls"\n{body}\n')
        path.chmod(0o755)

    def stand_in_packages(self, installed: str, apt_get: str):
        self.stand_in("dpkg-query", f"echo '{installed}' | tr ' ' '\\n' | sed 's/^/installed /'")
        (self.bin / "tr").symlink_to(shutil.which("tr"))
        self.stand_in("apt-get", f"echo {{env:$DEBIAN_FRONTEND}} >>{self.folder}/calls; {apt_get}")
        self.stand_in("sudo", '"$@"')

    def dev(self, *arguments: str) -> subprocess.CompletedProcess:
        environment = {key: value for key, value in os.environ.items()
                       if not key.startswith("HARPOON_")}
        return subprocess.run(["bash", self.folder / "dev", *arguments], capture_output=True,
                              text=True, check=False, env={**environment, "PATH": str(self.bin)})

    def calls(self) -> list[str]:
        path = self.folder / "calls"
        return path.read_text().splitlines() if path.exists() else []

    def test_help_names_every_command(self):
        result = self.dev("help")
        self.assertEqual(result.returncode, 0)
        commands = re.findall(r"^command_(\w+)\(\)", (ROOT / "dev").read_text(), re.MULTILINE)
        self.assertGreaterEqual(len(commands), 8)
        for command in commands:
            self.assertRegex(result.stdout, rf"(?m)^  {command}\b")

    def test_an_unknown_command_is_refused(self):
        result = self.dev("tset")
        self.assertEqual(result.returncode, 2)
        self.assertIn("usage:", result.stderr)

    def test_without_apt_it_names_the_packages(self):
        result = self.dev("build")
        self.assertEqual(result.returncode, 1)
        self.assertIn("not a Debian system", result.stderr)
        self.assertIn("libhwy-dev", result.stderr)
        self.assertIn("HARPOON_SKIP_PACKAGES=1", result.stderr)

    def test_it_installs_what_is_missing_and_says_so(self):
        self.stand_in_packages("g++ cmake ninja-build pkg-config libfmt-dev", "exit 0")
        result = self.dev("build")
        missing = ("libhwy-dev libtbb-dev libcli11-dev nlohmann-json3-dev libode-dev verilator "
                   "make")
        self.assertIn(f"installing from Debian's packages (log: build/packages.log): {missing}",
                      result.stdout)
        updates = [call for call in self.calls() if re.search(r"apt-get .*\bupdate\b", call)]
        installs = [call for call in self.calls() if re.search(r"apt-get .*\binstall\b", call)]
        self.assertEqual(len(updates), 1)
        self.assertEqual(len(installs), 1)
        self.assertIn("-y", installs[0])
        self.assertTrue(installs[0].endswith(f"install --no-install-recommends {missing}"))
        self.assertEqual(self.calls().count("{env:noninteractive}"), 2)

    def test_it_leaves_a_complete_machine_alone(self):
        everything = re.search(r"packages=\((.*?)\n\)", (ROOT / "dev").read_text(), re.DOTALL)[1]
        self.stand_in_packages(" ".join(re.sub(r"\[\w+\]=|'", " ", everything).split()), "exit 0")
        result = self.dev("build")
        self.assertNotIn("installing", result.stdout)
        self.assertEqual([call for call in self.calls() if call.startswith("apt-get")], [])

    def test_a_failed_installation_shows_why(self):
        self.stand_in_packages("g++", "echo no space left; exit 100")
        result = self.dev("build")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no space left", result.stderr)
        self.assertIn("apt-get could not install: cmake", result.stderr)

    def test_a_command_from_elsewhere_satisfies_a_package(self):
        text = (ROOT / "dev").read_text()
        self.assertIn("nodejs=node", text)
        self.stand_in_packages("", "exit 100")
        with_node = (self.folder / "dev")
        with_node.write_text(text.replace("[core]='", "[core]='nodejs=node "))
        self.assertIn("nodejs", self.dev("build").stdout)
        self.stand_in("node", "exit 0")
        self.assertNotIn("nodejs", self.dev("build").stdout)


if __name__ == "__main__":
    unittest.main()
