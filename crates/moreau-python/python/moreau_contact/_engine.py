"""An engine that is a Python class, asked by the messages of moreau-engine/1.

The class has `describe(options)`, and what it can of `simulate(scene, time_step, sample_every, options)`,
`solve(problem, options)` and `project(friction, points, options)`; arguments and answers are those of docs/protocol.md as
dicts, lists and numpy arrays. `raise Unsupported(reason)` says that a question cannot be expressed.
"""
from __future__ import annotations

import ctypes
import importlib
import importlib.machinery
import importlib.util
import json
import sys
import threading
import traceback
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from ._errors import InvalidInput, Unsupported

PROTOCOL = "moreau-engine/1"
#: Whether this process is the child of a gate, which gates nothing itself.
is_child = False
_running: set[int] = set()
_lock = threading.Lock()


def made(engine: Any) -> Any:
    """An object of a class; what is an object, or was made by a function, as it is."""
    return engine() if callable(engine) else engine


def interrupt() -> None:
    """Raises KeyboardInterrupt in every engine that is being asked; code of C is not reached before it returns."""
    with _lock:
        for thread in _running:
            ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(KeyboardInterrupt))


def answer(engine: Any, line: str) -> str:
    """The reply to one line."""
    thread = threading.get_ident()
    identity = None
    try:
        with _lock:
            _running.add(thread)
        try:
            request = json.loads(line)
            identity = request.get("id")
            if request.get("protocol", PROTOCOL) != PROTOCOL:
                raise ValueError(f"`protocol` is {request['protocol']!r}; this engine speaks {PROTOCOL}")
            reply = {"id": identity, "result": _result(engine, request)}
            return text_of(reply)
        finally:
            with _lock:
                _running.discard(thread)
    except Unsupported as reason:
        return json.dumps({"id": identity, "unsupported": str(reason)})
    except KeyboardInterrupt:
        return json.dumps({"id": identity, "error": "the run was interrupted"})
    except Exception as error:  # whatever the engine raises is its answer
        return json.dumps({"id": identity, "error": _told(error)})


def _result(engine: Any, request: dict[str, Any]) -> Any:
    what = request["request"]
    names = {"describe": (), "simulate": ("scene", "time_step", "sample_every"), "solve": ("problem",), "project": ("friction", "points")}
    if what not in names:
        raise Unsupported(f"request `{what}` is not implemented")
    method = getattr(engine, what, None)
    if method is None:
        raise Unsupported(f"{type(engine).__name__} has no method `{what}`")
    found = method(*(request[name] for name in names[what]), request.get("options", {}))
    if found is None:
        raise TypeError(f"`{what}` of {type(engine).__name__} returned None")
    return found if what != "project" or isinstance(found, dict) else {"points": found}


def text_of(value: Any) -> str:
    """A value as JSON, arrays and numbers of numpy included."""
    return json.dumps(value, default=_plain)


def _plain(value: Any) -> Any:
    """Arrays and numbers of numpy as JSON has them; floats of any size in double precision."""
    if isinstance(value, (np.ndarray, np.generic)):
        return (value.astype(np.float64) if value.dtype.kind == "f" else value).tolist()
    raise TypeError(f"a {type(value).__name__} has no form in JSON")


def _told(error: Exception) -> str:
    frames = traceback.extract_tb(error.__traceback__)
    own = [frame for frame in frames if Path(frame.filename).resolve() != Path(__file__).resolve() and "/json/" not in frame.filename]
    place = f" at {Path(own[-1].filename).name}:{own[-1].lineno}" if own else ""
    # half a character of UTF-16 has no form in a message
    return f"{type(error).__name__}: {error}{place}".encode("utf-8", "replace").decode()


def address(engine: type) -> tuple[str, str]:
    """File or module, and name, of a class, from which another process can import it."""
    if not isinstance(engine, type):
        raise InvalidInput(f"`engine`: {engine!r} is no class, and no other process can make it; give a class at the top of a file",
                           "engine", "is no class", "give a class at the top of a file")
    module = sys.modules.get(engine.__module__)
    file = getattr(module, "__file__", None)
    if "." in engine.__qualname__ or file is None or not Path(file).is_file():
        where = engine.__qualname__ if "." in engine.__qualname__ else engine.__module__
        raise InvalidInput(f"`engine`: {engine.__qualname__} cannot be imported by another process (it stands in {where}); "
                           "put the class at the top of a file", "engine", "cannot be imported by another process",
                           "put the class at the top of a file")
    if getattr(module, engine.__qualname__, None) is not engine:
        raise InvalidInput(f"`engine`: {engine.__qualname__} of {engine.__module__} is another class than this one; "
                           "give the class that its file has under this name", "engine", "is not what its file has under this name",
                           "give the class that its file has under this name")
    # a package is imported by its name, anything else by its file, which need not be on the path of the child
    return (engine.__module__ if getattr(module, "__package__", "") else str(Path(file).resolve())), engine.__qualname__


def load(place: str, name: str) -> Any:
    """The class from its address."""
    if not Path(place).is_file():
        return getattr(importlib.import_module(place), name)
    sys.path.insert(0, str(Path(place).parent))
    loader = importlib.machinery.SourceFileLoader(Path(place).stem, place)
    spec = importlib.util.spec_from_file_location(Path(place).stem, place, loader=loader)
    if spec is None:
        raise ImportError(f"{place} is no Python file")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    loader.exec_module(module)
    return getattr(module, name)


def serve(engine: Any, replies: TextIO | None = None) -> None:
    """Serves an engine, a class or an object, on standard input and output, until `bye`: `moreau gate -- python3 my_engine.py`.

    What the engine prints goes to standard error.
    """
    engine = made(engine)
    if replies is None:
        replies, sys.stdout = sys.stdout, sys.stderr
    for line in sys.stdin:
        request = _object(line)
        bye = request.get("request") == "bye"
        reply = json.dumps({"id": request.get("id"), "result": {}}) if bye else answer(engine, line)
        replies.write(reply + "\n")
        replies.flush()
        if bye:
            return


def _object(line: str) -> dict[str, Any]:
    """The object on a line; an empty one where there is none, which `answer` refuses in words."""
    try:
        found = json.loads(line)
    except ValueError:
        return {}
    return found if isinstance(found, dict) else {}


def command(engine: type) -> list[str]:
    """The command of a child that serves a class; it looks for modules where this process does."""
    return [sys.executable, "-m", "moreau_contact._child", *address(engine), *filter(None, sys.path)]

