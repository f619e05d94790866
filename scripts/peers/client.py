"""A worker as its parent sees it: started pinned to one core, asked, ended when it takes too long."""

import json
import os
import select
import subprocess
import time


def alone(core):
    """What a process does before it starts: it keeps to one core, before other processes where it may."""
    def prepare():
        os.sched_setaffinity(0, {core})
        try:
            os.nice(-20)
        except PermissionError:
            pass
    return prepare


class Late(Exception):
    """The worker did not answer in time and was ended."""


class Worker:
    """One peer's process; it is started again after it was late or has died."""

    def __init__(self, command, core):
        self.command, self.core, self.process, self.loaded = command, core, None, None

    def load(self, path, seconds):
        """The settings of the peer for a problem; [] with the reason in `refusal` where it has none."""
        self.loaded = path
        answer = self._ask({"load": str(path)}, seconds)
        self.refusal = answer.get("error")
        return answer.get("settings", [])

    def solve(self, setting, tolerance, repeat, seconds):
        """The worker's answer; `Late` where it takes longer than `seconds`."""
        if self.process is None or self.process.poll() is not None:
            self.load(self.loaded, seconds)
        return self._ask({"setting": setting, "tolerance": tolerance, "repeat": repeat}, seconds)

    def _ask(self, request, seconds):
        if self.process is None or self.process.poll() is not None:
            self._start()
        try:
            self.process.stdin.write(json.dumps(request).encode() + b"\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            self.end()
            return {"error": "the process ended"}
        line, until = b"", time.monotonic() + seconds
        while not line.endswith(b"\n"):
            ready = select.select([self.process.stdout], [], [], max(0.0, until - time.monotonic()))[0]
            if not ready:
                self.end()
                raise Late(f"more than {seconds:g} s")
            chunk = os.read(self.process.stdout.fileno(), 1 << 16)
            if not chunk:
                self.end()
                return {"error": "the process ended"}
            line += chunk
        return json.loads(line)

    def _start(self):
        one_thread = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
        self.process = subprocess.Popen(
            [str(word) for word in self.command], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, env={**os.environ, **one_thread},
            preexec_fn=alone(self.core))

    def end(self):
        """End the process."""
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            for pipe in (self.process.stdin, self.process.stdout):
                try:
                    pipe.close()
                except BrokenPipeError:
                    pass
        self.process = None
