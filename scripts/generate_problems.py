#!/usr/bin/env python3
"""Make, or check, the collection of contact problems with certified answers, references/problems/.

The problems are posed by scripts/problems/ from our own scenes and from stored steps of engines.  Small ones in the plane are solved in
fractions, pattern by pattern; `moreau problems measure` asks every solver and judges the answers, `moreau certify --prove` adds what can
be proved.  A record in which two ways to an answer contradict each other is not written.  The same machine writes the same bytes.
"""

import argparse
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from problems import boxes, small, spheres, steps  # noqa: E402
from problems.records import Contradiction, record, text  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "references" / "problems"
TABLE = ROOT / "src" / "problems" / "table.rs"
HEAD = """//! The problems that the program embeds, in the order in which they are posed; `scripts/generate_problems.py` writes this table.

use super::stored::Stored;

macro_rules! record {
    ($name:literal) => {
        include_str!(concat!("../../references/problems/answers/", $name, ".json"))
    };
}

macro_rules! stored {
    ($name:literal) => {
        Stored { name: $name, problem: Some(include_str!(concat!("../../references/problems/", $name, ".json"))), record: record!($name) }
    };
}

/// Every problem.
#[rustfmt::skip]
pub(super) static STORED: &[Stored] = &[
"""
EPILOG = """
examples:
  scripts/generate_problems.py                        write all (needs target/release/moreau; some minutes)
  scripts/generate_problems.py --only tower-5         write one
  scripts/generate_problems.py --check                make everything again and compare, byte by byte; write nothing
  scripts/generate_problems.py --check --posed        compare the problems alone, without asking a solver
  scripts/generate_problems.py --only pile-700 --large /tmp     make a problem that is too large to be stored

The program is target/release/moreau, or $MOREAU.
exit status: 0 everything agrees (or was written), 1 there are differences or contradictions, 2 wrong usage
"""


MOST_CONTACTS = 300  # of a problem that is stored; larger ones are listed with their hash and made with --large
LISTED_CONTACTS = 600  # of a problem with a record: every solver is asked, and proofs are dense


def all_posed():
    """Every problem that is posed, the large ones too."""
    for module in (small, boxes, spheres, steps):
        yield from module.all_problems()
    yield from boxes.large()
    yield from spheres.large()


def is_stored(posed):
    """Whether the problem is stored; otherwise its record alone."""
    return posed.contacts <= MOST_CONTACTS


def posed_problems():
    """Every problem that has a record."""
    return (posed for posed in all_posed() if posed.contacts <= LISTED_CONTACTS)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare with the stored files and write nothing")
    parser.add_argument("--posed", action="store_true", help="the problems alone, not their records")
    parser.add_argument("--only", metavar="NAME[,NAME]", default="", help="these problems alone")
    parser.add_argument("--large", type=Path, metavar="FOLDER", help="write problems that are too large to be stored into this folder")
    parser.add_argument("--folder", type=Path, default=FOLDER, help="folder of the files (default: %(default)s)")
    return parser.parse_args()


def compare_or_write(path, content, check):
    """Whether the file holds this text; writes it unless it is only compared."""
    if check:
        return path.exists() and path.read_text(encoding="utf-8") == content
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content, encoding="utf-8")
    return True


def table(names):
    """The Rust table of what is embedded."""
    rows = [f'    stored!("{name}"),\n' if stored else f'    Stored {{ name: "{name}", problem: None, record: record!("{name}") }},\n'
            for name, stored in names]
    return HEAD + "".join(rows) + "];\n"


def main():
    options = arguments()
    command = [os.environ.get("MOREAU") or str(ROOT / "target" / "release" / "moreau")]
    only = set(filter(None, options.only.split(",")))
    every = list(all_posed()) if options.large else list(posed_problems())
    unknown = only - {posed.name for posed in every}
    if unknown:
        print(f"no problem is called {', '.join(sorted(unknown))}", file=sys.stderr)
        return 2
    chosen = [posed for posed in every if not only or posed.name in only]
    if options.large:
        for posed in chosen:
            compare_or_write(options.large / f"{posed.name}.json", text(posed.document), False)
        return 0
    different = [posed.name for posed in chosen
                 if is_stored(posed) and not compare_or_write(options.folder / f"{posed.name}.json", text(posed.document), options.check)]

    def answer(posed):
        try:
            made = text(record(posed, command, is_stored(posed)))
        except Contradiction as problem:
            return f"{posed.name}: {problem}"
        same = compare_or_write(options.folder / "answers" / f"{posed.name}.json", made, options.check)
        return None if same else f"answers/{posed.name}"

    if not options.posed:
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            different += filter(None, pool.map(answer, chosen))
    if not only and options.folder == FOLDER:
        if not compare_or_write(TABLE, table([(posed.name, is_stored(posed)) for posed in every]), options.check):
            different.append(str(TABLE))
        known = {posed.name for posed in every if is_stored(posed)}
        different += [f"{file.name}: posed by no script" for file in sorted(FOLDER.glob("*.json")) if file.stem not in known]
    for name in different:
        print(f"DIFFERENT {name}" if options.check else f"NOT WRITTEN {name}", file=sys.stderr)
    print(f"{len(chosen)} problems {'checked' if options.check else 'written'}, {len(different)} different", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
