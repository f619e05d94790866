"""How an engine is started: one virtual environment per Python engine, made on demand from its pinned
requirements, and one program per version of Rapier, built with cargo."""

import hashlib
import shutil
import subprocess
import sys


RAPIER_VERSION = "v0_36"  # of the stored motions


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


def rapier_program(scripts, version):
    """The adapter built against one version of Rapier; it need not be there."""
    return scripts / "engines" / "rapier" / "target" / version / "release" / "moreau-engine-rapier"


def build_rapier(scripts, version, report):
    """Build the adapter against one version of Rapier; raises NotInstalled when cargo cannot."""
    report(f"rapier: building {version}")
    folder = scripts / "engines" / "rapier"
    done = subprocess.run(
        ["cargo", "build", "--release", "--quiet", "--manifest-path", str(folder / "Cargo.toml"),
         "--no-default-features", "--features", version,
         "--target-dir", str(folder / "target" / version)])
    if done.returncode != 0:
        raise NotInstalled(f"cargo could not build {version}")


def is_installed(engine, scripts, root):
    """Whether the adapter of `engine` can be started without installing anything."""
    if engine == "rapier":
        return rapier_program(scripts, RAPIER_VERSION).exists()
    return is_current(engine, scripts, root)


def command_of(engine, scripts, root, report):
    """The command that starts the adapter of `engine`, which is installed when missing."""
    if engine != "rapier":
        python = python_of(engine, scripts, root, report)
        return [str(python), str(scripts / "engines" / f"{engine}.py")]
    if not is_installed(engine, scripts, root):
        build_rapier(scripts, RAPIER_VERSION, report)
    return [str(rapier_program(scripts, RAPIER_VERSION))]
