#!/usr/bin/env python3
"""Runs the random properties of tests/properties in shards that can be stopped and taken up again, and logs what each shard did.

    python3 scripts/campaign.py --cases 200000 --shards 20
    python3 scripts/campaign.py --cases 1000000 --shards 100 --only rounded_lemke --only w_is_symmetric

A shard is one property with its share of the cases and a seed of its own, PROPTEST_RNG_SEED, so that it can be run again alone. Each is a
line of the log, target/campaign/properties.jsonl: property, commit, shard, seed, cases, seconds, whether it passed, and the output if it
did not. Shards of this commit that are in the log are not run again. Exit code 1 if one failed.
"""
import argparse
import json
import os
import subprocess
import sys
import time
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def output(*command):
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def commit():
    """What is tested; a tree with changes has no name that another run could trust."""
    if output("git", "status", "--porcelain"):
        sys.exit("commit first: a log names what was tested")
    return output("git", "rev-parse", "HEAD").strip()


def program():
    """The compiled test program."""
    for line in output("cargo", "test", "--profile", "campaign", "--test", "properties", "--no-run", "--message-format", "json").splitlines():
        message = json.loads(line)
        if message.get("executable") and message["target"]["name"] == "properties":
            return message["executable"]
    sys.exit("cargo built no program `properties`")


def properties(executable):
    """The names of the tests that draw cases: those that a request for one case leaves among the tests, by their source."""
    sources = "".join(path.read_text() for path in (ROOT / "tests" / "properties").glob("*.rs"))
    random = sources.split("proptest! {")[1:]
    bodies = "".join(part.split("\n}\n")[0] for part in random)
    listed = [line.removesuffix(": test") for line in output(executable, "--list").splitlines() if line.endswith(": test")]
    return [name for name in listed if f"fn {name.split('::')[-1]}(" in bodies]


def seed(name, shard):
    """A seed of its own for every shard of every property."""
    return zlib.crc32(name.encode()) * 1_000_003 + shard


def run(executable, tested, name, shard, cases):
    environment = os.environ | {"PROPTEST_CASES": str(cases), "PROPTEST_RNG_SEED": str(seed(name, shard))}
    environment |= {"PROPTEST_MAX_GLOBAL_REJECTS": str(100 * cases + 1024)}
    start = time.monotonic()
    done = subprocess.run([executable, "--exact", name], cwd=ROOT, env=environment, capture_output=True, text=True)
    line = {"property": name, "commit": tested, "shard": shard, "seed": seed(name, shard), "cases": cases}
    line |= {"seconds": round(time.monotonic() - start, 1), "passed": done.returncode == 0 and "1 passed" in done.stdout}
    return line if line["passed"] else line | {"output": done.stdout + done.stderr}


def known(log, tested):
    """The lines of this commit; one that was cut off is not among them."""
    lines = []
    for text in log.read_text().splitlines() if log.exists() else []:
        try:
            line = json.loads(text)
        except json.JSONDecodeError:
            continue
        if line["commit"] == tested:
            lines.append(line)
    return lines


def summary(lines):
    for name in sorted({line["property"] for line in lines}):
        mine = [line for line in lines if line["property"] == name]
        cases, seconds = sum(line["cases"] for line in mine), sum(line["seconds"] for line in mine)
        failed = [line["seed"] for line in mine if not line["passed"]]
        print(f"{name}: {cases} cases, {seconds:.0f} s, failed seeds: {failed or 'none'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=200_000, help="cases of each property, in all shards together")
    parser.add_argument("--shards", type=int, default=20)
    parser.add_argument("--only", action="append", default=[], help="properties whose name holds this text")
    parser.add_argument("--log", type=Path, default=ROOT / "target" / "campaign" / "properties.jsonl")
    arguments = parser.parse_args()
    if arguments.shards < 1 or arguments.cases % arguments.shards:
        parser.error("the cases must be a multiple of the shards")
    tested, executable, each = commit(), program(), arguments.cases // arguments.shards
    names = [name for name in properties(executable) if not arguments.only or any(text in name for text in arguments.only)]
    if not names:
        parser.error("no property has such a name")
    arguments.log.parent.mkdir(parents=True, exist_ok=True)
    lines = known(arguments.log, tested)
    done = {(line["property"], line["seed"], line["cases"]) for line in lines}
    for shard in range(arguments.shards):
        for name in names:
            if (name, seed(name, shard), each) in done:
                continue
            line = run(executable, tested, name, shard, each)
            lines.append(line)
            with arguments.log.open("a") as log:
                # a line that was cut off ends here
                log.write("\n" + json.dumps(line))
    summary(lines)
    sys.exit(not all(line["passed"] for line in lines))


if __name__ == "__main__":
    main()
