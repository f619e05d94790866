"""Shared by the tests of the installed package: `pytest crates/moreau-python/tests`."""
import signal
import subprocess
import sys
from pathlib import Path

import pytest

pytest_plugins = ["pytester"]

CHECKOUT = Path(__file__).resolve().parents[3]
PROJECT = CHECKOUT / "examples" / "python"
sys.path.insert(0, str(PROJECT))


@pytest.fixture
def interruptible():
    """Ctrl-C as a terminal has it: what a shell starts in the background ignores it, and so does a run of these tests there."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def command(tmp_path):
    """The command `moreau` of this environment; its standard output."""

    def run(*words, code=0):
        moreau = Path(sys.executable).with_name("moreau")
        done = subprocess.run([moreau, *map(str, words)], capture_output=True, text=True, cwd=tmp_path, check=False)
        assert done.returncode == code, done.stderr
        return done.stdout

    return run
