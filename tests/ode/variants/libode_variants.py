"""Variants of Debian's libode.so.8 that stand for other builds of ODE, made without any download.

    python3 libode_variants.py SOURCE VARIANT TARGET [NAME...]

writes a changed copy of the library SOURCE to the file TARGET (its folder must be there). A program
uses it by LD_LIBRARY_PATH when the file is called libode.so.8. Variants:

    copy           nothing but another file name
    renamed NAME   calls itself by another name (SONAME), one of eleven letters
    symbolic       calls all its own functions itself, as after linking with -Bsymbolic
    direct NAME    calls only the named functions itself; everybody else still sees them. What a
                   compiler does that inlines them, or a linker with -Bsymbolic-functions
    inlined F G    calls the function G itself, but only inside the function F
    hidden NAME    does not export the named functions
    unlocked       has no assertions on locked spaces nor on its own state, as upstream's default
                   build: callbacks may change spaces. Assertions on arguments stay

The file keeps its size: relocations, flags and a few jumps are changed in place. Only for x86-64;
`symbolic` needs what Debian's library has, an entry DT_FLAGS.
"""

import functools
import pathlib
import re
import struct
import subprocess
import sys

DT_FLAGS, DF_SYMBOLIC = 30, 2
R_64, R_GLOB_DAT, R_JUMP_SLOT, R_RELATIVE = 1, 6, 7, 8
PT_LOAD, SHT_RELA, SHT_DYNAMIC, SHT_DYNSYM = 1, 4, 6, 11
STV_HIDDEN = 2
# What ends a process on Debian and is not asked in upstream's default build.
LOCKED = rb"Invalid operation for locked space in %s\(\)\0"
REFUSALS = LOCKED + rb'|assertion "'


@functools.lru_cache
def instructions_of(path):
    """Address, operation and operands of every instruction."""
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", path], check=True,
                          capture_output=True, text=True).stdout
    found = re.finditer(r"^ +([0-9a-f]+):\t(\S+) *(.*)$", text, re.MULTILINE)
    return [(int(m[1], 16), m[2], m[3]) for m in found]


def rename(data, old, new):
    """Changes a name of a library in the string table of one that has or needs it."""
    if len(new) != len(old) or data.count(b"\0" + old.encode() + b"\0") != 1:
        raise SystemExit(f"{old} cannot be renamed to {new}")
    at = data.index(b"\0" + old.encode() + b"\0") + 1
    data[at:at + len(old)] = new.encode()


class Library:
    """The bytes of a shared library, with what of its structure the variants need."""

    def __init__(self, path):
        self.path = path
        self.data = bytearray(pathlib.Path(path).read_bytes())
        if self.data[:6] != b"\x7fELF\x02\x01" or self.number("<H", 18) != 62:
            raise SystemExit(f"{path}: not for x86-64")
        self.segments = [struct.unpack_from("<IIQQQQQQ", self.data, at) for at in
                         self.table(32, 54, 56)]
        self.sections = [struct.unpack_from("<IIQQQQIIQQ", self.data, at) for at in
                         self.table(40, 58, 60)]
        self.symbols = self.read_symbols()

    def number(self, form, at):
        return struct.unpack_from(form, self.data, at)[0]

    def table(self, start, size, count):
        first, step = self.number("<Q", start), self.number("<H", size)
        return [first + k * step for k in range(self.number("<H", count))]

    def sections_of(self, kind):
        return [section for section in self.sections if section[1] == kind]

    def read_symbols(self):
        """Offset of each dynamic symbol's entry, by name."""
        (dynsym,) = self.sections_of(SHT_DYNSYM)
        names = self.sections[dynsym[6]][4]
        symbols = {}
        for at in range(dynsym[4], dynsym[4] + dynsym[5], 24):
            start = names + self.number("<I", at)
            symbols[bytes(self.data[start:self.data.index(0, start)]).decode()] = at
        self.first_symbol = dynsym[4]
        return symbols

    def entry(self, name):
        if name not in self.symbols:
            raise SystemExit(f"{self.path} has no {name}")
        return self.symbols[name]

    def address(self, name):
        return self.number("<Q", self.entry(name) + 8)

    def offset_of(self, address):
        for kind, _, offset, start, _, size, _, _ in self.segments:
            if kind == PT_LOAD and start <= address < start + size:
                return offset + address - start
        raise SystemExit(f"{self.path}: nothing at {address:x}")

    def address_of(self, offset):
        for kind, _, first, start, _, size, _, _ in self.segments:
            if kind == PT_LOAD and first <= offset < first + size:
                return start + offset - first
        raise SystemExit(f"{self.path}: offset {offset:x} is not loaded")

    def make_symbolic(self):
        (dynamic,) = self.sections_of(SHT_DYNAMIC)
        for at in range(dynamic[4], dynamic[4] + dynamic[5], 16):
            if self.number("<Q", at) == DT_FLAGS:
                flags = self.number("<Q", at + 8) | DF_SYMBOLIC
                struct.pack_into("<Q", self.data, at + 8, flags)
                return
        raise SystemExit(f"{self.path} has no DT_FLAGS")

    def make_direct(self, name):
        """Relocations against the symbol become its address."""
        index = (self.entry(name) - self.first_symbol) // 24
        for section in self.sections_of(SHT_RELA):
            for at in range(section[4], section[4] + section[5], 24):
                _, info, addend = struct.unpack_from("<QQq", self.data, at)
                if info >> 32 != index or info & 0xFFFFFFFF not in (R_64, R_GLOB_DAT, R_JUMP_SLOT):
                    continue
                target = self.address(name) + (addend if info & 0xFFFFFFFF == R_64 else 0)
                struct.pack_into("<Qq", self.data, at + 8, R_RELATIVE, target)

    def hide(self, name):
        self.make_direct(name)
        self.data[self.entry(name) + 5] = STV_HIDDEN

    def rename(self, name):
        rename(self.data, "libode.so.8", name)

    def instructions(self):
        return instructions_of(self.path)

    def callers(self, name):
        """The exported functions that call the named one by way of the dynamic linker."""
        spans = sorted((self.address(symbol), self.number("<Q", at + 16), symbol)
                       for symbol, at in self.symbols.items() if symbol)
        calls = [address for address, operation, operands in self.instructions()
                 if operation in ("call", "jmp") and f"<{name}@plt>" in operands]
        return sorted({symbol for start, size, symbol in spans
                       if any(start <= call < start + size for call in calls)})

    def inline(self, where, name):
        """Calls and jumps of one function to another one's PLT entry lead to the function."""
        start = self.address(where)
        end = start + self.number("<Q", self.entry(where) + 16)
        changed = 0
        for address, operation, operands in self.instructions():
            calls = operation in ("call", "jmp") and f"<{name}@plt>" in operands
            if calls and start <= address < end:
                at = self.offset_of(address)
                struct.pack_into("<i", self.data, at + 1, self.address(name) - address - 5)
                changed += 1
        if changed == 0:
            raise SystemExit(f"{where} does not call {name}")

    def assertions(self, code):
        """What of the code is run only when an assertion of REFUSALS fails: positions of the first
        and the last instruction, whether it is one on a locked space."""
        texts = {self.address_of(m.start()) for m in re.finditer(REFUSALS, self.data)}
        locked = self.address_of(re.search(LOCKED, self.data).start())
        found, start = [], 0
        for k, (_, operation, operands) in enumerate(code):
            if "<dDebug@plt>" in operands:
                words = " ".join(operands for _, _, operands in code[start:k])
                loaded = {int(text, 16) for text in re.findall(r"# ([0-9a-f]+) ", words)}
                if loaded & texts:
                    found.append((start, k, locked in loaded))
            if operation in ("call", "ret") or operation.startswith("j"):
                start = k + 1
        return found

    def without_assertions(self):
        """No jump leads to where a failed assertion ends the process, and those around it are
        always taken. Functions that do nothing but refuse stay as they are."""
        code = self.instructions()
        position = {address: k for k, (address, _, _) in enumerate(code)}
        block_of = {k: block for block in self.assertions(code)
                    for k in range(block[0], block[1] + 1)}
        reached = set()
        for k, (address, operation, operands) in enumerate(code):
            target = re.match(r"[0-9a-f]+(?= <)", operands) if operation.startswith("j") else None
            if not target or operation == "jmp":
                continue
            at, size = self.offset_of(address), code[k + 1][0] - address
            if (block := block_of.get(position.get(int(target[0], 16)))) is not None:
                self.data[at:at + size] = b"\x90" * size
                reached.add(block)
            elif (block := block_of.get(k + 1)) is not None:
                self.data[at:at + size] = (b"\xeb" + self.data[at + 1:at + 2] if size == 2 else
                                           b"\x90\xe9" + self.data[at + 2:at + 6])
                reached.add(block)
        left = [block for block in set(block_of.values()) - reached if block[2]]
        if left or not any(block[2] for block in reached):
            raise SystemExit(f"{self.path}: {len(left)} assertions on locked spaces are left")


def make(source, variant, target, names=()):
    """Writes the variant; see the head of this file."""
    library = Library(str(source))
    if variant == "symbolic":
        library.make_symbolic()
    elif variant in ("direct", "hidden"):
        for name in names:
            (library.make_direct if variant == "direct" else library.hide)(name)
    elif variant == "inlined":
        library.inline(*names)
    elif variant == "renamed":
        library.rename(*names)
    elif variant == "unlocked":
        library.without_assertions()
    elif variant != "copy":
        raise SystemExit(f"no variant {variant}")
    pathlib.Path(target).write_bytes(library.data)


def installed_libode():
    """The path of Debian's library."""
    listed = subprocess.run(["/sbin/ldconfig", "-p"], check=True, capture_output=True, text=True)
    return re.search(r"libode\.so\.8 .*=> (\S+)", listed.stdout)[1]


if __name__ == "__main__":
    if len(sys.argv) < 4:
        raise SystemExit(__doc__)
    make(sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:])
