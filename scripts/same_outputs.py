#!/usr/bin/env python3
"""Shows that a change moved code and nothing else: what the command prints is, byte for byte, what it printed before.

    python3 scripts/same_outputs.py save FOLDER      runs every command below and stores what it prints, with its exit code
    python3 scripts/same_outputs.py check FOLDER     runs them again and compares

`MOREAU` is the program, `target/release/moreau` unless it is set; the help names it, so that both should have one file name. The commands are `COMMANDS`: the claims,
the systems of the chapter, the gate on our own schemes, the stored scoreboard, the matrix of defects, a problem solved and certified, two simulations, every schema and
every help. Standard output and exit code are compared. Times that a command prints are stored as 0 (`UNSTABLE`).
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

PROGRAM = os.environ.get("MOREAU", str(ROOT / "target/release/moreau"))


def gate(name: str) -> list[str]:
    """The gate on one of our own engines."""
    return ["gate", "--quick", "--format", "json", "--", PROGRAM, "engine", "--scheme", name]


FILES = "tests/compatibility/0.1/"
SUBCOMMANDS = ("verify", "solve", "certify", "simulate", "compare", "gate", "defects", "engine", "protocol-check", "schema", "scoreboard", "systems")
SCHEMAS = ("contact-problem", "solution", "scene", "trajectory", "request", "reply")

COMMANDS = {
    "verify": ["verify"],
    "verify-json": ["verify", "--format", "json"],
    "systems": ["systems"],
    "systems-json": ["systems", "--format", "json"],
    **{f"gate-{name}": gate(name) for name in ("moreau-jean", "stewart-trinkle", "anitescu")},
    "gate-list": ["gate", "--list"],
    "scoreboard": ["scoreboard", "--stored"],
    "scoreboard-json": ["scoreboard", "--stored", "--format", "json"],
    "defects-json": ["defects", "--format", "json"],
    "solve": ["solve", f"{FILES}problem.json", "--format", "json"],
    "certify": ["certify", f"{FILES}problem.json", f"{FILES}solution.json"],
    "simulate": ["simulate", "--scene", f"{FILES}scene.json", "--step", "0.01"],
    "compare": ["compare", "--scene", "box-stack", "--step", "0.01"],
    "schemas": ["schema"],
    **{f"schema-{name}": ["schema", name] for name in SCHEMAS},
    "help": ["--help"],
    **{f"help-{name}": [name, "--help"] for name in SUBCOMMANDS},
}

UNSTABLE = re.compile(rb'(?<="seconds": )[0-9.e+-]+|(?<="seconds":)[0-9.e+-]+|(?<=in )[0-9.]+(?= s\b)')
"""What differs between two runs of one program: seconds it took. They are stored as 0."""


def run(command: list[str]) -> bytes:
    """Standard output and exit code of one command."""
    done = subprocess.run([PROGRAM, *command], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    return UNSTABLE.sub(b"0", done.stdout.replace(PROGRAM.encode(), b"moreau")) + f"\nexit code {done.returncode}\n".encode()


def main() -> int:
    """Saves or compares."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["save", "check"])
    parser.add_argument("folder", type=pathlib.Path)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    different = []
    for name, command in COMMANDS.items():
        file, output = arguments.folder / f"{name}.txt", run(command)
        if arguments.what == "save" and (output.startswith(b"\nexit code") or not output.endswith((b"code 0\n", b"code 1\n"))):
            different.append(name)
            print(f"{name}: printed nothing, or ended otherwise than with 0 or 1; nothing is stored")
        elif arguments.what == "save":
            file.write_bytes(output)
            print(f"{name}: {len(output)} bytes")
        elif not file.exists():
            different.append(name)
            print(f"{name}: nothing is stored in {file}; run `save` with the program before the change")
        elif file.read_bytes() != output:
            different.append(name)
            (arguments.folder / f"{name}.new.txt").write_bytes(output)
            print(f"{name}: DIFFERENT, see {name}.new.txt beside it")
        else:
            print(f"{name}: the same {len(output)} bytes")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
