"""Siconos behind the engine protocol: `/usr/bin/python3 scripts/engines/siconos.py`.

Siconos is the Debian package `python3-siconos` and needs the system's own Python.  Moreau–Jean
steps of Newton–Euler bodies, ν the linear and (body frame) angular velocities, H(q) of the contacts
whose gap g is forecast closed, g(q_k) + γ h u_n(ν_k) ≤ threshold:

    M (ν_{k+1} − ν_k) + h (gyroscopic terms at θ) = h F + Hᵀ r,
    q_{k+1} = q_k ⊕ h (θ ν_{k+1} + (1−θ) ν_k),
    K_μ ∋ r ⟂ ŷ ∈ K_μ*,   y = H ν_{k+1} + e u_n(ν_k) n,   ŷ = y + μ‖y_t‖ n.

Where bodies touch is computed by `_contact_points`, to rounding, and handed to Siconos as
relations; its own detector works in single precision.  The tangents are Siconos's own, which are
not orthogonal on most slopes; `contact_frame` "orthonormal" mends them.  An impulse r belongs to
(t_k, t_{k+1}].

Static bodies and those with a prescribed velocity have a boundary condition on all six velocities,
which takes their rows and columns out of M.  The prescribed spin is constant in the world and so in
the body frame.

`solve` hands a `contact-problem/1` to the same numerical solvers, W + R in place of W.
"""

import contextlib
import os
import subprocess
import sys

# This file has the name of the package it needs: look for the package without our own folder.
_here = sys.path.pop(0)
import numpy as np  # noqa: E402
import siconos.kernel as kernel  # noqa: E402
import siconos.numerics as numerics  # noqa: E402
sys.path.insert(0, _here)

import _problem  # noqa: E402
from _contact_points import rotation  # noqa: E402
from _protocol import Unsupported, serve  # noqa: E402
from _scene import (GROUND, initial_state, kind_of, pair_values, record,  # noqa: E402
                    require_declared, solid_inertia)
from _settings import contact_model, in_force, options_of  # noqa: E402
from _siconos_relations import OrthonormalTouch, Pair, Touch  # noqa: E402

SOLVERS = ("NSGS", "NSN_AC", "TFP", "PROX", "ACLMFP", "VI_EG", "VI_FPP", "ADMM")
"""Solvers of spatial problems that neither stop the process nor need another library."""

PLANAR_SOLVERS = ("NSGS", "LEMKE", "CPG")
"""LEMKE often reports success and a residual of order 1 at once, which is an error here."""

FRAMES = {"siconos": Touch, "orthonormal": OrthonormalTouch}

# Bodies that touch have gaps as small as rounding and the solver's tolerance make them.  With the
# threshold 0, Siconos's own, it takes them for open, and the bodies start to fall.
# The Newton loop of a step stops when what is left of the momentum equation is below its tolerance.
PARAMETERS = {"activation_threshold": (1e-9, "m"), "newton_tolerance": (1e-10, "N*s")}

# A step with a residual above `tolerance` is reported on standard error, one above
# `largest_residual`, Siconos's own tolerance, is an error.
OPTIONS = {
    "theta": 0.5, "gamma": 0.5, "contact_frame": tuple(FRAMES),
    "newton_iterations": 20,
    "solver": SOLVERS, "planar_solver": PLANAR_SOLVERS, "tolerance": 1e-10, "iterations": 200000,
    "largest_residual": 1e-4,
}


def _version():
    """The version of the Debian package; its Python metadata name a later one than it holds."""
    asked = subprocess.run(["dpkg-query", "--show", "--showformat", "${Version}",
                            "python3-siconos"], capture_output=True, text=True)
    return asked.stdout.strip() or "unknown"


def describe(request):
    """Name, version and contact model under the request's options."""
    values = in_force("siconos", PARAMETERS, OPTIONS, request)
    return {
        "name": "siconos", "version": _version(), "precision": "double",
        "contact_model": contact_model("rigid", "coulomb", PARAMETERS, values),
        "restitution": True, "friction": "cone", "reports_contacts": True,
        "levels": ["simulate", "solve"], "laws": ["coulomb"],
        "shapes": ["sphere", "box", "capsule", "cylinder"],
        "bodies": ["free", "static", "prescribed"],
        "options": options_of(OPTIONS, values),
    }


def _configured(options, values):
    """Siconos's options of a solver, with the iterations and the tolerance in force."""
    options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = values["iterations"]
    options.dparam[numerics.SICONOS_DPARAM_TOL] = values["tolerance"]
    return options


def _solver_number(name, dimension):
    return getattr(numerics, f"SICONOS_FRICTION_{dimension}D_{name}")


class World:
    """Bodies, relations and the time-stepping of a scene.

    Siconos keeps references to what it is given; everything is kept here as long as it steps.
    """

    def __init__(self, scene, time_step, values):
        self.time_step, self.touch = time_step, FRAMES[values["contact_frame"]]
        self.kept = []
        self.bodies = {body["name"]: self._body(scene, body) for body in scene["bodies"]}
        self.system = kernel.NonSmoothDynamicalSystem(0.0, 2.0 * scene["duration"] + 1.0)
        for body in self.bodies.values():
            self.system.insertDynamicalSystem(body)
        self.apart, self.touches = _pairs_with_laws(scene), []
        self.integrator = kernel.MoreauJeanOSI(values["theta"], values["gamma"])
        self.integrator.setConstraintActivationThreshold(values["activation_threshold"])
        self.values, self.unsolved = values, []
        self.solver = _configured(
            kernel.solver_options_create(_solver_number(values["solver"], 3)), values)
        self.problem = kernel.FrictionContact(3, self.solver)
        self.instants = kernel.TimeDiscretisation(0.0, time_step)
        self.stepping = kernel.TimeStepping(self.system, self.instants, self.integrator,
                                            self.problem)
        self.stepping.setNewtonOptions(kernel.SICONOS_TS_NONLINEAR)
        self.stepping.setNewtonMaxIteration(values["newton_iterations"])
        self.stepping.setNewtonTolerance(values["newton_tolerance"])

    def _body(self, scene, body):
        position, orientation, linear, angular = initial_state(body)
        twist = [*linear, *(_rotation(orientation).T @ angular)]
        free = kind_of(body) == "free"
        mass, inertia = (body["mass"], solid_inertia(body)) if free else (1.0, [1.0] * 3)
        system = kernel.NewtonEulerDS([*position, *orientation], twist, mass, np.diag(inertia))
        if free:
            system.setFExtPtr([mass * g for g in scene["gravity"]])
        else:
            self.kept.append(kernel.BoundaryCondition(list(range(6)), twist))
            system.setBoundaryConditions(self.kept[-1])
        return system

    def states(self):
        """(x, q, v, w) of every body; Siconos turns in the body frame."""
        for body in self.bodies.values():
            q, twist = body.q(), body.twist()
            yield q[:3], q[3:], twist[:3], _rotation(q[3:]) @ twist[3:]

    def step(self):
        """Make one step; its contact points with their impulses."""
        self.apart = [(pair, law) for pair, law in self.apart if not self._link(pair, law)]
        self.stepping.computeOneStep()
        self._check()
        points = [point for touch in self.touches for point in touch.impulse()]
        self.stepping.nextStep()
        return points

    def _link(self, pair, law):
        """Make a pair that comes close known, with one interaction for every point it may have."""
        bodies = [self.bodies[name] for name in (pair.a, pair.b) if name != GROUND]
        states = [(body.q().tolist(), body.twist().tolist()) for body in bodies]
        if not pair.could_touch(states, self.time_step):
            return False
        for slot in range(pair.slots):
            touch = self.touch(pair, slot)
            touch.interaction = kernel.Interaction(law, touch)
            self.stepping.link(touch.interaction, *bodies)
            self.touches.append(touch)
        return True

    def _check(self):
        """Notes a step that is not solved, as Siconos does; one that is far off is an error."""
        residual = float(self.solver.dparam[numerics.SICONOS_DPARAM_RESIDU])
        if self.problem.getSizeOutput() == 0 or residual <= self.values["tolerance"]:
            return
        self.unsolved.append(residual)
        if not residual <= self.values["largest_residual"]:
            raise RuntimeError(f"{self.values['solver']} left a residual of {residual:.2e} at "
                               f"t = {self.stepping.nextTime():.6g}")


def _pairs_with_laws(scene):
    """[(pair, law)], one law for each (friction, restitution)."""
    laws, restitutions, pairs = {}, pair_values(scene, "restitution"), []
    moved = {body["name"] for body in scene["bodies"] if kind_of(body) == "free"}
    for (b, a), friction in pair_values(scene, "friction").items():
        if not moved & {a, b}:
            continue
        key = (friction, restitutions[b, a])
        if key not in laws:
            laws[key] = kernel.NewtonImpactFrictionNSL(restitutions[b, a], 0.0, friction, 3)
        pairs.append((Pair(scene, a, b), laws[key]))
    return pairs


def _rotation(quaternion):
    return np.array(rotation([float(c) for c in quaternion]))


def simulate(request):
    """{scene, time_step, sample_every, options} → trajectory/1."""
    require_declared(describe(request), request["scene"])
    values = in_force("siconos", PARAMETERS, OPTIONS, request)
    with _silent_output():
        world = World(request["scene"], request["time_step"], values)
        engine = {"name": "siconos", "version": _version(), "options": values}
        trajectory = record(request, engine, world)
    if world.unsolved:
        print(f"{len(world.unsolved)} steps were left with residuals above {values['tolerance']}, "
              f"up to {max(world.unsolved):.2e}", file=sys.stderr)
    return trajectory


@contextlib.contextmanager
def _silent_output():
    """Throws away standard output: Siconos reports there whenever it copies a vector."""
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


def solve(request):
    """{problem, options} → solution/1."""
    values, problem = in_force("siconos", PARAMETERS, OPTIONS, request), _problem.read(request["problem"])
    if problem.law != "coulomb" or problem.dimension == 1:
        raise Unsupported(f"the law {problem.law} in dimension {problem.dimension}; Siconos's "
                          "drivers take Coulomb's in dimension 2 and 3")
    name = values["solver" if problem.dimension == 3 else "planar_solver"]
    if not problem.friction:
        return problem.solution([], name, 0)
    options = _configured(numerics.SolverOptions(_solver_number(name, problem.dimension)), values)
    impulse, velocity = np.zeros(problem.rows), np.zeros(problem.rows)
    driver = numerics.fc3d_driver if problem.dimension == 3 else numerics.fc2d_driver
    failed = driver(
        numerics.FrictionContactProblem(
            problem.dimension, len(problem.friction), np.array(problem.stiff_operator()),
            np.array(problem.law_free_velocity()), np.array(problem.friction)),
        impulse, velocity, options)
    residual = options.dparam[numerics.SICONOS_DPARAM_RESIDU]
    iterations = options.iparam[numerics.SICONOS_IPARAM_ITER_DONE]
    if failed or not residual <= values["tolerance"]:
        raise RuntimeError(f"{name} ended with information {failed} after {iterations} "
                           f"iterations, residual {residual:.2e}")
    return problem.solution(impulse, f"siconos {name}", iterations)


if __name__ == "__main__":
    serve({"describe": describe, "simulate": simulate, "solve": solve})
