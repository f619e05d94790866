"""Making one reference document through the protocol, with its provenance and sensitivity."""

import copy

from reference.compare import comparable, largest_changes
from reference.tolerance import PERTURBATION

SCRIPT_VERSION = 1


def ask(engine, job, scene, options):
    """The engine's own answer to a job."""
    fields = {"scene": scene, "time_step": job.time_step, "options": options}
    if job.is_dump:
        return engine.ask("dump", step=job.step, **fields)
    return engine.ask("simulate", sample_every=job.sample_every, **fields)


def steps_of(job, scene):
    """Steps the engine makes for the file."""
    return job.step + 1 if job.is_dump else round(scene["duration"] / job.time_step)


def document(engine, job, scene, description):
    """The document without its sensitivity: the engine's answer and where it comes from."""
    result = ask(engine, job, scene, job.options)
    result["provenance"] = {
        "script": "scripts/generate_references.py", "script_version": SCRIPT_VERSION,
        "engine": description["name"], "version": description["version"],
        "scene": f"scenes/{job.scene}.json", "config": job.config,
        "request": "dump" if job.is_dump else "simulate", "options": job.options,
        "time_step": job.time_step, "steps": steps_of(job, scene),
    }
    if job.is_dump:
        result["provenance"]["step"] = job.step
    else:
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
    def measure(other_scene, options):
        other = ask(engine, job, other_scene, options)
        return largest_changes(comparable(base), comparable(other))

    change = measure(perturbed(scene), job.options)
    stopping = change
    if job.engine == "mujoco":
        tolerance = job.options.get("tolerance", 1e-8)
        stopping = measure(scene, {**job.options, "tolerance": tolerance / 2})
    return {kind: [float(f"{change.get(kind, 0.0) / PERTURBATION:.2e}"),
                   float(f"{stopping.get(kind, 0.0):.2e}")]
            for kind in sorted(set(change) | set(stopping))}
