#!/usr/bin/env python3
"""What public repositories hold at one commit each: makes references/facts/repositories.json from clones.

    python3 scripts/repository_trees.py FOLDER           write the file anew
    python3 scripts/repository_trees.py FOLDER --check   compare only

FOLDER has a clone of each repository of TREES, with or without files checked out: NAME, OWNER+NAME, OWNER/NAME or `repo` in one of these,
for instance

    git clone --filter=blob:none https://github.com/siconos/siconos FOLDER/siconos

Of each revision the file keeps the commit, all files whose paths fit what was sought, wherever they stand (git ls-tree -r --name-only),
and words of one source file (git show). Exit code 1: with --check a file that differs; 2: no such clone or revision.
"""

import argparse
import fnmatch
import re
import subprocess
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent
sys.path[:0] = [str(SCRIPTS)]

from reference import documents  # noqa: E402

FILE = SCRIPTS.parent / "references" / "facts" / "repositories.json"
SCHEMA = "repositories/1"
COMMAND = "git ls-tree -r --name-only COMMIT"

# the files that the chapter names
SICONOS = ["MoreauJeanOSI.cpp", "fc3d_nonsmooth_Newton_AlartCurnier.c", "fc3d_nsgs.c", "gfc3d_ipm.c"]
FREMOND = ["FremondImpactFrictionNSL.cpp", "FremondImpactFrictionNSL.hpp"]
PINOCCHIO = ["admm-solver.hpp", "admm-solver.hxx", "contact-cholesky.hpp"]
# what the constructor of the solver and its `solve` take
ADMM = {"admm_takes": ["include/pinocchio/algorithm/admm-solver.hpp",
                       r"^ +Scalar (\w+) = Scalar\(|^ +const Eigen::MatrixBase<VectorLikeR> & (\w+),"]}

# repository, revision, ends of the paths that are sought, folders that are passed over, words of a file by name
TREES = [
    ("siconos/siconos", "4.4.0", SICONOS + FREMOND, [], {}),
    ("siconos/siconos", "4.5.0", SICONOS + FREMOND, [], {}),
    ("siconos/siconos", "6070f0f6", SICONOS + FREMOND, [], {}),
    ("RobotLocomotion/drake", "be259df7", ["tamsi_solver.cc", "sap_solver.cc"], [], {}),
    ("google-deepmind/mujoco", "a7255075", ["engine_solver.c", "engine_core_constraint.c", "_src/solver.py"], [],
     {"functions": ["src/engine/engine_solver.c", r"^void (mj_sol\w+)\("]}),
    # all sources for a GPU but those of fluids and sensors
    ("projectchrono/chrono", "7689fbc0", ["ChSolver*.cpp", "*.cu"], ["src/chrono_fsi/", "src/chrono_sensor/"], {}),
    ("stack-of-tasks/pinocchio", "v2.7.0", PINOCCHIO, [], ADMM),
    ("stack-of-tasks/pinocchio", "v3.7.0", PINOCCHIO, [], ADMM),
]


def git(clone, *arguments):
    """What git prints; SystemExit 2 where it fails."""
    done = subprocess.run(["git", "-C", str(clone), *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        print(f"{clone}: git {' '.join(arguments)}: {done.stderr.strip()}", file=sys.stderr)
        raise SystemExit(2)
    return done.stdout


def clone_of(folder, repository):
    """The folder's clone of a repository."""
    owner, name = repository.split("/")
    for place in (name, f"{owner}+{name}", f"{owner}/{name}"):
        for clone in (folder / place / "repo", folder / place):
            if (clone / ".git").exists() or (clone / "objects").is_dir():
                return clone
    print(f"{folder} has no clone of {repository}", file=sys.stderr)
    raise SystemExit(2)


def fits(path, sought, without):
    """Whether a path ends like one of those sought, from a folder's name on, and stands in no folder that is passed over."""
    return any(fnmatch.fnmatchcase("/" + path, "*/" + end) for end in sought) and not path.startswith(tuple(without))


def words(clone, commit, paths, file, pattern):
    """The words that a pattern finds in a file of the commit, each once, in its order; none where there is no such file."""
    text = git(clone, "show", f"{commit}:{file}") if file in paths else ""
    found = [next(group for group in match.groups() if group) for match in re.finditer(pattern, text, re.MULTILINE)]
    return list(dict.fromkeys(found))


def tree(clone, repository, revision, sought, without, wanted):
    """The entry of one revision."""
    commit = git(clone, "rev-parse", "--verify", f"{revision}^{{commit}}").strip()
    date = git(clone, "show", "-s", "--format=%cs", commit).strip()
    paths = git(clone, "-c", "core.quotePath=false", "ls-tree", "-r", "--name-only", commit).splitlines()
    stated = {"files": sorted(path for path in paths if fits(path, sought, without))}
    stated |= {name: words(clone, commit, paths, *place) for name, place in wanted.items()}
    return {"repository": repository, "revision": revision, "commit": commit, "date": date, "sought": sought,
            "without": without, "words": wanted, "stated": stated}


def document(folder, trees):
    """The file as it should be."""
    return {"schema": SCHEMA, "trees": [tree(clone_of(folder, one[0]), *one) for one in trees],
            "provenance": {"script": "scripts/repository_trees.py", "command": COMMAND}}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--check", action="store_true", help="compare only")
    options = parser.parse_args()
    fresh = document(options.folder, TREES)
    if not options.check:
        documents.write(FILE, fresh)
        return 0
    stored, now = documents.leaves(documents.read(FILE)), documents.leaves(fresh)
    differing = [place for place in {**stored, **now} if stored.get(place) != now.get(place)]
    for place in differing:
        print(f"{place}: stored {stored.get(place, ('', None))[1]}, now {now.get(place, ('', None))[1]}")
    return 1 if differing else 0


if __name__ == "__main__":
    sys.exit(main())
