"""Tables of the measurement of steps, for reading or as Markdown."""

import re


def refused(row):
    """The reason why none of the scenes is taken, if every run says so: exit code 2, the scene, why."""
    said = [re.fullmatch(r"exit code 2: error: box-\d+: (.*)", run["failed"] or "") for run in row["bad"]]
    reasons = {one.group(1) for one in said if one}
    return reasons.pop() if len(said) == row["runs"] and all(said) and len(reasons) == 1 else None


def show(value):
    """A cell: – for what is not reported."""
    if value is None:
        return "–"
    return value if isinstance(value, str) else str(value) if isinstance(value, int) else f"{value:.3g}"


def table(title, heads, rows, markdown):
    """Lines of one table, as Markdown or in aligned columns."""
    cells = [list(heads)] + [[show(cell) for cell in row] for row in rows]
    if markdown:
        lines = ["| " + " | ".join(row) + " |" for row in cells]
        return ["", f"**{title}**", "", lines[0], "|" + "---|" * len(heads), *lines[1:]]
    widths = [max(map(len, column)) for column in zip(*cells)]
    return ["", title, *("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in cells)]


def side_by_side(rows, keys, measures, names):
    """Heads and cells: the keys, then each measure once per binary."""
    heads = [*keys, *(f"{measure} {name}".strip() if len(names) > 1 else measure for measure in measures for name in names)]
    return heads, [[row[key] for key in keys] + [row.get(name, {}).get(measure) for measure in measures for name in names]
                   for row in rows]


def report(boxes, piles, heavy, names, markdown):
    """All tables and the list of runs that went wrong."""
    taken = [row for row in boxes if not all(refused(row[name]) for name in names if name in row)]
    lines = []
    for title, rows in (("Tumbling boxes", taken), ("Thrown piles", piles)):
        lines += table(title, *side_by_side(rows, ("scheme", "solver"), (
            "runs", "gained", "higher", "rejected", "unconverged", "failed", "residual", "seconds"), names), markdown)
    lines += table("Heavy on light", *side_by_side(heavy, ("motion", "ratio", "solver"), (
        "steps", "depth", "lowest", "seconds"), names), markdown)
    others = [row for row in boxes if row not in taken]
    lines += ["", *(f"- {row['scheme']} takes no such scene: {refused(row[names[-1]])}" for row in others)]
    for row in taken + piles:
        for name in names:
            reasons = sorted({run["failed"] for run in row.get(name, {"bad": []})["bad"] if run["failed"]})
            lines += [f"- {row['scheme']} {row['solver']} ({name}) fails: {reason}" for reason in reasons]
    return lines
