#!/usr/bin/env python3
"""Solve every problem of a folder and write a page of what is proved of each answer.

For each file: `moreau solve` to 1e-8, then `moreau certify --prove` of its answer.  The page has
the largest residual of a contact relative to its scale, the proved backward error, the proved
distance from a solution or the reason why there is none, and what is known of other solutions.
"""

import argparse
import datetime
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent
ROOT = SCRIPTS.parent
ENDS = {".json", ".dat", ".hdf5", ".h5"}
EPILOG = """
examples:
  scripts/prove_files.py problems/ --out docs/benchmarks/public-files.md

exit status: 0 every problem is solved or proved to have no solution, 1 one is not, 2 wrong usage
"""
HEAD = """# Public files, with proofs

The 34 public test files of Siconos and FCLIB that [peers.md](peers.md) times (`public-files`, not part of the product), each solved by `auto` to 1e-8, and what `moreau certify --prove` proves of the
answer. Written by a script on {date} with `{version}`:

<!-- not run: the files are not part of the product -->
```sh
python3 scripts/prove_files.py problems/ --out docs/benchmarks/public-files.md
```

δ is the proved backward error: the answer is exact for a free velocity that differs by at most δ at a contact. The radius is the proved distance of u from that of a solution of the problem itself.

| file | contacts | residual | δ [m/s] | radius of u [m/s], or why there is none | other solutions |
|---|---|---|---|---|---|
"""


def options_of(words):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--moreau", type=Path, default=ROOT / "target" / "release" / "moreau")
    parser.add_argument("--out", type=Path, required=True, help="the page")
    return parser.parse_args(words)


def told(moreau, *words):
    """What a command of moreau says in JSON; an error's own words where it says nothing else."""
    done = subprocess.run([moreau, *map(str, words), "--format", "json"], capture_output=True,
                          text=True, check=False)
    if done.returncode == 2 or not done.stdout.strip():
        sys.exit(f"moreau {' '.join(map(str, words))}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def short(number):
    """Two digits are enough to compare."""
    return "–" if number is None else f"{number:.1e}"


def largest(residuals):
    """The largest residual of a contact, relative to its scale."""
    kinds = ("primal", "dual", "complementarity", "normal", "tangential", "velocity")
    return max(residuals[kind]["relative"] for kind in kinds if kind in residuals)


def near(proved):
    """The radius, or the reason why there is none."""
    exact = (proved.get("lcp") or {}).get("near") or {}
    if "slack_distance" in exact:
        return short(exact["slack_distance"]) + ", in " + exact["in"]
    forward = proved.get("forward")
    if forward is None:
        return "no proof is made"
    return short(forward["radius"]["velocity"]) if forward["proved"] else forward["reason"]


def others(proved):
    """What is known of all solutions."""
    lcp = proved.get("lcp")
    if lcp:
        count = {"one": "none", "several": f"{lcp.get('count', 'several')} in all"}
        return count.get(lcp["solutions"], lcp["solutions"]) + f": {lcp['why']}"
    solutions = proved.get("solutions") or {}
    if solutions.get("infeasible"):
        return "there is none: a witness in fractions"
    if solutions.get("all"):
        count = solutions["all"]["velocities"]
        return f"exactly {count} velocit{'y' if count == 1 else 'ies'}, by all patterns"
    if solutions.get("several"):
        return f"at least {solutions['several']['at_least']} velocities, of disjoint enclosures"
    if solutions:
        return {"solution": "none: ", "velocity": "none with another velocity: ",
                "unknown": "not known: "}[solutions["unique"]] + solutions["reason"]
    return "–"


def row(moreau, file, folder):
    """A line of the table, and whether the problem is decided."""
    answer = folder / "answer.json"
    solved = told(moreau, "solve", file, "--out", answer)
    proved = told(moreau, "certify", file, answer, "--prove")
    decided = proved["status"] == "solved" or bool(proved.get("no_solution"))
    backward = (proved.get("backward") or {}).get("velocity")
    cells = [f"`{file.name}`", solved["contacts"], short(largest(proved["residuals"])),
             short(backward), near(proved), others(proved)]
    return "| " + " | ".join(map(str, cells)) + " |", decided


def main(words):
    """Writes the page."""
    options = options_of(words)
    files = sorted((file for file in options.folder.iterdir() if file.suffix in ENDS),
                   key=lambda file: file.name.lower())
    if not files:
        sys.exit(f"{options.folder} has no file that moreau reads")
    version = subprocess.run([options.moreau, "--version"], capture_output=True, text=True,
                             check=True).stdout.strip()
    lines, undecided = [], []
    with tempfile.TemporaryDirectory() as folder:
        for number, file in enumerate(files, 1):
            print(f"{number} of {len(files)}: {file.name}", file=sys.stderr)
            line, decided = row(options.moreau, file, Path(folder))
            lines.append(line)
            undecided += [] if decided else [file.name]
    page = HEAD.format(date=datetime.date.today(), version=version) + "\n".join(lines) + "\n"
    options.out.write_text(page, encoding="utf-8")
    print(f"{len(files) - len(undecided)} of {len(files)} decided", *undecided, file=sys.stderr)
    return 1 if undecided else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
