"""Which files exist: scene × engine configuration × time step, and which steps are dumped.

Trajectories are called `<scene>__<config>__h<step>.json`; a dump of the step from t = k h to
(k+1) h is called `<scene>__<config>__h<step>__step<k>.dump.json`, a motion with the contact points
of every step `<scene>__<config>__h<step>.steps.json`, the contact points alone of the first k
steps `<scene>__<config>__h<step>__contacts<k>.json`.  A solver's answer to a problem
is called `<problem>.json`.
"""

from dataclasses import dataclass, field

from reference.problems import all_problems

STEPS = (1e-2, 5e-3, 2e-3, 1e-3)


@dataclass(frozen=True)
class Job:
    """One reference file."""

    engine: str
    scene: str
    config: str
    time_step: float
    sample_every: int = 0
    step: int = -1
    steps: int = 0
    contacts: int = 0
    options: dict = field(default_factory=dict)

    @property
    def is_dump(self):
        """Whether the file holds one step instead of a motion."""
        return self.step >= 0

    @property
    def path(self):
        """Path below `references/`."""
        name = f"{self.scene}__{self.config}__h{self.time_step:g}"
        if self.is_dump:
            name += f"__step{self.step}.dump"
        elif self.steps:
            name += ".steps"
        if self.contacts:
            name += f"__contacts{self.contacts}"
        return f"{self.engine}/{name}.json"


@dataclass(frozen=True)
class Solve:
    """One reference file with a solver's answer to a contact problem of `reference.problems`."""

    engine: str
    problem: dict
    options: dict

    @property
    def path(self):
        """Path below `references/`."""
        return f"{self.engine}/{self.problem['name']}.json"


MUJOCO_SOLVERS = {
    f"{solver.lower()}-{cone}": {"solver": solver, "cone": cone}
    for solver in ("Newton", "CG", "PGS") for cone in ("elliptic", "pyramidal")
}
MUJOCO_NEWTON = ("newton-elliptic", "newton-pyramidal")
DRAKE = {name: {"approximation": name} for name in ("sap", "similar", "lagged", "tamsi")}
SAMPLE_INTERVAL = {"ball_drop": 1e-2, "ball_drop_elastic": 1e-2, "ball_rest": 2e-2,
                   "block_stick": 1e-2, "block_slide": 1e-2, "five_box_stack": 5e-2,
                   "box_tumble": 2e-2, "ball_spin": 2e-2, "ball_roll": 2e-2}
# The engine goes on until the cost falls by 1e-20 of the inertia: the gradient is below 1e-9 N.
CONVERGED_MUJOCO = {"tolerance": 1e-20}
REPLAYED_STEPS = 500


def _motion(engine, scene, config, options, time_step):
    every = round(SAMPLE_INTERVAL[scene] / time_step)
    return Job(engine, scene, config, time_step, sample_every=every, options=options)


# Every step is stored: one step from each state, through impacts too.
IMPACTS = (("ball_impact", (1e-3,)), ("block_impact", (1e-3,)), ("stack_landing", (5e-3, 2e-3)))


def _mujoco():
    for scene in ("ball_drop", "ball_drop_elastic", "ball_rest"):
        for config in MUJOCO_NEWTON:
            for h in STEPS:
                yield _motion("mujoco", scene, config, MUJOCO_SOLVERS[config], h)
    for scene in ("block_stick", "block_slide", "five_box_stack"):
        for config, options in MUJOCO_SOLVERS.items():
            for h in STEPS:
                yield _motion("mujoco", scene, config, options, h)
    elliptic = MUJOCO_SOLVERS["newton-elliptic"]
    for h in STEPS:
        yield _motion("mujoco", "block_stick", "newton-elliptic-impratio100",
                      {**elliptic, "impratio": 100.0}, h)
        yield _motion("mujoco", "block_stick", "newton-elliptic-solref2h",
                      {**elliptic, "solref": [2 * h, 1.0]}, h)
    for scene, step in (("block_stick", 20), ("block_slide", 100), ("five_box_stack", 8)):
        for config, options in MUJOCO_SOLVERS.items():
            yield Job("mujoco", scene, config, 2e-3, step=step, options=options)
    for cone in ("elliptic", "pyramidal"):
        config = f"pgs-{cone}"
        yield Job("mujoco", "five_box_stack", f"{config}-10sweeps", 2e-3, step=8,
                  options={**MUJOCO_SOLVERS[config], "iterations": 10})
    for config in MUJOCO_NEWTON:
        for scene, h, step in (("ball_rest", 1e-3, 900), ("block_stick", 2e-3, 400)):
            yield Job("mujoco", scene, config, h, step=step, options=MUJOCO_SOLVERS[config])


def _mujoco_converged():
    """Newton run to the end: motions, their contact points, and steps."""
    h = 2e-3
    for config in MUJOCO_NEWTON:
        options, name = {**MUJOCO_SOLVERS[config], **CONVERGED_MUJOCO}, f"{config}-converged"
        for scene in ("ball_drop", "block_stick", "block_slide", "five_box_stack", "box_tumble"):
            yield _motion("mujoco", scene, name, options, h)
        for scene, time_step, step in (
                ("ball_rest", 1e-3, 900), ("block_stick", h, 20), ("block_stick", h, 400),
                ("block_slide", h, 100), ("five_box_stack", h, 8)):
            yield Job("mujoco", scene, name, time_step, step=step, options=options)
        for scene in ("ball_drop", "block_slide"):
            yield Job("mujoco", scene, name, h, contacts=REPLAYED_STEPS, options=options)
        for integrator in ("implicitfast", "RK4"):
            for scene in ("ball_drop", "block_stick", "block_slide", "box_tumble"):
                yield _motion("mujoco", scene, f"{config}-{integrator.lower()}",
                              {**options, "integrator": integrator}, h)
        for scene, rotational in (("ball_spin", {"torsional": 0.01}),
                                  ("ball_roll", {"torsional": 0.01, "rolling": 0.01})):
            yield _motion("mujoco", scene, f"{config}-{list(rotational)[-1]}",
                          {**options, **rotational}, h)
    elliptic = {**MUJOCO_SOLVERS["newton-elliptic"], **CONVERGED_MUJOCO}
    for time_step in (1e-2, 5e-3, 1e-3):
        yield _motion("mujoco", "block_slide", "newton-elliptic-converged", elliptic, time_step)
    yield Job("mujoco", "five_box_stack", "newton-elliptic-converged", h, contacts=REPLAYED_STEPS,
              options=elliptic)


def _drake():
    for scene in ("ball_drop", "ball_rest", "block_stick", "block_slide", "five_box_stack"):
        for config, options in DRAKE.items():
            for h in STEPS:
                yield _motion("drake", scene, config, options, h)
    for h in STEPS[1:]:
        yield _motion("drake", "ball_drop_elastic", "lagged", DRAKE["lagged"], h)
    for scene, steps in IMPACTS:
        for config, options in DRAKE.items():
            for h in steps:
                yield Job("drake", scene, config, h, sample_every=1, options=options)
    for scene, h, step in (("ball_rest", 1e-3, 20), ("ball_rest", 1e-3, 900),
                           ("block_stick", 1e-3, 20), ("block_stick", 1e-3, 900),
                           ("block_stick", 1e-2, 90), ("block_slide", 1e-3, 300),
                           ("block_slide", 2e-3, 150)):
        yield Job("drake", scene, "sap", h, step=step, options=DRAKE["sap"])


CONVERGED = {"residual_threshold": 0.0, "iterations": 500}
BULLET = {
    "multi": CONVERGED,
    "rigid": {**CONVERGED, "maximal_coordinates": True, "rigid_ground": True},
    "box": {**CONVERGED, "ground_shape": "box"},
    "box-default": {"ground_shape": "box"},
}


def _bullet():
    for h in STEPS[:2]:
        for scene in ("ball_sunk", "ball_deep", "ball_bounce"):
            for config in ("multi", "rigid"):
                yield Job("bullet", scene, config, h, sample_every=1, options=BULLET[config])
        for scene in ("block_stick", "block_slide"):
            for config in ("box", "box-default"):
                yield Job("bullet", scene, config, h, sample_every=2, options=BULLET[config])


def _sweeps(count):
    return {"ground_shape": "box", "residual_threshold": 0.0, "iterations": count}


RIGID = {"ground_shape": "box", "maximal_coordinates": True, "rigid_ground": True}
BULLET_STEPS = (
    ("block_slide", "box-default", BULLET["box-default"], 1e-2, 100),
    ("block_slide", "box-default", BULLET["box-default"], 5e-3, 100),
    ("block_slide", "box-1-sweep", _sweeps(1), 1e-2, 20),
    ("block_slide", "box-5-sweeps", _sweeps(5), 1e-2, 20),
    ("block_stick", "box-default", BULLET["box-default"], 1e-2, 30),
    ("block_stick", "box-default", BULLET["box-default"], 5e-3, 30),
    ("block_stick", "rigid-cold", {**RIGID, "iterations": 3, "warm_starting_factor": 0.0}, 1e-2, 20),
    ("block_stick", "rigid-warm", {**RIGID, "iterations": 3, "warm_starting_factor": 0.85}, 1e-2, 20),
    ("block_oblique", "box-default", BULLET["box-default"], 5e-3, 40),
    ("block_oblique", "pyramid", {"ground_shape": "box", "cone_friction": False}, 5e-3, 40),
    ("block_oblique", "rigid", RIGID, 5e-3, 40),
    ("block_landing", "pyramid", {**BULLET["box"], "cone_friction": False}, 1e-2, 2),
    ("block_landing", "box", BULLET["box"], 1e-2, 2),
    ("ball_oblique", "pyramid", {"ground_shape": "box", "cone_friction": False}, 1e-2, 12),
)


def _bullet_steps():
    for scene, config, options, h, steps in BULLET_STEPS:
        yield Job("bullet", scene, config, h, steps=steps, options=options)


# Far below the default 1e-6 and 1e-10 of Pinocchio and of its adapter, so that the answer and not
# the stopping rule is stored; the relative rule would end an iteration that has not converged.
PINOCCHIO = {"tolerance": 1e-13, "relative_tolerance": 1e-16, "iterations": 200000}


def _pinocchio():
    for problem in all_problems().values():
        yield Solve("pinocchio", problem, PINOCCHIO)


DART = {"fcl": {}, "ode": {"collision_detector": "ode"}}  # FCL has one point between box and plane
SWEEPS = 50
RAPIER = {
    "default": {},
    "coulomb": {"friction_model": "Coulomb"},
    "sweeps": {"internal_pgs_iterations": SWEEPS, "stabilization_iterations": SWEEPS},
    "unpredicted": {"prediction_distance": 0.0},
}


def _every(scene, time_step):
    return round(SAMPLE_INTERVAL["five_box_stack"] / time_step) if scene == "five_box_stack" else 2


def _dart():
    for h in STEPS[:2]:
        for scene in ("ball_bounce", "ball_rest", "ball_sunk"):
            yield Job("dart", scene, "fcl", h, sample_every=1, options=DART["fcl"])
        for scene in ("block_stick", "block_slide", "five_box_stack"):
            yield Job("dart", scene, "ode", h, sample_every=_every(scene, h), options=DART["ode"])


def _rapier():
    for h in STEPS[:2]:
        for scene in ("ball_bounce", "ball_rest", "ball_sunk"):
            yield Job("rapier", scene, "default", h, sample_every=1, options=RAPIER["default"])
        for scene, configs in (("block_stick", ("default", "sweeps")),
                               ("block_slide", ("default", "sweeps", "coulomb")),
                               ("five_box_stack", ("default", "unpredicted"))):
            for config in configs:
                yield Job("rapier", scene, config, h, sample_every=_every(scene, h),
                          options=RAPIER[config])


# Motions that the engine itself does not reproduce when its stopping tolerance or the initial
# state changes by next to nothing (`tolerance.MEANINGFUL`); they would check nothing.
NOT_REPRODUCIBLE = {
    # The sliding block hops, and the solver's stopping error decides when.
    ("mujoco", "block_slide", "cg-elliptic", 1e-3),
    ("mujoco", "block_slide", "cg-pyramidal", 2e-3),
    ("mujoco", "block_slide", "pgs-elliptic", 1e-3),
    # The top of the stack tumbles at this step.
    *(("drake", "five_box_stack", config, 1e-2) for config in DRAKE),
    # DART's pivoting misses the solution of one step, rounding decides of which.
    ("dart", "five_box_stack", "ode", 5e-3),
    # Rapier's per-point friction turns the block, rounding decides to which side.
    ("rapier", "block_slide", "coulomb", 5e-3),
}


def all_jobs():
    """Every motion, step and answer, engine by engine; on facts see `reference.facts`."""
    engines = (*_mujoco(), *_mujoco_converged(), *_drake(), *_dart(), *_rapier())
    motions = [job for job in engines if job.is_dump or
               (job.engine, job.scene, job.config, job.time_step) not in NOT_REPRODUCIBLE]
    return [*motions, *_bullet(), *_bullet_steps(), *_pinocchio()]
