#!/usr/bin/env python3
"""Decides again what `moreau verify --export FILE` wrote: every exact decision, in fractions, and every verdict from its findings.

    moreau verify --export witnesses.json
    python3 scripts/check_witnesses.py witnesses.json

Shares nothing with the crate but the file; needs Python's standard library only. Exit code 0: every witness shows what it says, and every verdict follows; 1: one does not; 2: the file cannot be read, or is not
whole: it says how many claims, findings and witnesses it has. It decides what it finds: that a check asked what its sentence says, and that
nothing was taken out together with its count, is not shown by it.
"""

import argparse
import collections
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from witnesses.decisions import DECISIONS, Wrong  # noqa: E402
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
    try:
        decide(claim)
        counts["verdict"] += 1
    except (Wrong, OverflowError) as problem:
        wrong.append(f"{claim['id']}: {problem}")
    return wrong


def no_number(text: str) -> None:
    """What JSON does not know."""
    raise ValueError(f"{text} is no number")


def whole(document: dict) -> list[dict]:
    """The claims, if there are as many of everything as the document says; ValueError or the like if not."""
    if not isinstance(document, dict) or "schema" not in document:
        raise ValueError("it is no object with a `schema`")
    if document["schema"] != "witnesses/1":
        raise ValueError(f"its schema is {document['schema']}, not witnesses/1")
    claims = document["claims"]
    found = {"claims": len(claims)} | {kind: sum(len(claim[kind]) for claim in claims) for kind in ("findings", "witnesses")}
    if found != document["counts"]:
        raise ValueError(f"it has {found}, and says {document['counts']}")
    for claim in claims:
        readable(claim)
    twice = [name for name, count in collections.Counter(claim["id"] for claim in claims).items() if count > 1]
    if twice:
        raise ValueError(f"claims stand there twice: {', '.join(twice)}")
    return claims


def main(arguments: list[str] | None = None) -> int:
    """Reads, decides, prints."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=pathlib.Path, help="what `moreau verify --export` wrote")
    file = parser.parse_args(arguments).file
    try:
        claims = whole(json.loads(file.read_text(), parse_constant=no_number))
    except (OSError, ValueError, KeyError, TypeError, AttributeError, OverflowError, RecursionError) as problem:
        print(f"{file}: {type(problem).__name__}: {problem}; write it with `moreau verify --export {file}`", file=sys.stderr)
        return 2
    counts: collections.Counter = collections.Counter()
    wrong = [line for claim in claims for line in wrong_in(claim, counts)]
    for line in wrong:
        print(line)
    for kind, count in sorted(counts.items()):
        print(f"{count:6} {kind}")
    bare = [claim["id"] for claim in claims if claim["evidence"] == "exact" and not claim["witnesses"]]
    if bare:
        print(f"exact without a witness, so that only the verdict was decided again: {', '.join(bare)}")
    print(f"{len(claims)} claims, {len(bare)} of them exact without a witness; {len(wrong)} wrong")
    return 1 if wrong or not claims else 0


if __name__ == "__main__":
    sys.exit(main())
