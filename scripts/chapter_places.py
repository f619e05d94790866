#!/usr/bin/env python3
"""Where the chapter says what a claim states: completes references/chapter/places.json from the chapter's text.

    python3 scripts/chapter_places.py CHAPTER           write the file anew: headings, and section, heading, paragraph of every place
    python3 scripts/chapter_places.py CHAPTER --check   compare only

CHAPTER is the chapter as plain text, one paragraph a line, headings ending with a pilcrow. The text itself is not ours to hold: the file
quotes a few words of each sentence, and has the text's length and digest. To add a claim, give its place as {"line": …, "words": …}.
Exit code 1: words that do not stand in their line, or with --check a file that differs; 2: no such text.
"""

import argparse
import hashlib
import json
import re
import sys
from pathlib import Path

FILE = Path(__file__).resolve().parent.parent / "references" / "chapter" / "places.json"
SECTION = re.compile(r"§\d+")


def outline(lines):
    """The headings, each with the section that it stands in and how many paragraphs follow until the next."""
    headings, section = [], ""
    for number, line in enumerate(lines, 1):
        if line.endswith("¶"):
            title = line[:-1].strip()
            opening = SECTION.match(title)
            section = opening.group() if opening else section
            headings.append({"line": number, "section": section, "title": title, "paragraphs": 0})
        elif headings and line.strip():
            headings[-1]["paragraphs"] += 1
    return headings


def place(lines, headings, line, words):
    """Section, heading, paragraph below it and line of the words."""
    if not 1 <= line <= len(lines) or words not in lines[line - 1]:
        raise SystemExit(f"line {line} does not hold “{words}”")
    heading = max((entry for entry in headings if entry["line"] <= line), key=lambda entry: entry["line"])
    below = lines[heading["line"] : line]
    paragraph = sum(1 for text in below if text.strip())
    before = sum(len(text) + 1 for text in lines[: line - 1])
    percent = int(100 * before / sum(len(text) + 1 for text in lines))
    return {"section": heading["section"], "heading": heading["title"], "paragraph": paragraph, "line": line, "percent": percent, "words": words}


def completed(text, stored):
    """The file as it should be."""
    lines = text.split("\n")
    headings = outline(lines)
    digest = hashlib.sha256(text.encode()).hexdigest()
    chapter = {"lines": len(lines), "characters": len(text), "sha256": digest}
    ends = [entry["line"] for entry in headings if entry["title"].startswith("本章常见误解")]
    for entry in headings:  # what follows the last section belongs to none
        if ends and entry["line"] >= ends[0]:
            entry["section"] = ""
    places = {
        claim: [place(lines, headings, entry["line"], entry["words"]) for entry in entries]
        for claim, entries in sorted(stored["places"].items())
    }
    return {"chapter": chapter, "headings": headings, "places": places, "absent": stored["absent"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("chapter", type=Path)
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    try:
        text = arguments.chapter.read_text(encoding="utf-8")
    except OSError as error:
        print(f"{arguments.chapter}: {error.strerror}", file=sys.stderr)
        return 2
    stored = json.loads(FILE.read_text(encoding="utf-8"))
    wanted = completed(text, stored)
    if arguments.check:
        return 0 if wanted == stored else 1
    FILE.write_text(json.dumps(wanted, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
