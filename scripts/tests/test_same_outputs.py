"""Tests of same_outputs.py: a program that prints the same, one that prints other things, one that ends otherwise."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parent.parent / "same_outputs.py"


def program(folder: pathlib.Path, name: str, text: str) -> pathlib.Path:
    """A program that runs this shell text."""
    file = folder / name
    file.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
    file.chmod(0o755)
    return file


def run(what: str, folder: pathlib.Path, binary: pathlib.Path) -> subprocess.CompletedProcess:
    """Saves or checks with a program."""
    environment = {**os.environ, "MOREAU": str(binary)}
    return subprocess.run([sys.executable, str(SCRIPT), what, str(folder)], env=environment, capture_output=True, text=True, check=False)


class SameOutputs(unittest.TestCase):
    """What is the same, and what is not."""

    def test_a_program_is_the_same_as_itself_and_run_times_do_not_count(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            stored = folder / "stored"
            self.assertEqual(run("save", stored, program(folder, "one", 'echo "$@" in 1.5 s')).returncode, 0)
            self.assertEqual(run("check", stored, program(folder, "one", 'echo "$@" in 2.5 s')).returncode, 0)

    def test_other_text_and_another_exit_code_are_different(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            stored = folder / "stored"
            run("save", stored, program(folder, "one", 'echo "$1"'))
            for text in ('echo "$1" more', 'echo "$1"; exit 1'):
                checked = run("check", stored, program(folder, "one", text))
                self.assertEqual(checked.returncode, 1)
                self.assertIn("verify: DIFFERENT", checked.stdout)

    def test_a_command_that_prints_nothing_or_is_misused_is_not_stored(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for text in ("true", "echo usage; exit 2"):
                self.assertEqual(run("save", folder / "stored", program(folder, "one", text)).returncode, 1)
            self.assertEqual(list((folder / "stored").iterdir()), [])

    def test_nothing_stored_is_not_the_same(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.assertEqual(run("check", folder / "empty", program(folder, "one", "echo")).returncode, 1)


if __name__ == "__main__":
    unittest.main()
