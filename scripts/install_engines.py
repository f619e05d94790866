#!/usr/bin/env python3
"""Install the engines that scripts/engines/ has adapters for, and say which ones answer.

Python engines get a virtual environment .venv/<engine> with the pinned packages of
scripts/requirements-<engine>.txt.  Rapier is built with cargo, once per version.  Siconos comes
from the distribution; it is only looked for.  An engine is installed when every adapter command
of scripts/engines/engines.json that belongs to it answers `describe`.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS))

from reference import environment  # noqa: E402
from reference.client import PROTOCOL  # noqa: E402

ROOT = SCRIPTS.parent
ENVIRONMENTS = ROOT / ".venv"
ADAPTERS = "scripts/engines/"
OWN = "target/release/moreau"  # our own schemes need cargo alone
RAPIER_VERSIONS = ("v0_36", "v0_34", "v0_35_beta")
ANSWER_SECONDS = 120
EPILOG = """
examples:
  scripts/install_engines.py                   install every engine (some gigabytes, some minutes)
  scripts/install_engines.py mujoco bullet     install two
  scripts/install_engines.py --list            install nothing, say what is there

exit status: 0 every named engine answers, 1 one does not, 2 wrong usage
"""


def report(message):
    """One line on standard error."""
    print(message, file=sys.stderr, flush=True)


def engine_of(command):
    """The engine behind an adapter's command: `scripts/engines/rapier/…` → rapier."""
    for word in command:
        if word.startswith(ADAPTERS):
            return word[len(ADAPTERS):].split("/")[0].removesuffix(".py")
    raise ValueError(f"no word of {command} starts with {ADAPTERS}")


def commands_by_engine():
    """{engine: its different adapter commands}, in the order of engines.json."""
    text = (SCRIPTS / "engines" / "engines.json").read_text(encoding="utf-8")
    result = {}
    foreign = [one for one in json.loads(text)["engines"] if OWN not in one["command"]]
    for configuration in foreign:
        commands = result.setdefault(engine_of(configuration["command"]), [])
        if configuration["command"] not in commands:
            commands.append(configuration["command"])
    return result


def install(engine):
    """Install what can be; raises NotInstalled or OSError with the reason."""
    if engine == "rapier":
        for version in RAPIER_VERSIONS:
            environment.build_rapier(SCRIPTS, version, report)
    elif (SCRIPTS / f"requirements-{engine}.txt").exists():
        environment.python_of(engine, SCRIPTS, ENVIRONMENTS, report)


def _last_line(data):
    lines = data.decode("utf-8", "replace").strip().splitlines()
    return lines[-1].strip() if lines else "no message"


def version_of(command):
    """The version that an adapter reports; raises NotInstalled with the reason."""
    program = Path(command[0]) if command[0].startswith("/") else ROOT / command[0]
    if not program.exists():
        raise environment.NotInstalled(f"{command[0]} does not exist")
    request = {"protocol": PROTOCOL, "id": 1, "request": "describe"}
    try:
        done = subprocess.run([str(program), *command[1:]], cwd=ROOT, capture_output=True,
                              input=json.dumps(request).encode() + b"\n", timeout=ANSWER_SECONDS)
        return json.loads(done.stdout.splitlines()[0])["result"]["version"]
    except subprocess.TimeoutExpired as problem:
        raise environment.NotInstalled(f"no answer within {ANSWER_SECONDS} s") from problem
    except (IndexError, KeyError, TypeError, ValueError) as problem:
        raise environment.NotInstalled(_last_line(done.stderr)) from problem


def state_of(engine, commands):
    """The versions that answer; raises NotInstalled with the reason."""
    if ((SCRIPTS / f"requirements-{engine}.txt").exists() and (ENVIRONMENTS / engine).exists()
            and not environment.is_current(engine, SCRIPTS, ENVIRONMENTS)):
        raise environment.NotInstalled("its environment is not made from the present requirements")
    return ", ".join(version_of(command) for command in commands)


def main(words=None):
    """Install and report; the exit status."""
    engines = commands_by_engine()
    parser = argparse.ArgumentParser(description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="ENGINE",
                        help=f"default: all of {', '.join(engines)}")
    parser.add_argument("--list", action="store_true", help="install nothing")
    options = parser.parse_args(words)
    for name in options.names:
        if name not in engines:
            parser.error(f"unknown engine {name!r}; known: {', '.join(engines)}")
    missing = False
    for name in options.names or engines:
        try:
            if not options.list:
                install(name)
            print(f"{name:10} installed {state_of(name, engines[name])}", flush=True)
        except (environment.NotInstalled, OSError) as problem:
            missing = True
            print(f"{name:10} not installed: {problem}", flush=True)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
