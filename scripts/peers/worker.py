"""The loop of a worker: one process for each peer, which stays alive while problems are timed.

A line of JSON in, a line of JSON out:

    {"load": "problem.npz"}                              → {"settings": [name, …]}
    {"setting": name, "tolerance": t, "repeat": s}       → {"seconds", "impulse", "iterations", "note"}

or {"error": why}.  `seconds` is the least time of one solve among those that fit into `repeat`
seconds, at least one; what a solver is given is made before the clock starts.
"""

import json
import os
import sys
import time


def serve(load):
    """Answer requests until standard input ends.

    `load(path)` gives {name: prepare}; `prepare(tolerance)` gives a function without arguments that
    solves once and returns (impulse, iterations, note).
    """
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # solvers print there
    settings = {}
    for line in sys.stdin:
        request = json.loads(line)
        try:
            if "load" in request:
                settings = load(request["load"])
                answer = {"settings": list(settings)}
            else:
                answer = _timed(settings[request["setting"]], request["tolerance"], request["repeat"])
        except Exception as problem:  # whatever a peer raises is its answer
            answer = {"error": f"{type(problem).__name__}: {problem}"}
        print(json.dumps(answer), file=answers, flush=True)


def _timed(prepare, tolerance, repeat):
    begun, least, repeats = time.perf_counter(), float("inf"), 0
    while True:
        solve = prepare(tolerance)
        start = time.perf_counter()
        impulse, iterations, note = solve()
        least, repeats = min(least, time.perf_counter() - start), repeats + 1
        if time.perf_counter() - begun >= repeat:
            break
    return {"seconds": least, "repeats": repeats, "impulse": [float(r) for r in impulse],
            "iterations": int(iterations), "note": note}
