"""What the pinned packages themselves hold: names of files, lines of source, default settings.

Of Pinocchio the wheel in its environment is asked, whose files include the headers, and of DART its
wheel, which has no sources but tells its defaults.  Bullet's wheel has no sources either, so its
source distribution is downloaded with pip, once, and read unpacked.  Cargo keeps Rapier's sources.
All of it is `stated` in the sense of reference.facts.
"""

import json
import re
import subprocess
import tarfile
from pathlib import Path

from reference import facts

# engine → (package, what is read, names of files, expressions whose lines are kept)
SUBJECTS = {
    "pinocchio": ("libpinocchio", "wheel", (r"/admm-solver\.h(pp|xx)$", r"/pgs-solver\.h(pp|xx)$",
                                            r"/contact-cholesky\.h(pp|xx)$"), {}),
    "bullet": ("pybullet", "source distribution", (
        r"/btSequentialImpulseConstraintSolver\.(cpp|h)$", r"/btMultiBodyConstraintSolver\.(cpp|h)$",
        r"/bt(MLCP|Dantzig|Lemke)Solver\.(cpp|h)$"), {
            r"/btContactSolverInfo\.h$": r"m_(timeStep|numIterations|erp2|linearSlop|"
                                         r"restitutionVelocityThreshold|"
                                         r"splitImpulsePenetrationThreshold) = ",
            r"/PhysicsServerCommandProcessor\.cpp$": r"getSolverInfo\(\)\.m_(erp2|linearSlop|"
                                                     r"numIterations) = [0-9]",
            r"/bt(SequentialImpulse|MultiBody)ConstraintSolver\.cpp$":
                r"velocityError = restitution - rel_vel;"}),
    "dart": ("dartpy", "wheel", (r"^tests/unit/constraint/test_", r"\.dist-info/licenses/"), {}),
    "rapier": ("rapier3d-f64", "crate", (
        r"/solver/(velocity_solver|staged_island_solver/solve)\.rs$",
        r"/contact_constraint/contact_with_(coulomb|twist)_friction\.rs$"), {
            r"/dynamics/integration_parameters\.rs$":
                r"(natural_frequency|damping_ratio): N::splat|"
                r"(num_\w+_iterations|normalized_\w+|warmstart_coefficient): [0-9]"}),
}

ASK_WHEEL = """
import importlib.metadata, json, sys
package = importlib.metadata.distribution(sys.argv[1])
print(json.dumps([package.version, [str(file) for file in package.files]]))
"""

ASK_PINOCCHIO = """
import json, pinocchio
settings = pinocchio.ADMMSolverSettings()
print(json.dumps({"solve_ncp": settings.solve_ncp, "mu_prox": settings.mu_prox,
                  "admm_update_rule": str(settings.admm_update_rule).lower().split(".")[-1]}))
"""

ASK_DART = """
import dartpy, json
world = dartpy.simulation.World()
solver = world.getConstraintSolver()
node = dartpy.dynamics.Skeleton("").createFreeJointAndBodyNodePair()[1]
shape = node.createShapeNode(dartpy.dynamics.SphereShape(1.0))
shape.createDynamicsAspect()
surface = shape.getDynamicsAspect()
print(json.dumps({"time_step": world.getTimeStep(),
                  "solver": type(solver.getBoxedLcpSolver()).__name__,
                  "collision_detector": solver.getCollisionDetector().getType(),
                  "split_impulse": solver.isSplitImpulseEnabled(),
                  "friction": surface.getFrictionCoeff(),
                  "restitution": surface.getRestitutionCoeff()}))
"""
ASK = {"pinocchio": ASK_PINOCCHIO, "dart": ASK_DART}


def _run(program, *arguments):
    done = subprocess.run([str(program), *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise ValueError((done.stderr or done.stdout).strip().splitlines()[-1])
    return done.stdout


def _source(python, package, root):
    """(version, archive) of the source distribution with the version of the installed package."""
    version = json.loads(_run(python, "-c", ASK_WHEEL, package))[0]
    folder = root / f"{package}-{version}-source"
    archive = folder / f"{package}-{version}.tar.gz"
    if not archive.exists():
        _run(python, "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--no-deps",
             "--no-binary", package, "--dest", str(folder), f"{package}=={version}")
    return version, archive


def _archive(archive, patterns):
    """(names, texts of those that a pattern looks into) of an archive."""
    texts = {}
    with tarfile.open(archive) as tar:
        for member in tar.getmembers():
            if member.isfile() and any(re.search(name, member.name) for name in patterns):
                texts[member.name] = tar.extractfile(member).read().decode("utf-8", "replace")
        return tar.getnames(), texts


def _crate(name, patterns):
    """(version, names, texts of those that a pattern looks into) of the source that cargo keeps."""
    manifest = Path(__file__).resolve().parents[1] / "engines" / "rapier" / "Cargo.toml"
    told = json.loads(_run("cargo", "metadata", "--format-version", "1", "--locked", "--manifest-path",
                           str(manifest)))
    crate = next(one for one in told["packages"] if one["name"] == name)
    root = Path(crate["manifest_path"]).parent
    files = {f"{root.name}/{path.relative_to(root).as_posix()}": path
             for path in root.rglob("*") if path.is_file()}
    texts = {file: path.read_text(encoding="utf-8") for file, path in files.items()
             if any(re.search(pattern, file) for pattern in patterns)}
    return crate["version"], list(files), texts


def _lines(texts, patterns):
    """[{file, text}] of the lines that the patterns ask for, in the order of the files' names."""
    return [{"file": file, "text": part.split("//")[0].strip()}
            for file, text in sorted(texts.items())
            for name, line in patterns.items() if re.search(name, file)
            for part in text.splitlines() if re.search(line, part)]


def place(engine):
    """Path of the document below `references/`."""
    return f"{engine}/package.json"


def package(engine, command):
    """The document of an engine whose adapter is started by the command, see reference.facts."""
    name, kind, names, patterns = SUBJECTS[engine]
    settings, texts = {}, {}
    if kind == "wheel":
        version, files = json.loads(_run(command[0], "-c", ASK_WHEEL, name))
        settings = json.loads(_run(command[0], "-c", ASK[engine]))
    elif kind == "crate":
        version, files, texts = _crate(name, patterns)
    else:
        version, archive = _source(command[0], name, Path(command[0]).parents[2])
        files, texts = _archive(archive, patterns)
    kept = sorted(file for file in files if any(re.search(pattern, file) for pattern in names))
    stated = {"files": kept, "lines": _lines(texts, patterns), "settings": settings}
    return facts.document(engine, version, {"package": name, "read": kind}, stated)
