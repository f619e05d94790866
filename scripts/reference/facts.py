"""What an engine says of itself, `facts/1`: `stated` must not change, `computed` may round differently.

A computed number may move by 1e-6 of the largest of its kind, or of 1: the experiments take at
most a hundred steps or iterations, and none of them is unstable by more than 1e9 in that time.
"""

from reference.compare import differences
from reference.documents import leaves

SCENE = "block_slide"
ROUNDING = 1e-6


def document(engine, scene, description):
    """The engine's facts and where they come from."""
    return {
        "schema": "facts/1", **engine.ask("facts", scene=scene),
        "provenance": {"script": "scripts/generate_references.py", "engine": description["name"],
                       "version": description["version"], "scene": f"scenes/{SCENE}.json"},
    }


def _is_float(value):
    return isinstance(value, float)


def _allowed(table):
    sizes = {}
    for kind, value in table.values():
        if kind.startswith("computed/") and _is_float(value):
            sizes[kind] = max(sizes.get(kind, 1.0), abs(value))
    return {kind: ROUNDING * size for kind, size in sizes.items()}


def differences_of(stored, fresh):
    """Messages for what differs; as a control, a number of every kind moved by ten tolerances."""
    old, new = leaves(stored), leaves(fresh)
    allowed = _allowed(old)
    messages, tried = differences(old, new, allowed), set()
    for place, (kind, value) in old.items():
        if kind in tried or not _is_float(value) or place not in new:
            continue
        tried.add(kind)
        moved = {place: (kind, value + (10 * allowed[kind] if kind in allowed else 1e-9))}
        if not differences(moved, {place: new[place]}, allowed):
            messages.append(f"control: ten times the tolerance of {kind} goes unnoticed")
    return messages
