"""What the Debian packages of Siconos hold, as `facts/1` of reference.facts."""

import json
import re
import subprocess
from pathlib import Path

from reference import facts

PYTHON = "/usr/bin/python3"
PLACE = "facts/siconos.json"
SOURCE = {"package": "python3-siconos, libsiconos-kernel-dev, libsiconos-kernel7, libsiconos-numerics7",
          "read": "Debian packages"}

HEADERS = re.compile(r"(\w*(?:OSI|NSL)|TimeStepping\w*|EventDriven)\.hpp$")
CLASSES = re.compile(r"\w*(?:OSI|NSL)|TimeStepping\w*|EventDriven")
SOURCES = re.compile(rb"(?:kernel/src/simulationTools/MoreauJean|numerics/src/FrictionContact/fc3d_n)\w*\.c(?:pp)?")
SOLVERS = re.compile(r"SICONOS_((?:GLOBAL_)?FRICTION_3D_(?!ONECONTACT)\w+)_STR")
ENTRIES = (b"gfc3d_IPM", b"gfc3d_ipm_set_default")  # gfc3d_ipm.c leaves its functions, but not its name
CITED = re.compile(r"\* (.*(?:Computer Methods|Lecture Notes|Projected event|sweeping process\.|contact dynamics method).*)")


def installed(package):
    """The files of a Debian package; OSError where it is not installed."""
    listed = subprocess.run(["dpkg", "-L", package], capture_output=True, text=True)
    if listed.returncode != 0:
        raise OSError(f"the Debian package {package} is not installed")
    return [Path(line) for line in listed.stdout.splitlines()]


def document(version):
    """The facts of the packages of this version: headers, classes that Python shows, sources by the
    names that the compiler left in the libraries, solvers, and what the headers cite."""
    headers = [path for path in installed("libsiconos-kernel-dev") if HEADERS.search(path.name)]
    library = b"".join(path.read_bytes() for package in ("libsiconos-kernel7", "libsiconos-numerics7")
                       for path in installed(package) if ".so." in path.name and not path.is_symlink())
    shown = json.loads(subprocess.run(
        [PYTHON, "-c", "import json, siconos.kernel as k, siconos.numerics as n;"
         "print(json.dumps([dir(k), dir(n)]))"], capture_output=True, text=True).stdout)
    cited = {line.strip() for path in headers
             for line in CITED.findall(path.read_text(encoding="utf-8"))}
    return facts.document("siconos", version, SOURCE, {
        "headers": sorted({path.stem for path in headers}),
        "python": sorted(name for name in shown[0] if CLASSES.fullmatch(name)),
        "sources": sorted({name.decode() for name in SOURCES.findall(library)}),
        "functions": [name.decode() for name in ENTRIES if b"\0" + name + b"\0" in library],
        "solvers": sorted({match[1] for name in shown[1] if (match := SOLVERS.fullmatch(name))}),
        "cited": sorted(cited),
    })
