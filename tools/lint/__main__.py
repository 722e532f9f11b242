"""Runs every rule over the checkout, prints every violation, and fails when there is one.

    python3 -m tools.lint [--quick] [RULE ...]

--quick leaves out the rules that compile. RULE names those to run instead of all.
"""

import pathlib
import sys
import time

from tools.lint import programs, structure, text, unused
from tools.lint.tree import Tree

QUICK = (structure.edges, structure.naming, structure.picture, structure.twins, unused.drawn,
         unused.unused, text.outside, text.leftovers, text.clean, text.streams,
         programs.formatting, programs.scripts)
SLOW = (programs.verilog, programs.headers, programs.tidy)


def main(arguments: list[str]) -> int:
    rules = {rule.__name__: rule for rule in (*QUICK, *SLOW)}
    names = [argument for argument in arguments if not argument.startswith("-")]
    if unknown := [name for name in names if name not in rules]:
        print(f"lint: no rule {', '.join(unknown)}; there are: {', '.join(rules)}")
        return 2
    chosen = [rules[name] for name in names]
    if not chosen:
        chosen = list(QUICK) if "--quick" in arguments else list(rules.values())
    tree = Tree(pathlib.Path(__file__).resolve().parent.parent.parent)
    violations = []
    for rule in chosen:
        begin = time.monotonic()
        found = sorted(set(rule(tree)))
        for violation in found:
            print(violation)
        violations += found
        seconds = time.monotonic() - begin
        print(f"lint: {rule.__name__:10} {len(found):4} violations {seconds:6.1f} s", flush=True)
    print(f"lint: {len(tree.files)} files, {len(violations)} violations")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
