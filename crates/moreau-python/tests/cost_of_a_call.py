"""What Python adds to solving and certifying four contacts: at most 30 µs are asked.

    python crates/moreau-python/tests/cost_of_a_call.py

The compiled half repeats the same work in a loop of its own (`_native.seconds_of`); the difference per call is what conversion, checks of arguments and objects of
Python cost. Printed, and not a test: it is a time.
"""
import timeit

import moreau_contact as mc
import numpy as np
from moreau_contact import _native

ROUNDS, CALLS = 7, 2000


def box() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A box of 2 kg on four corners, pushed sideways: W, u_free, μ."""
    mass = np.diag([2.0, 2.0, 2.0, 0.05, 0.05, 0.05])
    corners = [(x, y, -0.1) for x in (-0.2, 0.2) for y in (-0.2, 0.2)]
    rows = np.vstack([[[0, 0, 1, y, -x, 0], [1, 0, 0, 0, z, -y], [0, 1, 0, -z, 0, x]] for x, y, z in corners])
    return rows @ np.linalg.inv(mass) @ rows.T, rows @ [1.0, 0, -0.0981, 0, 0, 0], np.full(4, 0.3)


def main() -> None:
    W, free, mu = box()
    problem = mc.Problem(W, free, mu)
    called = min(timeit.repeat(lambda: mc.solve(W, free, mu).certificate.is_solution, number=CALLS, repeat=ROUNDS)) / CALLS
    inside = min(_native.seconds_of(problem, CALLS) for _ in range(ROUNDS)) / CALLS
    print(f"solve and certify four contacts: {1e6 * called:.1f} µs from numpy, {1e6 * inside:.1f} µs in Rust: {1e6 * (called - inside):.1f} µs more (30 are asked)")


if __name__ == "__main__":
    main()
