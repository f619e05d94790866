#!/usr/bin/env python3
"""Store how much of their derived bounds the claims and the systems use: `references/regression.json`.

    cargo build --release
    python3 scripts/measure_regression.py

`cargo test` lets a number use ten times what is stored here (src/tolerance/regression.rs). Run this when a
number moved on purpose, or when a claim or an agreement is new, and look at what changed: `git diff`.
`MOREAU` is the program, `target/release/moreau` unless it is set. Needs the standard library.
"""

import json
import os
import pathlib
import platform
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = os.environ.get("MOREAU", str(ROOT / "target/release/moreau"))
FILE = ROOT / "references" / "regression.json"
COMMANDS = {"claims": ["verify", "--format", "json"], "systems": ["systems", "--format", "json"]}


def output(command):
    """What a command prints; the verdicts are not looked at here."""
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout


def shares(rows, name):
    """[name, used] of every row that uses a bound, in order, three digits."""
    return [[name(row), float(f"{row['used']:.2e}")] for row in rows if "used" in row]


def measured():
    """What both commands tell, by the id of a claim and the name of a system; those that use no bound are left out."""
    claims, systems = (json.loads(output([PROGRAM, *COMMANDS[part]])) for part in ("claims", "systems"))
    by_claim = {claim["id"]: shares(claim["findings"], lambda row: row["name"]) for claim in claims}
    by_system = {system["name"]: shares(system["held_against"], lambda row: f"{row['against']}: {row['quantity']}")
                 for system in systems["systems"]}
    return [{name: rows for name, rows in part.items() if rows} for part in (by_claim, by_system)]


def document():
    """The file."""
    claims, systems = measured()
    return {
        "schema": "regression/1",
        "provenance": {
            "commit": output(["git", "rev-parse", "HEAD"]).strip(),
            "command": "python3 scripts/measure_regression.py",
            "asked": [" ".join(["moreau", *command]) for command in COMMANDS.values()],
            "moreau": output([PROGRAM, "--version"]).split()[-1],
            "processor": platform.machine(),
        },
        "claims": claims,
        "systems": systems,
    }


def text(value):
    """JSON with one line for each number."""
    lines = [f" {json.dumps(key)}: {json.dumps(value[key], ensure_ascii=False)}" for key in ("schema", "provenance")]
    for part in ("claims", "systems"):
        groups = []
        for name, rows in value[part].items():
            told = ",\n".join("   " + json.dumps(row, ensure_ascii=False) for row in rows)
            groups.append(f"  {json.dumps(name, ensure_ascii=False)}: [\n{told}\n  ]")
        lines.append(f" {json.dumps(part)}: {{\n" + ",\n".join(groups) + "\n }")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def main():
    """Write the file; exit code 1 if a command does not answer yes."""
    try:
        FILE.write_text(text(document()), encoding="utf-8")
    except subprocess.CalledProcessError as error:
        print(f"{' '.join(error.cmd)} ended with exit code {error.returncode}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
