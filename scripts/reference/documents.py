"""JSON documents: stable text, atomic writing, and numbers by place."""

import json
import os
import tempfile


def _inline(value):
    return json.dumps(value, allow_nan=False, ensure_ascii=False, separators=(",", ":"))


def _is_row(value):
    """A list of scalars, or anything empty or scalar: stays on one line."""
    if isinstance(value, dict):
        return all(not isinstance(x, (dict, list)) for x in value.values())
    return not isinstance(value, list) or all(not isinstance(x, (dict, list)) for x in value)


def _render(value, indent):
    if _is_row(value):
        return _inline(value)
    inner = indent + " "
    if isinstance(value, dict):
        if "sample" in value:  # one contact record per line
            return _inline(value)
        parts = [f"{_inline(key)}:{_render(item, inner)}" for key, item in value.items()]
        return "{\n" + ",\n".join(inner + part for part in parts) + "\n" + indent + "}"
    parts = [_render(item, inner) for item in value]
    return "[\n" + ",\n".join(inner + part for part in parts) + "\n" + indent + "]"


def render(document):
    """The text of a document: one row of numbers per line, floats in shortest exact form."""
    return _render(document, "") + "\n"


def write(path, document):
    """Replace the file in one move, so that an interrupted run leaves no half file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=".tmp")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(render(document))
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


def read(path):
    """Parse a file; NaN and Infinity are refused."""
    def refuse(token):
        raise ValueError(f"{path}: {token} is not allowed")
    return json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse)


def leaves(document):
    """{place: (kind, scalar)} of every scalar, and of every list's length.

    The place names one scalar; the kind is the place without list indices, and a tolerance
    belongs to a kind.  Contacts of a trajectory are placed by sample and pair of bodies, so that
    lists of different length can be compared: a contact that is absent has impulse zero.
    """
    result = {}

    def walk(value, place, kind):
        if isinstance(value, dict):
            for key, item in value.items():
                walk(item, f"{place}/{key}", f"{kind}/{key}")
        elif isinstance(value, list):
            result[f"{place}/#"] = (f"{kind}/#", len(value))
            for index, item in enumerate(value):
                walk(item, f"{place}/{index}", kind)
        else:
            result[place] = (kind, value)

    for key, item in document.items():
        if key == "contacts":
            for contact in item:
                name = f"{contact['sample']}:{'+'.join(contact['bodies'])}"
                for part in ("normal", "impulse"):
                    walk(contact[part], f"contacts/{name}/{part}", f"contacts/{part}")
        else:
            walk(item, key, key)
    return result
