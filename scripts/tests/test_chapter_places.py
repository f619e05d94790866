"""A quotation of the chapter is a clause: it cuts no formula, no bracket and no quotation, and is short. The sentences here are ours."""

import json
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import chapter_places
from chapter_places import LONGEST, clause, is_whole, length

LONG = "很" * (LONGEST + 1)


class Clause(unittest.TestCase):
    def test_words_grow_to_the_clause_around_them(self):
        self.assertEqual(clause("前半句,后半句在这里;最后一句。", "半句在"), "后半句在这里")
        self.assertEqual(clause("前半句,后半句在这里;最后一句。", "前半句,后"), "前半句,后半句在这里")

    def test_no_formula_is_cut_and_a_comma_in_it_is_no_end(self):
        line = r"集合 \(\{x, y\}\) 有界,且凸"
        self.assertEqual(clause(line, r"x, y"), r"集合 \(\{x, y\}\) 有界")

    def test_no_bracket_quotation_or_bold_word_is_cut(self):
        self.assertEqual(clause("接触(法向,切向)成对,分开", "法向,切"), "法向,切向")
        self.assertEqual(clause("接触(法向,切向)成对,分开", "切向)成"), "接触(法向,切向)成对")
        self.assertEqual(clause('所谓"接触,分离"二者,其一', '离"二'), '"接触,分离"二者')
        self.assertEqual(clause("这是**严格,唯一**的解,其一", "唯一**的"), "这是**严格,唯一**的解")

    def test_a_formula_with_words_is_left_out(self):
        self.assertEqual(clause(r"证明它等价于条件 \(x\ \text{或}\ y\),其一", "等价于"), "证明它等价于条件")

    def test_a_number_is_not_cut(self):
        self.assertEqual(clause("步长为 0.5 或 1,000 步,其一", "1,0"), "步长为 0.5 或 1,000 步")

    def test_a_clause_that_is_too_long_gives_a_part_that_is_whole(self):
        self.assertEqual(clause(f"{LONG} 四个字的 {LONG}", "个字"), "四个字的")
        self.assertIsNone(clause(LONG, "很很"))

    def test_a_clause_of_a_clause_is_itself(self):
        line = r"设 \(x>0\)(见上),则 \(f(x)\) 有界;证毕"
        for words in ("见上", "有界", "(x>0"):
            found = clause(line, words)
            self.assertEqual(clause(line, found), found)

    def test_a_formula_is_as_long_as_it_is_read(self):
        self.assertEqual(length(r"有 \(\alpha_{1}\,x\)"), len("有 ") + len("α1 x"))

    def test_what_is_cut_is_seen(self):
        for text in (r"设 \(x", r"x\) 有界", "(见上", "见上)", '所谓"接触', "**严格", "`name", "(甲]乙"):
            self.assertFalse(is_whole(text), text)


class Stored(unittest.TestCase):
    def test_every_stored_quotation_is_whole_and_short(self):
        places = json.loads(chapter_places.FILE.read_text(encoding="utf-8"))["places"]
        for claim, entries in places.items():
            for entry in entries:
                self.assertTrue(is_whole(entry["words"]) and length(entry["words"]) <= LONGEST, f"{claim}: {entry['words']}")


if __name__ == "__main__":
    unittest.main()
