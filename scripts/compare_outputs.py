#!/usr/bin/env python3
"""Compares what two versions of the command say in JSON: the same claims, verdicts, checks, defects and trials, and numbers that moved no further than they may.

    python3 scripts/same_outputs.py save OLD         with the program before the change (set MOREAU)
    python3 scripts/same_outputs.py save NEW         with the program after it
    python3 scripts/compare_outputs.py OLD NEW

A number may move within its own bound where the object that holds it states one (`bound` or `tolerance`), and otherwise by 1e-9 of itself. Everything else, texts, truth values, lengths and keys, must be equal.
What moved is listed with both values. Exit code 0: nothing moved further than it may; 1: something did; 2: a file is missing.
"""

import argparse
import json
import pathlib
import sys

COMPARED = ("verify-json", "systems-json", "gate-moreau-jean", "gate-stewart-trinkle", "gate-anitescu", "scoreboard-json", "defects-json")
RELATIVE = 1e-9
BOUNDS = ("bound", "tolerance")


def read(folder: pathlib.Path, name: str) -> object:
    """The JSON that a command printed, without the exit code that follows it."""
    text = (folder / f"{name}.txt").read_text()
    body, code = text.rsplit("\nexit code ", 1)
    return {"exit code": int(code), "output": json.loads(body)}


def is_number(value: object) -> bool:
    """Whether it is a number; a truth value is none."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


class Comparison:
    """Walks two documents together."""

    def __init__(self) -> None:
        self.moved: list[str] = []
        self.wrong: list[str] = []
        self.numbers = 0

    def number(self, path: str, old: float, new: float, bound: float | None) -> None:
        """Two numbers at one place."""
        self.numbers += 1
        if old == new:
            return
        allowed = max(RELATIVE * abs(old), bound or 0.0)
        (self.moved if abs(old - new) <= allowed else self.wrong).append(f"{path}: {old!r} → {new!r} (may move by {allowed:.3g})")

    def walk(self, path: str, old: object, new: object, bound: float | None = None) -> None:
        """Two values at one place; `bound` is that of the object that holds them."""
        if is_number(old) and is_number(new):
            self.number(path, old, new, bound)
        elif isinstance(old, dict) and isinstance(new, dict):
            own = next((abs(old[key]) for key in BOUNDS if is_number(old.get(key))), None)
            for key in sorted(old.keys() | new.keys()):
                if key not in old or key not in new:
                    self.wrong.append(f"{path}/{key}: only in the {'old' if key in old else 'new'} output")
                    continue
                self.walk(f"{path}/{key}", old[key], new[key], None if key in BOUNDS else own)
        elif isinstance(old, list) and isinstance(new, list):
            if len(old) != len(new):
                self.wrong.append(f"{path}: {len(old)} → {len(new)} entries")
            for k, (one, other) in enumerate(zip(old, new)):
                self.walk(f"{path}/{label(one, k)}", one, other, bound)
        elif old != new:
            self.wrong.append(f"{path}: {old!r} → {new!r}")


def label(entry: object, k: int) -> str:
    """The name of an entry, or its number."""
    if isinstance(entry, dict):
        for key in ("id", "name", "check", "claim", "scene"):
            if isinstance(entry.get(key), str):
                return str(entry[key])
    return str(k)


def main() -> int:
    """Compares the folders."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    arguments = parser.parse_args()
    failed = False
    for name in COMPARED:
        try:
            old, new = read(arguments.old, name), read(arguments.new, name)
        except FileNotFoundError as missing:
            print(f"{missing.filename} is missing: run scripts/same_outputs.py save", file=sys.stderr)
            return 2
        found = Comparison()
        found.walk("", old, new)
        failed |= bool(found.wrong)
        print(f"{name}: {found.numbers} numbers, {len(found.moved)} moved as they may, {len(found.wrong)} differences")
        for line in found.wrong:
            print(f"  DIFFERENT {line}")
        for line in found.moved:
            print(f"  moved {line}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
