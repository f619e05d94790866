#!/usr/bin/env python3
"""Run the commands of a page of docs/ that need an engine, and compare what they print with what the page shows.

    cargo build --release && python3 scripts/install_engines.py mujoco
    python3 scripts/check_pages.py [--moreau FILE] [PAGE ...]

Without pages: docs/gating-an-engine.md.  A block of `sh` is run if the line before it is
`<!-- run by scripts/check_pages.py -->`, with `; exit code N` before ` -->` where the answer is
not yes.  The next block of `text` in the same section is what it printed: its lines in this order, where `…`
stands for lines left out.  The commands run in a folder of their own beside links to what the
checkout has.  Other blocks are run by `cargo test --test pages`, or say why they are not run.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGES = ["docs/gating-an-engine.md"]
MARK = re.compile(r"<!-- run by scripts/check_pages\.py(?:; exit code (\d+))? -->$")
LINKED = (".venv", "scripts", "examples", "references")


def blocks(page):
    """(language, text, line before it, number of headings before it) of every block of code."""
    found, before, section = [], "", 0
    lines = iter(page.splitlines())
    for line in lines:
        if line.startswith("```"):
            text = []
            for inner in lines:
                if inner.startswith("```"):
                    break
                text.append(inner)
            found.append((line[3:], text, before, section))
        section += line.startswith("#")
        if line.strip():
            before = line
    return found


def missing(shown, printed):
    """The first shown line that does not follow the one before it; None if all do."""
    place, anywhere = 0, True
    for line in shown:
        if line == "…":
            anywhere = True
            continue
        end = len(printed) if anywhere else min(len(printed), place + 1)
        hits = [at for at in range(place, end) if printed[at].rstrip() == line.rstrip()]
        if not hits:
            return line
        place, anywhere = hits[0] + 1, False
    return None


def run(text, folder, environment):
    """Output and exit code of the commands of a block, the code that of the last one."""
    done = subprocess.run(["bash", "-c", "\n".join(text)], cwd=folder, env=environment,
                          capture_output=True, text=True)
    return done.stdout, done.stderr, done.returncode


def check(page, folder, environment):
    """What is wrong with a page, and how many blocks were run and compared."""
    wrong, printed, counts = [], None, [0, 0]
    for language, text, before, section in blocks(page):
        mark = MARK.match(before) if language == "sh" else None
        if mark:
            output, errors, code = run(text, folder, environment)
            counts[0] += 1
            printed = (output.splitlines(), section)
            if code != int(mark.group(1) or 0):
                wrong.append(f"exit code {code}: {text[-1]}\n{output}{errors}")
        elif language == "text" and printed and printed[1] == section:
            line = missing(text, printed[0])
            counts[1] += 1
            if line is not None:
                wrong.append(f"not printed in this place: {line}\n" + "\n".join(printed[0]))
            printed = None
        elif language == "sh":
            printed = None
    return wrong, counts


def main():
    """Exit code 1 if a command ends otherwise than the page says or does not print what it shows."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", metavar="PAGE", default=PAGES)
    parser.add_argument("--moreau", type=pathlib.Path, default=ROOT / "target/release/moreau", metavar="FILE",
                        help="the program to run")
    arguments = parser.parse_args()
    path = f"{arguments.moreau.resolve().parent}{os.pathsep}{os.environ['PATH']}"
    failed = False
    for name in arguments.pages:
        with tempfile.TemporaryDirectory() as folder:
            for part in LINKED:
                os.symlink(ROOT / part, pathlib.Path(folder) / part)
            page = (ROOT / name).read_text(encoding="utf-8")
            wrong, (ran, compared) = check(page, folder, {**os.environ, "PATH": path})
        if not ran:
            wrong.append("no block is run here: this looks at nothing")
        for one in wrong:
            print(f"{name}: {one}", file=sys.stderr)
        print(f"{name}: {ran} blocks run, {compared} compared, {len(wrong)} wrong")
        failed = failed or bool(wrong)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
