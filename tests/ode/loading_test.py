"""Which libode libharpoon_ode finds, whether it hears of changes, and what it does not do.

    python3 loading_test.py FOLDER_OF_LIBRARIES FOLDER_OF_PROGRAMS

Programs to which Harpoon is unknown run with stock libode and with the preload, for many builds of
libode: see variants/libode_variants.py.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).with_name("variants")))
import libode_variants  # noqa: E402

LIBRARIES, PROGRAMS = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
PRELOAD = LIBRARIES / "libharpoon_ode.so"
HOST = PROGRAMS / "ode_loading_host"
WORLD, SMALL_WORLD, FOREIGN, FAILING_NEW = (
    PROGRAMS / f"ode_loading_{name}.so"
    for name in ("world", "small_world", "foreign", "failing_new"))
LIBODE = libode_variants.installed_libode()
DEAF = "does not tell of every change"
# What small_world needs in order to be loaded at all.
NEEDED = {"dInitODE2", "dHashSpaceCreate", "dCreateSphere", "dGeomSetPosition", "dSpaceCollide",
          "dSpaceDestroy", "dCloseODE"}
EXPORTS = subprocess.run(["nm", "-D", PRELOAD], check=True, capture_output=True, text=True).stdout
INTERPOSED = set(re.findall(r" T (d[A-Z]\w+)", EXPORTS))


def run(words, preload=PRELOAD, prefix=(), cwd=None, **variables):
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("HARPOON_", "LD_"))}
    environment.update(HARPOON_MIN_GEOMS="12", HARPOON_STATS="1")
    environment.update(variables)
    if preload:
        environment["LD_PRELOAD"] = str(preload)
    return subprocess.run([*map(str, prefix), *map(str, words)], env=environment, check=False,
                          capture_output=True, text=True, cwd=cwd, timeout=300)


class Loading(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def variant(self, *words, folder="variant", file="libode.so.8"):
        """A folder with a variant of libode."""
        target = self.folder / folder
        target.mkdir(exist_ok=True)
        libode_variants.make(LIBODE, words[0], target / file, words[1:])
        return target

    def compare(self, folder, modules=(WORLD,)):
        """Runs stock and Harpoon; what Harpoon said."""
        stock = run([HOST, *modules], preload=None, LD_LIBRARY_PATH=str(folder))
        ours = run([HOST, *modules], LD_LIBRARY_PATH=str(folder))
        self.assertEqual((stock.returncode, stock.stderr), (0, ""), stock.stdout)
        self.assertEqual((ours.returncode, ours.stdout), (0, stock.stdout), ours.stderr)
        return ours.stderr

    def test_debians_libode_tells_of_every_change(self):
        said = self.compare(self.variant("copy"))
        self.assertNotIn(DEAF, said)
        self.assertRegex(said, r"[1-9]\d* searched, [1-9]\d* updated")

    def test_one_that_is_bound_to_itself_is_read_in_every_call(self):
        said = self.compare(self.variant("symbolic"))
        self.assertEqual(said.count(DEAF), 1, said)
        self.assertRegex(said, r"[1-9]\d* searched, 0 updated, 0 unchanged")
        self.assertIn("changes are not reported by this libode", said)

    def test_each_function_that_it_may_call_directly_is_noticed(self):
        library = libode_variants.Library(LIBODE)
        direct = [name for name in INTERPOSED if library.callers(name)]
        self.assertGreaterEqual(set(direct), {"dGeomMoved", "dSpaceAdd", "dSpaceRemove",
                                              "dGeomDestroy", "dGeomSetBody"})
        for name in direct:
            with self.subTest(name):
                said = self.compare(self.variant("direct", name))
                if name not in ("dCollide", "dSpaceCollide", "dSpaceCollide2"):
                    self.assertIn(DEAF, said)

    def test_each_place_where_a_move_may_be_inlined_is_noticed_or_does_not_matter(self):
        places = libode_variants.Library(LIBODE).callers("dGeomMoved")
        self.assertGreater(len(places), 20)
        deaf = []
        for place in places:
            with self.subTest(place):
                said = self.compare(self.variant("inlined", place, "dGeomMoved"))
                if DEAF in said:
                    deaf.append(place)
        # Adding and removing are told of by themselves; a heightfield moves its own triangles.
        self.assertEqual(sorted(set(places) - set(deaf)),
                         [place for place in places if "dxSpace" in place or "eightfield" in place])

    def test_a_renamed_private_one_is_served(self):
        folder = self.variant("renamed", "libodX.so.8", file="libode-3a7c21de.so.8")
        (folder / "libodX.so.8").symlink_to("libode-3a7c21de.so.8")
        said = self.compare(folder, [self.module_for("libodX.so.8")])
        self.assertRegex(said, r"[1-9]\d* searched")

    def module_for(self, name, source=WORLD):
        """The module, linked to a libode of that name."""
        target = self.folder / f"{source.stem}-{name}.module"
        data = bytearray(source.read_bytes())
        libode_variants.rename(data, "libode.so.8", name)
        target.write_bytes(data)
        return target

    def test_each_of_several_has_an_engine_of_its_own(self):
        names = [f"libod{k}.so.8" for k in range(6)]
        kinds = ["copy", "symbolic", "unlocked", "copy", "copy", "copy"]
        for name, kind in zip(names, kinds):
            target = self.variant(kind, file=name) / name
            data = bytearray(target.read_bytes())
            libode_variants.rename(data, "libode.so.8", name)
            target.write_bytes(data)
        said = self.compare(self.folder / "variant", [self.module_for(name) for name in names])
        self.assertEqual(len(re.findall(r"[1-9]\d* searched", said)), 4, said)
        self.assertEqual(said.count(DEAF), 1, said)
        self.assertEqual(said.count("one libode too many"), 2, said)

    def test_without_a_function_it_is_left_to_itself_and_the_program_goes_on(self):
        source = (pathlib.Path(__file__).parents[2] / "src/ode/libode.hpp").read_text()
        called = set(re.findall(r'take\("(d\w+)"', source))
        self.assertGreater(len(called), 20)
        for name in sorted((called | INTERPOSED) - NEEDED):
            with self.subTest(name):
                said = self.compare(self.variant("hidden", name), [SMALL_WORLD])
                self.assertNotIn("calls do nothing", said)
                if name in called:
                    self.assertIn(f"has no {name}", said)

    def test_what_it_lacks_does_nothing_when_it_is_called(self):
        for name in ("dSpaceCollide", "dCloseODE"):
            with self.subTest(name):
                folder = self.variant("hidden", name)
                done = run([HOST, SMALL_WORLD], LD_LIBRARY_PATH=str(folder))
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(f"has no {name}; its calls do nothing", done.stderr)

    def test_folders_are_those_of_the_start(self):
        ours, foreign = self.folder / "ours", self.folder / "foreign"
        ours.mkdir()
        foreign.mkdir()
        for name in ("libharpoon_ode.so", "libharpoon_ode_engine.so"):
            shutil.copy(LIBRARIES / name, ours)
            shutil.copy(FOREIGN, foreign / name)
        for device in ("afu", "abacus"):
            shutil.copy(FOREIGN, foreign / f"libharpoon_device_{device}.so")
        for preload in ("./libharpoon_ode.so", "../ours/libharpoon_ode.so", "libharpoon_ode.so"):
            for device in ("afu", "abacus"):
                with self.subTest(preload=preload, device=device):
                    done = run([HOST, "--folder", foreign, SMALL_WORLD], preload=preload, cwd=ours,
                               HARPOON_DEVICE=device, LD_LIBRARY_PATH=".")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertNotIn("foreign", done.stdout)
                    self.assertIn(f'no device "{device}"', done.stderr)
                    self.assertRegex(done.stderr, r"240 searched|[1-9]\d* updated")

    def test_without_its_engine_the_program_runs_as_stock(self):
        shutil.copy(PRELOAD, self.folder)
        stock = run([HOST, WORLD], preload=None)
        done = run([HOST, WORLD], preload=self.folder / PRELOAD.name)
        self.assertEqual((done.returncode, done.stdout), (0, stock.stdout))
        self.assertEqual(done.stderr.count("harpoon does nothing"), 1, done.stderr)

    def test_a_process_without_ode_loads_nothing_else(self):
        needed = subprocess.run(["readelf", "-dW", PRELOAD], check=True, capture_output=True,
                                text=True).stdout
        self.assertEqual(re.findall(r"NEEDED.*\[(.*)\]", needed), ["libc.so.6"])
        maps = run(["/bin/cat", "/proc/self/maps"], HARPOON_STATS="0").stdout
        self.assertIn(PRELOAD.name, maps)
        for library in ("libharpoon_ode_engine", "libharpoon.so", "libtbb", "libfmt", "libstdc++"):
            self.assertNotIn(library, maps)

    @unittest.skipUnless(shutil.which("valgrind"), "valgrind is not installed")
    def test_it_runs_under_valgrind(self):
        stock = run([HOST, WORLD], preload=None)
        ours = run([HOST, WORLD], prefix=["valgrind", "-q", "--error-exitcode=9"])
        self.assertEqual((ours.returncode, ours.stdout), (0, stock.stdout), ours.stderr)
        self.assertRegex(ours.stderr, r"[1-9]\d* searched, [1-9]\d* updated")

    def test_an_allocation_that_fails_leaves_the_call_to_libode(self):
        stock = run([HOST, SMALL_WORLD], preload=None).stdout
        failed = 0
        for always in ({}, {"FAIL_ALWAYS": "1"}):
            for number in range(0, 48, 2) if always else range(1, 48, 2):
                with self.subTest(number=number, always=bool(always)):
                    done = run([HOST, SMALL_WORLD], preload=f"{PRELOAD}:{FAILING_NEW}",
                               HARPOON_STATS="0", FAIL_AT=str(number), **always)
                    self.assertEqual((done.returncode, done.stdout), (0, stock), done.stderr)
                    failed += "out of memory" in done.stderr
        self.assertGreater(failed, 10)

    def test_silence_is_broken_where_no_call_arrives(self):
        for option in ("HARPOON_STATS", "HARPOON_VERIFY"):
            for words in ([HOST, "--deepbind", WORLD], [HOST, "--deepbind", "--underscore-exit",
                                                        WORLD], [HOST]):
                with self.subTest(option=option, words=words):
                    settings = {"HARPOON_STATS": "0", option: "1"}
                    done = run(words, **settings)
                    self.assertEqual(done.returncode, 0)
                    self.assertEqual(done.stderr.count("no call of ODE arrived"), 1, done.stderr)
        self.assertEqual(run([HOST], HARPOON_STATS="0").stderr, "")

    def test_the_line_of_statistics_is_written_once_however_the_process_ends(self):
        for words in ([HOST, WORLD], [HOST, "--underscore-exit", WORLD]):
            done = run(words)
            self.assertEqual(done.stderr.count("searched"), 1, done.stderr)


if __name__ == "__main__":
    unittest.main()
