#!/usr/bin/env python3
"""Where the chapter says what a claim states: completes references/chapter/places.json from the chapter's text.

    python3 scripts/chapter_places.py CHAPTER           write the file anew: headings, and section, heading, paragraph of every place
    python3 scripts/chapter_places.py CHAPTER --check   compare only

CHAPTER is the chapter as plain text, one paragraph a line, headings ending with a pilcrow. The text itself is not ours to hold: the file
quotes the shortest clause around a few words of each sentence, at most LONGEST characters as they are read, and has the text's length and digest. To add a
claim, give its place as {"line": …, "words": …}: the words grow to their clause, which cuts no formula, bracket or quotation.
Exit code 1: words that do not stand in their line, or that no short clause holds, or with --check a file that differs; 2: no such text.
"""

import argparse
import hashlib
import json
import re
import sys
from pathlib import Path

FILE = Path(__file__).resolve().parent.parent / "references" / "chapter" / "places.json"
SECTION = re.compile(r"§\d+")
LONGEST = 60
SHORTEST = 4
FORMULA = re.compile(r"\\\(.*?\\\)")
BOLD = re.compile(r"\*\*")
OPEN = {"(": ")", "（": "）", "[": "]", "【": "】", "「": "」", "《": "》", "“": "”", "{": "}"}
# where a clause may begin and end; and, where such a clause is too long, where a part of it may
BREAKS = set("。；;，,：:！!？?|→⇒—…•\"") | set(OPEN) | set(OPEN.values())
WEAK = BREAKS | set(" 、/")
# what a quotation neither begins nor ends with: marks of lists and headings, and breaks
EDGES = " \t-–—、¶·。,，;；:："


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


def is_whole(text):
    """Whether no formula, bracket, quotation, name in code or bold word is cut, and no formula has Chinese words in it, which nobody draws."""
    if not all(formula.isascii() for formula in FORMULA.findall(text)):
        return False
    rest = FORMULA.sub("", text)
    if "\\" in rest or any(rest.count(mark) % 2 for mark in ('"', "`", "**")):
        return False
    closing = []
    for letter in rest:
        if letter in OPEN:
            closing.append(OPEN[letter])
        elif letter in OPEN.values() and (not closing or closing.pop() != letter):
            return False
    return not closing


def length(text):
    """How many characters a reader sees: a command of TeX is one, its braces and marks are none."""
    seen = lambda formula: re.sub(r"[{}_^\\\s]", "", re.sub(r"\\(?:[A-Za-z]+|[,;!: ])", "x", formula.group()[2:-2]))
    return len(FORMULA.sub(seen, text))


def cuts(line, breaks):
    """Where a clause may begin, and where it may end: beside a break outside of formulas and numbers. None begins with a bracket."""
    inside = {k for found in FORMULA.finditer(line) for k in range(*found.span())}
    in_number = {found.start() + 1 for found in re.finditer(r"\d[.,:/](?=\d)", line)}
    stops = {found.start() for found in re.finditer(r"\.(?=\s|$)", line)}
    at = [k for k, letter in enumerate(line) if k not in inside and k not in in_number and (letter in breaks or k in stops)]
    after = {k + 1 for k in at}
    begins = {0, *after, *(k for k in at if line[k] in '"“「《')}
    ends = {len(line), *at, *after}
    if breaks is WEAK:
        marks = {k for mark in (FORMULA, BOLD) for found in mark.finditer(line) for k in found.span()}
        begins, ends = begins | marks, ends | marks
    return sorted(begins), sorted(ends)


def clause(line, words):
    """The shortest clause of a line that holds these words; nothing if it would be longer than LONGEST."""
    start = line.index(words)
    end = start + len(words)
    core = words.strip(EDGES)
    for breaks in (BREAKS, WEAK):
        begins, ends = cuts(line, breaks)
        found = [line[a:b].strip(EDGES) for a in begins if a <= start for b in ends if b >= end]
        found = [text for text in found if SHORTEST <= length(text) <= LONGEST and core in text and is_whole(text)]
        if found:
            return min(found, key=length)
    return None


def place(lines, headings, line, words):
    """Section, heading, paragraph below it, line and clause of the words."""
    if not 1 <= line <= len(lines) or words not in lines[line - 1]:
        raise SystemExit(f"line {line} does not hold “{words}”")
    quoted = clause(lines[line - 1], words)
    if quoted is None:
        raise SystemExit(f"line {line} has no clause of at most {LONGEST} characters around “{words}”")
    heading = max((entry for entry in headings if entry["line"] <= line), key=lambda entry: entry["line"])
    below = lines[heading["line"] : line]
    paragraph = sum(1 for text in below if text.strip())
    before = sum(len(text) + 1 for text in lines[: line - 1])
    percent = int(100 * before / sum(len(text) + 1 for text in lines))
    return {"section": heading["section"], "heading": heading["title"], "paragraph": paragraph, "line": line, "percent": percent, "words": quoted}


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
