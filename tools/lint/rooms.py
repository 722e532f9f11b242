"""The rooms of the tree and which room may use which: the picture of ARCHITECTURE.md as data.

A file belongs to the longest room that its path starts with. A room may include files of its own
and of the rooms listed for it, nothing else; `ANY` marks the rooms that compose parts. What is
listed and not used, or not there, is a violation too (unused.py).
"""

ANY = "any"

ALLOWED: dict[str, set[str] | str] = {
    "include/harpoon": set(),
    "src/base": {"include/harpoon"},
    "src/collide": set(),
    "src/device": {"include/harpoon", "src/base", "src/collide"},
    "src/device/cpu": {"include/harpoon", "src/base", "src/collide", "src/device"},
    "src/device/afu": {"include/harpoon", "src/device"},
    "src/broad": {"include/harpoon", "src/base", "src/collide"},
    "src/scene": {"include/harpoon", "src/base", "src/broad"},
    "src/ode": {"include/harpoon"},
    "src/hls": {"src/collide", "src/device/afu"},
    "rtl": set(),
    "sim": {"include/harpoon", "src/device/afu", "rtl"},
    "bench": {"include/harpoon"},
    "apps": ANY,
    "tests": ANY,
    "examples": {"include/harpoon"},
    "web": set(),
}

# Rooms without code of the product: they include nothing, so no edges are written for them.
OTHER_ROOMS = {"docs", "cmake", "tools", ".ci"}

# Third-party headers by the rooms that may name them. What is not listed here is open to all.
THIRD_PARTY: dict[str, set[str]] = {
    "hwy/": {"src/base", "src/collide", "src/device/cpu", "src/broad", "apps", "bench", "tests"},
    "tbb/": {"src/base", "src/device", "src/device/cpu", "bench", "tests"},
    "oneapi/": {"src/base", "src/device", "src/device/cpu", "bench", "tests"},
    "ode/": {"src/ode", "bench", "apps", "tests"},
    "verilated": {"sim", "tests"},
    "CLI/": {"apps", "tests"},
    "nlohmann/": {"apps", "bench", "tests"},
    "gtest/": {"tests"},
    "dart/": {"tests"},
    "ompl/": {"tests"},
    "rapidcheck": {"tests"},
    "benchmark/": {"bench"},
    "iostream": {"src/hls", "apps", "bench", "examples", "sim", "tests"},
    "cstdio": {"src/hls", "apps", "bench", "examples", "sim", "tests"},
}


def room_of(path: str) -> str | None:
    """The room of a file; "." for files at the root; None when no room is known."""
    folder, _, file = path.rpartition("/")
    if not folder:
        return "."
    if folder == "src" and file == "CMakeLists.txt":
        return "src"
    rooms = [room for room in (*ALLOWED, *OTHER_ROOMS) if path.startswith(room + "/")]
    return max(rooms, key=len, default=None)
