#!/usr/bin/env python3
"""Time Siconos, Pinocchio and Clarabel beside `moreau` on the same contact problems, in one run.

Every solver works on one core, one after another, round after round; its least time counts.  A
peer's setting is asked for the accuracy, then for ever more, until its answer has

    ‖r − P_K(r − ŷ)‖ / ‖q‖ ≤ accuracy     (ρ = 1 kg, computed here from the file's own numbers)

and is timed with what it had to be asked for.  The virtual best peer takes, file by file, the
fastest setting of all peers that reaches the accuracy.  Pinocchio and Clarabel read one half of W
and get (W + Wᵀ)/2 where W is asymmetric by up to 1e-3, as in files with few digits: they are judged
by that problem, and marked; where it is more they are not asked.
"""

import argparse
import json
import os
import sys
import tempfile
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS))

from reference import environment  # noqa: E402

ROOT = SCRIPTS.parent
ENVIRONMENTS = ROOT / ".venv"
SYSTEM_PYTHON = Path("/usr/bin/python3")
ENDS = {".json", ".dat", ".hdf5", ".h5"}
EPILOG = """
examples:
  scripts/bench_peers.py problems/ --out docs/benchmarks/peers
  scripts/bench_peers.py pile.json --accuracy 1e-8 --peers siconos
  scripts/bench_peers.py problems/ --law associated --peers clarabel,pinocchio

Siconos is looked for in the system's own Python (Debian: python3-siconos); the others get an
environment below .venv.  exit status: 0 measured, 2 wrong usage or a peer is not there
"""


def options_of(words):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problems", nargs="+", type=Path, help="files that moreau reads, or folders")
    parser.add_argument("--accuracy", type=float, action="append", help="default: 1e-8 and 1e-12")
    parser.add_argument("--peers", default="siconos,pinocchio,clarabel")
    parser.add_argument("--solver", action="append", help="of moreau; default: auto")
    parser.add_argument("--law", choices=("associated", "coulomb"), help="in place of the files' own")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--repeat", type=float, default=0.1, help="time for one measurement [s]")
    parser.add_argument("--limit", type=float, default=20.0, help="longest solve [s]")
    parser.add_argument("--largest", type=int, default=6000, help="most rows for the dense peers")
    parser.add_argument("--core", type=int, default=max(os.sched_getaffinity(0)))
    parser.add_argument("--moreau", type=Path, default=ROOT / "target" / "release" / "moreau")
    parser.add_argument("--instructions", action="store_true",
                        help="count moreau's instructions by callgrind, too")
    parser.add_argument("--out", type=Path, help="write OUT.json and OUT.md")
    options = parser.parse_args(words)
    options.accuracy = options.accuracy or [1e-8, 1e-12]
    options.solver = options.solver or ["auto"]
    options.peers = options.peers.split(",") if options.peers else []
    # where a folder lies on this machine is no part of what is repeated
    shown = (Path(word).name if os.path.isabs(word) else word for word in words)
    options.command = " ".join(["scripts/bench_peers.py", *shown])
    return options


def files_of(given):
    """The problems of files and folders, in order."""
    files = []
    for path in given:
        files += sorted(file for file in path.iterdir() if file.suffix in ENDS) if path.is_dir() else [path]
    return files


def commands(names):
    """{peer: command of its worker}; raises NotInstalled."""
    found = {}
    for name in names:
        if name == "siconos":
            python = SYSTEM_PYTHON
        else:
            python = environment.python_of(name, SCRIPTS, ENVIRONMENTS,
                                           lambda line: print(line, file=sys.stderr))
        found[name] = [python, SCRIPTS / "peers" / f"{name}.py"]
    return found


def main(words=None):
    """Measure and write; the exit status."""
    words = sys.argv[1:] if words is None else words
    options = options_of(words)
    try:
        # numpy comes with the environment of a peer
        python = environment.python_of("clarabel", SCRIPTS, ENVIRONMENTS, lambda line: None)
        found = commands(options.peers)
    except environment.NotInstalled as problem:
        print(f"error: {problem}", file=sys.stderr)
        return 2
    if Path(sys.prefix).resolve() != (ENVIRONMENTS / "clarabel").resolve():
        os.execv(python, [str(python), __file__, *words])
    from peers import page, run
    with tempfile.TemporaryDirectory() as folder:
        report = run.measure(options, files_of(options.problems), found, Path(folder))
    if options.out is not None:
        options.out.parent.mkdir(parents=True, exist_ok=True)
        options.out.with_suffix(".json").write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
        options.out.with_suffix(".md").write_text(page.markdown(report), encoding="utf-8")
    print(page.markdown(report))
    return 0


if __name__ == "__main__":
    sys.exit(main())
