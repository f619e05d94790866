"""What the pinned packages themselves hold: names of files, lines of source, default settings.

Of Pinocchio the wheel in its environment is asked, whose files include the headers.  Bullet's
wheel has no sources, so its source distribution is downloaded with pip, once, and read unpacked.
"""

import json
import re
import subprocess
import tarfile

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


def _run(python, *arguments):
    done = subprocess.run([str(python), *arguments], capture_output=True, text=True)
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


def _lines(archive, patterns):
    """[{file, text}] of the lines that the patterns ask for, in the archive's order of names."""
    found = []
    with tarfile.open(archive) as tar:
        for member in sorted(tar.getmembers(), key=lambda member: member.name):
            for name, line in patterns.items():
                if member.isfile() and re.search(name, member.name):
                    text = tar.extractfile(member).read().decode("utf-8", "replace")
                    found += [{"file": member.name, "text": part.split("//")[0].strip()}
                              for part in text.splitlines() if re.search(line, part)]
    return found


def package(engine, python, root):
    """The document `package/1` of an engine."""
    name, kind, names, patterns = SUBJECTS[engine]
    if kind == "wheel":
        version, files = json.loads(_run(python, "-c", ASK_WHEEL, name))
        lines, settings = [], json.loads(_run(python, "-c", ASK_PINOCCHIO))
    else:
        version, archive = _source(python, name, root)
        with tarfile.open(archive) as tar:
            files = tar.getnames()
        lines, settings = _lines(archive, patterns), {}
    kept = sorted(file for file in files if any(re.search(pattern, file) for pattern in names))
    return {"schema": "package/1", "package": name, "version": version, "read": kind,
            "files": kept, "lines": lines, "settings": settings,
            "provenance": {"script": "scripts/generate_references.py", "engine": engine}}
