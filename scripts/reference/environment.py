"""One virtual environment per engine, made on demand from its pinned requirements."""

import hashlib
import shutil
import subprocess
import sys


class NotInstalled(Exception):
    """The engine's environment could not be made; carries the reason."""


def stamp_of(requirements):
    """What the environment made from this file is marked with."""
    return hashlib.sha256(requirements.read_bytes() + sys.version.encode()).hexdigest()


def is_current(engine, scripts, root):
    """Whether the environment of `engine` is there and made from its present requirements."""
    stamp = root / engine / "installed"
    return (stamp.exists() and (root / engine / "bin" / "python").exists()
            and stamp.read_text() == stamp_of(scripts / f"requirements-{engine}.txt"))


def python_of(engine, scripts, root, report):
    """The interpreter with the pinned packages of `engine`, below `root`; made when missing."""
    requirements = scripts / f"requirements-{engine}.txt"
    folder = root / engine
    python = folder / "bin" / "python"
    if is_current(engine, scripts, root):
        return python
    report(f"{engine}: installing {requirements.name} into {folder}")
    shutil.rmtree(folder, ignore_errors=True)
    for command in ([sys.executable, "-m", "venv", str(folder)],
                    [str(python), "-m", "pip", "install", "--quiet",
                     "--disable-pip-version-check", "--requirement", str(requirements)]):
        try:
            done = subprocess.run(command, capture_output=True, text=True)
        except OSError as problem:
            raise NotInstalled(str(problem)) from problem
        if done.returncode != 0:
            lines = (done.stderr or done.stdout).strip().splitlines() or ["no message"]
            raise NotInstalled(lines[-1])
    (folder / "installed").write_text(stamp_of(requirements))
    return python
