"""Whether the pages of sections have every claim whole: its verdict, its statement and its correction, as report.json has them."""

import html.parser
import pathlib
import re
import unicodedata

from . import site

# How a correction begins that says no more than the sentence does; the page has a label for it.
SAME = "As stated"
# Sums and products are letters on a terminal, signs of their own in MathML.
SIGNS = {ord("∑"): "Σ", ord("∏"): "Π"}


class Claims(html.parser.HTMLParser):
    """Of every claim on a page the class of its verdict, and the English text of its statement and of its correction."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.claims: dict[str, dict[str, str]] = {}
        self.name = ""
        self.open: list[tuple[str, str]] = []  # the elements of the part that is read, each with the language of its text
        self.part = ""
        self.language = "en"  # of the page
        self.feed(text)

    VOID = {"br", "img", "meta", "link", "input", "hr"}

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        found = dict(attributes)
        classes = (found.get("class") or "").split()
        if tag == "html":
            self.language = found.get("lang") or ""
        if tag == "article" and "claim" in classes:
            self.name = found.get("id") or ""
            self.claims[self.name] = {"verdict": "", "statement": "", "correction": ""}
        begins = self.name and (tag == "blockquote" or "correct" in classes)
        if begins and not self.part:
            self.part = "statement" if tag == "blockquote" else "correction"
        if self.part and tag not in self.VOID:
            around = self.open[-1][1] if self.open else self.language
            self.open.append((tag, found.get("lang") or around))
        if self.name and "verdict" in classes and not self.claims[self.name]["verdict"]:
            self.claims[self.name]["verdict"] = classes[-1]

    def handle_endtag(self, tag: str) -> None:
        if self.part and tag not in self.VOID:
            self.open.pop()
            if not self.open:
                self.part = ""

    def handle_data(self, data: str) -> None:
        if self.part and self.open[-1][1] == "en":
            self.claims[self.name][self.part] += data


def letters(text: str) -> list[str]:
    """The letters and digits of a text, sorted: a formula has the same as Unicode and as MathML, in an order of its own where it has scripts."""
    written = unicodedata.normalize("NFKD", text).translate(SIGNS)
    return sorted(letter for letter in written if unicodedata.category(letter)[0] in "LN")


def cut(folder: pathlib.Path) -> list[str]:
    """Claims that a section page of either language has otherwise than report.json, or not at all."""
    wrong = []
    claims = site.document(folder)["claims"]
    for room in (folder, folder / "zh"):
        shown = {name: parts for page in sorted(room.glob("section-*.html")) for name, parts in Claims(page.read_text()).claims.items()}
        for claim in claims:
            name, parts = claim["id"], shown.get(claim["id"])
            if parts is None:
                wrong.append(f"{room.name}: {name} stands on no page of a section")
                continue
            reads = re.sub(f"^{SAME}[,;:. ]*", "", claim["correct_statement"])
            for what, text in (("statement", claim["statement"]), ("correction", reads)):
                if letters(parts[what]) != letters(text):
                    wrong.append(f"{room.name}: the {what} of {name} ends with “{parts[what][-40:]}”, and in report.json with “{text[-40:]}”")
            if parts["verdict"] != site.axis(claim, "verdict"):
                wrong.append(f"{room.name}: the verdict of {name} is {parts['verdict']}")
    return wrong
