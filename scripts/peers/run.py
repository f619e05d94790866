"""The run: every problem converted once, every setting tried, the ones that reach the accuracy timed in turn."""

import json
import os
import platform
import subprocess
import sys
import time

import numpy as np

from . import arrays, statistics
from .client import Late, Worker, alone

ASKED = (1.0, 1e-2, 1e-4)
"""Shares of the accuracy that a peer is asked for, one after the other; its own residual is another than ours."""

LEAST = 1e-15
"""Nothing below rounding is asked for."""

SYMMETRIC = 1e-14
"""Share of max |W| below which W − Wᵀ is rounding."""

PATIENCE = 100.0
"""A peer's setting that takes this many times our time is given up: it can be the virtual best no more."""

LEAST_PATIENCE = 0.3
"""… but not before this time [s]."""

NEARLY = 1e-3
"""Share of max |W| up to which (W + Wᵀ)/2 passes for W: above it the other half is another problem."""


def measure(options, files, commands, folder):
    """The report of all files."""
    workers = {name: Worker(command, options.core) for name, command in commands.items()}
    problems = []
    try:
        for number, file in enumerate(files):
            print(f"[{number + 1}/{len(files)}] {file.name}", file=sys.stderr, flush=True)
            measured = _problem(options, file, workers, folder)
            if measured is not None:
                problems.append(measured)
    finally:
        for worker in workers.values():
            worker.end()
    report = {"schema": "peers/1", "date": time.strftime("%Y-%m-%d"), "machine": _machine(),
              "versions": _versions(options, commands), "command": options.command,
              "accuracies": options.accuracy, "rounds": options.rounds, "limit": options.limit,
              "patience": [PATIENCE, LEAST_PATIENCE],
              "problems": problems}
    report["summary"] = statistics.summary(report)
    return report


def _problem(options, file, workers, folder):
    given = folder / "problem.json"
    words = [options.moreau, "convert", file, "--out", given]
    done = subprocess.run([*words, *(["--law", options.law] if options.law else [])],
                          capture_output=True, text=True)
    if done.returncode != 0:
        print(f"  left out: {done.stderr.strip()}", file=sys.stderr)
        return None
    try:
        problem = arrays.read(given)
    except ValueError as reason:
        print(f"  left out: {reason}", file=sys.stderr)
        return None
    asymmetry = arrays.asymmetry(problem["operator"])
    entry = {"name": file.name, "contacts": len(problem["friction"]), "law": problem["law"],
             "rows": len(problem["free"]), "asymmetry": asymmetry, "results": []}
    if len(problem["free"]) == 0 or not np.any(problem["free"]):
        return None
    whole, half = folder / "whole.npz", folder / "half.npz"
    np.savez(whole, **problem)
    changed = asymmetry > SYMMETRIC
    symmetric = {**problem, "operator": (problem["operator"] + problem["operator"].T) / 2}
    np.savez(half, **symmetric)
    own = [_first(options, file, solver, accuracy, problem, folder)
           for accuracy in options.accuracy for solver in options.solver]
    candidates = []
    for name, worker in workers.items():
        if len(problem["free"]) > options.largest:
            continue
        symmetrised = changed and name != "siconos"
        if symmetrised and asymmetry > NEARLY:
            continue
        try:
            settings = worker.load(half if name != "siconos" else whole, options.limit)
        except Late:
            continue
        judged = symmetric if symmetrised else problem
        for accuracy in options.accuracy:
            limit = _limit(options, own, accuracy)
            for setting in settings:
                candidates.append(_tried(limit, name, worker, setting, accuracy, judged, symmetrised))
    entry["results"] = candidates + own
    _rounds(options, entry, workers, file, problem, folder)
    return entry


def _limit(options, own, accuracy):
    """How long a peer may take for one solve."""
    ours = [result["seconds"] for result in own if result["accuracy"] == accuracy and result["reached"]]
    return min(options.limit, max(LEAST_PATIENCE, PATIENCE * min(ours))) if ours else options.limit


def _tried(limit, peer, worker, setting, accuracy, judged, symmetrised):
    """The first of the tolerances with which the answer has the accuracy."""
    best = {"peer": peer, "setting": setting, "accuracy": accuracy, "symmetrised": symmetrised,
            "reached": False}
    for share in ASKED:
        asked = max(accuracy * share, LEAST)
        try:
            answer = worker.solve(setting, asked, 0.0, limit)
        except Late as late:
            return {**best, "note": best.get("note") or str(late)}
        if "error" in answer:
            return {**best, "note": answer["error"]}
        residual = arrays.natural_map(**_data(judged), impulse=answer["impulse"])
        best.update(asked=asked, residual=residual, seconds=answer["seconds"],
                    iterations=answer["iterations"], note=answer["note"], reached=residual <= accuracy)
        if best["reached"]:
            break
    return best


def _first(options, file, solver, accuracy, problem, folder):
    """The first of the tolerances with which our answer has the accuracy."""
    entry = {}
    for share in ASKED:
        entry = _moreau(options, file, solver, accuracy, max(accuracy * share, LEAST), problem, folder, 0.0)
        if entry["reached"] or "residual" not in entry:
            break
    return entry


def _bench(options, file, solver, tolerance):
    words = [options.moreau, "bench", file, "--solver", solver, "--tolerance", repr(tolerance), "--format", "json"]
    return [*words, *(["--law", options.law] if options.law else [])]


def _moreau(options, file, solver, accuracy, asked, problem, folder, repeat):
    entry = {"peer": "moreau", "setting": solver, "accuracy": accuracy, "asked": asked, "symmetrised": False,
             "reached": False}
    words = [*_bench(options, file, solver, asked), "--repeat", str(repeat), "--answers", folder / "answers"]
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=5 * options.limit,
                              preexec_fn=alone(options.core))
        run = json.loads(done.stdout)["runs"][0]
    except subprocess.TimeoutExpired:
        return {**entry, "note": f"more than {5 * options.limit:g} s"}
    except (ValueError, IndexError):
        return {**entry, "note": done.stderr.strip()}
    entry.update(seconds=run["seconds"], iterations=run["iterations"], note=run.get("failure") or "",
                 certified=run["solved"], relative=run["relative"], certifying=run["certifying"])
    if "answer" in run:
        answer = json.loads((folder / "answers" / run["answer"]).read_text(encoding="utf-8"))
        entry["residual"] = arrays.natural_map(**_data(problem), impulse=answer["impulse"])
        entry["reached"] = entry["residual"] <= accuracy
    return entry


def _rounds(options, entry, workers, file, problem, folder):
    """Every result that reached the accuracy, timed in turn; its least time and all of them."""
    timed = [result for result in entry["results"] if result["reached"]]
    for result in timed:
        result["times"] = []
    for _ in range(options.rounds):
        for result in timed:
            if result["peer"] == "moreau":
                again = _moreau(options, file, result["setting"], result["accuracy"], result["asked"],
                                problem, folder, options.repeat)
            else:
                try:
                    again = workers[result["peer"]].solve(result["setting"], result["asked"], options.repeat,
                                                          2 * options.limit)
                except Late:
                    continue
            if "seconds" in again:
                result["times"].append(again["seconds"])
                result["certifying"] = again.get("certifying", result.get("certifying"))
    for result in timed:
        result["seconds"] = min(result["times"] or [result["seconds"]])
    if options.instructions:
        for result in timed:
            if result["peer"] == "moreau":
                result["instructions"] = _instructions(options, file, result)


def _instructions(options, file, result):
    """Instructions of one solve by callgrind: those of two solves less those of one."""
    counts = []
    for solves in (1, 2):
        words = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null",
                 *_bench(options, file, result["setting"], result["asked"]), "--solves", str(solves)]
        done = subprocess.run(words, capture_output=True, text=True)
        lines = [line for line in done.stderr.splitlines() if "Collected" in line]
        if not lines:
            return None
        counts.append(int(lines[0].split(":")[1]))
    return counts[1] - counts[0]


def _data(problem):
    return {name: problem[name] for name in ("operator", "free", "friction", "dimension", "law")}


def _machine():
    processor = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo", encoding="utf-8")
                      if line.startswith("model name")), platform.processor())
    return {"processor": processor, "cores": os.cpu_count(), "system": platform.platform(), "load": os.getloadavg()[0]}


def _versions(options, commands):
    words = {"siconos": "import importlib.metadata as m, subprocess as s; "
                        "print(s.run(['dpkg-query','-W','-f','${Version}','python3-siconos'],capture_output=True,text=True).stdout)",
             "pinocchio": "import importlib.metadata as m; print(m.version('pin'))",
             "clarabel": "import importlib.metadata as m; print(m.version('clarabel'))"}
    found = {name: subprocess.run([command[0], "-c", words[name]], capture_output=True, text=True).stdout.strip()
             for name, command in commands.items()}
    own = subprocess.run([options.moreau, "--version"], capture_output=True, text=True).stdout.split()
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    return {**found, "moreau": " ".join([*own[1:], commit])}
