"""What is done to pages before mkdocs sees them, and what may not be in the site."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from build_docs import foreign, navigation, spaced, stage, targets  # noqa: E402


class Staging(unittest.TestCase):
    """Pages, and what they link to, are copied once each."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.source, self.staged = (pathlib.Path(folder.name).resolve() / name for name in ("source", "staged"))
        (self.source / "docs/engines").mkdir(parents=True)
        self.write("README.md", "[docs](docs/README.md) [rest](https://example.org)\n")
        self.write("docs/README.md", "| [a](a.md) | [engines](engines/) | [back](../README.md) |\n")
        self.write("docs/a.md", "```text\n[no](nowhere.md)\n```\n[data](data.json)\n")
        self.write("docs/data.json", "{}\n")
        self.write("docs/engines/b.md", "[a](../a.md)\n")
        stage(self.source, self.staged, pathlib.Path("README.md"), set())

    def write(self, name, text):
        (self.source / name).write_text(text, encoding="utf-8")

    def test_what_is_linked_is_there_and_a_folder_gets_an_index(self):
        names = sorted(str(path.relative_to(self.staged)) for path in self.staged.rglob("*.*"))
        self.assertEqual(names, ["README.md", "docs/README.md", "docs/a.md", "docs/data.json",
                                 "docs/engines/README.md", "docs/engines/b.md"])
        self.assertIn("[engines](engines/README.md)", (self.staged / "docs/README.md").read_text(encoding="utf-8"))
        self.assertEqual(navigation(self.staged), ["README.md", "docs/README.md", "docs/a.md", "docs/engines/README.md"])

    def test_links_in_code_are_no_links(self):
        self.assertEqual(list(targets("```text\n[a](b.md)\n```\n[c](d.md#e)\n")), ["d.md"])


class Pages(unittest.TestCase):
    """Lists are set off; nothing is loaded from elsewhere."""

    def test_a_list_gets_its_blank_line_and_nothing_else_does(self):
        self.assertEqual(spaced("text:\n- one\n- two\n"), "text:\n\n- one\n- two\n")
        for same in ("# h\n- one\n", "- one\n  more\n- two\n", "```text\na\n- b\n```\n", "| a |\n- b\n"):
            self.assertEqual(spaced(same), same)

    def test_what_loads_from_elsewhere_is_found_and_a_link_is_not(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "a.html"
            page.write_text('<a href="https://x">x</a><script src="js/base.js"></script>', encoding="utf-8")
            self.assertEqual(foreign(pathlib.Path(folder)), [])
            page.write_text('<script src="//x/y.js"></script><link rel="s" href="https://x/y.css">', encoding="utf-8")
            self.assertEqual(len(foreign(pathlib.Path(folder))), 2)


if __name__ == "__main__":
    unittest.main()
