"""Copies of the report with one mistake each, which the check for it must see."""

import pathlib
import re
import shutil
from collections.abc import Callable

from . import checks, site, statements
from .browser import Browser


def changed(file: str, old: str, new: str) -> Callable[[pathlib.Path], None]:
    """A mistake by other words in a file."""

    def plant(folder: pathlib.Path) -> None:
        text = (folder / file).read_text()
        if old not in text:
            raise SystemExit(f"{file} has no {old}: the mistake cannot be planted")
        (folder / file).write_text(text.replace(old, new, 1))

    return plant


def inserted(file: str, markup: str) -> Callable[[pathlib.Path], None]:
    """A mistake by more markup at the end of a page's content."""
    return changed(file, "</main>", markup + "</main>")


def shortened(file: str, end: str) -> Callable[[pathlib.Path], None]:
    """A mistake by a text without its last ten letters before the first mark of its end."""

    def plant(folder: pathlib.Path) -> None:
        text = (folder / file).read_text()
        at = text.index(end)
        rest = re.sub(r"[\w .,;]{10}$", "", text[:at].removesuffix("</span>"))
        if len(rest) >= at - 10:
            raise SystemExit(f"{file} has no text before {end}: the mistake cannot be planted")
        (folder / file).write_text(rest + "</span>" + text[at:])

    return plant


def added(file: str, bytes_: int) -> Callable[[pathlib.Path], None]:
    """A mistake by a large file."""
    return lambda folder: (folder / file).write_bytes(bytes(bytes_))


def first_picture(folder: pathlib.Path) -> None:
    """A picture without units."""
    (folder / "pictures").mkdir(exist_ok=True)
    (folder / "pictures" / "planted.svg").write_text("<svg><text>time</text></svg>")


def look(browser: Browser, folder: pathlib.Path, axe: str, room: pathlib.Path) -> list[str]:
    """The mistakes that no check sees."""
    front = lambda copy: [copy / "index.html"]
    lists = lambda copy: [copy / "claims.html"]
    mistakes = (
        ("an error of a program", inserted("index.html", "<script>nothing()</script>"), lambda copy: checks.errors(browser, copy, front(copy))),
        ("a picture from elsewhere", inserted("index.html", '<img alt="" src="http://elsewhere.invalid/a.png">'), lambda copy: checks.errors(browser, copy, front(copy))),
        ("a link to no page", changed("index.html", 'href="errata.html"', 'href="erratum.html"'), site.lost_links),
        ("a link to no claim", inserted("index.html", '<a href="section-S4.html#S4.none">a</a>'), site.lost_links),
        ("another verdict on the page of a section", changed("section-S4.html", 'standing"><span class="verdict false"', 'standing"><span class="verdict true"'), site.told_otherwise),
        ("a statement that is cut short", changed("section-S4.html", "<blockquote>The LCP has three complementarity groups", "<blockquote>The LCP has"), statements.cut),
        ("a correction that is cut short", shortened("zh/section-S4.html", "</p></div>"), statements.cut),
        ("a claim under the verdict of another one", changed("zh/section-S4.html", 'standing"><span class="verdict false"', 'standing"><span class="verdict true"'), statements.cut),
        ("a claim on no page", changed("section-S4.html", '<article class="claim" id="S4.groups"', '<article class="claim" id="S4.group"'), statements.cut),
        ("another count on the front page", changed("index.html", '</b> <span><span class="mark"', '0</b> <span><span class="mark"'), site.told_otherwise),
        ("a picture without units", first_picture, site.unlabelled),
        ("a report too large", added("large.bin", site.MOST_BYTES), site.too_large),
        ("a claim under another verdict", changed("claims.html", 'data-verdict="false"', 'data-verdict="true"'), lambda copy: checks.filters(browser, copy, lists(copy))),
        ("a search that looks at ids alone", changed("claims.js", "[data-text]", "[no-text]"), lambda copy: checks.filters(browser, copy, lists(copy))),
        ("a Chinese list that is searched in English alone", changed("claims.js", "[data-text]", "p[data-text], p > [data-text]"), lambda copy: checks.filters(browser, copy, [copy / "zh" / "claims.html"])),
        ("an address that is not kept", changed("claims.js", "history.replaceState", "void"), lambda copy: checks.filters(browser, copy, lists(copy))),
        ("a list that its program makes", changed("claims.html", 'id="claims"', 'id="claims" hidden'), lambda copy: checks.filters(browser, copy, lists(copy))),
        ("a formula that is not drawn", inserted("index.html", '<math style="display:none"><mi>x</mi></math>'), lambda copy: checks.shapes(browser, copy, front(copy))),
        ("a page too wide", inserted("index.html", '<div style="width:400px">wide</div>'), lambda copy: checks.shapes(browser, copy, front(copy))),
        ("a target too small", inserted("index.html", "<button style='min-height:30px;height:30px'>a</button>"), lambda copy: checks.shapes(browser, copy, front(copy))),
        ("a picture without words", inserted("index.html", '<img src="data:image/gif;base64,R0lGODlhAQABAAAAACw=">'), lambda copy: checks.accessible(browser, copy, front(copy), axe)),
        ("pale letters in the dark", inserted("index.html", "<style>@media(prefers-color-scheme:dark){p{color:#333}}</style>"), lambda copy: checks.accessible(browser, copy, front(copy), axe)),
        ("a certificate that cannot be read", inserted("explorer.html", "<style>.explorer .pass{background:#0b6b3a!important;color:#0b6b3a!important}</style>"), lambda copy: checks.accessible(browser, copy, [copy / "explorer.html"], axe)),
        ("K and K* exchanged", changed("explorer/draw.js", 'wedge(1, mu, "dual"), wedge(mu, 1, "cone")', 'wedge(1, mu, "cone"), wedge(mu, 1, "dual")'), lambda copy: checks.explored(browser, copy, [copy / "explorer.html"])),
        ("a scene without its runs", lambda copy: (copy / "explorer" / "stack.js").unlink(), lambda copy: checks.explored(browser, copy, [copy / "explorer.html"])),
        ("a filter that keys do not reach", changed("claims.html", '<select name="kind"', '<select tabindex="-1" name="kind"'), lambda copy: checks.keyboard(browser, copy, lists(copy))),
        ("a focus that is not seen", changed("style.css", "outline:3px solid", "outline:0 none"), lambda copy: checks.keyboard(browser, copy, lists(copy))),
        ("a table that is cut off on paper", inserted("problems.html", "<table><tr><td style='white-space:nowrap'>" + "wide " * 60 + "</td></tr></table>"), lambda copy: checks.on_paper(browser, copy, [copy / "problems.html"])),
        ("a table whose end is hidden on paper", changed("style.css", ".scroll{max-height:none;overflow:visible;", ".scroll{max-height:none;overflow:hidden;white-space:nowrap;"), lambda copy: checks.on_paper(browser, copy, [copy / "systems.html"])),
        ("the scoreboard on paper of the shorter side", changed("style.css", ".wide,main:has(.wide)", "main:has(.wide)"), lambda copy: checks.on_paper(browser, copy, [copy / "scoreboard.html"])),
        ("a summary of three pages", inserted("summary.html", "<p>more</p>" * 200), lambda copy: checks.printed(browser, copy, [copy / "summary.html"])),
    )
    missed = []
    for k, (name, plant, check) in enumerate(mistakes):
        copy = room / f"copy-{k}"
        shutil.copytree(folder, copy)
        plant(copy)
        if not check(copy):
            missed.append(f"no check sees {name}")
        shutil.rmtree(copy)
    print(f"planted: {len(mistakes)} mistakes, {len(missed)} that no check sees", flush=True)
    return missed
