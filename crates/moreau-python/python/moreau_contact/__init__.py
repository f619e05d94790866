"""Certified contact problems, simulation, claims and the gate for simulators: the project moreau, from Python.

    import moreau_contact as mc

    answer = mc.solve(W, u_free, mu)          # impulses r [N·s] with u = W r + u_free, certified
    print(mc.certify(mc.Problem(W, u_free, mu), my_impulse))
    report = mc.gate(MyEngine)                # a simulator that is a Python class, through every check

All quantities are in SI units; rows stand contact by contact as normal, tangent₁, tangent₂. The package `moreau` of the
package index is another project, a conic optimiser; this one is imported as `moreau_contact`.
"""
import atexit

from . import _native
from ._api import certify, claims, scenes, simulate, solve, solvers, verify
from ._engine import serve
from ._errors import EngineError, FileError, InvalidInput, MoreauError, Rejected, SolverError, Unsupported, UnusualOperator
from ._gate import QUICK, SWEEP, checks, gate, protocol_check
from ._native import Certificate, Motion, Problem, Report, Solution, __version__, set_memory_limit

# a thread that is in a call when Python ends would end Python with it
atexit.register(_native.close)

__all__ = [
    "Certificate", "EngineError", "FileError", "InvalidInput", "MoreauError", "Motion", "Problem", "QUICK", "Rejected", "Report", "SWEEP",
    "Solution", "SolverError", "Unsupported", "UnusualOperator", "__version__", "certify", "checks", "claims", "gate", "protocol_check", "scenes", "serve",
    "set_memory_limit", "simulate", "solve", "solvers", "verify",
]
