#!/usr/bin/env python3
"""Run `moreau simulate` on generated scenes and count the steps and motions that went wrong.

Tumbling boxes: each scene is one random box of 1 kg thrown onto a rough floor, its seed is its name.
One row per scheme with the solver auto, and per solver of Coulomb's law with moreau-jean.
Thrown piles: five or eight boxes or plates that fall on each other, moreau-jean with auto.
Heavy on light: a box of 1 … 10⁸ kg rests or lands on a box of 1 kg, per solver with moreau-jean.
A run gained if its energy, measured from the floor, grew in one step by more than 0.1 % of the
initial energy, and ended higher if it ended with more than it began with.  Seconds are processor
seconds, so that two busy cores do not change them.  Needs the standard library and a Unix shell.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS))

from steps.runs import TIME_STEP, parallel, simulate, tally, verdict  # noqa: E402
from steps.scenes import HALF, heavy_on_light, thrown_pile, tumbling_box, write_scenes  # noqa: E402
from steps.tables import refused, report, show  # noqa: E402

ROOT = SCRIPTS.parent
EPILOG = """examples:
  python3 scripts/measure_steps.py
  python3 scripts/measure_steps.py --boxes 20 --schemes moreau-jean,stewart-trinkle --solvers auto
  python3 scripts/measure_steps.py --before old/moreau --markdown --json steps.json
  python3 scripts/measure_steps.py --boxes 1 --piles 0 --seed 17 --ratios none --keep scenes

exit status:
  0  nothing panics; with auto every step is accepted in time (a scheme may say that it cannot go on:
     exit code 2); moreau-jean with auto never fails or ends higher (a step may gain: Newton's e on
     the normal with friction has no bound below its own, which tests/random_scenes checks); heavy
     on light with auto is accepted up to a mass ratio of 10⁵, no box sinking by more than a tenth of its half extent
  1  otherwise; each reason is named with the seed of its scene
  2  wrong usage"""
COULOMB = ("auto", "pgs", "psor", "admm", "nonsmooth-newton", "sequential-impulses")
HEAVY_SOLVERS = ("auto", "pgs", "admm", "nonsmooth-newton", "psor")
RATIOS = tuple(10.0 ** k for k in range(9))
RATIO_LIMIT = 1e5  # up to here auto must be accepted
# A fall of 20 mm ends at 0.63 m/s, which is 3 mm in a step; two contacts lie under the heavy box.
SINK_LIMIT = 0.01  # [m]


def measure_boxes(options, folder):
    """The rows of the tumbling boxes, and those of the thrown piles."""
    rows = [(scheme, "auto") for scheme in options.schemes]
    rows += [("moreau-jean", solver) for solver in options.solvers if ("moreau-jean", solver) not in rows]
    boxes = measure(options, folder, tumbling_box, options.boxes, rows)
    piles = measure(options, folder, thrown_pile, options.piles, [("moreau-jean", "auto")])
    return boxes, [{**row, "motion": "pile"} for row in piles]


def measure(options, folder, scene, number, rows):
    """[{scheme, solver, binary: tally}] of these rows over so many scenes."""
    files, result = write_scenes(folder, {options.seed + k: scene(options.seed + k) for k in range(number)}), []
    for scheme, solver in rows if files else []:
        row = {"scheme": scheme, "solver": solver}
        for name, (binary, known) in options.binaries.items():
            if scheme in known["schemes"] and solver in known["solvers"]:
                print(f"{scene.__name__} {scheme} {solver} {name}", file=sys.stderr, flush=True)
                row[name] = tally(parallel(options.jobs, files, lambda file: simulate(
                    binary, file, scheme, solver, options.limit)))
        result.append(row)
    return result


def measure_heavy(options, folder):
    """[{solver, ratio, motion, binary: run}] over heavy on light."""
    cases = {(ratio, lands): heavy_on_light(ratio, lands) for lands in (False, True) for ratio in options.ratios}
    files, result = write_scenes(folder, cases), []
    for solver in [solver for solver in HEAVY_SOLVERS if solver in options.solvers]:
        rows = {key: {"solver": solver, "ratio": key[0], "motion": "lands" if key[1] else "rests"} for key in cases}
        for name, (binary, known) in options.binaries.items():
            if files and solver in known["solvers"]:
                print(f"heavy on light {solver} {name}", file=sys.stderr, flush=True)
                runs = parallel(options.jobs, files, lambda file: simulate(
                    binary, file, "moreau-jean", solver, options.limit,
                    folder / f"{file.stem}-{solver}-{name}-motion.json"))
                for key, run in runs.items():
                    rows[key][name] = {**run, "steps": verdict(run)}
        result += rows.values()
    return result


def earlier(parser, options):
    """The rows of an earlier measurement of the same scenes, by what they measured."""
    document = json.loads(options.before.read_text())
    same = {"seed": options.seed, "boxes": options.boxes, "piles": options.piles, "limit": options.limit, "time_step": TIME_STEP}
    for name in [name for name, value in same.items() if document.get(name) != value]:
        parser.error(f"{options.before} was measured with another {name}: {document.get(name)}, not {same[name]}")
    return {identity(row): row["after"] for row in document["tumbling"] + document["thrown_piles"] + document["heavy_on_light"] if "after" in row}


def identity(row):
    return tuple(row.get(key) for key in ("scheme", "solver", "ratio", "motion"))


def shortcomings(boxes, heavy, name="after"):
    """Every reason for exit status 1, as sentences."""
    result = []
    for row in [row for row in boxes if name in row and not refused(row[name])]:
        strict, auto = (row["scheme"], row["solver"]) == ("moreau-jean", "auto"), row["solver"] == "auto"
        for run in row[name]["bad"]:
            where = f"{'pile, ' if 'motion' in row else ''}{row['scheme']} {row['solver']} seed {run['seed']}"
            failed = run["failed"]
            if failed and (strict or failed.startswith(("panic", "signal")) or auto and not failed.startswith("exit code 2")):
                result.append(f"{where}: {failed}")
            elif run.get("rejected") and auto:
                result.append(f"{where}: {run['rejected']} steps rejected, worst {show(run['residual'])}")
            if strict and run.get("higher"):
                result.append(f"{where}: ends {run['change']:.2e} of its energy higher")
    for row in heavy:
        run = row.get(name)
        if run and row["solver"] == "auto" and row["ratio"] <= RATIO_LIMIT:
            where = f"heavy {row['motion']} on light, ratio {row['ratio']:.0e}, auto"
            if run["failed"] or run["rejected"]:
                result.append(f"{where}: {verdict(run)}")
            elif not run.get("lowest", -math.inf) >= HALF - SINK_LIMIT:
                result.append(f"{where}: a box sinks to {show(run.get('lowest'))} m")
    return result


def words(text):
    return [] if text == "none" else text.split(",")


def numbers(text):
    return [float(word) for word in words(text)]


def known_names(parser, binary):
    """Schemes and solvers that a program lists."""
    try:
        run = subprocess.run([str(binary), "simulate", "--list", "--format", "json"],
                             capture_output=True, text=True, check=True)
        return json.loads(run.stdout)
    except (OSError, subprocess.CalledProcessError, ValueError) as error:
        return parser.error(f"{binary} is no moreau: {error}; build it with cargo build --release")


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--moreau", type=pathlib.Path, metavar="BINARY", help="the program measured",
        default=os.environ.get("MOREAU", ROOT / "target" / "release" / "moreau"))
    add("--before", type=pathlib.Path, metavar="BINARY|FILE",
        help="an older program, or what --json wrote of it (.json), shown beside it")
    add("--boxes", type=int, default=100, metavar="N", help="tumbling boxes (100; 0: none)")
    add("--piles", type=int, default=10, metavar="N", help="thrown piles (10; 0: none)")
    add("--seed", type=int, default=0, help="seed of the first box and pile, the others count on (0)")
    add("--schemes", type=words, metavar="A,B", help="all that the program lists, or none")
    add("--solvers", type=words, metavar="A,B", help=f"with moreau-jean, or none ({','.join(COULOMB)})")
    add("--ratios", type=numbers, default=RATIOS, metavar="R,S", help="of heavy on light, or none (1 … 1e8)")
    add("--jobs", type=int, default=2, metavar="N", help="runs at a time (2)")
    add("--limit", type=int, default=60, metavar="SECONDS", help="processor seconds of a run (60)")
    add("--keep", type=pathlib.Path, metavar="FOLDER", help="write scenes and motions here and keep them")
    add("--json", type=pathlib.Path, metavar="FILE", help="write every count and every bad run")
    add("--markdown", action="store_true", help="print the tables as Markdown")
    options = parser.parse_args(arguments)
    known = known_names(parser, options.moreau)
    options.schemes = known["schemes"] if options.schemes is None else options.schemes
    options.solvers = [s for s in COULOMB if s in known["solvers"]] if options.solvers is None else options.solvers
    for kind in ("schemes", "solvers"):
        for name in [name for name in getattr(options, kind) if name not in known[kind]]:
            parser.error(f"{options.moreau} has no {name} among its {kind}: {', '.join(known[kind])}")
    if options.boxes < 0 or options.piles < 0 or options.jobs < 1 or options.limit < 1 or any(not r > 0 for r in options.ratios):
        parser.error("--boxes and --piles must be at least 0, --jobs and --limit at least 1, --ratios above 0")
    stored = options.before is not None and options.before.suffix == ".json"
    options.earlier = earlier(parser, options) if stored else {}
    runs_too = {"before": options.before} if options.before and not stored else {}
    options.binaries = {name: (binary, known_names(parser, binary)) for name, binary in runs_too.items()}
    options.binaries["after"] = (options.moreau, known)
    return options


def main(arguments=None):
    """Measure, print and judge; the exit status."""
    options = parse(arguments)
    with tempfile.TemporaryDirectory() as folder:
        folder = options.keep or pathlib.Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        (boxes, piles), heavy = measure_boxes(options, folder), measure_heavy(options, folder)
    for row in boxes + piles + heavy:
        row.update({"before": options.earlier[identity(row)]} if identity(row) in options.earlier else {})
    names = ["before", "after"] if options.before else ["after"]
    reasons = shortcomings(boxes + piles, heavy)
    print("\n".join(report(boxes, piles, heavy, names, options.markdown)))
    print("\n" + "\n".join([f"wrong: {reason}" for reason in reasons] or ["nothing wrong"]))
    if options.json:
        options.json.write_text(json.dumps({
            "seed": options.seed, "boxes": options.boxes, "piles": options.piles, "limit": options.limit,
            "time_step": TIME_STEP, "tumbling": boxes, "thrown_piles": piles, "heavy_on_light": heavy, "wrong": reasons}, indent=1) + "\n")
    return 1 if reasons else 0


if __name__ == "__main__":
    sys.exit(main())
