"""Siconos's own steps on small systems, and facts about its release: references/siconos, references/facts.

Siconos is a Debian package for the system's own Python, so it has no environment below `.venv/`
and no scene: scripts/engines/_siconos_steps.py drives it directly.  Its solvers here are direct
ones, and none of these motions amplifies an error: a number x after k steps of a regenerated run
may differ by

    64 ε max(1, |x|) (k + 1) .
"""

import json
import re
import subprocess
from pathlib import Path

from reference import documents

PYTHON = "/usr/bin/python3"
EPSILON = 2.0 ** -52
FOLDER, FACTS = "siconos", "facts/siconos.json"

SINE, COSINE = 0.34202014332566871, 0.93969262078590843  # of 20 degrees
GRAVITY = 9.81
MOREAU_JEAN = {"class": "MoreauJeanOSI", "theta": 0.5}
FULLY_IMPLICIT = {"class": "MoreauJeanOSI", "theta": 1.0}
PROJECTION = {"class": "MoreauJeanCombinedProjectionOSI", "theta": 0.5}
NAMES = {"MoreauJeanOSI": "moreau-jean", "MoreauJeanCombinedProjectionOSI": "projection"}


def _ball(restitution):
    return {"kind": "ball", "mass": 1.0, "gravity": GRAVITY, "restitution": restitution}


def _block(friction, restitution):
    return {"kind": "block", "mass": 1.0, "gravity": [GRAVITY * SINE, GRAVITY * COSINE],
            "friction": friction, "restitution": restitution}


def _chain(masses, restitution):
    return {"kind": "chain", "masses": masses, "radii": [0.1] * len(masses),
            "restitution": restitution}


def _bead(restitution):
    return {"kind": "bead", "mass": 1.0, "radius": 1.0, "gravity": GRAVITY,
            "restitution": restitution}


BALL = {"position": [1.0], "velocity": [0.0]}
# A ball that leaves the floor with a multiple of g h/2 comes back to it exactly at the end of a step,
# and rounding decides whether it has touched; with this start its velocities are never multiples.
THROWN = {"position": [1.0], "velocity": [0.03]}
BLOCK = {"position": [0.0, 0.01], "velocity": [0.3, -0.5]}
CHAIN = {"position": [0.0, 0.255, 0.455], "velocity": [1.0, 0.0, 0.0]}
BEAD = {"position": [0.3, -0.4], "velocity": [1.6, 1.2]}


def runs():
    """{path below references/: what is asked of Siconos}."""
    step, result = 0.01, {}
    for name, system, scheme, start, steps in (
            ("ball", _ball(0.5), MOREAU_JEAN, BALL, 200),
            ("ball_elastic", _ball(1.0), FULLY_IMPLICIT, BALL, 200),
            ("block_slide", _block(0.3, 0.5), MOREAU_JEAN, BLOCK, 60),
            ("block_stick", _block(0.5, 0.0), MOREAU_JEAN, BLOCK, 60),
            ("cradle", _chain([1.0, 1.0, 1.0], 1.0), MOREAU_JEAN, CHAIN, 20),
            ("chain", _chain([1.0, 2.0, 4.0], 0.5), MOREAU_JEAN, CHAIN, 20),
            ("bead", _bead(0.0), MOREAU_JEAN, BEAD, 60),
            ("bead_bounce", _bead(0.5), MOREAU_JEAN, BEAD, 40),
            ("ball", _ball(0.5), PROJECTION, THROWN, 200),
            ("ball_elastic", _ball(1.0), PROJECTION, THROWN, 500),
            ("chain", _chain([1.0, 2.0, 4.0], 0.5), PROJECTION, CHAIN, 20),
            ("bead", _bead(0.0), PROJECTION, BEAD, 60)):
        path = f"{FOLDER}/{name}__{NAMES[scheme['class']]}__h{step:g}.json"
        result[path] = {"system": system, "scheme": scheme, "start": start, "time_step": step,
                        "steps": steps}
    return result


def _ask(scripts, requests):
    done = subprocess.run([PYTHON, str(scripts / "engines" / "_siconos_steps.py")],
                          input=json.dumps(requests), capture_output=True, text=True)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or [f"ended with {done.returncode}"]
        raise OSError(lines[-1])
    return json.loads(done.stdout)


def make(scripts):
    """{path: document} of every run and of the facts; OSError if Siconos is not there."""
    asked = runs()
    reply = _ask(scripts, list(asked.values()))
    result = {}
    for (path, request), answer in zip(asked.items(), reply["answers"]):
        result[path] = {"schema": "siconos-steps/1", **request, **answer, "provenance": {
            "script": "scripts/generate_references.py", "engine": "siconos",
            "version": reply["version"]}}
    result[FACTS] = _facts(reply["version"])
    return result


HEADERS = re.compile(r"(\w*(?:OSI|NSL)|TimeStepping\w*|EventDriven)\.hpp$")
CLASSES = re.compile(r"\w*(?:OSI|NSL)|TimeStepping\w*|EventDriven")
SOURCES = re.compile(rb"(?:kernel/src/simulationTools/MoreauJean|numerics/src/FrictionContact/fc3d_n)\w*\.c(?:pp)?")
SOLVERS = re.compile(r"SICONOS_((?:GLOBAL_)?FRICTION_3D_(?!ONECONTACT)\w+)_STR")
ENTRIES = (b"gfc3d_IPM", b"gfc3d_ipm_set_default")  # gfc3d_ipm.c leaves its functions, but not its name
CITED = re.compile(r"\* (.*(?:Computer Methods|Lecture Notes|Projected event|sweeping process\.|contact dynamics method).*)")


def _installed(package):
    listed = subprocess.run(["dpkg", "-L", package], capture_output=True, text=True)
    if listed.returncode != 0:
        raise OSError(f"the Debian package {package} is not installed")
    return [Path(line) for line in listed.stdout.splitlines()]


def _facts(version):
    """What the Debian packages hold: headers, classes that Python shows, sources by the names that
    the compiler left in the libraries, solvers, and what the headers cite."""
    headers = [path for path in _installed("libsiconos-kernel-dev") if HEADERS.search(path.name)]
    library = b"".join(path.read_bytes() for package in ("libsiconos-kernel7", "libsiconos-numerics7")
                       for path in _installed(package) if ".so." in path.name and not path.is_symlink())
    shown = json.loads(subprocess.run(
        [PYTHON, "-c", "import json, siconos.kernel as k, siconos.numerics as n;"
         "print(json.dumps([dir(k), dir(n)]))"], capture_output=True, text=True).stdout)
    cited = {line.strip() for path in headers
             for line in CITED.findall(path.read_text(encoding="utf-8"))}
    return {
        "schema": "facts/1", "program": "siconos", "version": version,
        "headers": sorted({path.stem for path in headers}),
        "python": sorted(name for name in shown[0] if CLASSES.fullmatch(name)),
        "sources": sorted({name.decode() for name in SOURCES.findall(library)}),
        "functions": [name.decode() for name in ENTRIES if b"\0" + name + b"\0" in library],
        "solvers": sorted({match[1] for name in shown[1] if (match := SOLVERS.fullmatch(name))}),
        "cited": sorted(cited),
    }


def _rows(document):
    """(place, row, allowed) for every row of numbers that Siconos computed."""
    for key in ("positions", "velocities", "impulses"):
        for step, row in enumerate(document.get(key, [])):
            yield f"{key}/{step}", row, 64 * EPSILON * (step + 1)


def differences(stored, fresh):
    """Messages for every place where two documents differ beyond rounding."""
    rows = ("positions", "velocities", "impulses")
    messages = [f"{key}: differs" for key in sorted(set(stored) | set(fresh))
                if key not in rows and stored.get(key) != fresh.get(key)]
    old, new = list(_rows(stored)), list(_rows(fresh))
    if len(old) != len(new):
        return messages + [f"{len(old)} rows stored, {len(new)} made"]
    for (place, one, allowed), (_, other, _) in zip(old, new):
        if len(one) != len(other) or any(
                not abs(x - y) <= allowed * max(1.0, abs(x)) for x, y in zip(one, other)):
            messages.append(f"{place}: stored {one}, now {other}, relative tolerance {allowed:.1e}")
    return messages


def check(stored, fresh):
    """The differences; and, as a control, one number moved by ten times its tolerance must show."""
    messages = differences(stored, fresh)
    for key in ("positions", "velocities", "impulses"):
        if key not in fresh:
            continue
        moved = json.loads(json.dumps(fresh))
        moved[key][-1][0] += 640 * EPSILON * len(moved[key]) * max(1.0, abs(moved[key][-1][0]))
        if not differences(fresh, moved):
            messages.append(f"control: ten times the tolerance of {key} goes unnoticed")
    return messages


def write_or_check(run, scripts):
    """All documents of Siconos: written, or compared with the stored ones; OSError if it is not there."""
    made, root = make(scripts), run.options.references
    stored = {f"{FOLDER}/{path.name}" for path in (root / FOLDER).glob("*")}
    for path in sorted(stored - set(made)):
        run.fail(path, ["not in the plan; delete it or add it to the plan"])
    for path, fresh in made.items():
        if run.options.match not in path:
            continue
        if not run.options.check:
            documents.write(root / path, fresh)
        elif not (root / path).exists():
            run.fail(path, ["missing"])
            continue
        elif messages := check(documents.read(root / path), fresh):
            run.fail(path, messages)
        run.done += 1
    return len(made)
