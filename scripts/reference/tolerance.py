"""How far a regenerated number may be from the stored one, and why.

Another processor rounds differently, and an iterative solver may then stop one sweep earlier or
later.  For every kind of number x of a file (positions, impulses, one array of a dump, …) with N
steps made,

    tolerance = 8 (A N ε s + D) + 64 ε max(s, max|x|).

A       amplification, measured when the file was made: the largest change of the kind when the
        initial position and velocity of every body change by δ = 1e-9 m and m/s, divided by δ.
N ε s   rounding: one unit ε = 2⁻⁵² per step of states of size s = 1 m, 1 m/s.
D       the engine's stopping tolerance.  MuJoCo: the largest change of the kind when the
        tolerance is halved for the whole run (0 when that changes no iteration).  Drake, whose
        tolerances Python cannot change: the whole change under δ, which is ten million times
        rounding and so changes the number of iterations in more steps than rounding can.
        DART and Rapier stop at no tolerance: 0.
8       headroom: A and D are measured on one perturbation each.
64 ε    forming the number itself, out of terms of size s: a velocity at rest, 1e-17 m/s, is the
        difference of two that are not.

Numbers of the scene, the options and the times are not computed by the engine: tolerance 0.
`checks` of a dump are residuals that the adapter holds to its own limits: tolerance 1e-5.
Iteration counts may differ by 2 or by what was measured with D.
A and D are stored in each file under `provenance.sensitivity` as {kind: [A, D]}.
"""

EPSILON = 2.0 ** -52
PERTURBATION = 1e-9
HEADROOM = 8.0

COMPUTED = ("bodies", "contacts", "problem", "answer", "native", "checks", "geometry", "end")
COUNTS = ("answer/iterations", "native/iterations")
CHECKS_TOLERANCE = 1e-5


def is_computed(kind):
    """Whether the numbers of this kind come out of the engine's computation."""
    return kind.split("/")[0] in COMPUTED and "/provenance" not in kind


def tolerances(values, sensitivity, steps):
    """{kind: tolerance} for `values` = {kind: numbers} of one file."""
    result = {}
    for kind, numbers in values.items():
        amplification, stopping = sensitivity.get(kind, (0.0, 0.0))
        size = max(1.0, *map(abs, numbers))
        if not is_computed(kind):
            result[kind] = 0.0
        elif kind.startswith("checks/"):
            result[kind] = CHECKS_TOLERANCE
        elif kind in COUNTS:
            result[kind] = 2.0 + stopping
        else:
            result[kind] = (HEADROOM * (amplification * steps * EPSILON + stopping)
                            + 64 * EPSILON * size)
    return result


# A file is worth storing when its tolerance is small against the largest number of the kind, or
# against the floor where a motion has come to rest (m, m/s, N s).
MEANINGFUL = {
    "bodies/position": (1e-3, 0.0), "bodies/linear_velocity": (0.05, 1e-2),
    "contacts/impulse": (0.05, 0.0), "answer/impulse": (0.05, 0.0),
}


def loose_kinds(values, allowed):
    """Messages for the kinds whose tolerance says nothing about the motion."""
    messages = []
    for kind, (ratio, floor) in MEANINGFUL.items():
        size = max([floor, *map(abs, values.get(kind, []))])
        if allowed.get(kind, 0.0) > ratio * size:
            messages.append(f"not reproducible: {kind} up to {size:.1e} has the tolerance "
                            f"{allowed[kind]:.1e}")
    return messages
