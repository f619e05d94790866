"""Pinocchio's contact solvers behind the engine protocol: `python scripts/engines/pinocchio.py`.

Pinocchio is no simulator here; it solves one step's problem `contact-problem/1` and projects on
friction cones.  Its solvers look for impulses r with

    Coulomb, `solve_ncp`:       K_μ ∋ r ⟂ ŷ ∈ K_μ*,   y = (W + R) r + q,   ŷ = y + μ‖y_t‖ n,
    associated, otherwise:      the same without the correction μ‖y_t‖ n,

where q = u_free + shift.  Pinocchio orders a contact (t₁, t₂, n), the protocol (n, t₁, t₂).
Contacts with one or two rows get the missing tangents with W = 1 and q = 0: these carry no impulse,
whatever the law, so nothing is approximated.  The law `frictionless` is Coulomb's with μ = 0.

The solver `pgs` takes the residual of a contact when it has just been solved, before its neighbours
move on; where contacts are solved exactly one by one, it stops after the first sweep, converged by
its own account, whatever the others say.  With `over_relaxation` 0.5 a sweep leaves a residual.

Units: Pinocchio's own are those of W and q, so with velocities it returns impulses [N s].
"""

import sys

# This file has the name of the package it needs: look for the package without our own folder.
_here = sys.path.pop(0)
import numpy as np  # noqa: E402
import pinocchio as pin  # noqa: E402
sys.path.insert(0, _here)

import _problem  # noqa: E402
from _protocol import Unsupported, serve  # noqa: E402
from _settings import contact_model, in_force, options_of  # noqa: E402

# The last three are Pinocchio's own settings with its own defaults: how ADMM changes its penalty,
# how many iterates it accelerates with (0: none), and how far PGS goes towards its update.
OPTIONS = {"solver": ("admm", "pgs"), "tolerance": 1e-10, "relative_tolerance": 1e-13,
           "iterations": 20000, "admm_update_rule": ("osqp", "spectral", "linear", "constant"),
           "anderson_capacity": 0, "over_relaxation": 1.0}

SOLVERS = {
    "admm": (pin.ADMMConstraintSolver, pin.ADMMSolverSettings, pin.ADMMSolverResult),
    "pgs": (pin.PGSConstraintSolver, pin.PGSSolverSettings, pin.PGSSolverResult),
}

# `solve_ncp = False` changes nothing in the projected Gauss–Seidel solver: it keeps to Coulomb.
LAWS = {"admm": ["frictionless", "coulomb", "associated"], "pgs": ["frictionless", "coulomb"]}

ASYMMETRY = 1e-14
"""Share of max |W| below which W − Wᵀ is rounding."""

NORMAL_LAST = [1, 2, 0]
"""Component i of Pinocchio's contact is component NORMAL_LAST[i] of ours."""


def describe(request):
    """Name, version and contact model under the request's options."""
    values = in_force("pinocchio", {}, OPTIONS, request)
    return {
        "name": "pinocchio", "version": pin.__version__, "precision": "double",
        "contact_model": contact_model("rigid", "coulomb", {}, values),
        "restitution": False, "friction": "cone", "reports_contacts": False,
        "levels": ["solve", "project"], "laws": LAWS[values["solver"]],
        "options": options_of(OPTIONS, values),
    }


class Contacts:
    """Pinocchio's models of point contacts with these coefficients of friction.

    The models own the coefficients: a `CoulombFrictionCone` only refers to one, and one that is
    made from a Python number refers to memory that is gone.
    """

    def __init__(self, friction):
        model = pin.Model()
        joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "body")
        self.models, self.data = pin.StdVec_ConstraintModel(), pin.StdVec_ConstraintData()
        for coefficient in friction:
            contact = pin.PointContactConstraintModel(model, joint)
            contact.setFriction(coefficient)
            self.models.append(pin.ConstraintModel(contact))
            self.data.append(self.models[-1].createData())

    def cone(self, index):
        """The cone of one contact; valid as long as this object."""
        return self.models[index].extract().set(self.data[index].extract())


def _places(problem):
    """For every row of the problem, its row among Pinocchio's three per contact."""
    return [3 * contact + NORMAL_LAST.index(component)
            for contact in range(len(problem.friction)) for component in range(problem.dimension)]


def solve(request):
    """{problem, options} → solution/1."""
    options = in_force("pinocchio", {}, OPTIONS, request)
    problem = _problem.read(request["problem"])
    if problem.law not in LAWS[options["solver"]]:
        raise Unsupported(f"Pinocchio's solver {options['solver']} has no law {problem.law}")
    if not problem.friction:
        return problem.solution([], options["solver"], 0)
    contacts = Contacts([0.0 if problem.law == "frictionless" else mu for mu in problem.friction])
    places, rows = _places(problem), 3 * len(problem.friction)
    operator, free = np.eye(rows), np.zeros(rows)
    operator[np.ix_(places, places)] = problem.stiff_operator()
    if np.abs(operator - operator.T).max() > ASYMMETRY * np.abs(operator).max():
        raise Unsupported("W is not symmetric, and Pinocchio's solvers read one half of it")
    free[places] = problem.law_free_velocity()
    result = _run(options, problem.law != "associated", operator, free, contacts)
    impulse = result.retrieveConstraintImpulses()[places]
    return problem.solution(impulse, f"pinocchio {options['solver']}", result.iterations)


def _run(options, solve_ncp, operator, free, contacts):
    solver, make_settings, make_result = SOLVERS[options["solver"]]
    settings, result = make_settings(), make_result()
    settings.solve_ncp = solve_ncp
    settings.max_iterations = options["iterations"]
    settings.absolute_feasibility_tol = options["tolerance"]
    settings.absolute_complementarity_tol = options["tolerance"]
    # with a relative tolerance, iterates that move less than it count as converged, too
    settings.relative_feasibility_tol = options["relative_tolerance"]
    settings.relative_complementarity_tol = options["relative_tolerance"]
    if options["solver"] == "admm":
        settings.admm_update_rule = pin.ADMMUpdateRule.names[options["admm_update_rule"].upper()]
        settings.anderson_capacity = options["anderson_capacity"]
    else:
        settings.over_relaxation = options["over_relaxation"]
    converged = solver(len(free)).solve(pin.DelassusOperatorDense(operator), free, contacts.models,
                                        contacts.data, settings, result)
    if not converged:
        raise RuntimeError(
            f"{options['solver']} did not reach {options['tolerance']} in {result.iterations} "
            f"iterations: primal {result.primal_feasibility:.2e}, dual "
            f"{result.dual_feasibility:.2e}, complementarity {result.complementarity:.2e}")
    return result


def project(request):
    """{friction, points} → the points' projections on the cone ‖t‖ ≤ μ n."""
    in_force("pinocchio", {}, OPTIONS, request)
    contacts, points = Contacts([request["friction"]]), []
    cone = contacts.cone(0)
    for point in request["points"]:
        padded = np.array([*point, 0.0] if len(point) == 2 else point, dtype=float)
        projected = cone.project(padded[NORMAL_LAST])
        points.append([float(projected[NORMAL_LAST.index(i)]) for i in range(len(point))])
    return {"points": points}


if __name__ == "__main__":
    serve({"describe": describe, "solve": solve, "project": project})
