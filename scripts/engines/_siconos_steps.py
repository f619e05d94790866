"""Steps of Siconos on small systems: `/usr/bin/python3 scripts/engines/_siconos_steps.py < runs.json`.

Reads runs {system, scheme, time_step, steps} on standard input and writes the states and
impulses after every step, with nothing between Siconos and the file: no shape, no collision
detection, a linear relation where the constraint is linear.

    system  {"kind": "ball", "mass", "gravity", "restitution"}                   q = height
            {"kind": "block", "mass", "gravity": [along, down], "friction", "restitution"}
                                                                                 q = (along, normal)
            {"kind": "puck", "mass", "gravity": [along, across, down], "friction", "restitution"}
                                                                                 q = (along, across, normal)
            {"kind": "chain", "masses", "radii", "restitution"}                  q = centres
            {"kind": "bead", "mass", "radius", "gravity", "restitution"}         q = (x, z)
            {"kind": "stop", "mass", "stiffness", "stop", "restitution"}         q = elongation
    scheme  {"class": name of Siconos's integrator, "theta"}; LsodarOSI: see `_siconos_events`

Solvers are direct ones, so that a step is exact to rounding: Lemke for normal impulses,
enumeration for planar friction and for the projection's mixed problem; for spatial friction
Newton's method on Alart and Curnier's function, until its residual is 1e-15.
"""

import json
import os
import subprocess
import sys

_here = sys.path.pop(0)  # siconos.py beside this file has the name of the package
import numpy as np  # noqa: E402
import siconos.kernel as kernel  # noqa: E402
import siconos.numerics as numerics  # noqa: E402
sys.path.insert(0, _here)

import _siconos_events  # noqa: E402

TOLERANCE = 1e-14  # m; when a projection ends
SPATIAL_TOLERANCE = 1e-15  # Siconos's residual of a spatial friction problem
FAR = 1e9  # s


class Circle(kernel.NewtonEuler1DR):
    """R − |q| of a point in the x-y plane."""

    def __init__(self, radius):
        super().__init__()
        self.radius = radius

    def computeh(self, _time, q, y):
        """Siconos asks for gap, contact points and normal; they are written in place."""
        distance = float(np.hypot(q[0], q[1]))
        self.pc1()[:] = [q[0], q[1], 0.0]
        self.pc2()[:] = [q[0] / distance * self.radius, q[1] / distance * self.radius, 0.0]
        self.nc()[:] = [-q[0] / distance, -q[1] / distance, 0.0]
        y[0] = self.radius - distance


def _lagrangian(start, mass, force):
    body = kernel.LagrangianLinearTIDS(start["position"], start["velocity"], np.diag(mass))
    body.setFExtPtr(list(force))
    return body


def _ball(system, start):
    body = _lagrangian(start, [system["mass"]], [-system["mass"] * system["gravity"]])
    law = kernel.NewtonImpactNSL(system["restitution"])
    return [body], [(law, kernel.LagrangianLinearTIR(np.array([[1.0]])), [body])]


def _block(system, start):
    mass, (along, down) = system["mass"], system["gravity"]
    body = _lagrangian(start, [mass, mass], [mass * along, -mass * down])
    law = kernel.NewtonImpactFrictionNSL(system["restitution"], 0.0, system["friction"], 2)
    relation = kernel.LagrangianLinearTIR(np.array([[0.0, 1.0], [1.0, 0.0]]))
    return [body], [(law, relation, [body])]


def _puck(system, start):
    mass, (along, across, down) = system["mass"], system["gravity"]
    body = _lagrangian(start, [mass] * 3, [mass * along, mass * across, -mass * down])
    law = kernel.NewtonImpactFrictionNSL(system["restitution"], 0.0, system["friction"], 3)
    rows = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    return [body], [(law, kernel.LagrangianLinearTIR(rows), [body])]


def _stop(system, start):
    body = _lagrangian(start, [system["mass"]], [0.0])
    body.setKPtr(np.array([[system["stiffness"]]]))
    law = kernel.NewtonImpactNSL(system["restitution"])
    relation = kernel.LagrangianLinearTIR(np.array([[1.0]]), [-system["stop"]])
    return [body], [(law, relation, [body])]


def _chain(system, start):
    bodies = [_lagrangian({key: [start[key][i]] for key in start}, [mass], [0.0])
              for i, mass in enumerate(system["masses"])]
    law = kernel.NewtonImpactNSL(system["restitution"])
    links = []
    for i, (left, right) in enumerate(zip(system["radii"], system["radii"][1:])):
        relation = kernel.LagrangianLinearTIR(np.array([[-1.0, 1.0]]), [-(left + right)])
        links.append((law, relation, bodies[i:i + 2]))
    return bodies, links


def _bead(system, start):
    (x, z), (vx, vz) = start["position"], start["velocity"]
    body = kernel.NewtonEulerDS([x, z, 0.0, 1.0, 0.0, 0.0, 0.0], [vx, vz, 0.0, 0.0, 0.0, 0.0],
                                system["mass"], np.eye(3))
    body.setFExtPtr([0.0, -system["mass"] * system["gravity"], 0.0])
    law = kernel.NewtonImpactNSL(system["restitution"])
    return [body], [(law, Circle(system["radius"]), [body])]


SYSTEMS = {"ball": _ball, "block": _block, "puck": _puck, "chain": _chain, "bead": _bead, "stop": _stop}
ROWS = {"block": 2, "puck": 3}


def _solver(rows):
    if rows == 1:
        return kernel.LCP(numerics.SICONOS_LCP_LEMKE)
    if rows == 2:
        return kernel.FrictionContact(2, numerics.SICONOS_FRICTION_2D_ENUM)
    options = kernel.solver_options_create(numerics.SICONOS_FRICTION_3D_NSN_AC)
    options.dparam[numerics.SICONOS_DPARAM_TOL] = SPATIAL_TOLERANCE
    return kernel.FrictionContact(3, options)


def _stepping(world, instants, integrator, rows, scheme):
    velocity = _solver(rows)
    if "Projection" not in scheme["class"]:
        return kernel.TimeStepping(world, instants, integrator, velocity), [velocity]
    position = kernel.MLCPProjectOnConstraints(numerics.SICONOS_MLCP_ENUM, 1.0)
    stepping = kernel.TimeSteppingCombinedProjection(world, instants, integrator, velocity,
                                                     position, 2)
    stepping.setProjectionMaxIteration(100)
    stepping.setConstraintTolUnilateral(TOLERANCE)
    stepping.setConstraintTol(TOLERANCE)
    return stepping, [velocity, position]


def run(request):
    """{positions, velocities, impulses}: the start, then one row per step."""
    system, scheme = request["system"], request["scheme"]
    bodies, links = SYSTEMS[system["kind"]](system, request["start"])
    if scheme["class"] == "LsodarOSI":
        return _siconos_events.run(request, bodies[0], *links[0][:2])
    world = kernel.NonSmoothDynamicalSystem(0.0, FAR)
    for body in bodies:
        world.insertDynamicalSystem(body)
    interactions = []
    for law, relation, linked in links:
        interactions.append(kernel.Interaction(law, relation))
        world.link(interactions[-1], *linked)
    integrator = getattr(kernel, scheme["class"])(scheme["theta"])
    instants = kernel.TimeDiscretisation(0.0, request["time_step"])
    stepping, kept = _stepping(world, instants, integrator,
                               ROWS.get(system["kind"], 1), scheme)
    flat = 2 if system["kind"] == "bead" else None

    def state():
        rates = [body.twist() if flat else body.velocity() for body in bodies]
        return ([float(x) for body in bodies for x in body.q()[:flat]],
                [float(x) for rate in rates for x in rate[:flat]])

    position, velocity = state()
    result = {"positions": [position], "velocities": [velocity], "impulses": []}
    for _ in range(request["steps"]):
        stepping.computeOneStep()
        position, velocity = state()
        result["positions"].append(position)
        result["velocities"].append(velocity)
        result["impulses"].append([float(r) for one in interactions for r in one.lambda_(1)])
        stepping.nextStep()
    del kept  # Siconos keeps references to what it is given
    return result


def version():
    """The version of the Debian package; its Python metadata name a later one than it holds."""
    asked = subprocess.run(["dpkg-query", "--show", "--showformat", "${Version}",
                            "python3-siconos"], capture_output=True, text=True)
    return asked.stdout.strip() or "unknown"


def main():
    """Siconos reports on standard output; the answer is written after it has been put back."""
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    answers = [run(request) for request in json.load(sys.stdin)]
    sys.stdout.flush()
    os.dup2(kept, 1)
    json.dump({"version": version(), "answers": answers}, sys.stdout, allow_nan=False)


if __name__ == "__main__":
    main()
