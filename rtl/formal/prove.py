"""Proves the properties of the RTL's control blocks, and shows that each one can fail.

    python3 prove.py [--mutants | --proofs] [--every=N] [PROOF ...]

A proof takes one module with its properties (NAME.svh beside this file) through yosys, then z3 by
yosys-smtbmc: a bounded check from reset and k-induction. A mutant is the same module with one
seeded bug; the bounded check must fail in the property that the mutant names. Without an option
both are done; --every=N tries every Nth mutant only. The exit status is 1 when a proof fails or a
mutant survives.
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import time

import mutants

HERE = pathlib.Path(__file__).resolve().parent
RTL = HERE.parent
PACKAGES = ["pkg/harpoon_contract_pkg.sv", "pkg/puc_pkg.sv"]

# name: (sources: its own and those that are proven with it; parameters; k; depth of the mutants'
# check)
PROOFS = {
    "fifo": (["cells/fifo.sv"], {"Width": 4, "Depth": 4}, 2, 9),
    "credits": (["cells/credits.sv"], {"Count": 5}, 2, 9),
    "register_slice": (["cells/register_slice.sv"], {"Width": 4}, 2, 5),
    "collector": (["puc/collector.sv"], {"CountWidth": 4}, 2, 8),
    "dispatcher": (["puc/dispatcher.sv"], {}, 2, 5),
    "spl2_reader": (["spl2/spl2_reader.sv"], {"MaxInFlight": 4}, 2, 10),
    "spl2_writer": (["spl2/spl2_writer.sv"], {"MaxInFlight": 4}, 2, 10),
    "spl2_page_table": (["spl2/spl2_page_table.sv"], {"MaxPages": 4}, 2, 5),
    "spl2": (["formal/spl2_stubs.svh", "spl2/spl2.sv"], {"MaxInFlight": 4, "MaxPages": 4}, 2, 15),
    "puc": (["generated/scpu_pkg.sv", "formal/puc_stubs.svh", "puc/puc_job.sv",
             "puc/puc_sequence.sv", "puc/puc_counters.sv", "puc/puc_report.sv",
             "puc/source_numbers.sv", "puc/front_direct.sv", "puc/puc.sv"], {}, 3, 20),
    "source_numbers": (["puc/source_numbers.sv"], {}, 2, 5),
    "front_direct": (["puc/front_direct.sv"], {}, 2, 3),
    "front_indexed": (["formal/front_stubs.svh", "puc/front_indexed.sv"], {"Spheres": 64}, 2, 8),
    "afu_registers": (["afu/afu_registers.sv"], {"MaxInFlight": 4, "Spheres": 64}, 3, 6),
    "scpu_array": (["formal/pipeline_stubs.svh", "puc/scpu_array.sv"],
                   {"NumScpu": 4, "Depth": 8, "FirstTurn": 2, "LastTurn": 4,
                    "Patience": 2}, 2, 18),
    "index_slices": (["puc/index_slices.sv"], {"Lanes": 3}, 2, 10),
    "index_compact": (["puc/index_compact.sv"], {"Lanes": 5}, 2, 5),
    "index_lanes": (["formal/pipeline_stubs.svh", "puc/index_slices.sv", "puc/index_compact.sv",
                     "puc/index_lanes.sv"],
                    {"Lanes": 3, "Spheres": 64, "Depth": 8, "Patience": 2}, 2, 18),
}
TIMEOUT_S = 300


def model(name: str, sources: list[pathlib.Path], folder: pathlib.Path,
          only: str = "") -> pathlib.Path:
    """The SMT model of a module with its properties, or with only one of them."""
    parameters = "".join(f"chparam -set {key} {value} {name}; "
                         for key, value in PROOFS[name][1].items())
    out = folder / f"{name}.smt2"
    choose = f"delete t:$assert c:{only} %d; " if only else ""
    files = " ".join(str(source) for source in sources)
    script = (f"read_verilog -sv -formal -DFORMAL -I{HERE} {files}; {parameters}"
              f"prep -top {name} -flatten; {choose}memory_map; opt -fast; dffunmap; opt_clean; "
              f"write_smt2 -wires {out}")
    run = subprocess.run(["yosys", "-q", "-p", script], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise RuntimeError(run.stdout + run.stderr)
    return out


def solve(smt2: pathlib.Path, options: list[str]) -> tuple[str, list[str]]:
    """PASSED, FAILED or UNKNOWN, and the properties that failed."""
    command = ["yosys-smtbmc", "-s", "z3", "--unroll", *options, str(smt2)]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=TIMEOUT_S,
                             check=False)
    except subprocess.TimeoutExpired:
        return "UNKNOWN", []
    status = re.search(r"Status: (\w+)", run.stdout)
    return (status[1] if status else "UNKNOWN",
            re.findall(r"Assert failed in \w+: (\S+)", run.stdout))


def labels(name: str) -> set[str]:
    return set(re.findall(r"(\w+):\s+assert\b", (HERE / f"{name}.svh").read_text()))


def prove(name: str, folder: pathlib.Path) -> bool:
    sources, _, k, _ = PROOFS[name]
    smt2 = model(name, [RTL / source for source in PACKAGES + sources], folder)
    begin = time.monotonic()
    results = [solve(smt2, ["-t", str(k + 2)]), solve(smt2, ["-i", "-t", str(k)])]
    good = all(status == "PASSED" for status, _ in results)
    print(f"{'proved' if good else 'FAILED'}  {name}: {len(labels(name))} properties, "
          f"{time.monotonic() - begin:.1f} s", *(f"{results}",) if not good else (), flush=True)
    return good


def kill(name: str, mutant: tuple[str, str, str], folder: pathlib.Path) -> bool:
    label, old, new = mutant
    sources, _, _, depth = PROOFS[name]
    texts = {source: (RTL / source).read_text() for source in sources if source.endswith(".sv")}
    places = {source: text.count(old) for source, text in texts.items() if old in text}
    if sum(places.values()) != 1:
        print(f"STALE   {label}: {sum(places.values())} places match {old!r}")
        return False
    files = [RTL / source for source in PACKAGES + sources]
    original = next(iter(places))
    changed = folder / pathlib.Path(original).name
    changed.write_text(texts[original].replace(old, new))
    files[files.index(RTL / original)] = changed
    status, failed = solve(model(name, files, folder, label), ["-t", str(depth)])
    good = status == "FAILED" and label in failed
    print(f"{'killed' if good else 'SURVIVED'}  {label}" + ("" if good else f": {status} {failed}"),
          flush=True)
    return good


def main(arguments: list[str]) -> int:
    names = [argument for argument in arguments if not argument.startswith("-")] or list(PROOFS)
    stride = next((int(a.partition("=")[2]) for a in arguments if a.startswith("--every=")), 1)
    good = True
    tried = 0
    shown: set[str] = set()
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            if "--mutants" not in arguments:
                good &= prove(name, pathlib.Path(folder))
            if "--proofs" not in arguments:
                for mutant in mutants.MUTANTS[name]:
                    tried += 1
                    if tried % stride == 0:
                        good &= kill(name, mutant, pathlib.Path(folder))
                        shown.add(mutant[0])
    if "--proofs" not in arguments and stride == 1:
        every = set().union(*(labels(name) for name in names))
        for label in sorted(every - shown):
            print(f"MISSING {label}: no mutant shows that it can fail")
        print(f"{len(shown)} of {len(every)} properties shown to fail on a seeded bug")
        good &= not every - shown
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
