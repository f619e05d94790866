#!/usr/bin/env python3
"""Prints how long every crate of the workspace takes to compile (Markdown): alone from nothing, and again after a change.

    python3 scripts/measure_builds.py            builds into a folder of its own and removes it

`cold` is what `cargo build --timings` reports for the crate's library while everything is built from nothing, on all cores; `again` is the wall time of `cargo build -p CRATE`
after its root file was touched; `users` is that of `cargo build --workspace` after the same, which compiles whatever depends on it, too. Timings of one machine in one run: compare rows,
not runs. The development profile, as for `cargo test`.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent


def cargo(target: str, *arguments: str) -> float:
    """Wall seconds of a cargo command."""
    start = time.monotonic()
    subprocess.run(["cargo", *arguments, "--quiet"], cwd=ROOT, env={**os.environ, "CARGO_TARGET_DIR": target}, check=True)
    return time.monotonic() - start


def units(target: str) -> list[dict]:
    """What cargo reports of every unit it compiled."""
    pages = sorted(pathlib.Path(target, "cargo-timings").glob("cargo-timing-*.html"))
    found = re.search(r"UNIT_DATA = (\[.*?\]);\n", pages[-1].read_text(), re.DOTALL)
    if not found:
        raise SystemExit("this version of cargo writes its timings otherwise")
    return json.loads(found.group(1))


def main() -> int:
    """Measures and prints."""
    crates = ["moreau", *sorted(folder.name for folder in (ROOT / "crates").glob("moreau-*"))]
    roots = {name: ROOT / ("src/lib.rs" if name == "moreau" else f"crates/{name}/src/lib.rs") for name in crates}
    subprocess.run(["cargo", "fetch", "--quiet"], cwd=ROOT, check=True)
    with tempfile.TemporaryDirectory() as target:
        total = cargo(target, "build", "--workspace", "--timings")
        cold = {unit["name"]: unit["duration"] for unit in units(target) if unit["name"] in roots and not unit["target"].strip()}
        others = sum(unit["duration"] for unit in units(target) if unit["name"] not in roots)
        print(f"Everything from nothing: {total:.0f} s of wall time on {os.cpu_count()} cores; other packages {others:.0f} s of compiler time.\n")
        print("| crate | lines | cold [s] | again [s] | with its users [s] |\n|---|---|---|---|---|")
        for name in crates:
            lines = sum(len(file.read_text().splitlines()) for file in roots[name].parent.rglob("*.rs"))
            roots[name].touch()
            again = cargo(target, "build", "-p", name)
            roots[name].touch()
            users = cargo(target, "build", "--workspace")
            print(f"| `{name}` | {lines} | {cold.get(name, float('nan')):.1f} | {again:.1f} | {users:.1f} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
