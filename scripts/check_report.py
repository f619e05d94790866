#!/usr/bin/env python3
"""Writes the report as users get it, and looks at it with a browser from the disk.

    python3 scripts/check_report.py [--moreau PROGRAM] [--report FOLDER] [--screenshots FOLDER]

`moreau report` writes the site (or FOLDER holds one); its seconds and bytes are printed and limited. Then Chromium opens every page without
a network: no error, every link and anchor leads somewhere, search and filters find what report.json counts, formulas have a size, plots name
their units, section pages have the whole statement, correction and verdict of report.json, nothing is wider than a telephone or cut off on
paper, axe-core finds nothing in light and dark, the keyboard reaches the filters, and the summary prints on two pages. At last each check
is shown a copy with a mistake, and must see it. With --screenshots pictures of some pages are written instead.

Needs Python 3.11, npm, the package registries and Chromium; where there is no Chromium and this is root on Debian, apt-get installs it.
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

ROOT = pathlib.Path(__file__).resolve().parent.parent
PLAYWRIGHT = "playwright==1.65.2"
AXE = "axe-core@4.14.1"
SECONDS = 60
INSIDE = "--inside"


def run(*command: object, **options: object) -> subprocess.CompletedProcess:
    """Runs a command, whose failure ends this program with its name."""
    words = [str(word) for word in command]
    done = subprocess.run(words, check=False, **options)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(words)}: exit code {done.returncode}")
    return done


def chromium() -> pathlib.Path:
    """The browser; installed where it is missing and may be."""
    found = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if found is None and os.geteuid() == 0 and shutil.which("apt-get"):
        quiet = {"env": {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}, "stdout": subprocess.DEVNULL}
        run("apt-get", "update", **quiet)
        run("apt-get", "install", "-y", "--no-install-recommends", "chromium", **quiet)
        found = shutil.which("chromium")
    if found is None:
        raise SystemExit("the report cannot be looked at: there is no Chromium, and it can be installed only by root on Debian (apt-get install chromium)")
    return pathlib.Path(found)


def axe(folder: pathlib.Path) -> pathlib.Path:
    """The program of axe-core, from its package."""
    archive = run("npm", "pack", "--silent", AXE, cwd=folder, capture_output=True, text=True).stdout.split()[-1]
    with tarfile.open(folder / archive) as packed:
        packed.extractall(folder, filter="data")
    return folder / "package" / "axe.min.js"


def environment(folder: pathlib.Path) -> pathlib.Path:
    """The Python of a fresh environment that has the browser's driver."""
    venv.create(folder, with_pip=True)
    python = folder / "bin" / "python"
    run(python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", PLAYWRIGHT)
    return python


def written(program: pathlib.Path, folder: pathlib.Path) -> None:
    """The report of this program; how long it took."""
    begin = time.monotonic()
    run(program, "report", "--out", folder, stdout=subprocess.DEVNULL)
    seconds = time.monotonic() - begin
    print(f"moreau report: {seconds:.1f} s, at most {SECONDS}", flush=True)
    if seconds > SECONDS:
        raise SystemExit("the report takes too long to write")


def outside(arguments: argparse.Namespace) -> int:
    """Makes what the checks need, and runs them where the driver is."""
    browser = chromium()
    with tempfile.TemporaryDirectory() as room:
        room = pathlib.Path(room)
        report = arguments.report
        if report is None:
            report = room / "report"
            written(arguments.moreau.resolve(), report)
        python = environment(room / "environment")
        command = [python, __file__, INSIDE, "--report", report.resolve(), "--browser", browser, "--axe", axe(room)]
        if arguments.screenshots:
            command += ["--screenshots", arguments.screenshots.resolve()]
        return subprocess.run([str(word) for word in command], check=False).returncode


def inside(arguments: argparse.Namespace) -> int:
    """Runs the checks, or takes the pictures."""
    sys.path.insert(0, str(ROOT / "scripts"))
    from report import checks, plants, screenshots
    from report.browser import Browser

    with tempfile.TemporaryDirectory() as room, Browser(arguments.browser, pathlib.Path(room) / "profile") as browser:
        if arguments.screenshots:
            screenshots.take(browser, arguments.report, arguments.screenshots)
            return 0
        script = arguments.axe.read_text()
        wrong = checks.look(browser, arguments.report, script)
        if not wrong:
            wrong = plants.look(browser, arguments.report, script, pathlib.Path(room))
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"{len(wrong)} problems" if wrong else "the report is as it should be")
    return 1 if wrong else 0


def main() -> int:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--moreau", type=pathlib.Path, default=ROOT / "target" / "release" / "moreau", help="the program that writes the report")
    parser.add_argument("--report", type=pathlib.Path, help="look at this report instead of writing one")
    parser.add_argument("--screenshots", type=pathlib.Path, help="write pictures of pages into this folder")
    for hidden in (INSIDE, "--browser", "--axe"):
        parser.add_argument(hidden, help=argparse.SUPPRESS, **({"action": "store_true"} if hidden == INSIDE else {"type": pathlib.Path}))
    arguments = parser.parse_args()
    return inside(arguments) if arguments.inside else outside(arguments)


if __name__ == "__main__":
    sys.exit(main())
