"""Siconos's SchatzmanPaoliOSI and NewMarkAlphaOSI, by a small C++ program: its Python has neither.

Needs g++ and the Debian package libsiconos-kernel-dev.  Schatzman and Paoli's scheme is in positions,

    M (q⁺ − 2q + q⁻) + h² K q = h² F + Cᵀ λ ,   0 ≤ λ ⟂ g(q⁺) + e g(q⁻) ≥ 0       (θ = 0 if K ≠ 0)

and starts with q₁ = q₀ + h v₀, without force or contact.  Siconos gives λ [N·s²] = h r and the
velocity (q⁺ − q⁻)/(2h).

NewMarkAlphaOSI is the generalised-α method of Siconos's event-driven strategy, not the nonsmooth
one.  Its runs end with their first impact, for what happens there in 4.4.0 is no impact law (see
references/README.md).
"""

import shutil
import subprocess
import tempfile
from pathlib import Path

HEADERS = Path("/usr/include/siconos")
PARTS = ("kernel", "numerics", "externals")
SCHATZMAN_PAOLI, ALPHA = "SchatzmanPaoliOSI", "NewMarkAlphaOSI"


def _linear(system):
    """(masses, K, F, C, b, e) of a system of `_siconos_steps.py`."""
    kind, e = system["kind"], system["restitution"]
    if kind == "ball":
        mass = system["mass"]
        return [mass], [0.0], [-mass * system["gravity"]], [1.0], [0.0], [e]
    if kind == "stop":
        return [system["mass"]], [system["stiffness"]], [0.0], [1.0], [-system["stop"]], [e]
    if kind == "chain":
        masses, radii = system["masses"], system["radii"]
        bodies, gaps = len(masses), len(masses) - 1
        rows = [float(j == i + 1) - float(j == i) for i in range(gaps) for j in range(bodies)]
        return (masses, [0.0] * bodies ** 2, [0.0] * bodies, rows,
                [-(radii[i] + radii[i + 1]) for i in range(gaps)], [e] * gaps)
    raise ValueError(f"no linear system: {kind}")


def _alpha_line(request):
    system, scheme, start = request["system"], request["scheme"], request["start"]
    numbers = [system["mass"], system["stiffness"], system["damping"], system["gravity"],
               system["stop"], system["restitution"], *start["position"], *start["velocity"],
               scheme["spectral_radius"], request["time_step"], request["duration"],
               scheme["newton_tolerance"], scheme["event_tolerance"]]
    return " ".join(map(repr, numbers))


def _lines(request):
    yield request["scheme"]["class"]
    if request["scheme"]["class"] == ALPHA:
        yield _alpha_line(request)
        return
    masses, *rest = _linear(request["system"])
    start = request["start"]
    head = [len(masses), len(rest[-1]), request["scheme"]["theta"], request["time_step"],
            request["steps"] - 1]
    for numbers in (head, masses, *rest, start["position"], start["velocity"]):
        yield " ".join(map(repr, numbers))


def _alpha_answer(text):
    """{times, impacts, positions, velocities, impulses} of one run: the start, then one row per event."""
    rows = [[float(word) for word in line.split()] for line in text.splitlines()]
    return {"times": [row[0] for row in rows], "impacts": [row[1] != 0.0 for row in rows],
            "positions": [[row[2]] for row in rows], "velocities": [[row[3]] for row in rows],
            "impulses": [[row[4]] for row in rows[1:]]}


def _answer(request, text):
    """{positions, velocities, impulses} of one run: the start, the first step, then one row per step."""
    if request["scheme"]["class"] == ALPHA:
        return _alpha_answer(text.strip())
    start, h = request["start"], request["time_step"]
    dof = len(start["position"])
    result = {"positions": [start["position"]], "velocities": [start["velocity"]], "impulses": []}
    for line in text.splitlines():
        numbers = [float(word) for word in line.split()]
        result["positions"].append(numbers[:dof])
        result["velocities"].append(numbers[dof:2 * dof])
        result["impulses"].append([multiplier / h for multiplier in numbers[2 * dof:]])
    return result


def ask(scripts, requests):
    """The answers of the program to all requests; OSError if it cannot be built or run."""
    if shutil.which("g++") is None or not (HEADERS / "kernel" / "SchatzmanPaoliOSI.hpp").exists():
        raise OSError("needs g++ and the Debian package libsiconos-kernel-dev")
    with tempfile.TemporaryDirectory() as folder:
        program, written = Path(folder) / "driver", Path(folder) / "answers"
        subprocess.run(["g++", "-std=c++17", "-w", f"-I{HEADERS}",
                        *(f"-I{HEADERS / part}" for part in PARTS),
                        str(scripts / "engines" / "siconos_driver" / "driver.cpp"), "-o", str(program),
                        *(f"-lsiconos_{part}" for part in PARTS)], check=True)
        asked = "\n".join(line for request in requests for line in _lines(request))
        done = subprocess.run([str(program), str(written)], input=asked, text=True,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        if done.returncode != 0:
            lines = done.stderr.strip().splitlines() or [f"ended with {done.returncode}"]
            raise OSError(lines[-1])
        texts = written.read_text(encoding="utf-8").split("\n\n")[:-1]
    return [_answer(request, text) for request, text in zip(requests, texts, strict=True)]
