"""Event-driven motion of one body by Siconos: `EventDriven` with `LsodarOSI`, from `_siconos_steps`.

LSODAR integrates ẋ = f(x) until the gap has a root; there one problem gives the velocity after the
impact, and wherever a contact stays closed another one gives its force from the accelerations.

LSODAR keeps Siconos's own tolerances: 4.4.0 cannot be given two, for its `setTol` of scalars takes
the relative one for both.
"""

import siconos.kernel as kernel
import siconos.numerics as numerics

NON_SMOOTH = 2  # Siconos's type of an event that is no end of a time step


def run(request, body, law, relation):
    """{event_tolerance, times, impacts, positions, velocities, impulses, forces, integrator_steps}.

    The start, then one row per event, of which `impacts` tells whether it is an impact or the end of
    a time step; the steps are those that LSODAR has made since it was last started.  The event
    tolerance is the gap and the normal velocity that count as zero.
    """
    world = kernel.NonSmoothDynamicalSystem(0.0, request["duration"])
    world.insertDynamicalSystem(body)
    interaction = kernel.Interaction(law, relation)
    world.link(interaction, body)
    integrator = kernel.LsodarOSI()
    instants = kernel.TimeDiscretisation(0.0, request["time_step"])
    motion = kernel.EventDriven(world, instants)
    motion.insertIntegrator(integrator)
    problems = [kernel.LCP(numerics.SICONOS_LCP_LEMKE) for _ in range(2)]
    motion.insertNonSmoothProblem(problems[0], kernel.SICONOS_OSNSP_ED_IMPACT)
    motion.insertNonSmoothProblem(problems[1], kernel.SICONOS_OSNSP_ED_SMOOTH_ACC)
    motion.initialize()
    result = {"event_tolerance": motion.toleranceED(), "times": [0.0], "impacts": [False],
              "positions": [[float(body.q()[0])]], "velocities": [[float(body.velocity()[0])]],
              "impulses": [], "forces": [], "integrator_steps": []}
    while motion.hasNextEvent():
        motion.advanceToEvent()
        motion.processEvents()
        impact = motion.eventsManager().currentEvent().getType() == NON_SMOOTH
        result["times"].append(float(motion.startingTime()))
        result["impacts"].append(impact)
        result["positions"].append([float(body.q()[0])])
        result["velocities"].append([float(body.velocity()[0])])
        result["impulses"].append([float(interaction.lambda_(1)[0]) if impact else 0.0])
        result["forces"].append([float(interaction.lambda_(2)[0])])
        result["integrator_steps"].append(int(integrator.count_NST))
    return result
