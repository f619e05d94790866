"""The protocol loop against good, bad and hostile lines; no engine needed."""

import io
import json
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS), str(SCRIPTS / "engines")]

import _protocol  # noqa: E402
from reference.client import Engine, EngineError  # noqa: E402


def _refuse(_request):
    raise _protocol.Unsupported("no such thing here")


HANDLERS = {
    "describe": lambda request: {"name": "toy"},
    "nan": lambda request: {"value": float("nan")},
    "refuse": _refuse,
    "fail": lambda request: 1 / 0,
    "field": lambda request: request["scene"],
}


def request(kind, number=1, **fields):
    return json.dumps({"protocol": _protocol.PROTOCOL, "id": number, "request": kind, **fields})


def converse(*lines):
    sink = io.BytesIO()
    _protocol.serve(HANDLERS, io.BytesIO("\n".join(lines).encode() + b"\n"), sink)
    return [json.loads(line) for line in sink.getvalue().splitlines()]


class Replies(unittest.TestCase):
    def setUp(self):
        self.stderr, sys.stderr = sys.stderr, io.StringIO()

    def tearDown(self):
        sys.stderr = self.stderr

    def test_a_result_carries_the_id_of_its_request(self):
        self.assertEqual(converse(request("describe", 7)), [{"id": 7, "result": {"name": "toy"}}])

    def test_unsupported_says_why(self):
        self.assertEqual(converse(request("refuse")),
                         [{"id": 1, "unsupported": "no such thing here"}])

    def test_an_unknown_request_is_unsupported(self):
        self.assertIn("unsupported", converse(request("fly"))[0])

    def test_an_exception_becomes_an_error_and_the_loop_goes_on(self):
        replies = converse(request("fail", 1), request("describe", 2))
        self.assertIn("ZeroDivisionError", replies[0]["error"])
        self.assertEqual(replies[1]["id"], 2)

    def test_a_missing_field_is_named(self):
        self.assertIn("scene", converse(request("field"))[0]["error"])

    def test_nan_in_a_result_is_an_error(self):
        self.assertIn("error", converse(request("nan"))[0])

    def test_nan_in_a_request_is_an_error(self):
        line = request("describe")[:-1] + ', "x": NaN}'
        self.assertIn("NaN", converse(line)[0]["error"])

    def test_broken_json_and_other_protocols_are_errors(self):
        for line in ("{", "[]", '{"protocol":"other/1","id":3,"request":"describe"}'):
            self.assertIn("error", converse(line)[0])

    def test_bye_ends_the_loop(self):
        self.assertEqual(len(converse(request("bye", 1), request("describe", 2))), 1)


ADAPTER = """
import os, sys
sys.path.insert(0, {engines!r})
from _protocol import serve
def noisy(request):
    print("stray line")
    os.write(1, b"stray bytes\\n")
    return {{"ok": True}}
serve({{"noisy": noisy, "quit": lambda request: os._exit(3)}})
"""


class Process(unittest.TestCase):
    def test_stray_output_does_not_reach_the_client(self):
        with tempfile.TemporaryDirectory() as folder:
            script = Path(folder) / "adapter.py"
            script.write_text(ADAPTER.format(engines=str(SCRIPTS / "engines")))
            with open(Path(folder) / "log", "wb") as log, \
                    Engine([sys.executable, str(script)], log) as engine:
                self.assertEqual(engine.ask("noisy"), {"ok": True})
                with self.assertRaisesRegex(EngineError, "unsupported"):
                    engine.ask("describe")
                with self.assertRaisesRegex(EngineError, "ended"):
                    engine.ask("quit")
            self.assertIn(b"stray line", (Path(folder) / "log").read_bytes())


if __name__ == "__main__":
    unittest.main()
