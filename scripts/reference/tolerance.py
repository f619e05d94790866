"""How far a regenerated number may be from the stored one, and why.

Another processor rounds differently, and an iterative solver may then stop one sweep earlier or
later.  For every kind of number x of a file (positions, impulses, one array of a dump, …) with N
steps made,

    tolerance = 8 [ A (N ε s + e_stop) + D ] + 64 ε max|x|.

A       amplification, measured when the file was made: the largest change of the kind when the
        initial position and velocity of every body change by δ = 1e-9 m and m/s, divided by δ.
N ε s   rounding: one unit ε = 2⁻⁵² per step of states of size s = 1 m, 1 m/s or larger.
e_stop  velocity by which one step changes when the solver makes one iteration more or less, once
        in the run (Drake, whose stopping tolerance Python cannot change): table `STOP`.
D       the engine's stopping tolerance, measured where it can be changed (MuJoCo): the largest
        change of the kind when the tolerance is halved for the whole run.  0 for solvers that
        make the same number of sweeps either way.
8       headroom: A and D are measured on one perturbation each.
64 ε    forming and storing the number itself.

Numbers of the scene, the options and the times are not computed by the engine: tolerance 0.
Iteration counts may differ by 2 or by what was measured with D.
A and D are stored in each file under `provenance.sensitivity` as {kind: [A, D]}.
"""

EPSILON = 2.0 ** -52
PERTURBATION = 1e-9
HEADROOM = 8.0

# Documented stopping criteria of the engine's solvers, as a velocity error [m/s].
STOP = {
    # SAP: relative tolerance 1e-6 on momentum; one step changes velocities by about g h ≤ 0.1 m/s.
    ("drake", "sap"): 1e-7,
    ("drake", "similar"): 1e-7,
    ("drake", "lagged"): 1e-7,
    # TAMSI: relative tolerance 1e-2 of the stiction tolerance, 1e-3 m/s unless declared.
    ("drake", "tamsi"): 1e-5,
}

COMPUTED = ("bodies", "contacts", "problem", "answer", "native", "checks")
COUNTS = ("answer/iterations", "native/iterations", "native/rebuilt_sweeps")


def is_computed(kind):
    """Whether the numbers of this kind come out of the engine's computation."""
    return kind.split("/")[0] in COMPUTED and "/provenance" not in kind


def tolerances(values, sensitivity, steps, engine, config):
    """{kind: tolerance} for `values` = {kind: numbers} of one file."""
    result = {}
    for kind, numbers in values.items():
        if not is_computed(kind):
            result[kind] = 0.0
            continue
        amplification, stopping = sensitivity.get(kind, (0.0, 0.0))
        size = max((abs(x) for x in numbers), default=0.0)
        if kind in COUNTS:
            result[kind] = 2.0 + stopping
            continue
        stop = STOP.get((engine, config), 0.0)
        result[kind] = (HEADROOM * (amplification * (steps * EPSILON + stop) + stopping)
                        + 64 * EPSILON * size)
    return result
