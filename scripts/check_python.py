#!/usr/bin/env python3
"""Builds the Python package as users get it, and tests it where nothing else is.

    python3 scripts/check_python.py [--keep FOLDER]

The sdist is packed, unpacked, and the wheel (manylinux2014, abi3) built from it, so that one build shows both. The wheel goes into a fresh environment beside the package
index's `moreau`, which is another project. There run the tests, the examples in the documentation, the types, the example project with its planted mistake, the notebook,
and the cost of a call. Needs Rust, Python 3.10 or newer and the package registries. The seconds of each step are printed.
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import venv
import zipfile
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parent.parent
CRATE = ROOT / "crates" / "moreau-python"
BUILDERS = ["maturin>=1.9,<2", "ziglang"]
TESTERS = ["moreau", "numpy", "scipy", "pytest", "pytest-xdist", "mypy", "nbclient", "nbformat", "ipykernel"]


class Steps:
    """Prints what is done and how long it took."""

    def __init__(self) -> None:
        self.begin = time.monotonic()
        self.taken: list[tuple[str, float]] = []

    def run(self, name: str, *commands: list, **options) -> None:
        begin = time.monotonic()
        for command in commands:
            print(f"-- {name}: {' '.join(map(str, command))}", flush=True)
            done = subprocess.run([str(word) for word in command], check=False, **options)
            if done.returncode != 0:
                raise SystemExit(f"{name}: exit code {done.returncode}")
        self.taken.append((name, time.monotonic() - begin))

    def show(self) -> None:
        for name, seconds in self.taken:
            print(f"{seconds:7.1f} s  {name}")
        print(f"{time.monotonic() - self.begin:7.1f} s  from beginning to end")


def environment(folder: pathlib.Path, packages: list[str]) -> tuple[pathlib.Path, dict[str, str]]:
    """A fresh environment with these packages: its Python, and the variables under which its commands are found first."""
    venv.create(folder, with_pip=True)
    places = f"{folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
    python, variables = folder / "bin" / "python", {**os.environ, "PATH": places, "PIP_DISABLE_PIP_VERSION_CHECK": "1", "VIRTUAL_ENV": str(folder)}
    subprocess.run([python, "-m", "pip", "install", "--quiet", *packages], check=True, env=variables)
    return python, variables


def unpacked(archive: pathlib.Path, folder: pathlib.Path) -> pathlib.Path:
    """The folder in an sdist."""
    with tarfile.open(archive) as packed:
        packed.extractall(folder, filter="data")
    (inside,) = folder.iterdir()
    for name in ("pyproject.toml", "Cargo.lock", "PKG-INFO"):
        if not (inside / name).is_file():
            raise SystemExit(f"{archive.name} has no {name}")
    return inside


def check_wheel(wheel: pathlib.Path) -> None:
    """One library, no second program, the plugin and the types."""
    if "-cp310-abi3-manylinux" not in wheel.name or "2014" not in wheel.name and "2_17" not in wheel.name:
        raise SystemExit(f"{wheel.name} is no abi3 wheel for manylinux2014")
    names = zipfile.ZipFile(wheel).namelist()
    libraries = [name for name in names if name.endswith(".so")]
    programs = [name for name in names if "/scripts/" in name]
    wanted = {"moreau_contact/py.typed", "moreau_contact/_native.pyi", "moreau_contact/pytest_plugin.py"}
    if len(libraries) != 1 or programs or not wanted <= set(names):
        raise SystemExit(f"{wheel.name}: libraries {libraries}, programs {programs}, missing {wanted - set(names)}")
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="copy wheel and sdist into this folder")
    arguments = parser.parse_args()
    steps = Steps()
    with tempfile.TemporaryDirectory(prefix="moreau-python-") as name, ThreadPoolExecutor() as beside:
        work = pathlib.Path(name)
        # fetched while the compiler works
        testers = beside.submit(environment, work / "testers", TESTERS)
        build(work, steps)
        (wheel,) = (work / "dist").glob("*.whl")
        check_wheel(wheel)
        test(work, wheel, testers.result(), steps)
        if arguments.keep:
            arguments.keep.mkdir(parents=True, exist_ok=True)
            for archive in (work / "dist").iterdir():
                shutil.copy(archive, arguments.keep)
    steps.show()
    return 0


def build(work: pathlib.Path, steps: Steps) -> None:
    """The sdist, and the wheel from it."""
    python, variables = environment(work / "builders", BUILDERS)
    steps.run("sdist", [python, "-m", "maturin", "sdist", "-m", CRATE / "Cargo.toml", "-o", work / "dist"], env=variables)
    (archive,) = (work / "dist").glob("*.tar.gz")
    inside = unpacked(archive, work / "sdist")
    # cargo-zigbuild finds zig by the environment's Python; what is compiled is kept from run to run
    variables |= {"CARGO_TARGET_DIR": str(ROOT / "target" / "python")}
    command = [python, "-m", "maturin", "build", "--release", "--locked", "--zig", "--compatibility", "manylinux2014", "-o", work / "dist"]
    steps.run("wheel, from the sdist", command, cwd=inside, env=variables)


def test(work: pathlib.Path, wheel: pathlib.Path, testers: tuple[pathlib.Path, dict[str, str]], steps: Steps) -> None:
    """Everything that is told of the package, in an environment that has only the wheel and what tests it."""
    python, variables = testers
    away = work / "away"
    away.mkdir()
    steps.run("a fresh environment, beside the package index's moreau", [python, "-m", "pip", "install", "--quiet", wheel], env=variables)
    both = "import moreau, moreau_contact; assert moreau.__file__ != moreau_contact.__file__; print(moreau_contact.__version__)"
    steps.run("both packages", [python, "-c", both], [work / "testers" / "bin" / "moreau", "--version"], cwd=away, env=variables)
    quiet = [python, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    # side by side: most of their time they wait for engines that hang
    steps.run("tests", [*quiet, "-n", 4, CRATE / "tests"], cwd=away, env=variables)
    steps.run("examples of the documentation", [*quiet, "--doctest-modules", "--pyargs", "moreau_contact"], cwd=away, env=variables)
    steps.run(
        "types",
        [python, "-m", "mypy", "--strict", "-p", "moreau_contact"],
        [python, "-m", "mypy.stubtest", "moreau_contact._native"],
        cwd=away, env=variables,
    )
    project = work / "project"
    shutil.copytree(ROOT / "examples" / "python", project)
    steps.run("example project", [*quiet, project], cwd=project, env=variables)
    spoilt = subprocess.run([str(word) for word in [*quiet, project]], cwd=project, env={**variables, "TOY_BUG": "1"}, check=False, capture_output=True, text=True)
    if spoilt.returncode != 1 or "derivation: " not in spoilt.stdout:
        raise SystemExit(f"the planted mistake of the example project is not caught: exit code {spoilt.returncode}\n{spoilt.stdout}")
    notebook = (
        "import nbformat; from nbclient import NotebookClient; "
        "NotebookClient(nbformat.read('certify_and_gate.ipynb', 4), timeout=300, kernel_name='python3').execute()"
    )
    steps.run("notebook", [python, "-c", notebook], cwd=project, env=variables)
    steps.run("cost of a call", [python, CRATE / "tests" / "cost_of_a_call.py"], cwd=away, env=variables)


if __name__ == "__main__":
    sys.exit(main())
