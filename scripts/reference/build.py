"""Making one reference document through the protocol, with its provenance and sensitivity."""

import copy

from reference.compare import comparable, largest_changes
from reference.plan import Solve
from reference.tolerance import PERTURBATION

SCRIPT_VERSION = 1
DIRECT = ("dart", "rapier")  # pivoting and a fixed number of sweeps: no stopping tolerance


def answer(engine, job, description):
    """The answer of a solver to a problem, and where it comes from."""
    return {"schema": "answer/1", "problem": job.problem,
            "answer": engine.ask("solve", problem=job.problem, options=job.options),
            "provenance": {
                "script": "scripts/generate_references.py", "script_version": SCRIPT_VERSION,
                "engine": description["name"], "version": description["version"],
                "request": "solve", "options": job.options, "steps": 1}}


def answer_sensitivity(engine, job, base):
    """{kind: [A, D]} of an answer: another free velocity, half the stopping tolerance."""
    def measure(problem, options):
        other = {**base, "problem": problem,
                 "answer": engine.ask("solve", problem=problem, options=options)}
        changes = largest_changes(comparable(base), comparable(other))
        return {kind: change for kind, change in changes.items() if kind.startswith("answer/")}

    moved = copy.deepcopy(job.problem)
    moved["free_velocity"] = [u + PERTURBATION for u in moved["free_velocity"]]
    tolerance = {"tolerance": job.options["tolerance"] / 2}
    return _pairs(measure(moved, job.options), measure(job.problem, {**job.options, **tolerance}))


def _pairs(change, stopping):
    """{kind: [A, D]} from the changes under the perturbation and under half the tolerance."""
    return {kind: [float(f"{change.get(kind, 0.0) / PERTURBATION:.2e}"),
                   float(f"{stopping.get(kind, 0.0):.2e}")]
            for kind in sorted(set(change) | set(stopping))}


def ask(engine, job, scene, options):
    """The engine's own answer to a job."""
    fields = {"scene": scene, "time_step": job.time_step, "options": options}
    if job.is_dump:
        return engine.ask("dump", step=job.step, **fields)
    if job.steps:
        return engine.ask("steps", steps=job.steps, **fields)
    if job.contacts:
        return engine.ask("geometry", steps=job.contacts, **fields)
    return engine.ask("simulate", sample_every=job.sample_every, **fields)


def steps_of(job, scene):
    """Steps the engine makes for the file."""
    if job.is_dump:
        return job.step + 1
    return job.steps or job.contacts or round(scene["duration"] / job.time_step)


def request_of(job):
    """The protocol's word for what a job asks."""
    if job.is_dump:
        return "dump"
    return "steps" if job.steps else "geometry" if job.contacts else "simulate"


def document(engine, job, scene, description):
    """The document without its sensitivity: the engine's answer and where it comes from."""
    if isinstance(job, Solve):
        return answer(engine, job, description)
    result = ask(engine, job, scene, job.options)
    result["provenance"] = {
        "script": "scripts/generate_references.py", "script_version": SCRIPT_VERSION,
        "engine": description["name"], "version": description["version"],
        "scene": f"scenes/{job.scene}.json", "config": job.config,
        "request": request_of(job), "options": job.options,
        "time_step": job.time_step, "steps": steps_of(job, scene),
    }
    if job.is_dump:
        result["provenance"]["step"] = job.step
    elif not (job.steps or job.contacts):
        result["provenance"]["sample_every"] = job.sample_every
    return result


def perturbed(scene):
    """The scene with every body moved and pushed by the perturbation, away from the ground."""
    scene = copy.deepcopy(scene)
    push = [1.0, 1.0, 1.0]
    for body in scene["bodies"]:
        for key in ("position", "linear_velocity", "angular_velocity"):
            body[key] = [x + PERTURBATION * p for x, p in zip(body[key], push)]
    return scene


def sensitivity(engine, job, scene, base):
    """{kind: [A, D]} of `reference.tolerance`."""
    if isinstance(job, Solve):
        return answer_sensitivity(engine, job, base)

    def measure(other_scene, options):
        other = ask(engine, job, other_scene, options)
        return largest_changes(comparable(base), comparable(other))

    change = measure(perturbed(scene), job.options)
    stopping = {} if job.engine in DIRECT else change
    if job.engine == "mujoco":
        tolerance = job.options.get("tolerance", 1e-8)
        stopping = measure(scene, {**job.options, "tolerance": tolerance / 2})
    return _pairs(change, stopping)
