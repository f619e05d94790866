#!/usr/bin/env python3
"""Make a static site of the documentation with mkdocs: docs/ and the pages beside it.

    python3 scripts/build_docs.py [--out FOLDER] [--python FILE]

The pages stay what they are, Markdown that reads well unrendered; this copies them, and what they
link to, into a temporary folder and lets mkdocs make `target/docs` of it.  mkdocs is pinned in
`scripts/requirements-docs.txt` and installed into `.venv/docs` when it is missing.  A link that leads nowhere, to a
page or to a heading, ends it with exit code 1, and so does a page that would load something from elsewhere.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS))

from reference import environment  # noqa: E402

ROOT = SCRIPTS.parent
LINK = re.compile(r"\]\(([^)#\s]+)(#[^)\s]*)?\)")
ITEM = re.compile(r"\s*([-*+]|\d+\.) ")
FOREIGN = re.compile(r"<(?:script|link|img)\b[^>]*?(?:src|href)=\"(?:https?:)?//[^\"]*\"")
CONFIGURATION = """\
site_name: moreau
use_directory_urls: false
plugins: []
theme: {name: mkdocs, highlightjs: false}
markdown_extensions:
  - toc:
      slugify: !!python/name:markdown.extensions.toc.slugify_unicode
validation: {links: {not_found: warn, anchors: warn, unrecognized_links: warn, absolute_links: warn}}
nav:
"""


def prose(text):
    """(line, whether it stands outside blocks of code) of every line."""
    code = False
    for line in text.splitlines():
        fence = line.startswith("```")
        yield line, not code and not fence
        code ^= fence


def spaced(text):
    """A blank line before every list: Python-Markdown wants one, where the pages do without."""
    lines, before = [], ""
    for line, outside in prose(text):
        begins = outside and ITEM.match(line) and before.strip() and not ITEM.match(before)
        if begins and not before.startswith((" ", "#", ">", "|")):
            lines.append("")
        lines.append(line)
        before = line
    return "\n".join(lines) + "\n"


def targets(text):
    """The files that a page links to, as they are written."""
    for line, outside in prose(text):
        if outside:
            yield from (match.group(1) for match in LINK.finditer(line) if "://" not in match.group(1))


def index(folder):
    """A page for a folder that has none: what is in it."""
    entries = sorted(path.name for path in folder.iterdir() if path.suffix == ".md")
    return f"# {folder.name}\n\n" + "".join(f"- [{name}]({name})\n" for name in entries)


def stage(source, staged, page, seen):
    """Copies a page and everything that it links to, each once."""
    place = (source / page).resolve().relative_to(source)
    if place in seen:
        return
    seen.add(place)
    goal = staged / place
    goal.parent.mkdir(parents=True, exist_ok=True)
    if (source / place).suffix != ".md":
        shutil.copyfile(source / place, goal)
        return
    text = (source / place).read_text(encoding="utf-8")
    for target in set(targets(text)):
        to = (source / place.parent / target).resolve()
        if to.is_dir():
            text = text.replace(f"]({target})", f"]({target.rstrip('/')}/README.md)")
            if not (to / "README.md").exists():
                written = staged / to.relative_to(source) / "README.md"
                written.parent.mkdir(parents=True, exist_ok=True)
                written.write_text(index(to), encoding="utf-8")
                for name in sorted(path.name for path in to.glob("*.md")):
                    stage(source, staged, to.relative_to(source) / name, seen)
                continue
            to = to / "README.md"
        if to.exists():
            stage(source, staged, to.relative_to(source), seen)
    goal.write_text(spaced(text), encoding="utf-8")


def navigation(staged):
    """The pages at the top, then those of docs/ in the order of its table."""
    first = [page for page in ("README.md", "docs/README.md") if (staged / page).exists()]
    listed = [f"docs/{target}" for target in targets((staged / "docs/README.md").read_text(encoding="utf-8"))
              if target.endswith(".md") and not target.startswith("..")]
    return first + listed


def foreign(folder):
    """Everything that a page of the site would load from elsewhere."""
    found = []
    for page in sorted(folder.rglob("*.html")):
        found += [f"{page.relative_to(folder)}: {tag}" for tag in FOREIGN.findall(page.read_text(encoding="utf-8"))]
    return found


def build(source, out, python):
    """The site; what mkdocs says, and whether it is content."""
    with tempfile.TemporaryDirectory() as folder:
        staged = pathlib.Path(folder) / "pages"
        seen = set()
        stage(source, staged, pathlib.Path("README.md"), seen)
        stage(source, staged, pathlib.Path("docs/README.md"), seen)
        nav = "".join(f"  - {page}\n" for page in navigation(staged))
        configuration = pathlib.Path(folder) / "mkdocs.yml"
        configuration.write_text(f"docs_dir: pages\n{CONFIGURATION}{nav}", encoding="utf-8")
        command = [str(python), "-m", "mkdocs", "build", "--strict",
                   "--config-file", str(configuration), "--site-dir", str(out.resolve())]
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "NO_COLOR": "1"})
        said = (done.stdout + done.stderr).splitlines()
        # `--quiet` would keep warnings from being counted, too
        return [line for line in said if not line.startswith(("INFO", "  - ")) and line.strip()], done.returncode == 0


def main():
    """Exit code 1 if a link leads nowhere, a page loads something from elsewhere, or mkdocs cannot be installed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "target" / "docs", metavar="FOLDER", help="where the site goes")
    parser.add_argument("--python", type=pathlib.Path, metavar="FILE", help="an interpreter that has mkdocs")
    arguments = parser.parse_args()
    try:
        python = arguments.python or environment.python_of("docs", SCRIPTS, ROOT / ".venv", lambda line: print(line, file=sys.stderr))
    except environment.NotInstalled as problem:
        print(f"mkdocs cannot be installed: {problem}", file=sys.stderr)
        return 1
    said, content = build(ROOT, arguments.out, python)
    loads = foreign(arguments.out) if content else []
    for line in loads if content else said:
        print(line, file=sys.stderr)
    if content and not loads:
        print(f"{sum(1 for _ in arguments.out.rglob('*.html'))} pages in {arguments.out}")
    return 0 if content and not loads else 1


if __name__ == "__main__":
    sys.exit(main())
