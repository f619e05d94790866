"""A written report as a folder: its pages, what links where, and what report.json counts."""

import functools
import html.parser
import json
import pathlib
import re
import tomllib
import unicodedata
import urllib.parse

ERRATA = pathlib.Path(__file__).resolve().parents[2] / "src" / "claims" / "errata.zh.toml"
MOST_BYTES = 15_000_000
KEYS = {"TRUE": "true", "TRUE WITH CONDITIONS": "conditional", "FALSE AS STATED": "false", "INTERNALLY INCONSISTENT": "inconsistent", "AMBIGUOUS": "ambiguous"}
AXES = ("section", "verdict", "severity", "kind", "evidence")


class Links(html.parser.HTMLParser):
    """The ids of a page and what it refers to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if name == "id":
                self.ids.add(value or "")
            if name in ("href", "src") and value:
                self.links.append(value)


def pages(folder: pathlib.Path) -> list[pathlib.Path]:
    """Every page, by name."""
    return sorted(folder.rglob("*.html"))


def lost_links(folder: pathlib.Path) -> list[str]:
    """Links that lead nowhere; an anchor with = is a choice of filters, or of the explorer."""
    read = {page.resolve(): Links(page.read_text()) for page in pages(folder)}
    wrong = []
    for page, found in read.items():
        for link in found.links:
            parts = urllib.parse.urlsplit(link)
            target = (page.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else page
            anchor = urllib.parse.unquote(parts.fragment)
            known = read[target].ids if target in read else set()
            if parts.scheme or not target.is_file() or (anchor and "=" not in anchor and anchor not in known):
                wrong.append(f"{page.relative_to(folder.resolve())}: {link} leads nowhere")
    return wrong


def document(folder: pathlib.Path) -> dict:
    """report.json."""
    return json.loads((folder / "report.json").read_text())


def axis(claim: dict, name: str) -> str:
    """The value of a claim on an axis, as filters name it."""
    value = claim.get(name) or ""
    return KEYS[value] if name == "verdict" else value


# Dashes and quotes as a keyboard has them.
TYPED = {**dict.fromkeys([*range(0x2010, 0x2016), 0x2212], "-"), ord("‘"): "'", ord("’"): "'", ord("“"): '"', ord("”"): '"'}


def plain(text: str) -> str:
    """A text as the search compares it."""
    letters = (letter for letter in unicodedata.normalize("NFKD", text) if not unicodedata.category(letter).startswith("M"))
    return "".join(letters).translate(TYPED).lower()


@functools.cache
def errata() -> dict:
    """The errata in Chinese."""
    return tomllib.loads(ERRATA.read_text())


def words_of(claim: dict, page: pathlib.Path) -> str:
    """What the search of a page looks at; on a Chinese page also the erratum, the headings and the chapter's words."""
    words = [claim[name] for name in ("id", "title", "statement", "correct_statement")]
    if page.parent.name == "zh":
        words += errata().get(claim["id"], {}).values()
        words += [place[name] for place in claim["places"] for name in ("heading", "words")]
    return plain(" ".join(words))


def too_large(folder: pathlib.Path) -> list[str]:
    """Whether the report is larger than it may be."""
    size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())
    print(f"size: {size / 1e6:.1f} MB, at most {MOST_BYTES / 1e6:.0f}", flush=True)
    return [f"the report has {size} bytes"] if size > MOST_BYTES else []


def unlabelled(folder: pathlib.Path) -> list[str]:
    """Pictures that name no unit in brackets."""
    texts = lambda file: re.findall(r"<text\b[^>]*>(.*?)</text>", file.read_text(), re.DOTALL)
    return [f"{file.name} names no unit" for file in sorted((folder / "pictures").glob("*.svg")) if not any(re.search(r"\[[^\]]+\]", text) for text in texts(file))]


STANDING = re.compile(r'<article class="claim" id="([^"]+)".*?<span class="verdict ([a-z]+)"', re.DOTALL)
COUNTED = re.compile(r'<a href="claims\.html#([a-z]+)=([^"&]+)">(.*?)</a>', re.DOTALL)


def told_otherwise(folder: pathlib.Path) -> list[str]:
    """Verdicts of section pages and counts of front pages that are not those of report.json."""
    claims = document(folder)["claims"]
    verdicts = {claim["id"]: axis(claim, "verdict") for claim in claims}
    wrong = []
    for room in (folder, folder / "zh"):
        told = {name: key for page in sorted(room.glob("section-*.html")) for name, key in STANDING.findall(page.read_text())}
        wrong += [f"{room.name}: {name} is {told.get(name)} on its page" for name, key in verdicts.items() if told.get(name) != key]
        counts = COUNTED.findall((room / "index.html").read_text())
        for name, value, markup in counts:
            expected = sum(axis(claim, name) == urllib.parse.unquote(value) for claim in claims)
            if expected not in map(int, re.findall(r"\d+", re.sub("<[^>]*>", " ", markup))):
                wrong.append(f"{room.name}/index.html: {name} {value} is not {expected}")
        if not counts:
            wrong.append(f"{room.name}/index.html: no count leads to the list of claims")
    return wrong
