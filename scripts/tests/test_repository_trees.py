"""What a repository holds at a commit is read from a clone; made here, so that no network is needed."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(SCRIPTS)]

import repository_trees  # noqa: E402
from reference import documents  # noqa: E402

SOURCE = "void solve_a(int n) {}\nstatic void solve_b(int n) {}\nvoid solve_c(int n) {}\nvoid solve_a(int n);\n"


class Clone(unittest.TestCase):
    """A repository with a tag, and a file that moves after it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.clone = self.folder / "toy"
        self.clone.mkdir()
        self.git("init", "--quiet")
        for name, text in (("src/solver.c", SOURCE), ("src/other/my_solver.c", ""), ("fluid/solver.c", ""), ("src/größe.cu", "")):
            (self.clone / name).parent.mkdir(parents=True, exist_ok=True)
            (self.clone / name).write_text(text, encoding="utf-8")
        self.git("add", ".")
        self.commit("first")
        self.git("tag", "1.0")
        self.git("mv", "src/solver.c", "src/other/solver.c")
        self.commit("second")

    def git(self, *arguments):
        return repository_trees.git(self.clone, *arguments)

    def commit(self, message):
        self.git("-c", "user.name=toy", "-c", "user.email=toy@example.org", "commit", "--quiet", "-m", message)

    def tree(self, revision, sought, without=(), wanted=None):
        return repository_trees.tree(self.clone, "owner/toy", revision, sought, list(without), wanted or {})

    def test_a_file_is_found_by_its_name_at_the_revision_that_is_asked(self):
        self.assertEqual(self.tree("1.0", ["solver.c"])["stated"]["files"], ["fluid/solver.c", "src/solver.c"])
        self.assertEqual(self.tree("HEAD", ["solver.c"], ["fluid/"])["stated"]["files"], ["src/other/solver.c"])
        self.assertEqual(self.tree("HEAD", ["other/*.c"])["stated"]["files"], ["src/other/my_solver.c", "src/other/solver.c"])
        self.assertEqual(self.tree("1.0", ["*.cu"])["stated"]["files"], ["src/größe.cu"])
        self.assertEqual(self.tree("1.0", ["nothing.c"])["stated"]["files"], [])

    def test_the_entry_says_which_commit_it_is_of(self):
        entry = self.tree("1.0", ["solver.c"])
        self.assertEqual(entry["commit"], self.git("rev-parse", "HEAD~1").strip())
        self.assertRegex(entry["date"], r"^\d{4}-\d\d-\d\d$")

    def test_words_of_a_file_are_told_once_and_none_where_there_is_no_such_file(self):
        wanted = {"functions": ["src/solver.c", r"^void (solve_\w+)\("]}
        self.assertEqual(self.tree("1.0", ["solver.c"], wanted=wanted)["stated"]["functions"], ["solve_a", "solve_c"])
        self.assertEqual(self.tree("HEAD", ["solver.c"], wanted=wanted)["stated"]["functions"], [])

    def test_a_clone_is_found_under_its_name_or_its_owners_and_a_missing_one_ends_the_program(self):
        self.assertEqual(repository_trees.clone_of(self.folder, "owner/toy"), self.clone)
        self.clone.rename(self.folder / "owner+toy")
        self.assertEqual(repository_trees.clone_of(self.folder, "owner/toy"), self.folder / "owner+toy")
        for failing in (lambda: repository_trees.clone_of(self.folder, "owner/other"),
                        lambda: repository_trees.git(self.folder / "owner+toy", "rev-parse", "--verify", "2.0")):
            with self.assertRaises(SystemExit) as ended, contextlib.redirect_stderr(io.StringIO()):
                failing()
            self.assertEqual(ended.exception.code, 2)


class Stored(unittest.TestCase):
    def test_the_stored_trees_are_those_of_the_script(self):
        stored = documents.read(repository_trees.FILE)
        self.assertEqual(stored["schema"], repository_trees.SCHEMA)
        self.assertEqual(stored["provenance"]["script"], "scripts/repository_trees.py")
        kept = [tuple(tree[key] for key in ("repository", "revision", "sought", "without", "words")) for tree in stored["trees"]]
        self.assertEqual(kept, repository_trees.TREES)
        for tree in stored["trees"]:
            self.assertTrue(all(repository_trees.fits(file, tree["sought"], tree["without"]) for file in tree["stated"]["files"]))
            self.assertEqual(set(tree["stated"]), {"files", *tree["words"]})
        self.assertEqual(documents.render(stored), repository_trees.FILE.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
