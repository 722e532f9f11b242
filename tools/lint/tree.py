"""The project's files, as every lint rule sees them, and what a rule reports."""

import dataclasses
import functools
import os
import pathlib
import subprocess

IGNORED_FOLDERS = {".git", "build", "node_modules", "harpoon-out", "__pycache__"}
CPP = (".hpp", ".cpp", ".inl", ".cu", ".cuh", ".h")
SYSTEM_VERILOG = (".sv", ".svh")


@dataclasses.dataclass(frozen=True, order=True)
class Violation:
    """One thing to change, at a line of a file (0: the file as a whole)."""

    path: str
    line: int
    rule: str
    message: str

    def __str__(self) -> str:
        place = f"{self.path}:{self.line}" if self.line else self.path
        return f"{place}: {self.rule}: {self.message}"


class Tree:
    """The files of a checkout: what git tracks or would track; without git all but build output."""

    def __init__(self, root: pathlib.Path):
        self.root = root

    @functools.cached_property
    def files(self) -> list[str]:
        """Paths relative to the root, sorted."""
        command = ["git", "-c", "safe.directory=*", "ls-files", "-z"]
        try:
            if not (self.root / ".git").exists():
                raise OSError("not a checkout")
            listed = subprocess.run(
                [*command, "--cached", "--others", "--exclude-standard"],
                cwd=self.root, check=True, capture_output=True, text=True,
            ).stdout.split("\0")
            names = [name for name in listed if name]
        except (OSError, subprocess.CalledProcessError):
            names = list(self._walk())
        return sorted({name for name in names if (self.root / name).is_file()})

    def _walk(self):
        for folder, folders, names in os.walk(self.root):
            folders[:] = [name for name in folders if name not in IGNORED_FOLDERS]
            for name in names:
                yield str((pathlib.Path(folder) / name).relative_to(self.root))

    def matching(self, suffixes: tuple[str, ...]) -> list[str]:
        return [name for name in self.files if name.endswith(suffixes)]

    @functools.lru_cache(maxsize=None)
    def text(self, name: str) -> str | None:
        """The file's text, or None when it is not text."""
        data = (self.root / name).read_bytes()
        if b"\0" in data:
            return None
        try:
            return data.decode()
        except UnicodeDecodeError:
            return None

    def lines(self, name: str) -> list[tuple[int, str]]:
        """Numbered lines; none when the file is not text."""
        return list(enumerate((self.text(name) or "").splitlines(), start=1))
