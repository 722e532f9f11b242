"""Illegal parameters stop the elaboration of the RTL, with a message that says what is legal.

    python3 parameters.py [--rtl FOLDER] [MODULE ...]

Every module of rtl/ is elaborated by Verilator and by yosys (where there is one) with each of its
parameters outside its range, and at the ends of the range. A parameter that is missing in LIMITS
is an error; `parameter bit` has no illegal value. For a tool to reach the message, what a module
derives from a parameter must not be an error of the language: widths of 0 are.
"""

import argparse
import concurrent.futures
import pathlib
import re
import shutil
import subprocess
import sys

RTL = pathlib.Path(__file__).resolve().parents[2] / "rtl"

IN_FLIGHT = ("a power of two, 2 to 128", [0, 100, 256], [2, 128])
SPHERES = ("a power of two, 8 to 65536", [4, 1000, 131072], [8, 65536])
PAGES = ("a power of two, 2 to 1024", [0, 3, 2048], [2, 1024])
QUEUE = ("a power of two, at least 2", [0, 1, 3], [2])
LANES = ("1 to 16", [0, 17], [1, 16])
RESULTS = ("a power of two above the latency", [0, 64, 200], [128])
SOME = ("at least 1", [0], [1])

# module: {parameter: (what is legal, values that are not, values that are)}
LIMITS = {
    "credits": {"Count": SOME},
    "fifo": {"Width": SOME, "Depth": QUEUE},
    "register_slice": {"Width": SOME},
    "delay_line": {"Width": SOME, "Latency": SOME, "RamMin": ("at least 2", [0, 1], [2])},
    "collector": {"CountWidth": ("1 to 32", [0, 33], [1, 32])},
    "sphere_table": {"Spheres": SPHERES, "Ports": SOME},
    "index_slices": {"Lanes": LANES},
    "index_compact": {"Lanes": LANES},
    "index_lanes": {"Lanes": LANES, "Spheres": SPHERES, "Depth": QUEUE, "Patience": SOME},
    "scpu_array": {
        "NumScpu": ("1 or even", [0, 3, 9], [1, 2]),
        "Depth": RESULTS,
        "FirstTurn": ("a power of two, 1 to LastTurn", [0, 3, 8192], [1, 64]),
        "LastTurn": ("a power of two, at least 4", [0, 2, 100], [4, 64]),
        "Patience": SOME,
    },
    "puc": {"NumScpu": ("1 or even, up to 254", [0, 3, 256], [1, 2]), "Lanes": LANES,
            "Spheres": SPHERES, "Depth": RESULTS},
    "puc_job": {"Spheres": SPHERES},
    "puc_report": {"Spheres": SPHERES},
    "front_indexed": {"Lanes": LANES, "Spheres": SPHERES},
    "spl2": {"MaxInFlight": IN_FLIGHT, "MaxPages": PAGES},
    "spl2_reader": {"MaxInFlight": IN_FLIGHT},
    "spl2_writer": {"MaxInFlight": IN_FLIGHT},
    "spl2_page_table": {"MaxPages": PAGES},
    "afu_registers": {"MaxInFlight": IN_FLIGHT, "Spheres": SPHERES},
    "harpoon_afu": {"NumScpu": ("1 or even, up to 254", [0, 3, 256], [1, 2]), "Lanes": LANES,
                    "MaxInFlight": IN_FLIGHT, "Spheres": SPHERES},
}


def sources(rtl: pathlib.Path) -> list[pathlib.Path]:
    """Packages first."""
    files = sorted(rtl.glob("*/*.sv"))
    return sorted(files, key=lambda file: not file.stem.endswith("_pkg"))


def parameters(file: pathlib.Path) -> list[str]:
    """The parameters of a module that may have an illegal value."""
    return re.findall(r"^\s+parameter (?!bit\b)[\w ]*?(\w+)\s*=", file.read_text(), re.M)


def verilator(rtl: pathlib.Path, module: str, values: dict[str, int]) -> tuple[int, str]:
    packages = [str(file) for file in sources(rtl) if file.stem.endswith("_pkg")]
    folders = [word for folder in sorted(rtl.iterdir()) for word in ("-y", str(folder))]
    top = next(str(file) for file in sources(rtl) if file.stem == module)
    return run(["verilator", "--lint-only", "-Wall", *folders, str(rtl / "waivers.vlt"),
                *(f"-G{name}={value}" for name, value in values.items()), *packages, top])


def yosys(rtl: pathlib.Path, module: str, values: dict[str, int]) -> tuple[int, str]:
    files = " ".join(str(file) for file in sources(rtl))
    sets = "".join(f"chparam -set {name} {value} {module}; " for name, value in values.items())
    return run(["yosys", "-q", "-p", f"read_verilog -sv -defer {files}; {sets}"
                f"hierarchy -check -top {module}"])


def run(command: list[str]) -> tuple[int, str]:
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    return result.returncode, result.stdout + result.stderr


def together(lists: dict[str, list[int]]) -> list[dict[str, int]]:
    """Every value of every parameter at least once, all parameters set at a time."""
    return [{name: values[i % len(values)] for name, values in lists.items()}
            for i in range(max(map(len, lists.values())))]


def cases(module: str) -> list[tuple]:
    """(tool, module, values, is it legal?): Verilator says everything that is wrong at once, yosys
    only the first."""
    legal = together({name: good for name, (_, _, good) in LIMITS[module].items()})
    illegal = {name: bad for name, (_, bad, _) in LIMITS[module].items()}
    found = [(tool, module, values, True) for values in legal for tool in (verilator, yosys)]
    found += [(verilator, module, values, False) for values in together(illegal)]
    found += [(yosys, module, {name: value}, False)
              for name, values in illegal.items() for value in values]
    return [case for case in found if shutil.which(case[0].__name__)]


def judge(rtl: pathlib.Path, tool, module: str, values: dict[str, int], legal: bool) -> list[str]:
    """What is wrong with how a tool takes these values."""
    status, said = tool(rtl, module, values)
    case = f"{tool.__name__}: {module} with {values}"
    if legal:
        return [] if status == 0 else [f"{case} is legal, but:\n{said}"]
    if status == 0:
        return [f"{case} elaborates"]
    messages = [f"{module}: {name} must be {LIMITS[module][name][0]}" for name in values]
    return [f"{case} fails without '{message}':\n{said}" for message in messages
            if message not in said]


def missing(rtl: pathlib.Path) -> list[str]:
    """Parameters that LIMITS does not know, and entries that no module has."""
    there = {(file.stem, name) for file in rtl.glob("*/*.sv") for name in parameters(file)}
    known = {(module, name) for module, limits in LIMITS.items() for name in limits}
    return ([f"{module}.{name} has no limits" for module, name in sorted(there - known)] +
            [f"{module}.{name} has limits, but is not there" for module, name in
             sorted(known - there)])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rtl", type=pathlib.Path, default=RTL)
    parser.add_argument("modules", nargs="*")
    arguments = parser.parse_args()
    todo = [case for module in arguments.modules or LIMITS for case in cases(module)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = pool.map(lambda case: judge(arguments.rtl, *case), todo)
        faults = [fault for result in results for fault in result]
    faults += missing(arguments.rtl)
    print(*faults, sep="\n")
    print(f"{len(todo)} elaborations, {len(faults)} faults")
    return 1 if faults or not todo else 0


if __name__ == "__main__":
    sys.exit(main())
