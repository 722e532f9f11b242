"""Every lint rule finds the violation it is there for, and lets its correct twin pass.

Each case is a small tree: `bad` must give exactly one kind of violation at the named file, `good`
must give none. The last test fails when a rule of the lint has no case here.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT))

from tools.lint import __main__ as lint  # noqa: E402
from tools.lint import programs, rooms, structure, text, unused  # noqa: E402
from tools.lint.tree import Tree  # noqa: E402

GUARD = "#pragma once\n"
MARKER = "TO" + "DO"
PRIVATE = "/ho" + "me/someone/x"
CLIMB = "../" * 2 + "elsewhere"


def picture_page(table: dict) -> str:
    drawing = " ".join(sorted(table))
    rows = "".join(
        f"| `{room}` | {'anything' if used == rooms.ANY else ', '.join(f'`{u}`' for u in used)} |\n"
        for room, used in table.items())
    return f"```\n{drawing}\n```\n{rows}"


def drawn_tree(table: dict) -> dict[str, str]:
    """A tree in which every room is there and every edge is used once."""
    files = {}
    for room, used in table.items():
        files[f"{room}/a.hpp"] = GUARD
        named = [] if used == rooms.ANY else sorted(used)
        files[f"{room}/b.cpp"] = "".join(f'#include "{other}/a.hpp"\n' for other in named)
    return files


DRAWN = drawn_tree(rooms.ALLOWED)
SOME_ROOM = "src/device/cpu"
SOME_EDGE = f'#include "{sorted(rooms.ALLOWED[SOME_ROOM])[0]}/a.hpp"\n'


# rule: list of (what, bad tree, file that is reported, good tree)
CASES = {
    structure.edges: [
        ("the public headers use nothing",
         {"include/harpoon/a.hpp": '#include "base/b.hpp"\n', "src/base/b.hpp": GUARD},
         "include/harpoon/a.hpp",
         {"src/base/a.hpp": '#include "harpoon/b.hpp"\n', "include/harpoon/b.hpp": GUARD}),
        ("the ODE client uses no private header",
         {"src/ode/a.cpp": '#include "device/b.hpp"\n', "src/device/b.hpp": GUARD},
         "src/ode/a.cpp",
         {"src/ode/a.cpp": '#include "harpoon/b.hpp"\n#include <ode/ode.h>\n',
          "include/harpoon/b.hpp": GUARD}),
        ("the simulation knows nothing of scenes",
         {"sim/a.cpp": '#include "scene/b.hpp"\n', "src/scene/b.hpp": GUARD},
         "sim/a.cpp",
         {"sim/a.cpp": '#include "device/afu/b.hpp"\n', "src/device/afu/b.hpp": GUARD}),
        ("an include beside the file is resolved",
         {"src/collide/a.hpp": '#include "../device/b.hpp"\n', "src/device/b.hpp": GUARD},
         "src/collide/a.hpp",
         {"src/collide/a.hpp": '#include "b.hpp"\n', "src/collide/b.hpp": GUARD}),
        ("an unknown room", {"attic/a.hpp": GUARD}, "attic/a.hpp", {"src/base/a.hpp": GUARD}),
        ("an unknown room in src", {"src/attic/a.hpp": GUARD}, "src/attic/a.hpp",
         {"src/CMakeLists.txt": "\n"}),
        ("vectors only where they belong", {"src/hls/a.cpp": "#include <hwy/highway.h>\n"},
         "src/hls/a.cpp", {"src/device/cpu/a.cpp": "#include <hwy/highway.h>\n"}),
        ("the library prints nothing", {"src/scene/a.cpp": "#include <iostream>\n"},
         "src/scene/a.cpp", {"apps/a.cpp": "#include <iostream>\n"}),
        ("a header that does not exist", {"src/scene/a.cpp": '#include "lost.hpp"\n'},
         "src/scene/a.cpp", {"src/scene/a.cpp": "#include <vector>\n"}),
    ],
    structure.naming: [
        ("src never names rtl", {"src/hls/a.cpp": "// see rt" "l/fp/fp_add.sv\n"}, "src/hls/a.cpp",
         {"src/hls/a.cpp": "// see the adder cell\n"}),
        ("rtl never names src", {"rtl/a.sv": "// from sr" "c/collide\n"}, "rtl/a.sv",
         {"rtl/a.sv": "// generated\n"}),
    ],
    structure.picture: [
        ("a row differs", {"ARCHITECTURE.md": picture_page({**rooms.ALLOWED, "rtl": {"src/ode"}})},
         "ARCHITECTURE.md", {"ARCHITECTURE.md": picture_page(rooms.ALLOWED)}),
        ("a row is missing",
         {"ARCHITECTURE.md": picture_page({k: v for k, v in rooms.ALLOWED.items() if k != "sim"})},
         "ARCHITECTURE.md", {"ARCHITECTURE.md": picture_page(rooms.ALLOWED)}),
        ("the picture leaves a room out",
         {"ARCHITECTURE.md": picture_page(rooms.ALLOWED).replace(" sim ", " ", 1)},
         "ARCHITECTURE.md", {"ARCHITECTURE.md": picture_page(rooms.ALLOWED)}),
        ("no page", {"README.md": "x\n"}, "ARCHITECTURE.md",
         {"ARCHITECTURE.md": picture_page(rooms.ALLOWED)}),
    ],
    structure.twins: [
        ("no test", {"src/base/a.cpp": "\n"}, "src/base/a.cpp",
         {"src/base/a.cpp": "\n", "tests/base/a_test.cpp": "\n"}),
        ("a waiver without a reason",
         {"src/base/a.cpp": "\n", "tests/twins.txt": "src/base/a.cpp:\n"}, "tests/twins.txt",
         {"src/base/a.cpp": "\n", "tests/twins.txt": "# why\nsrc/base/a.cpp: tested by b\n"}),
        ("a waiver for a file that is gone", {"tests/twins.txt": "src/base/a.cpp: tested by b\n"},
         "tests/twins.txt", {"tests/twins.txt": "# none\n"}),
    ],
    unused.drawn: [
        ("an edge that nothing uses",
         {**DRAWN, f"{SOME_ROOM}/b.cpp": DRAWN[f"{SOME_ROOM}/b.cpp"].replace(SOME_EDGE, "")},
         "tools/lint/rooms.py", DRAWN),
        ("an edge that only a comment names",
         {**DRAWN, f"{SOME_ROOM}/b.cpp":
          DRAWN[f"{SOME_ROOM}/b.cpp"].replace(SOME_EDGE, f"// {SOME_EDGE}")},
         "tools/lint/rooms.py", DRAWN),
        ("a room that is not there",
         {name: content for name, content in DRAWN.items() if not name.startswith("examples/")},
         "tools/lint/rooms.py", DRAWN),
        ("an edge that CMake uses",
         {**DRAWN, "sim/b.cpp": DRAWN["sim/b.cpp"].replace('#include "rtl/a.hpp"\n', "")},
         "tools/lint/rooms.py",
         {**DRAWN, "sim/b.cpp": DRAWN["sim/b.cpp"].replace('#include "rtl/a.hpp"\n', ""),
          "sim/CMakeLists.txt": "set(rtl ${PROJECT_SOURCE_DIR}/rtl)\n"}),
    ],
    unused.unused: [
        ("a header that is not included", {"src/base/a.hpp": GUARD + "// see base/a.hpp\n"},
         "src/base/a.hpp",
         {"src/base/a.hpp": GUARD, "src/base/b.cpp": '#include "base/a.hpp"\n',
          "src/CMakeLists.txt": "add_library(x base/b.cpp)\n"}),
        ("a header that only a page names",
         {"src/base/a.hpp": GUARD, "README.md": "see `src/base/a.hpp`\n"}, "src/base/a.hpp",
         {"src/base/a.inl": "\n", "src/base/b.cpp": '#include "a.inl"\n',
          "src/CMakeLists.txt": "add_library(x base/b.cpp)\n"}),
        ("a source that is not built",
         {"src/base/a.cpp": "\n", "src/CMakeLists.txt": "# add_library(x base/a.cpp)\n"},
         "src/base/a.cpp",
         {"src/base/a.cpp": "\n", "src/CMakeLists.txt": "add_library(x base/a.cpp)\n"}),
        ("a source of the same name elsewhere",
         {"src/base/a.cpp": "\n", "src/scene/a.cpp": "\n",
          "src/CMakeLists.txt": "add_library(x base/a.cpp)\n"}, "src/scene/a.cpp",
         {"apps/a.cpp": "\n", "tests/CMakeLists.txt": "add(${PROJECT_SOURCE_DIR}/apps/a.cpp)\n"}),
        ("a test that is not registered",
         {"tests/base/a_test.cpp": "\n", "tests/base/CMakeLists.txt": "harpoon_test(NAME b)\n"},
         "tests/base/a_test.cpp",
         {"tests/base/a_test.cpp": "\n",
          "tests/base/CMakeLists.txt": "harpoon_test(NAME a SOURCES a_test.cpp)\n"}),
        ("an example that is not built",
         {"examples/a.cpp": "\n", "examples/CMakeLists.txt": "foreach(example b)\n"},
         "examples/a.cpp",
         {"examples/a.cpp": "\n", "examples/a.txt": "out\n",
          "examples/CMakeLists.txt": "foreach(example a)\n"}),
        ("a module that is not instantiated", {"rtl/a.sv": "module a (); endmodule\n"}, "rtl/a.sv",
         {"rtl/a.sv": "module a (); endmodule\n", "sim/CMakeLists.txt": "verilate(TOP a)\n"}),
        ("an included file that is not included",
         {"rtl/formal/a.svh": "\n", "rtl/formal/prove.py": 'PROOFS = {"b": 2}  # a\n',
          "CMakeLists.txt": "add_test(rtl/formal/prove.py)\n"}, "rtl/formal/a.svh",
         {"rtl/formal/a.svh": "\n", "rtl/formal/prove.py": 'PROOFS = {"a": 2}\n',
          "CMakeLists.txt": "add_test(rtl/formal/prove.py)\n"}),
        ("a script that nobody runs", {"tools/a.py": "print(1)\n", "dev": "# tools/a.py\n"},
         "tools/a.py", {"tools/a.py": "print(1)\n", "dev": "python3 -m tools.a\n"}),
        ("a Python module that nobody imports",
         {"tools/a.py": "\n", "tools/b.py": "import os\n", "dev": "python3 tools/b.py\n"},
         "tools/a.py",
         {"tools/a.py": "\n", "tools/b.py": "from tools import a\n",
          "dev": "python3 tools/b.py\n"}),
        ("TypeScript that nobody imports",
         {"web/src/a.ts": "export {};\n", "web/src/main.ts": 'import "./b.ts";\n',
          "web/build.mjs": 'bundle("src/main.ts");\n', "web/package.json": '"node build.mjs"\n'},
         "web/src/a.ts",
         {"web/src/a.ts": "export {};\n", "web/src/main.ts": 'import "./a.ts";\n',
          "web/build.mjs": 'bundle("src/main.ts");\n', "web/package.json": '"node build.mjs"\n'}),
        ("tests of a page that no pattern finds",
         {"web/test/unit/a.spec.ts": "\n", "web/test/run": "run test/unit/*.test.ts\n",
          "web/CMakeLists.txt": "add_test(test/run)\n"}, "web/test/unit/a.spec.ts",
         {"web/test/unit/a.test.ts": "\n", "web/test/run": "run test/unit/*.test.ts\n",
          "web/CMakeLists.txt": "add_test(test/run)\n"}),
        ("a page that is not linked", {"docs/a.md": "x\n", "README.md": "docs/a.md\n"}, "docs/a.md",
         {"docs/a.md": "x\n", "docs/b.svg": "x\n",
          "README.md": "[a](docs/a.md) ![b](docs/b.svg)\n"}),
        ("a corpus without a target", {"tests/fuzz/corpus/a/one": "x\n"}, "tests/fuzz/corpus/a/one",
         {"tests/fuzz/corpus/a/one": "x\n", "tests/fuzz/a.cpp": "\n",
          "tests/fuzz/CMakeLists.txt": "fuzz(a SOURCES a.cpp)\n"}),
        ("a waiver without a reason",
         {"src/base/a.hpp": GUARD, "tools/lint/unused.txt": "src/base/a.hpp:\n"},
         "tools/lint/unused.txt",
         {"src/base/a.hpp": GUARD, "tools/lint/unused.txt": "src/base/a.hpp: read by hand\n"}),
        ("a waiver for a file that is gone", {"tools/lint/unused.txt": "src/base/a.hpp: why\n"},
         "tools/lint/unused.txt", {"tools/lint/unused.txt": "# none\n"}),
        ("a waiver for a file that is used",
         {"src/base/a.hpp": GUARD, "src/base/b.cpp": '#include "base/a.hpp"\n',
          "src/CMakeLists.txt": "add_library(x base/b.cpp)\n",
          "tools/lint/unused.txt": "src/base/a.hpp: why\n"},
         "tools/lint/unused.txt", {"tools/lint/unused.txt": "# none\n"}),
    ],
    text.outside: [
        ("a private absolute path", {"dev": f"cat {PRIVATE}\n"}, "dev",
         {"dev": "cat /usr/bin/x\n"}),
        ("a path above the tree", {"docs/a.md": f"see {CLIMB}\n"}, "docs/a.md",
         {"docs/a/b.md": f"see {CLIMB}\n"}),
    ],
    text.streams: [
        ("the command prints through its one writer", {"apps/a.cpp": 'fmt::print("a");\n'},
         "apps/a.cpp", {"apps/a.cpp": 'print("a");\n', "apps/output.cpp": 'fmt::print("a");\n'}),
        ("the command opens files in one place", {"apps/a.cpp": "std::ifstream file(name);\n"},
         "apps/a.cpp", {"bench/a.cpp": "std::ifstream file(name);\n"}),
    ],
    text.leftovers: [
        ("work left for later", {"src/base/a.cpp": f"// {MARKER}: more\n"}, "src/base/a.cpp",
         {"src/base/a.cpp": "// Everything is done here; nothing is left.\n"}),
        ("a statement in a comment", {"src/base/a.cpp": "  // count = count + 1;\n"},
         "src/base/a.cpp", {"src/base/a.cpp": "  // d = sqrt(x*x + y*y), so d >= 0\n"}),
        ("a loop in a comment", {"src/base/a.cpp": "// for (int i = 0; i < n; ++i) {\n"},
         "src/base/a.cpp", {"src/base/a.cpp": "// for every pair in the batch\n"}),
        ("a call in a script's comment", {"CMakeLists.txt": "# add_library(x a.cpp)\n"},
         "CMakeLists.txt", {"CMakeLists.txt": "# adds the library\n"}),
    ],
    text.clean: [
        ("blanks at the end", {"README.md": "a \n"}, "README.md", {"README.md": "a\n"}),
        ("no newline at the end", {"README.md": "a"}, "README.md", {"README.md": "a\n"}),
        ("a tab", {"README.md": "a\tb\n"}, "README.md", {"README.md": "a b\n"}),
        ("a long line of code", {"src/base/a.cpp": "//" + "a" * 99 + "\n"}, "src/base/a.cpp",
         {"docs/a.md": "a" * 200 + "\n"}),
    ],
    programs.formatting: [
        ("a badly set line", {"src/base/a.cpp": "int  a ;\n"}, "src/base/a.cpp",
         {"src/base/a.cpp": "int a;\n"}),
    ],
    programs.scripts: [
        ("an unquoted variable", {"dev": '#!/usr/bin/env bash\nx="a b"\nrm $x\n'}, "dev",
         {"dev": '#!/usr/bin/env bash\nx="a b"\nrm "$x"\n'}),
    ],
    programs.headers: [
        ("a public header that needs another first",
         {"include/harpoon/a.hpp": GUARD + "inline std::vector<int> a;\n"}, "include/harpoon/a.hpp",
         {"include/harpoon/a.hpp": GUARD + "#include <vector>\ninline std::vector<int> a;\n"}),
        ("a public header without a guard", {"include/harpoon/a.hpp": "struct A {};\n"},
         "include/harpoon/a.hpp", {"include/harpoon/a.hpp": GUARD + "struct A {};\n"}),
        ("a private header", {"src/base/a.hpp": GUARD + "inline std::string a;\n"},
         "src/base/a.hpp", {"src/base/a.hpp": GUARD + "inline int a = 0;\n"}),
    ],
    programs.tidy: [
        ("a misnamed function", {"src/base/a.cpp": "int Count() { return 1; }\n"}, "src/base/a.cpp",
         {"src/base/a.cpp": "int count() { return 1; }\n"}),
        ("a misnamed constant", {"src/base/a.cpp": "constexpr int limit = 1;\n"}, "src/base/a.cpp",
         {"src/base/a.cpp": "constexpr int kLimit = 1;\n"}),
        ("a needless copy",
         {"src/base/a.cpp": "#include <string>\nbool f(std::string s) { return s.empty(); }\n"},
         "src/base/a.cpp",
         {"src/base/a.cpp":
          "#include <string>\nbool f(const std::string& s) { return s.empty(); }\n"}),
        ("a warning", {"src/base/a.cpp": "int f(double d) { return d; }\n"}, "src/base/a.cpp",
         {"src/base/a.cpp": "double f(double d) { return d; }\n"}),
    ],
    programs.verilog: [
        ("a width mismatch",
         {"rtl/a.sv": "module a (input logic [3:0] a_i, output logic [1:0] b_o);\n"
                      "  assign b_o = a_i;\nendmodule\n"},
         "rtl/a.sv",
         {"rtl/x/b.sv": "module b (input logic [1:0] a_i, output logic [1:0] b_o);\n"
                        "  assign b_o = a_i;\nendmodule\n",
          "rtl/y/a.sv": "module a (input logic [1:0] a_i, output logic [1:0] b_o);\n"
                        "  b u_b (.a_i, .b_o);\nendmodule\n"}),
        ("a file that is not named after its module",
         {"rtl/a.sv": "module b (input logic a_i, output logic b_o);\n"
                      "  assign b_o = a_i;\nendmodule\n"},
         "rtl/a.sv", {}),
    ],
}


class LintRules(unittest.TestCase):
    def violations(self, rule, files: dict[str, str]):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, content in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(content)
            for name in (".clang-format", ".clang-tidy"):
                shutil.copy(ROOT / name, root / name)
            if rule is programs.tidy:
                self.write_compile_commands(root, files)
            return list(rule(Tree(root)))

    @staticmethod
    def write_compile_commands(root: pathlib.Path, files: dict[str, str]):
        folder = root / "build/release"
        folder.mkdir(parents=True)
        entries = ",".join(
            f'{{"directory": "{folder}", "file": "{root / name}",'
            f' "command": "c++ -std=c++20 -Wconversion -c {root / name}"}}' for name in files)
        (folder / "compile_commands.json").write_text(f"[{entries}]")

    def test_rules_find_what_they_are_for(self):
        for rule, cases in CASES.items():
            if rule is programs.verilog and not shutil.which("verilator"):
                continue
            for what, bad, reported, good in cases:
                with self.subTest(rule=rule.__name__, case=what):
                    found = self.violations(rule, bad)
                    self.assertTrue(found, "the seeded violation was not found")
                    self.assertEqual({v.path for v in found}, {reported})
                    self.assertEqual(self.violations(rule, good), [], "the correct twin")

    def test_every_rule_has_a_case(self):
        self.assertEqual(set(CASES), {*lint.QUICK, *lint.SLOW})

    def test_words_of_the_place_where_one_works(self):
        environment = unittest.mock.patch.dict("os.environ", HARPOON_LINT_WORDS="secret-tool")
        with environment:
            found = self.violations(text.outside, {"docs/a.md": "ask Secret-Tool first\n"})
        self.assertEqual([v.line for v in found], [1])

    def test_a_broken_rule_name_is_an_error(self):
        result = subprocess.run([sys.executable, "-m", "tools.lint", "no_such_rule"], cwd=ROOT,
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertIn("no rule no_such_rule", result.stdout)


if __name__ == "__main__":
    unittest.main()
