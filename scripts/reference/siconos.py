"""Siconos's own steps on small systems: references/siconos.  Facts about its release: reference.siconos_package.

Siconos is a Debian package for the system's own Python, so it has no environment below `.venv/`
and no scene: scripts/engines/_siconos_steps.py drives it directly, and the program of
`reference.siconos_driver` where its Python lacks the class.  Its solvers here are direct
ones, and none of these motions amplifies an error: a number x after k steps of a regenerated run
may differ by

    64 ε max(1, |x|) (k + 1) ,

of an event-driven one by that times 1 + 1/|v| after the last impact: the instant of the next is the
error of the gap over the speed.
"""

import json
import re
import subprocess

from reference import documents, siconos_driver, siconos_package
from reference.siconos_package import PYTHON

EPSILON = 2.0 ** -52
FOLDER = "siconos"

SINE, COSINE = 0.34202014332566871, 0.93969262078590843  # of 20 degrees
GRAVITY = 9.81
MOREAU_JEAN = {"class": "MoreauJeanOSI", "theta": 0.5}
FULLY_IMPLICIT = {"class": "MoreauJeanOSI", "theta": 1.0}
PROJECTION = {"class": "MoreauJeanCombinedProjectionOSI", "theta": 0.5}
SCHATZMAN_PAOLI = {"class": "SchatzmanPaoliOSI", "theta": 0.5}
EXPLICIT_SCHATZMAN_PAOLI = {"class": "SchatzmanPaoliOSI", "theta": 0.0}
EVENT_DRIVEN = {"class": "LsodarOSI"}
ALPHA = {"class": "NewMarkAlphaOSI", "newton_tolerance": 1e-10, "event_tolerance": 1e-10}
NAMES = {"MoreauJeanOSI": "moreau-jean", "MoreauJeanCombinedProjectionOSI": "projection",
         "SchatzmanPaoliOSI": "schatzman-paoli", "LsodarOSI": "event-driven",
         "NewMarkAlphaOSI": "generalised-alpha"}


def _ball(restitution):
    return {"kind": "ball", "mass": 1.0, "gravity": GRAVITY, "restitution": restitution}


def _block(friction, restitution):
    return {"kind": "block", "mass": 1.0, "gravity": [GRAVITY * SINE, GRAVITY * COSINE],
            "friction": friction, "restitution": restitution}


def _puck(friction, restitution):
    return {"kind": "puck", "mass": 1.0, "gravity": [0.8 * GRAVITY * SINE, 0.6 * GRAVITY * SINE,
                                                     GRAVITY * COSINE],
            "friction": friction, "restitution": restitution}


def _spring(stiffness, damping, gravity, stop):
    return {"kind": "spring", "mass": 2.0, "stiffness": stiffness, "damping": damping,
            "gravity": gravity, "stop": stop, "restitution": 0.5}


def _stop(stop):
    return {"kind": "stop", "mass": 1.5, "stiffness": 6.0, "stop": stop, "restitution": 0.6}


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


LOW = {"position": [0.1], "velocity": [0.03]}
PUCK = {"position": [0.0, 0.0, 0.01], "velocity": [0.2, -0.4, -0.5]}
LAUNCHED = {"position": [1.0], "velocity": [0.7]}
STRETCHED = {"position": [1.0], "velocity": [0.0]}
NEAR_BEAD = {"position": [0.72, -0.64], "velocity": [1.6, 1.2]}


def _stepped():
    """(name, system, scheme, start, steps, h) of what goes on in steps."""
    yield from (
        ("ball", _ball(0.5), MOREAU_JEAN, BALL, 200, 0.01),
        ("ball_elastic", _ball(1.0), FULLY_IMPLICIT, BALL, 200, 0.01),
        ("block_slide", _block(0.3, 0.5), MOREAU_JEAN, BLOCK, 60, 0.01),
        ("block_stick", _block(0.5, 0.0), MOREAU_JEAN, BLOCK, 60, 0.01),
        ("cradle", _chain([1.0, 1.0, 1.0], 1.0), MOREAU_JEAN, CHAIN, 20, 0.01),
        ("chain", _chain([1.0, 2.0, 4.0], 0.5), MOREAU_JEAN, CHAIN, 20, 0.01),
        ("bead", _bead(0.0), MOREAU_JEAN, BEAD, 60, 0.01),
        ("bead_bounce", _bead(0.5), MOREAU_JEAN, BEAD, 40, 0.01),
        ("ball", _ball(0.5), PROJECTION, THROWN, 200, 0.01),
        ("ball_elastic", _ball(1.0), PROJECTION, THROWN, 500, 0.01),
        ("chain", _chain([1.0, 2.0, 4.0], 0.5), PROJECTION, CHAIN, 20, 0.01),
        ("bead", _bead(0.0), PROJECTION, BEAD, 60, 0.01))
    for h in (0.005, 0.001):
        yield "ball", _ball(0.5), MOREAU_JEAN, LOW, 80 if h == 0.005 else 400, h
        yield "block_slide", _block(0.3, 0.5), MOREAU_JEAN, BLOCK, 80, h
        yield "block_stick", _block(0.5, 0.0), MOREAU_JEAN, BLOCK, 80, h
        yield "cradle", _chain([1.0, 1.0, 1.0], 1.0), MOREAU_JEAN, CHAIN, 24 if h == 0.005 else 70, h
        yield "bead", _bead(0.0), MOREAU_JEAN, NEAR_BEAD, 80, h
    for h in (0.01, 0.005, 0.001):
        yield "puck_slide", _puck(0.3, 0.5), MOREAU_JEAN, PUCK, 80, h
        yield "puck_stick", _puck(0.5, 0.0), MOREAU_JEAN, PUCK, 80, h
    yield "ball", _ball(0.5), SCHATZMAN_PAOLI, THROWN, 160, 0.01
    yield "ball_lively", _ball(0.8), SCHATZMAN_PAOLI, LOW, 300, 0.001
    yield "stop", _stop(0.5), EXPLICIT_SCHATZMAN_PAOLI, STRETCHED, 200, 0.01
    yield "chain", _chain([1.0, 2.0, 4.0], 0.5), SCHATZMAN_PAOLI, CHAIN, 20, 0.01


def runs():
    """{path below references/: what is asked of Siconos}."""
    result = {}
    for name, system, scheme, start, steps, step in _stepped():
        result[f"{FOLDER}/{name}__{NAMES[scheme['class']]}__h{step:g}.json"] = {
            "system": system, "scheme": scheme, "start": start, "time_step": step, "steps": steps}
    for name, system, start, step, duration in (
            ("ball", _ball(0.5), BALL, 0.1, 1.6), ("ball_lively", _ball(0.8), THROWN, 0.25, 3.5),
            ("stop_below", _stop(-0.5), STRETCHED, 0.25, 12.0),
            ("stop_above", _stop(0.5), STRETCHED, 0.25, 4.0)):
        result[f"{FOLDER}/{name}__{NAMES[EVENT_DRIVEN['class']]}__h{step:g}.json"] = {
            "system": system, "scheme": EVENT_DRIVEN, "start": start, "time_step": step,
            "duration": duration}
    for name, system, radius, step, duration in (
            ("spring", _spring(52.0, 4.0, 0.0, -10.0), 0.8, 0.01, 1.0),
            ("spring_trapezoidal", _spring(52.0, 0.0, 0.0, -10.0), 1.0, 0.02, 2.0),
            ("spring_stiff", _spring(5e4, 0.0, 0.0, -10.0), 0.2, 0.05, 2.0),
            ("fall", _spring(0.0, 0.0, GRAVITY, 0.0), 0.8, 0.05, 1.0)):
        result[f"{FOLDER}/{name}__{NAMES[ALPHA['class']]}__h{step:g}.json"] = {
            "system": system, "scheme": {**ALPHA, "spectral_radius": radius}, "start": LAUNCHED,
            "time_step": step, "duration": duration}
    return result


def _ask(scripts, requests):
    done = subprocess.run([PYTHON, str(scripts / "engines" / "_siconos_steps.py")],
                          input=json.dumps(requests), capture_output=True, text=True)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or [f"ended with {done.returncode}"]
        raise OSError(lines[-1])
    return json.loads(done.stdout)


def _by_driver(request):
    return request["scheme"]["class"] in (siconos_driver.SCHATZMAN_PAOLI, siconos_driver.ALPHA)


def _answers(scripts, asked):
    """({path: answer}, version, {path: why there is none}); OSError if Siconos's Python is not there."""
    driven = [path for path in asked if _by_driver(asked[path])]
    stepped = [path for path in asked if path not in driven]
    reply = _ask(scripts, [asked[path] for path in stepped])
    answers = dict(zip(stepped, reply["answers"], strict=True))
    try:
        answers |= zip(driven, siconos_driver.ask(scripts, [asked[path] for path in driven]), strict=True)
    except (OSError, subprocess.CalledProcessError) as problem:
        return answers, reply["version"], dict.fromkeys(driven, str(problem))
    return answers, reply["version"], {}


def make(scripts):
    """({path: document} of every run, {path: why it was not run}, version); OSError if Siconos is not
    there."""
    asked, result = runs(), {}
    answers, version, not_run = _answers(scripts, asked)
    for path, answer in answers.items():
        if asked[path]["scheme"] == EVENT_DRIVEN:
            answer = {**_lsodar_tolerances(), **answer}
        result[path] = {"schema": f"siconos-{'events' if 'times' in answer else 'steps'}/1",
                        **asked[path], **answer, "provenance": {
                            "script": "scripts/generate_references.py", "engine": "siconos",
                            "version": version}}
    return result, not_run, version


def _lsodar_tolerances():
    """What LSODAR is started with, from the header that says so."""
    files = siconos_package.installed("libsiconos-kernel-dev")
    header = next((path for path in files if path.name == "LsodarOSI.hpp"), None)
    stated = dict(re.findall(r"#define ([AR])TOL_DEFAULT (\d+) \* MACHINE_PREC", header.read_text(encoding="utf-8")))
    return {"relative_tolerance": int(stated["R"]) * EPSILON, "absolute_tolerance": int(stated["A"]) * EPSILON}


ROWS = ("positions", "velocities", "impulses", "forces", "times")


def _rows(document):
    """(place, row, allowed) for every row of numbers that Siconos computed."""
    slowness, since = [], 1.0
    for velocity, impact in zip(document.get("velocities", []), document.get("impacts", [])):
        since = 1.0 + 1.0 / max(abs(velocity[0]), EPSILON) if impact else since
        slowness.append(since)
    for key in ROWS:
        for step, row in enumerate(document.get(key, [])):
            factor = slowness[min(step, len(slowness) - 1)] if slowness else 1.0
            yield f"{key}/{step}", row if isinstance(row, list) else [row], 64 * EPSILON * (step + 1) * factor


def differences(stored, fresh):
    """Messages for every place where two documents differ beyond rounding."""
    messages = [f"{key}: differs" for key in sorted(set(stored) | set(fresh))
                if key not in ROWS and stored.get(key) != fresh.get(key)]
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
    allowed = {place: bound for place, _, bound in _rows(fresh)}
    for key in ROWS:
        if key not in fresh:
            continue
        moved, last = json.loads(json.dumps(fresh)), len(fresh[key]) - 1
        number = fresh[key][last] if key == "times" else fresh[key][last][0]
        number += 10 * allowed[f"{key}/{last}"] * max(1.0, abs(number))
        moved[key][last] = number if key == "times" else [number, *fresh[key][last][1:]]
        if not differences(fresh, moved):
            messages.append(f"control: ten times the tolerance of {key} goes unnoticed")
    return messages


def write_or_check(run, scripts):
    """All documents of Siconos: written, or compared with the stored ones; OSError if it is not there.

    ({path: why it was not run}, how many were made.)
    """
    (made, not_run, version), root = make(scripts), run.options.references
    stored = {f"{FOLDER}/{path.name}" for path in (root / FOLDER).glob("*")}
    for path in sorted(stored - set(made) - set(not_run)):
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
    run.facts(siconos_package.PLACE, lambda: siconos_package.document(version))
    return not_run, len(made) + 1
