"""The engine protocol `moreau-engine/1`: one JSON object per line in, exactly one out.

    request   {"protocol": "moreau-engine/1", "id": n, "request": "simulate", ...}
    reply     {"id": n, "result": {...}}             the request was carried out
              {"id": n, "unsupported": "reason"}     this engine cannot express it
              {"id": n, "error": "message"}          it could, but something went wrong

Lines are UTF-8, at most 256 MiB long, and hold no NaN or Infinity tokens.  Nothing else may
appear on standard output, so `serve` keeps the real one for itself and sends every other print,
also those of native libraries, to standard error.  `bye` is answered and ends the loop, and so
does the end of the input.

This file needs the standard library only.  Copy it to write an adapter for another engine:

    from _protocol import Unsupported, serve

    def describe(request):
        return {"name": "my-engine", "version": "1.0", ...}

    def simulate(request):
        if request["scene"]["material"]["restitution"] != 0:
            raise Unsupported("my-engine has no coefficient of restitution")
        ...
        return trajectory

    serve({"describe": describe, "simulate": simulate})
"""

import json
import os
import sys
import traceback

PROTOCOL = "moreau-engine/1"
MAX_LINE_BYTES = 256 * 1024 * 1024


class Unsupported(Exception):
    """Raised by a handler when the engine cannot express what is asked; carries the reason."""


def _reject_constant(token):
    raise ValueError(f"{token} is not allowed in a message")


def decode(line):
    """Parse one line (bytes or str) to an object; raises ValueError when it is not a message."""
    message = json.loads(line, parse_constant=_reject_constant)
    if not isinstance(message, dict):
        raise ValueError("a message must be a JSON object")
    return message


def encode(message):
    """One line of bytes with its newline; raises ValueError on NaN, Infinity or excess length."""
    line = json.dumps(message, allow_nan=False, ensure_ascii=False, separators=(",", ":"))
    data = line.encode("utf-8") + b"\n"
    if len(data) > MAX_LINE_BYTES:
        raise ValueError(f"the message has {len(data)} bytes, more than {MAX_LINE_BYTES}")
    return data


def answer(line, handlers):
    """The reply to one request line, and whether the conversation goes on after it."""
    number = None
    try:
        request = decode(line)
        number = request.get("id")
        if request.get("protocol") != PROTOCOL:
            raise ValueError(f"this adapter speaks {PROTOCOL}, not {request.get('protocol')!r}")
        kind = request.get("request")
        if kind == "bye":
            return {"id": number, "result": {}}, False
        if kind not in handlers:
            raise Unsupported(f"request {kind!r} is not implemented")
        reply = {"id": number, "result": handlers[kind](request)}
        encode(reply)
        return reply, True
    except Unsupported as reason:
        return {"id": number, "unsupported": str(reason)}, True
    except KeyError as missing:
        traceback.print_exc(file=sys.stderr)
        return {"id": number, "error": f"missing field {missing}"}, True
    except Exception as problem:  # an adapter must answer whatever its engine throws
        traceback.print_exc(file=sys.stderr)
        return {"id": number, "error": f"{type(problem).__name__}: {problem}"}, True


def serve(handlers, source=None, sink=None):
    """Answer requests until `bye` or the end of the input.

    `handlers` maps a request name to a function of the request that returns the result.
    `source` and `sink` are binary streams; by default the process's own input and output.
    """
    if sink is None:
        sys.stdout.flush()
        sink = os.fdopen(os.dup(1), "wb")
        os.dup2(2, 1)
    source = source or sys.stdin.buffer
    while True:
        line = source.readline(MAX_LINE_BYTES + 1)
        if not line:
            return
        if not line.strip():
            continue
        reply, go_on = answer(line, handlers)
        sink.write(encode(reply))
        sink.flush()
        if not go_on:
            return
