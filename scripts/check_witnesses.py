#!/usr/bin/env python3
"""Decides again what `moreau verify --export FILE` wrote: every exact decision, in fractions, and every verdict and grade from its findings.

    moreau verify --export witnesses.json
    python3 scripts/check_witnesses.py witnesses.json

Shares nothing with the crate but the file; needs Python's standard library only. Exit code 0: every witness shows what it says, and every verdict and every grade follows; 1: one does not; 2: the file cannot be read, or is not
whole: it says how many claims, findings and witnesses it has. It decides what it finds: that a check asked what its sentence says, and that
nothing was taken out together with its count, is not shown by it.
"""

import argparse
import collections
import json
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from witnesses.decisions import DECISIONS  # noqa: E402
from witnesses.judgement import Wrong  # noqa: E402
from witnesses.verdicts import decide, readable  # noqa: E402


def wrong_in(claim: dict, counts: collections.Counter) -> list[str]:
    """What is wrong with a claim."""
    wrong = []
    for witness in claim["witnesses"]:
        try:
            DECISIONS[witness["kind"]](witness)
            counts[witness["kind"]] += 1
        except (Wrong, KeyError, ValueError, TypeError, IndexError, ArithmeticError) as problem:
            wrong.append(f"{claim['id']}: {witness.get('kind')}: {type(problem).__name__}: {problem}")
    if claim["evidence"] == "exact" and not claim["witnesses"]:
        wrong.append(f"{claim['id']}: exact, and no witness of any decision")
    try:
        decide(claim)
        counts["verdict and grade"] += 1
    except (Wrong, OverflowError) as problem:
        wrong.append(f"{claim['id']}: {problem}")
    return wrong


def once(pairs: list) -> dict:
    """An object, if no key stands in it twice: another reader may take the other value."""
    twice = [key for key, count in collections.Counter(key for key, _ in pairs).items() if count > 1]
    if twice:
        raise ValueError(f"{', '.join(twice)} stands twice in an object")
    return dict(pairs)


def no_number(text: str) -> None:
    """What JSON does not know."""
    raise ValueError(f"{text} is no number")


def whole(document: dict) -> list[dict]:
    """The claims, if there are as many of everything as the document says; ValueError or the like if not."""
    if not isinstance(document, dict) or "schema" not in document:
        raise ValueError("it is no object with a `schema`")
    if document["schema"] != "witnesses/1":
        raise ValueError(f"its schema is {document['schema']!r}, not witnesses/1")
    claims = document["claims"]
    found = {"claims": len(claims)} | {kind: sum(len(claim[kind]) for claim in claims) for kind in ("findings", "witnesses")}
    if repr(sorted(found.items())) != repr(sorted(document["counts"].items())):
        raise ValueError(f"it has {found}, and says {document['counts']}")
    for claim in claims:
        readable(claim)
    twice = [name for name, count in collections.Counter(claim["id"] for claim in claims).items() if count > 1]
    if twice:
        raise ValueError(f"claims stand there twice: {', '.join(twice)}")
    chosen_as_said(document)
    return claims


def chosen_as_said(document: dict) -> None:
    """Raises ValueError unless all claims are there, or those that are meet what was asked for, as far as they tell it."""
    claims, of, selected = document["claims"], document["of"], document["selected"]
    if type(of) is not int or of < len(claims):
        raise ValueError(f"it has {len(claims)} claims, and says that there are {of!r}")
    if selected is None:
        if of != len(claims):
            raise ValueError(f"it has {len(claims)} of {of} claims, and does not say which")
        return
    if not isinstance(selected, dict) or set(selected) != {"group", "verdict", "severity", "kind"} or set(selected.values()) == {None}:
        raise ValueError("what was selected cannot be read")
    if not all(value is None or isinstance(value, str) for value in selected.values()):
        raise ValueError("what was selected cannot be read")
    group, verdict = selected["group"], selected["verdict"]
    for claim in claims:
        of_group = group is None or claim["id"] == group or claim["id"].startswith(f"{group}.") or re.fullmatch(f"{re.escape(group)}[0-9]+", claim["id"])
        if not of_group or verdict not in (None, claim["verdict"]):
            raise ValueError(f"{claim['id']} does not meet what was selected")


def read(file: pathlib.Path) -> dict:
    """The document; ValueError with the cure if it is none."""
    if file.is_dir():
        raise ValueError("it is a folder")
    text = file.read_text()
    if not text.strip():
        raise ValueError("it is empty")
    return json.loads(text, parse_constant=no_number, object_pairs_hook=once)


def described(problem: Exception) -> str:
    """What is wrong with a file, in words."""
    if isinstance(problem, KeyError):
        return f"it has no {problem}"
    known = isinstance(problem, OSError) or type(problem) is ValueError
    return str(problem) if known else f"{type(problem).__name__}: {problem}"


def main(arguments: list[str] | None = None) -> int:
    """Reads, decides, prints."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path, help="what `moreau verify --export` wrote")
    file = parser.parse_args(arguments).file
    try:
        document = read(file)
        claims = whole(document)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError) as problem:
        print(f"{file}: {described(problem)}; give a file that `moreau verify --export FILE` wrote, of the version that this script comes with", file=sys.stderr)
        return 2
    counts: collections.Counter = collections.Counter()
    wrong = [line for claim in claims for line in wrong_in(claim, counts)]
    for line in wrong:
        # a lone surrogate of JSON has no encoding
        print(line.encode("utf-8", "backslashreplace").decode())
    for kind, count in sorted(counts.items()):
        print(f"{count:6} {kind}")
    if document["selected"] is not None:
        asked = ", ".join(f"{name} {value}" for name, value in document["selected"].items() if value is not None)
        print(f"a selection, {asked}: {len(claims)} of {document['of']} claims")
    print(f"{len(claims)} claims; {len(wrong)} wrong")
    return 1 if wrong or not claims else 0


if __name__ == "__main__":
    sys.exit(main())
