#!/usr/bin/env python3
"""Prints how long every crate of the workspace takes to compile (Markdown): alone from nothing, and again after a change.

    python3 scripts/measure_builds.py            builds into a folder of its own and removes it

`cold` is what `cargo build --timings` reports for the crate's library while everything is built from nothing, on all cores; `again` is the wall time of `cargo build -p CRATE`
after a function was added to its root file; `users` is that of `cargo build --workspace` after another one, which compiles whatever depends on it, too. Timings of one machine in one
run: compare rows, not runs. The development profile, as for `cargo test`. Works on a copy of the files that git knows; the checkout stays as it is.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent


def copy(to: pathlib.Path) -> None:
    """The files that git knows."""
    for name in subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0"):
        if name and (ROOT / name).is_file():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / name, to / name)


def cargo(work: pathlib.Path, *arguments: str) -> float:
    """Wall seconds of a cargo command."""
    start = time.monotonic()
    environment = {**os.environ, "CARGO_TARGET_DIR": str(work / "target")}
    subprocess.run(["cargo", *arguments, "--quiet"], cwd=work, env=environment, check=True)
    return time.monotonic() - start


def change(root: pathlib.Path, number: int) -> None:
    """Adds a function."""
    root.write_text(root.read_text() + f"\n/// A change.\npub fn a_change_{number}() -> usize {{\n    {number}\n}}\n")


def units(target: pathlib.Path) -> list[dict]:
    """What cargo reports of every unit it compiled."""
    pages = sorted(pathlib.Path(target, "cargo-timings").glob("cargo-timing-*.html"))
    found = re.search(r"UNIT_DATA = (\[.*?\]);\n", pages[-1].read_text(), re.DOTALL)
    if not found:
        raise SystemExit("this version of cargo writes its timings otherwise")
    return json.loads(found.group(1))


def main() -> int:
    """Measures and prints."""
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        copy(work)
        crates = ["moreau", *sorted(path.name for path in (work / "crates").glob("moreau-*"))]
        roots = {name: work / ("src/lib.rs" if name == "moreau" else f"crates/{name}/src/lib.rs") for name in crates}
        lines = {name: sum(len(file.read_text().splitlines()) for file in roots[name].parent.rglob("*.rs")) for name in crates}
        cargo(work, "fetch")
        total = cargo(work, "build", "--workspace", "--timings")
        built = units(work / "target")
        cold = {unit["name"]: unit["duration"] for unit in built if unit["name"] in roots and not unit["target"].strip()}
        others = sum(unit["duration"] for unit in built if unit["name"] not in roots)
        print(f"Everything from nothing: {total:.0f} s of wall time on {os.cpu_count()} cores; other packages {others:.0f} s of compiler time.\n")
        print("| crate | lines | cold [s] | again [s] | with its users [s] |\n|---|---|---|---|---|")
        for name in crates:
            cargo(work, "build", "-p", name)  # alone a crate has fewer features than in the workspace: its dependencies are compiled once more
            change(roots[name], 1)
            again = cargo(work, "build", "-p", name)
            cargo(work, "build", "--workspace")
            change(roots[name], 2)
            users = cargo(work, "build", "--workspace")
            print(f"| `{name}` | {lines[name]} | {cold.get(name, float('nan')):.1f} | {again:.1f} | {users:.1f} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
