"""An installed Harpoon is all that a program needs.

    install_test.py shared|static BUILD_FOLDER

Installs the library into a fresh folder (shared: the build under test; static: a build of its own
with the same flags, so that ccache has the objects), then builds the programs of examples/ against
that folder alone, once through find_package and once through pkg-config, runs them and compares
what they print with examples/*.txt. The installed folder is moved first: nothing in it may depend
on where it was made.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
KIND, BUILD = sys.argv[1], pathlib.Path(sys.argv[2])
WORK = BUILD / f"install-test-{KIND}"
PREFIX = WORK / "moved"
EXAMPLES = sorted(path.stem for path in (ROOT / "examples").glob("*.cpp"))


def run(*command, **options) -> str:
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                            check=False, **options)
    if result.returncode != 0:
        raise AssertionError(f"{command} gave {result.returncode}:\n{result.stdout}{result.stderr}")
    return result.stdout


def cached(name: str) -> str:
    """A setting of the build under test."""
    match = re.search(rf"^{name}:\w+=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.MULTILINE)
    return match[1] if match else ""


def build_static() -> pathlib.Path:
    # As deep as BUILD, because ccache hashes paths relative to the folder.
    folder = BUILD.with_name(BUILD.name + "-static")
    run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DBUILD_SHARED_LIBS=OFF",
        "-DBUILD_TESTING=OFF", "-DHARPOON_APPS=OFF",
        *(f"-D{name}={cached(name)}" for name in (
            "CMAKE_CXX_COMPILER", "CMAKE_BUILD_TYPE", "CMAKE_CXX_FLAGS_RELWITHDEBINFO",
            "HARPOON_WERROR")))
    run("cmake", "--build", folder)
    return folder


class InstalledPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        folder = BUILD if KIND == "shared" else build_static()
        run("cmake", "--install", folder, "--prefix", WORK / "made")
        shutil.move(WORK / "made", PREFIX)
        cls.libraries = next(PREFIX.glob("lib*/**/pkgconfig")).parent

    def check_output(self, program: pathlib.Path):
        expected = (ROOT / "examples" / f"{program.name}.txt").read_text()
        environment = {**os.environ, "LD_LIBRARY_PATH": str(self.libraries)}
        self.assertEqual(run(program, env=environment), expected)

    def test_there_are_examples(self):
        self.assertGreaterEqual(len(EXAMPLES), 2)

    def test_find_package(self):
        run("cmake", "-S", ROOT / "examples", "-B", WORK / "examples", "-G", "Ninja",
            f"-DCMAKE_PREFIX_PATH={PREFIX}")
        run("cmake", "--build", WORK / "examples")
        for example in EXAMPLES:
            self.check_output(WORK / "examples" / example)

    def test_the_drop_in_finds_its_engine(self):
        command = PREFIX / "bin" / "harpoon"
        if not command.exists():
            self.skipTest("this build has no command")
        run(command, "run", "--require", "--", command, "diamond", "--steps", "2", "--out",
            WORK / "diamond")

    def test_version_is_checked(self):
        folder = WORK / "too_new"
        folder.mkdir()
        (folder / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(x LANGUAGES CXX)\n"
            "find_package(harpoon 99.0 REQUIRED)\n")
        with self.assertRaisesRegex(AssertionError, "compatible with requested version"):
            run("cmake", "-S", folder, "-B", folder / "build", f"-DCMAKE_PREFIX_PATH={PREFIX}")

    def test_pkg_config(self):
        environment = {**os.environ, "PKG_CONFIG_PATH": str(self.libraries / "pkgconfig")}
        flags = run("pkg-config", "--cflags", "--libs", "harpoon", env=environment).split()
        version = run("pkg-config", "--modversion", "harpoon", env=environment).strip()
        self.assertEqual(version, cached("CMAKE_PROJECT_VERSION"))
        for example in EXAMPLES:
            program = WORK / "pkg-config" / example
            program.parent.mkdir(exist_ok=True)
            source = ROOT / "examples" / f"{example}.cpp"
            run("c++", "-std=c++20", "-Wall", "-Wextra", "-Werror", "-o", program, source, *flags)
            self.check_output(program)

    @unittest.skipIf(KIND == "static", "the command is installed with the shared library")
    def test_command_and_its_texts(self):
        version = run(PREFIX / "bin/harpoon", "--version", env={})
        self.assertIn(cached("CMAKE_PROJECT_VERSION"), version)
        self.assertIn("harpoon", (PREFIX / "share/man/man1/harpoon.1").read_text())
        self.assertTrue((PREFIX / "share/bash-completion/completions/harpoon").exists())

    def test_no_file_names_the_source_or_build_tree(self):
        for path in PREFIX.rglob("*"):
            if path.suffix in (".cmake", ".pc", ".hpp") and path.is_file():
                self.assertNotIn(str(ROOT), path.read_text(), path)

    @unittest.skipIf(KIND == "static", "a static library exports everything")
    def test_only_the_interface_is_exported(self):
        symbols = run("nm", "-DC", "--defined-only", self.libraries / "libharpoon.so")
        ours = [line.split(" ", 2)[2] for line in symbols.splitlines() if "harpoon" in line]
        self.assertTrue(any("harpoon::collide(" in symbol for symbol in ours))
        hidden = [symbol for symbol in ours if "harpoon::colliders" in symbol]
        self.assertEqual(hidden, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
