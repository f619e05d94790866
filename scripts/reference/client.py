"""The other end of `moreau-engine/1`: starts an adapter and asks it."""

import json
import subprocess

PROTOCOL = "moreau-engine/1"


class EngineError(Exception):
    """The adapter answered `error` or `unsupported`, or broke the protocol."""


class Engine:
    """One running adapter; use as a context manager."""

    def __init__(self, command, log):
        self.command = command
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=log)
        self.number = 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            try:
                self.ask("bye")
            except (EngineError, OSError):
                pass
        self.process.stdin.close()
        self.process.stdout.close()
        try:
            self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def ask(self, request, **fields):
        """Send one request and return its result."""
        self.number += 1
        message = {"protocol": PROTOCOL, "id": self.number, "request": request, **fields}
        self.process.stdin.write(json.dumps(message, allow_nan=False).encode() + b"\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise EngineError(f"the adapter ended during {request!r}")

        def refuse(token):
            raise EngineError(f"the adapter wrote {token}")
        try:
            reply = json.loads(line, parse_constant=refuse)
        except ValueError as problem:
            raise EngineError(f"not a reply: {line[:80]!r} ({problem})") from problem
        if not isinstance(reply, dict) or reply.get("id") != self.number:
            raise EngineError(f"the reply does not answer request {self.number}: {line[:80]!r}")
        for kind in ("unsupported", "error"):
            if kind in reply:
                raise EngineError(f"{request}: {kind}: {reply[kind]}")
        if "result" not in reply:
            raise EngineError(f"a reply without result: {line[:80]!r}")
        return reply["result"]
