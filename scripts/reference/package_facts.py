"""What an engine says of itself: names, defaults and sentences of the installed package."""

import json
import subprocess

from reference.environment import NotInstalled

ENGINES = ("drake",)


def ask(engine, python, scripts):
    """The facts printed by scripts/engines/_<engine>_facts.py in the engine's environment."""
    command = [str(python), str(scripts / "engines" / f"_{engine}_facts.py")]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        lines = (done.stderr or "no message").strip().splitlines()
        raise NotInstalled(f"facts: {lines[-1]}")
    return json.loads(done.stdout)


def differences(stored, fresh):
    """Messages for every fact that is another one; facts are compared exactly."""
    return [f"{key}: stored {stored.get(key)!r}, now {fresh.get(key)!r}"
            for key in sorted(set(stored) | set(fresh)) if stored.get(key) != fresh.get(key)]
