"""One virtual environment per engine, made on demand from its pinned requirements."""

import hashlib
import shutil
import subprocess
import sys


class NotInstalled(Exception):
    """The engine's environment could not be made; carries the reason."""


def python_of(engine, scripts, root, report):
    """The interpreter with the pinned packages of `engine`, below `root`; made when missing."""
    requirements = scripts / f"requirements-{engine}.txt"
    stamp_text = hashlib.sha256(requirements.read_bytes() + sys.version.encode()).hexdigest()
    folder = root / engine
    python, stamp = folder / "bin" / "python", folder / "installed"
    if python.exists() and stamp.exists() and stamp.read_text() == stamp_text:
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
    stamp.write_text(stamp_text)
    return python
