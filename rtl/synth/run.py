"""Synthesises the RTL with stock yosys and prints what it costs on three FPGA families.

    run.py                 cell counts of every top, and docs/rtl-synthesis.md written from them
    run.py --timing        also the logic delay and the post-route frequency of the cells; without
                           it the document keeps the timing it has
    run.py --top scpu      only that top, and no document
    run.py --check         only elaborate every top and look for its rows in the document: a few
                           seconds, for the tests

Counts are of hierarchical synthesis: each module is synthesised once, so that ten SCPUs cost the
time of one, and nothing is optimised across modules. Cells are synthesised flat. A top's parts are
tops themselves: they enter it as black boxes and their counts are added. Clock gates stay what they
are: the vendor's tool puts a clock buffer there. Results are kept under
build/synth and used again while the sources that they need are the same, so a run that was cut off
goes on. yosys may take MEMORY_GB; a top that needs more fails by itself, not the machine.
"""

import argparse
import concurrent.futures
import dataclasses
import functools
import hashlib
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = ROOT / "build" / "synth"
DOCUMENT = ROOT / "docs" / "rtl-synthesis.md"
ROOMS = ("pkg", "generated", "fp", "cells", "scpu", "spl2", "puc", "afu")
YOSYS_JS = "@yowasp/yosys@0.55.944"
TIMING_TITLE = "## Timing of the cells"
MEMORY_GB = 9
CLOCK_GATE = "clock_gate"  # a clock buffer with enable, for which yosys has no cell


@dataclasses.dataclass(frozen=True)
class Part:
    """A module that enters another as a black box: each instance costs `copies` of `top`."""

    top: "Top"
    copies: int = 1


@dataclasses.dataclass(frozen=True)
class Top:
    """What is synthesised: a module, its parameters, its parts, and whether it is a cell."""

    module: str
    parameters: tuple[tuple[str, int], ...] = ()
    parts: tuple[Part, ...] = ()
    cell: bool = False

    @property
    def name(self) -> str:
        return self.module + "".join(f" {key}={value}" for key, value in self.parameters)

    @property
    def slug(self) -> str:
        return re.sub(r"\W+", "_", self.name)


CELLS = [Top(module, cell=True) for module in (
    "fp32_add", "fp32_mul", "fp32_recip", "fp32_sqrt", "fp32_sqrt_greater", "fp32_compare",
    "fp32_select")]
SCPU = Top("scpu")
SCPU_CULL = Top("scpu_cull")
SPHERE_TABLE = Top("sphere_table", (("Ports", 1),))


def table_copies(lanes: int) -> int:
    """An FPGA's RAM has one read port, so the sphere table is a copy for each: two for a lane, four
    behind the lanes. Stock yosys runs out of memory when it must find that out for 24."""
    return 2 * lanes + 4


def lanes(count: int) -> Top:
    parts = (Part(SCPU_CULL), Part(SPHERE_TABLE, copies=table_copies(count)))
    return Top("index_lanes", (("Lanes", count),), parts)


def array(scpus: int) -> Top:
    return Top("scpu_array", (("NumScpu", scpus),), (Part(SCPU),))


def afu(scpus: int) -> Top:
    parts = (Part(SCPU), Part(SCPU_CULL), Part(SPHERE_TABLE, copies=table_copies(scpus)))
    return Top("harpoon_afu", (("NumScpu", scpus),), parts)


TOPS = CELLS + [SCPU, SCPU_CULL, Top("sphere_plane"), Top("aabb_overlap"), SPHERE_TABLE,
                Top("afu_registers"), Top("spl2"), Top("collector"), Top("dispatcher"),
                array(1), array(10), lanes(1), lanes(10), afu(1), afu(10)]


@dataclasses.dataclass(frozen=True, eq=False)
class Family:
    """An FPGA family: yosys's command, and which of its cells make up each column."""

    name: str
    command: str
    flatten: str
    hierarchical: str
    columns: dict[str, str]


FAMILIES = [
    Family("xc7", "synth_xilinx -family xc7", "-flatten", "", {
        "LUT": r"LUT[1-6]", "SRL": r"SRL(16|C32)E?", "FF": r"FD[RSCP]E(_1)?", "CARRY4": r"CARRY4",
        "DSP48": r"DSP48E1", "RAMB18": r"RAMB18E1", "RAMB36": r"RAMB36E1", "LUT RAM": r"RAM\d+.*",
        "gated clocks": CLOCK_GATE}),
    Family("ecp5", "synth_ecp5", "", "-noflatten", {
        "LUT4": r"LUT4", "FF": r"TRELLIS_FF", "CCU2C": r"CCU2C", "MULT18": r"MULT18X18D",
        "DP16KD": r"DP16KD", "LUT RAM": r"TRELLIS_DPR16X4", "gated clocks": CLOCK_GATE}),
    Family("cyclonev", "synth_intel_alm -family cyclonev", "", "-noflatten", {
        "ALUT": r"MISTRAL_ALUT(\d|_ARITH)", "FF": r"MISTRAL_FF", "DSP": r"MISTRAL_MUL.*",
        "M10K": r"MISTRAL_M10K", "MLAB": r"MISTRAL_MLAB",
        "gated clocks": CLOCK_GATE}),
]


def sources() -> list[pathlib.Path]:
    """Packages first, in the order of the rooms."""
    files = [file for room in ROOMS for file in sorted((ROOT / "rtl" / room).glob("*.sv"))]
    return sorted(files, key=lambda file: not file.stem.endswith("_pkg"))


def present(tops: list[Top]) -> list[Top]:
    known = {file.stem for file in sources()}
    return [top for top in tops if top.module in known]


def read_commands(top: Top, files: list[str]) -> str:
    parameters = "".join(f" -chparam {key} {value}" for key, value in top.parameters)
    return f"read_verilog -sv {' '.join(files)}\nhierarchy -check -top {top.module}{parameters}\n"


@functools.cache
def needs(module: str) -> frozenset[str]:
    """The modules and packages that a module names, itself and theirs included."""
    texts = {file.stem: file.read_text() for file in sources()}
    found, todo = set(), [module]
    while todo:
        name = todo.pop()
        if name in found or name not in texts:
            continue
        found.add(name)
        todo += set(re.findall(r"\w+", texts[name])) & texts.keys()
    return frozenset(found)


def key_of(script: str) -> str:
    """Changes with the script and with any source that its top needs."""
    digest = hashlib.sha256(script.encode())
    top = re.search(r"-top (\w+)", script)[1]
    for file in sources():
        if file.stem in needs(top):
            digest.update(file.read_bytes())
    return digest.hexdigest()


def kept(name: str, script: str) -> bool:
    """Is the result of this script, over these sources, still there?"""
    key = WORK / f"{name}.key"
    return key.exists() and key.read_text() == key_of(script)


def keep(name: str, script: str) -> None:
    (WORK / f"{name}.key").write_text(key_of(script))


def limit_memory() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_GB << 30, MEMORY_GB << 30))


def yosys(script: str, name: str) -> None:
    """Runs stock yosys; its messages stay in the work folder, and are shown when it fails."""
    path = WORK / f"{name}.ys"
    path.write_text(script)
    log = WORK / f"{name}.log"
    command = ["yosys", "-q", "-l", str(log), "-s", str(path)]
    result = subprocess.run(command, cwd=WORK, capture_output=True, text=True, check=False,
                            preexec_fn=limit_memory)
    if result.returncode != 0:
        errors = [line for line in result.stderr.splitlines() if "ERROR" in line]
        raise RuntimeError(f"{name}: {' '.join(errors) or result.stderr[-500:]} (see {log})")


def elaborate(top: Top) -> None:
    """Reads the top as stock yosys does and checks that every net is driven once."""
    files = [str(file) for file in sources()]
    yosys(read_commands(top, files) + "proc\ncheck -assert\n", f"check_{top.slug}")


def base_name(cell: str) -> str:
    """The module of a cell whose type is yosys's name for a module with parameters."""
    return cell.split("\\")[1] if cell.startswith("$paramod") else cell


def cell_counts(report: str, module: str) -> dict[str, int]:
    """Cells of `module` and all below it, from yosys's `stat`."""
    modules: dict[str, dict[str, int]] = {}
    for title, body in re.findall(r"^=== (\S+) ===\n(.*?)(?=^===|\Z)", report, re.M | re.S):
        found = re.findall(r"^ {5}(\S+) +(\d+)$", body, re.M)
        modules[title.lstrip("\\")] = {name.lstrip("\\"): int(count) for name, count in found}

    def total(name: str) -> dict[str, int]:
        counts: dict[str, int] = {}
        for cell, count in modules[name].items():
            below = total(cell) if cell in modules else {cell: 1}
            for kind, number in below.items():
                counts[kind] = counts.get(kind, 0) + count * number
        return counts

    top = module if module in modules else next(n for n in modules if f"\\{module}" in n)
    return total(top)


@functools.cache
def synthesise(top: Top, family: Family) -> dict[str, int]:
    """All cells of a top, by their type in the family."""
    name = f"{top.slug}_{family.name}"
    report = WORK / f"{name}.stat"
    option = family.flatten if top.cell else family.hierarchical
    script = read_commands(top, [str(file) for file in sources()])
    boxes = [f"*{part.top.module}*" if part.top.parameters else part.top.module
             for part in top.parts]
    if CLOCK_GATE in needs(top.module):
        boxes.append(CLOCK_GATE)
    script += f"blackbox {' '.join(boxes)}\n" if boxes else ""
    script += "" if top.cell else "proc\nflatten *fp32_*\n"
    script += f"{family.command} {option} -top {top.module}\ntee -q -o {report} stat\n"
    if not kept(name, script):
        yosys(script, name)
        keep(name, script)
    cells = cell_counts(report.read_text(), top.module)
    for part in top.parts:
        boxes = [cell for cell in cells if base_name(cell) == part.top.module]
        instances = sum(cells.pop(box) for box in boxes)
        for cell, count in synthesise(part.top, family).items():
            cells[cell] = cells.get(cell, 0) + instances * part.copies * count
    return cells


def columns(top: Top, family: Family) -> list[int]:
    """The cell counts of a top in the columns of the family."""
    cells = synthesise(top, family)
    return [sum(count for cell, count in cells.items() if re.fullmatch(pattern, cell))
            for pattern in family.columns.values()]


def install_yosys_js() -> pathlib.Path | None:
    """The folder of npm packages with a yosys that knows the delays of 7-series cells."""
    folder = WORK / "node_modules"
    if not (folder / "@yowasp" / "yosys").exists():
        if not shutil.which("npm"):
            return None
        command = ["npm", "install", "--silent", "--no-audit", "--no-fund", "--prefix", str(WORK),
                   YOSYS_JS]
        if subprocess.run(command, check=False).returncode != 0:
            return None
    return folder


def logic_delay_ps(top: Top, packages: pathlib.Path) -> int:
    """The longest path through cells, routing not counted, on a 7-series part. The library is read
    again before `sta` because CARRY4 has lost its delays by then, and carry chains count."""
    files = [str(file) for file in sources()]
    script = WORK / f"{top.slug}_sta.ys"
    report = f"{top.slug}_sta.rpt"
    text = (read_commands(top, [pathlib.Path(file).name for file in files]) +
            f"synth_xilinx -family xc7 -top {top.module} -abc9 -flatten\n"
            "delete =CARRY4\nread_verilog -lib -specify +/xilinx/cells_sim.v\n"
            f"tee -q -o {report} sta\n")
    if not kept(report, text):
        (WORK / report).unlink(missing_ok=True)
        script.write_text(text)
        tool = pathlib.Path(__file__).with_name("yosys.mjs")
        command = ["node", str(tool), str(packages), str(script), str(WORK), *files]
        subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
        keep(report, text)
    match = re.search(r"Latest arrival time in '\S+' is (\d+)", (WORK / report).read_text())
    if not match:
        raise RuntimeError(f"{top.name}: no arrival time in {WORK / report}")
    return int(match[1])


def routed_mhz(top: Top) -> str:
    """Clock frequency after place and route on an iCE40 HX8K, register to register; "-" where a
    cell has no such path."""
    netlist = WORK / f"{top.slug}_ice40.json"
    script = read_commands(top, [str(file) for file in sources()])
    yosys(script + f"synth_ice40 -abc9 -top {top.module} -json {netlist}\n", f"{top.slug}_ice40")
    command = ["nextpnr-ice40", "--hx8k", "--package", "ct256", "--seed", "1", "--freq", "100",
               "--timing-allow-fail", "--json", str(netlist)]
    result = subprocess.run(command, capture_output=True, text=True, check=True)
    figures = re.findall(r"Max frequency for clock .*?: ([\d.]+) MHz", result.stderr)
    return f"{float(figures[-1]):.0f}" if figures else "-"


def table(rows: list[list[str]]) -> str:
    """A Markdown table; the first row is its head, columns but the first are numbers."""
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    lines.insert(1, "| --- |" + " ---: |" * (len(rows[0]) - 1))
    return "\n".join(lines) + "\n"


def count_tables(tops: list[Top], jobs: int) -> str:
    wholes = [top for top in tops if not top.parts]
    pairs = [(top, family) for family in FAMILIES for top in wholes]
    pairs += [(top, family) for family in FAMILIES for top in tops if top.parts]
    counts: dict[tuple[Top, str], list[int]] = {}
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for (top, family), row in zip(pairs, pool.map(columns, *zip(*pairs))):
            counts[top, family.name] = row
            print(f"{family.name} {top.name} done", file=sys.stderr, flush=True)
    text = ""
    for family in FAMILIES:
        rows = [["module", *family.columns]]
        for top in tops:
            rows.append([f"`{top.name}`", *map(str, counts[top, family.name])])
        text += f"## {family.name}\n\n`{family.command}`\n\n{table(rows)}\n"
    return text


def timing_table(jobs: int) -> str:
    packages = install_yosys_js()
    router = shutil.which("nextpnr-ice40")
    cells = [top for top in present(CELLS) if top.module != "fp32_select"]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        delays = [pool.submit(logic_delay_ps, top, packages) for top in cells] if packages else []
        routed = [pool.submit(routed_mhz, top) for top in cells] if router else []
    rows = [["cell", "xc7 logic delay, ns", "iCE40 HX8K after routing, MHz"]]
    for i, top in enumerate(cells):
        rows.append([f"`{top.name}`", f"{delays[i].result() / 1000:.2f}" if delays else "-",
                     routed[i].result() if routed else "-"])
    return (
        f"{TIMING_TITLE}\n\n"
        f"Logic delay: {YOSYS_JS.split('@')[2]} of yosys (npm), `synth_xilinx -abc9`, then `sta` "
        "with the delays of the\ncarry chains; cells only, no routing. After routing: "
        "`nextpnr-ice40`, register to register; the\npart has no multipliers of this width and is "
        "slow, the figure ranks the cells.\n\n" + table(rows) + "\n")


def write_document(text: str) -> None:
    """Writes the document; a text without timing keeps the timing that is there."""
    DOCUMENT.parent.mkdir(exist_ok=True)
    if TIMING_TITLE not in text and DOCUMENT.exists():
        _, title, timing = DOCUMENT.read_text().partition(TIMING_TITLE)
        text += title + timing
    DOCUMENT.write_text(
        "# What the RTL costs\n\nWritten by `./dev synth --timing`; do not edit. Cell counts by "
        "yosys 0.23, before place and route.\nPipelines and the AFU are synthesised module by "
        "module, nothing is optimised across modules: the\nrow of ten SCPUs is ten times the row "
        "of one and what holds them together. The sphere table (16,384\nspheres) is counted as a "
        "copy for each of its 2 N + 4 read ports; RAM with two ports needs half of\nthem. A gated "
        "clock is a clock buffer with enable.\n\n" + text.rstrip() + "\n")


def all_documented(tops: list[Top]) -> bool:
    """Has the document a row for each top in each family?"""
    text = DOCUMENT.read_text() if DOCUMENT.exists() else ""
    missing = [top.name for top in tops if text.count(f"| `{top.name}` |") < len(FAMILIES)]
    for name in missing:
        print(f"synth: {DOCUMENT.name} lacks {name}: run ./dev synth", file=sys.stderr)
    return not missing


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="elaborate every top, nothing more")
    parser.add_argument("--timing", action="store_true", help="also the timing of the cells")
    parser.add_argument("--top", help="only tops of this module; no document is written")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    WORK.mkdir(parents=True, exist_ok=True)
    tops = [top for top in present(TOPS) if arguments.top in (None, top.module)]
    if not tops:
        parser.error(f"there is no top {arguments.top}")
    try:
        if arguments.check:
            with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
                list(pool.map(elaborate, tops))
            print(f"{len(tops)} tops elaborate: {', '.join(top.name for top in tops)}")
            return 0 if all_documented(tops) else 1
        text = count_tables(tops, arguments.jobs)
        if arguments.timing:
            text += timing_table(arguments.jobs)
    except (RuntimeError, subprocess.CalledProcessError) as error:
        print(f"synth: {error}", file=sys.stderr)
        return 1
    print(text)
    if arguments.top is None:
        write_document(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
