"""Pinocchio's contact solvers; in the environment of scripts/requirements-pinocchio.txt.

They read one half of W: the parent gives a symmetric one.  A contact of Pinocchio has three rows,
(t₁, t₂, n); what is missing gets W = 1 and q = 0 and carries no impulse.
"""

import sys

_here = sys.path.pop(0)  # this file has the name of the package it needs
import numpy as np  # noqa: E402
import pinocchio as pin  # noqa: E402
sys.path.insert(0, _here)

from worker import serve  # noqa: E402

ITERATIONS = 1_000_000  # the parent's limit of time ends a solve before
NORMAL_LAST = [1, 2, 0]
ADMM = {"ADMM/osqp": ("OSQP", 0), "ADMM/spectral": ("SPECTRAL", 0), "ADMM/osqp+anderson": ("OSQP", 10)}
PGS = {"PGS": 1.0, "PGS/0.5": 0.5}


def load(path):
    """The settings for the problem of this file."""
    given = np.load(path)
    dimension, law, friction = int(given["dimension"]), str(given["law"]), given["friction"]
    places = [3 * contact + NORMAL_LAST.index(component)
              for contact in range(len(friction)) for component in range(dimension)]
    rows = 3 * len(friction)
    operator, free = np.eye(rows), np.zeros(rows)
    operator[np.ix_(places, places)] = given["operator"]
    free[places] = given["free"]
    models, data = _contacts(np.zeros_like(friction) if law == "frictionless" else friction)
    delassus = pin.DelassusOperatorDense(operator)

    def preparation(kind, change):
        def prepare(tolerance):
            settings, result, solver = kind[0](), kind[1](), kind[2](rows)
            settings.solve_ncp = law != "associated"
            settings.max_iterations = ITERATIONS
            settings.absolute_feasibility_tol = settings.absolute_complementarity_tol = tolerance
            settings.relative_feasibility_tol = settings.relative_complementarity_tol = 0.0
            change(settings)

            def solve():
                done = solver.solve(delassus, free, models, data, settings, result)
                return (result.retrieveConstraintImpulses()[places], result.iterations,
                        "" if done else "not converged")
            return solve
        return prepare

    admm = (pin.ADMMSolverSettings, pin.ADMMSolverResult, pin.ADMMConstraintSolver)
    pgs = (pin.PGSSolverSettings, pin.PGSSolverResult, pin.PGSConstraintSolver)
    made = {name: preparation(admm, _rule(*rule)) for name, rule in ADMM.items()}
    if law != "associated":  # its PGS has Coulomb's law alone
        made.update({name: preparation(pgs, _relaxation(value)) for name, value in PGS.items()})
    return made


def _rule(rule, capacity):
    def change(settings):
        settings.admm_update_rule = pin.ADMMUpdateRule.names[rule]
        settings.anderson_capacity = capacity
    return change


def _relaxation(value):
    def change(settings):
        settings.over_relaxation = value
    return change


def _contacts(friction):
    model = pin.Model()
    joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "body")
    models, data = pin.StdVec_ConstraintModel(), pin.StdVec_ConstraintData()
    for coefficient in friction:
        contact = pin.PointContactConstraintModel(model, joint)
        contact.setFriction(float(coefficient))
        models.append(pin.ConstraintModel(contact))
        data.append(models[-1].createData())
    return models, data


if __name__ == "__main__":
    serve(load)
