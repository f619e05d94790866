"""Comparing a regenerated document with the stored one, and showing that the comparison can fail."""

from reference.documents import leaves
from reference.tolerance import COUNTS, is_computed, tolerances

IGNORED = "provenance/sensitivity"


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def comparable(document):
    """Leaves without the stored sensitivity, which belongs to the comparison."""
    return {place: leaf for place, leaf in leaves(document).items()
            if not place.startswith(IGNORED)}


def numbers_by_kind(table):
    """{kind: [numbers]} of a table of leaves; lengths of lists are not numbers."""
    result = {}
    for kind, value in table.values():
        if _is_number(value) and not kind.endswith("/#"):
            result.setdefault(kind, []).append(value)
    return result


def _absent(kind):
    """What an absent leaf stands for: contacts without impulse are not listed."""
    return 0.0 if kind == "contacts/impulse" else None


def _comparable_place(place, kind, one, other):
    """A contact that only one side lists has an impulse to compare, but no normal, no length."""
    both = place in one and place in other
    return both or not kind.startswith("contacts/") or kind == "contacts/impulse"


def differences(stored, fresh, tolerance):
    """Messages for all places where two tables of leaves differ by more than `tolerance[kind]`."""
    messages = []
    for place in sorted(set(stored) | set(fresh)):
        kind = (stored.get(place) or fresh.get(place))[0]
        old = stored[place][1] if place in stored else _absent(kind)
        new = fresh[place][1] if place in fresh else _absent(kind)
        if not _comparable_place(place, kind, stored, fresh):
            continue
        if _is_number(old) and _is_number(new):
            allowed = tolerance.get(kind, 0.0)
            if not abs(old - new) <= allowed:
                messages.append(f"{place}: stored {old!r}, now {new!r}, "
                                f"difference {abs(old - new):.3e}, tolerance {allowed:.3e}")
        elif old != new or type(old) is not type(new):
            messages.append(f"{place}: stored {old!r}, now {new!r}")
    return messages


def largest_changes(base, other):
    """{kind: largest change} between two tables with the same structure.

    Raises ValueError when another structure came out: such a file could not be compared.
    """
    result = {}
    for place in set(base) | set(other):
        kind = (base.get(place) or other.get(place))[0]
        if not is_computed(kind) or not _comparable_place(place, kind, base, other):
            continue
        old = base[place][1] if place in base else _absent(kind)
        new = other[place][1] if place in other else _absent(kind)
        if _is_number(old) and _is_number(new) and not kind.endswith("/#"):
            result[kind] = max(result.get(kind, 0.0), abs(old - new))
        elif old != new:
            raise ValueError(f"{place} is {old!r} or {new!r}, depending on rounding")
    return result


def tolerances_of(document, table):
    """{kind: tolerance} from the sensitivity stored in the document."""
    provenance = document.get("provenance", {})
    return tolerances(numbers_by_kind(table), provenance.get("sensitivity", {}),
                      provenance.get("steps", 0))


def check(stored, fresh):
    """Compare two documents.

    Returns (messages, blind): the differences, and the kinds whose control failed.  The control
    moves one stored number of every kind by ten times its tolerance, which must be reported.
    """
    old, new = comparable(stored), comparable(fresh)
    allowed = tolerances_of(stored, old)
    messages = differences(old, new, allowed)
    blind, tried = [], set()
    for place, (kind, value) in old.items():
        if kind in tried or kind not in allowed or not _is_number(value) or place not in new:
            continue
        tried.add(kind)
        shift = 10 * allowed[kind] if allowed[kind] > 0 else 1e-9 * max(1.0, abs(value))
        one = {place: (kind, value + shift)}
        if not differences(one, {place: new[place]}, allowed) and kind not in COUNTS:
            blind.append(kind)
    return messages, blind
