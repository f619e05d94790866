"""One run of `moreau simulate`, what it came to, and the counts over many runs."""

import concurrent.futures
import json
import math
import os
import subprocess
import tempfile

TIME_STEP = 0.005
GAIN_LIMIT = 1e-3  # of the initial energy, in one step
BAD = ("failed", "rejected", "gained", "higher")


def finite(value):
    return value if value is not None and math.isfinite(value) else math.inf


def failure(code, errors):
    """Why a run has no summary, in one line."""
    if code in (-9, -24):
        return "time limit"
    lines = [line.strip() for line in errors.splitlines() if line.strip()]
    if code < 0:
        return f"signal {-code}"
    if code == 101:
        place = next((k for k, line in enumerate(lines) if "panicked at" in line), None)
        return "panic" if place is None else "panic: " + " ".join(lines[place:place + 2])
    return f"exit code {code}: {lines[0] if lines else 'says nothing'}"


def judge(code, output, errors, seconds):
    """What one run came to: quantities, counts of steps (None: not reported) and verdicts."""
    try:
        summary = json.loads(output)
        value = {item["name"]: item["value"] for item in summary["quantities"]}
    except (ValueError, KeyError, TypeError):
        return {"seconds": seconds, "failed": failure(code, errors)}
    before, change = finite(value["initial energy"]), finite(value["energy change"])
    gain, steps = finite(value["largest energy gain in a step"]), summary.get("steps") or {}
    worst = steps.get("worst") or {}
    return {"seconds": seconds, "failed": None, "gain": gain / before, "change": change / before,
            "gained": gain > GAIN_LIMIT * before, "higher": change > 0,
            "rejected": steps.get("rejected"), "unconverged": steps.get("unconverged"),
            "residual": worst.get("relative"), "depth": finite(value["deepest penetration"])}


def verdict(run):
    """What became of the steps of a run, in words; None where the program does not say."""
    if run["failed"]:
        return run["failed"]
    return f"{run['rejected']} rejected" if run["rejected"] else None if run["rejected"] is None else "accepted"


def simulate(binary, file, scheme, solver, limit, out=None):
    """One run under a limit of processor seconds; with `out` also the lowest centre of a box."""
    command = ["sh", "-c", 'ulimit -t "$0"; exec "$@"', str(limit), str(binary), "simulate",
               "--scene", str(file), "--scheme", scheme, "--solver", solver,
               "--step", str(TIME_STEP), "--format", "json", *(["--out", str(out)] if out else [])]
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=errors)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0), errors.seek(0)
        run = judge(process.returncode, output.read(), errors.read(), usage.ru_utime + usage.ru_stime)
    if out and out.exists():
        bodies = json.loads(out.read_text())["bodies"]
        run["lowest"] = min(finite(x[2]) for body in bodies for x in body["position"])
    return run


def tally(runs):
    """The counts of one row; None where no run reports steps."""
    def seeds(kind):
        return [seed for seed, run in runs.items() if run.get(kind)]

    reported = [run for run in runs.values() if run.get("rejected") is not None]
    residuals = [run["residual"] for run in reported if run["residual"] is not None]
    return {"runs": len(runs), "gained": len(seeds("gained")), "higher": len(seeds("higher")),
            "rejected": len(seeds("rejected")) if reported else None,
            "unconverged": len(seeds("unconverged")) if reported else None,
            "failed": len(seeds("failed")), "residual": max(residuals, default=None),
            "seconds": sum(run["seconds"] for run in runs.values()),
            "bad": [{"seed": seed, **run} for seed, run in runs.items()
                    if any(run.get(kind) for kind in BAD)]}


def parallel(jobs, files, run):
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return dict(zip(files, pool.map(run, files.values())))
