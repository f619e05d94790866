"""What every decision needs: the exception, what is demanded, and the fields that a witness has."""


class Wrong(Exception):
    """A witness does not show what it says."""


def demand(holds: bool, what: str) -> None:
    """Raises unless it holds."""
    if not holds:
        raise Wrong(what)


def answers(one: dict, *known: str) -> str:
    """The answer, one of those there are."""
    demand(one["answer"] in known, f"there is no answer {one['answer']!r}")
    return one["answer"]


def only(one: dict, *names: str) -> None:
    """Demands that a witness has these fields beside its kind, and no other."""
    demand(set(one) - {"kind"} == set(names), f"its fields are {', '.join(sorted(set(one) - {'kind'}))}, not {', '.join(sorted(names))}")


def count(one: dict, name: str, least: int, most: int) -> int:
    """The one whole number of a field, within bounds."""
    value = one[name]
    right = isinstance(value, list) and len(value) == 1 and type(value[0]) is int and least <= value[0] <= most
    demand(right, f"{name} is no list of one number from {least} to {most}")
    return value[0]


def enumerable(rows: list) -> list:
    """The matrix, if it has rows and few enough that all their subsets can be looked at."""
    demand(0 < len(rows) <= 12, f"the matrix has {len(rows)} rows, not 1 to 12")
    return rows
