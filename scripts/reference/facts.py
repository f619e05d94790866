"""`facts/1`: what a program says of itself and what its package holds; one format, written, read and compared here.

    schema      "facts/1"
    program     the engine: mujoco, drake, siconos, bullet, …
    version     of the package that was asked
    stated      names, settings, sentences, files, lines of source: compared exactly
    computed    numbers of small experiments, which may round differently; {} where there are none
    provenance  script that writes the file, `package`, what was `read` of it and, where one was asked about, the `scene`

Who asks depends on the program: MuJoCo and Drake answer the request `facts` of their adapters, the
Debian packages of Siconos are read by reference.siconos_package, and wheels, crates and source
distributions by reference.packages.  What `package.json` of an engine holds is of the same kind,
exact statements about a pinned package, and so of the same format; it stands in the engine's folder,
where the claims cite it.

A computed number may move by 1e-6 of the largest of its kind, or of 1: the experiments take at
most a hundred steps or iterations, and none of them is unstable by more than 1e9 in that time.
"""

from reference import documents
from reference.compare import differences
from reference.documents import leaves

SCHEMA = "facts/1"
KEYS = ("schema", "program", "version", "stated", "computed", "provenance")
SOURCE = ("script", "package", "read")
# engines whose adapters answer the request `facts` → (what is read of the package, the scene it is asked about)
ADAPTERS = {"mujoco": ("the engine, running", "block_slide"),
            "drake": ("Python module and its documentation", None)}
ROUNDING = 1e-6


def document(program, version, source, stated, computed=None):
    """A document of this format; `source` names `package`, what was `read` and perhaps the `scene`."""
    return _valid({
        "schema": SCHEMA, "program": program, "version": version, "stated": stated,
        "computed": computed or {},
        "provenance": {"script": "scripts/generate_references.py", **source}}, program)


def ask(engine, scenes, description):
    """The document of an engine whose adapter answers the request `facts`."""
    name = description["name"]
    read_of, scene = ADAPTERS[name]
    source, fields = {"package": name, "read": read_of}, {}
    if scene:
        source["scene"], fields["scene"] = f"scenes/{scene}.json", scenes[scene]
    return document(name, description["version"], source, **engine.ask("facts", **fields))


def _valid(facts, place):
    """The same facts; ValueError where they are not of this format."""
    if facts.get("schema") != SCHEMA or tuple(facts) != KEYS:
        raise ValueError(f"{place}: not {SCHEMA}, whose fields are {', '.join(KEYS)}")
    if missing := [key for key in SOURCE if not facts["provenance"].get(key)]:
        raise ValueError(f"{place}: provenance lacks {', '.join(missing)}")
    if not facts["stated"]:
        raise ValueError(f"{place}: states nothing")
    return facts


def write(path, facts):
    """Store facts."""
    documents.write(path, _valid(facts, path))


def read(path):
    """The stored facts."""
    return _valid(documents.read(path), path)


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
