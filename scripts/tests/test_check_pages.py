"""The runner of pages: what it runs, what it compares, what it refuses."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from check_pages import check, missing  # noqa: E402

MARK = "<!-- run by scripts/check_pages.py -->"


def judge(page):
    """What is wrong with a page, and how many blocks were run and compared."""
    with tempfile.TemporaryDirectory() as folder:
        return check(page, folder, {"PATH": "/usr/bin:/bin"})


class Pages(unittest.TestCase):
    """A page is held to what it shows."""

    def test_a_marked_block_is_run_and_compared(self):
        page = f"# a\n{MARK}\n```sh\necho one; echo two\n```\n\n```text\none\ntwo\n```\n"
        self.assertEqual(judge(page), ([], [1, 1]))
        self.assertEqual(len(judge(page.replace("```text\none", "```text\nnone"))[0]), 1)

    def test_another_exit_code_is_told(self):
        page = f"{MARK}\n```sh\nexit 1\n```\n"
        self.assertEqual(len(judge(page)[0]), 1)
        self.assertEqual(judge(page.replace(" -->", "; exit code 1 -->"))[0], [])

    def test_what_is_not_marked_is_not_run(self):
        self.assertEqual(judge("```sh\nexit 1\n```\n\n```text\nx\n```\n"), ([], [0, 0]))

    def test_lines_follow_each_other_unless_lines_are_left_out(self):
        printed = ["a", "b", "c", "d"]
        self.assertIsNone(missing(["b", "c"], printed))
        self.assertIsNone(missing(["a", "…", "d"], printed))
        self.assertEqual(missing(["a", "c"], printed), "c")
        self.assertEqual(missing(["d", "…", "a"], printed), "a")


if __name__ == "__main__":
    unittest.main()
