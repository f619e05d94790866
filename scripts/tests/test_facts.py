"""The format `facts/1`: what it takes, what it keeps, and what counts as another fact; no engine needed."""

import copy
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS)]

import repository_trees  # noqa: E402
from reference import documents, facts, packages, siconos_package  # noqa: E402

REFERENCES = SCRIPTS.parent / "references"
LITERATURE = REFERENCES / "facts" / "literature.json"
SOURCE = {"package": "toy-engine", "read": "wheel"}


class Toy:
    """An adapter that says what it was asked."""

    def ask(self, request, **fields):
        return {"stated": {"asked": request, "scene": fields.get("scene")}}


class Comparison(unittest.TestCase):
    def setUp(self):
        self.stored = facts.document("toy", "1.0", SOURCE, {"solver": 2, "step": 0.002, "files": ["a.h", "b.h"]},
                                     {"accelerations": [1.0, 20.0]})
        self.fresh = copy.deepcopy(self.stored)

    def messages(self):
        return facts.differences_of(self.stored, self.fresh)

    def test_rounding_of_what_is_computed_passes_and_more_does_not(self):
        self.assertEqual(self.messages(), [])
        self.fresh["computed"]["accelerations"][0] += 1e-5
        self.assertEqual(self.messages(), [])
        self.fresh["computed"]["accelerations"][0] += 2e-5
        self.assertEqual(len(self.messages()), 1)

    def test_what_is_stated_must_not_change(self):
        self.fresh["stated"]["solver"] = 1
        self.assertEqual(len(self.messages()), 1)
        self.fresh["stated"]["solver"] = 2
        self.fresh["stated"]["step"] += 1e-15
        self.assertEqual(len(self.messages()), 1)

    def test_another_file_another_version_and_another_source_are_differences(self):
        for key, change in (("stated", lambda stated: stated["files"].pop()),
                            ("provenance", lambda source: source.update(read="crate"))):
            self.fresh = copy.deepcopy(self.stored)
            change(self.fresh[key])
            self.assertTrue(self.messages(), key)
        self.fresh = {**self.stored, "version": "1.1"}
        self.assertEqual(len(self.messages()), 1)


class Format(unittest.TestCase):
    def test_what_is_written_is_read_and_nothing_else_is(self):
        made = facts.document("toy", "1.0", SOURCE, {"solver": 2})
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "toy.json"
            facts.write(path, made)
            self.assertEqual(facts.read(path), made)
            for other in ({**made, "schema": "package/1"}, {**made, "stated": {}}, {**made, "headers": []},
                          {key: value for key, value in made.items() if key != "computed"},
                          {**made, "provenance": {"script": "x", "package": "toy-engine"}}):
                with self.assertRaises(ValueError):
                    facts.write(path, other)
                documents.write(path, other)
                with self.assertRaisesRegex(ValueError, "toy.json"):
                    facts.read(path)

    def test_an_adapter_is_asked_about_a_scene_where_it_has_one(self):
        for name, (_, scene) in facts.ADAPTERS.items():
            made = facts.ask(Toy(), {"block_slide": {"name": "a block"}}, {"name": name, "version": "1.0"})
            self.assertEqual(made["stated"], {"asked": "facts", "scene": {"name": "a block"} if scene else None})
            self.assertEqual("scene" in made["provenance"], bool(scene))


class Stored(unittest.TestCase):
    def test_every_stored_fact_is_of_this_format_and_of_the_program_it_is_named_after(self):
        expected = {f"facts/{name}.json": name for name in facts.ADAPTERS}
        expected |= {siconos_package.PLACE: "siconos"}
        expected |= {packages.place(name): name for name in packages.SUBJECTS}
        there = {path.relative_to(REFERENCES).as_posix()
                 for pattern in ("facts/*", "*/package.json") for path in REFERENCES.glob(pattern)}
        # what is not about an engine has a format of its own
        others = {path.relative_to(REFERENCES).as_posix() for path in (repository_trees.FILE, LITERATURE)}
        self.assertEqual(there, set(expected) | others)
        for place, name in expected.items():
            stored = facts.read(REFERENCES / place)
            self.assertEqual(stored["program"], name)
            self.assertEqual(facts.differences_of(stored, stored), [])
            self.assertEqual(documents.render(stored), (REFERENCES / place).read_text(encoding="utf-8"))

    def test_every_record_of_literature_says_where_it_was_read_and_that_no_script_makes_it(self):
        stored = documents.read(LITERATURE)
        self.assertEqual(stored["schema"], "literature/1")
        self.assertEqual(stored["provenance"]["script"], "none")
        for record in stored["records"]:
            self.assertEqual(tuple(record), ("id", "identifier", "read", "transcribed", "entered", "stated"))
            self.assertTrue(record["read"] and record["stated"] and "by hand" in record["transcribed"], record["id"])
        self.assertEqual(documents.render(stored), LITERATURE.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
