"""Baselines of the gate: `--check` compares, without it they are saved.

    cargo build --release
    python3 scripts/save_baselines.py [--check] [NAME ...]

Without names: our own schemes and MuJoCo, which CI compares.  The files are
`references/baselines/NAME.toml`.  `scripts/install_engines.py mujoco` makes MuJoCo's environment,
which `scripts/generate_references.py` shares, and `scripts/install_engines.py rapier` builds Rapier.
"""

import argparse
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
MOREAU = ROOT / "target" / "release" / "moreau"
FOLDER = ROOT / "references" / "baselines"
DEFAULT = ("moreau-jean", "stewart-trinkle", "anitescu", "mujoco")
RAPIER = "scripts/engines/rapier/target/{}/release/moreau-engine-rapier"
ENGINES = {
    "moreau-jean": [str(MOREAU), "engine", "--scheme", "moreau-jean"],
    "stewart-trinkle": [str(MOREAU), "engine", "--scheme", "stewart-trinkle"],
    "anitescu": [str(MOREAU), "engine", "--scheme", "anitescu"],
    "mujoco": [str(ROOT / ".venv/mujoco/bin/python"), "scripts/engines/mujoco.py"],
    "rapier-0.34": [RAPIER.format("v0_34")],
    "rapier-0.36": [RAPIER.format("v0_36")],
}


def gate(name, check):
    """Run the quick sweep of one engine; its exit code."""
    option = "--baseline" if check else "--save-baseline"
    print(f"== {name}", flush=True)
    run = subprocess.run([str(MOREAU), "gate", "--quick", "--jobs", "2", option,
                          str(FOLDER / f"{name}.toml"), "--", *ENGINES[name]], cwd=ROOT)
    return run.returncode


def main():
    """Compare or save; exit code 1 if any engine got worse or could not be run."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME",
                        help=f"{', '.join(ENGINES)}; without names {', '.join(DEFAULT)}")
    parser.add_argument("--check", action="store_true", help="compare with what is stored")
    arguments = parser.parse_args()
    unknown = sorted(set(arguments.names) - set(ENGINES))
    if unknown:
        parser.error(f"unknown engine {unknown[0]}; known: {', '.join(ENGINES)}")
    FOLDER.mkdir(parents=True, exist_ok=True)
    codes = {name: gate(name, arguments.check) for name in arguments.names or DEFAULT}
    # saving a baseline with failures in it is allowed: they are then known
    bad = [name for name, code in codes.items() if code > (0 if arguments.check else 1)]
    if bad:
        print(f"worse than the baseline, or not run: {', '.join(bad)}", file=sys.stderr)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
