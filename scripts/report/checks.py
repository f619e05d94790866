"""The checks of a written report; each returns what is wrong."""

import pathlib
import re
import time
from collections.abc import Callable, Iterable

from . import site, statements
from .browser import DESKTOP, EVERYTHING_OPEN, PHONE, Browser

PRINTED_PAGES = 2
TAP = 44
# What stands in a line of text may be lower.
TAPPED = ".top a, button, select, input, summary, .cards a, .list a, .links a, .bars a, .neighbours a, .claims > li > a"
# The borders are written as doubles are: this is far above their rounding and far below what an eye sees.
WEDGE = 1e-9
WORDS = ("zeno", "copositive", "stewart-trinkle", "painleve", "drake energy", "no-such-word", "共正", "摩擦锥")


def errors(browser: Browser, folder: pathlib.Path, pages: Iterable[pathlib.Path]) -> list[str]:
    """Errors of a page, and whatever it asks of elsewhere."""
    wrong = []
    for path in pages:
        with browser.page() as page:
            page.goto(path.as_uri())
            wrong += [f"{path.relative_to(folder)}: {text}" for text in page.wrong]
    return wrong


def shapes(browser: Browser, folder: pathlib.Path, pages: Iterable[pathlib.Path]) -> list[str]:
    """Pages wider than a telephone, formulas without a size, and targets too small for a finger, with everything opened."""
    wrong, formulas = [], 0
    with browser.page(PHONE) as page:
        for path in pages:
            name = path.relative_to(folder)
            page.goto(path.as_uri())
            page.evaluate(EVERYTHING_OPEN)
            width = page.evaluate("document.documentElement.scrollWidth")
            if width > PHONE["width"]:
                wrong.append(f"{name}: is {width} pixels wide on a telephone")
            sizes = page.evaluate("[...document.querySelectorAll('math')].map(one => { const box = one.getBoundingClientRect(); return Math.min(box.width, box.height); })")
            formulas += len(sizes)
            empty = sum(size <= 0 for size in sizes)
            if empty:
                wrong.append(f"{name}: {empty} of {len(sizes)} formulas have no size")
            small = page.evaluate(
                "([what, least]) => [...document.querySelectorAll(what)].filter(one => one.checkVisibility() && one.getBoundingClientRect().height < least - 0.5).map(one => one.textContent.trim().slice(0, 40))",
                [TAPPED, TAP],
            )
            wrong += [f"{name}: too low for a finger: {text}" for text in small[:3]]
    print(f"formulas: {formulas}", flush=True)
    return wrong


# The explorer shows a certificate where something was solved, not at the start.
MOVED = """async () => {
    const explorer = document.getElementById('explorer'), time = document.getElementById('explorer-time');
    if (!explorer) return;
    for (let tries = 0; !explorer.dataset.ready && tries < 100; tries++) await new Promise((done) => setTimeout(done, 50));
    time.value = time.max / 2;
    time.dispatchEvent(new Event('input'));
}"""


# Letters in the colour of their background axe leaves undecided: nobody can read them here.
FOUND = """options => axe.run(document, options).then(found => {
    const same = (node) => node.any.some(check => check.data && check.data.messageKey === 'equalRatio');
    const unreadable = found.incomplete.filter(one => one.id === 'color-contrast')
        .map(one => ({ id: 'letters-in-the-colour-of-their-ground', nodes: one.nodes.filter(same) })).filter(one => one.nodes.length);
    return [...found.violations, ...unreadable].map(one => [one.id, one.nodes.length, one.nodes[0].html.slice(0, 120)]);
})"""


def accessible(browser: Browser, folder: pathlib.Path, pages: Iterable[pathlib.Path], axe: str) -> list[str]:
    """What axe-core finds with all its rules, in light and in dark; those of colours, which take most of the time and both languages share, in one language."""
    colours = "color-contrast"
    only, without = {"runOnly": {"type": "rule", "values": [colours]}}, {"rules": {colours: {"enabled": False}}}
    wrong = []
    for scheme in ("light", "dark"):
        with browser.page(DESKTOP, scheme) as page:
            for path in pages:
                is_translated = path.parent != folder
                if scheme == "dark" and is_translated:
                    continue
                options = only if scheme == "dark" else without if is_translated else {}
                page.goto(path.as_uri())
                page.evaluate(MOVED)
                page.evaluate(axe)
                found = page.evaluate(FOUND, {**options, "resultTypes": ["violations", "incomplete"]})
                wrong += [f"{path.relative_to(folder)}, {scheme}: {rule} ({count}): {where}" for rule, count, where in found]
    return wrong


# Of every panel: how far the borders of K and K* lie beside the axis for each unit along it.
WEDGES = """[...document.querySelectorAll('#explorer svg[id$="-cone"]')].map(svg => ['cone', 'dual'].map(kind => {
    const wedge = svg.querySelector(`polygon.${kind}`);
    if (!wedge) return null;
    const [[x, y], [a, b]] = wedge.getAttribute('points').split(' ').map(one => one.split(',').map(Number));
    return Math.abs((a - x) / (b - y));
}))"""


def explored(browser: Browser, folder: pathlib.Path, explorers: Iterable[pathlib.Path]) -> list[str]:
    """Every scene of the explorer: its runs are there, K is {|r_t| <= mu r_n}, and K* is its dual."""
    wrong = []
    for path in explorers:
        with browser.page() as page:
            page.goto(path.as_uri())
            page.wait_for_selector("#explorer[data-ready]")
            for scene in page.evaluate("[...document.getElementById('explorer-scene').options].map(one => one.value)"):
                before = page.get_attribute("#explorer", "data-ready")
                page.select_option("#explorer-scene", scene)
                try:
                    page.wait_for_function("before => document.getElementById('explorer').dataset.ready !== before", arg=before, timeout=10_000)
                except Exception as error:  # the driver's own, whose name depends on its version
                    wrong.append(f"{path.relative_to(folder)}: {scene} does not come: {str(error).splitlines()[0]}")
                    continue
                mu = float(page.input_value("#explorer-friction"))
                wedges = page.evaluate(WEDGES)
                right = [cone is not None and abs(cone - mu) <= WEDGE * max(mu, 1) and (mu == 0 or abs(dual * mu - 1) <= WEDGE) for cone, dual in wedges]
                if not right or not all(right):
                    wrong.append(f"{path.relative_to(folder)}: {scene}, friction {mu}: the borders of K and K* are {wedges}")
            wrong += [f"{path.relative_to(folder)}: {what}" for what in page.wrong]
    return wrong


def shown(page: object) -> tuple[int, int]:
    """How many claims are visible, and how many the page says there are."""
    return page.evaluate("[[...document.querySelectorAll('#claims > li')].filter(one => one.checkVisibility()).length, Number(document.getElementById('shown').textContent)]")


def filters(browser: Browser, folder: pathlib.Path, lists: Iterable[pathlib.Path]) -> list[str]:
    """Search and filters, by hand and by the address, against report.json."""
    claims = site.document(folder)["claims"]
    wrong = []

    def expect(what: str, page: object, is_meant: Callable[[dict], bool]) -> None:
        count, told = shown(page), sum(map(is_meant, claims))
        if count != [told, told]:
            wrong.append(f"{what}: {count[0]} claims shown and {count[1]} told, {told} in report.json")

    for path in lists:
        with browser.page() as page:
            page.goto(path.as_uri())
            expect(f"{path.name}", page, lambda claim: True)
            for axis in site.AXES:
                for value in sorted({site.axis(claim, axis) for claim in claims} - {""}):
                    page.select_option(f"select[name={axis}]", value)
                    expect(f"{axis} {value}", page, lambda claim: site.axis(claim, axis) == value)
                page.click("button[type=reset]")
                page.wait_for_timeout(20)
            for words in WORDS:
                page.fill("input[name=q]", words)
                expect(f"search {words}", page, lambda claim: all(word in site.words_of(claim, path) for word in words.split()))
            page.fill("input[name=q]", "zeno")
            page.select_option("select[name=verdict]", "false")
            address = page.url
        with browser.page() as page:
            page.goto(address)
            expect(f"the address {address.split('#')[-1]}", page, lambda claim: "zeno" in site.words_of(claim, path) and site.axis(claim, "verdict") == "false")
        with browser.page() as page:
            page.route("**/*.js", lambda route: route.abort())
            page.goto(path.as_uri())
            if shown(page)[0] != len(claims):
                wrong.append(f"{path.name}: without its program the list is not whole")
    return wrong


def keyboard(browser: Browser, folder: pathlib.Path, lists: Iterable[pathlib.Path]) -> list[str]:
    """The skip link first, then every filter by the tabulator alone, each with a visible focus; a choice by keys."""
    wrong = []
    active = "(() => { const one = document.activeElement; return [one.className, one.name || '', getComputedStyle(one).outlineStyle]; })()"
    for path in lists:
        with browser.page() as page:
            page.goto(path.as_uri())
            page.keyboard.press("Tab")
            if page.evaluate(active)[0] != "skip":
                wrong.append(f"{path.name}: the first key does not reach the skip link")
            page.keyboard.press("Enter")
            reached: dict[str, str] = {}
            for _ in range(12):
                page.keyboard.press("Tab")
                _, name, outline = page.evaluate(active)
                reached.setdefault(name, outline)
                if name == "verdict" and "chosen" not in reached:
                    before = shown(page)
                    page.keyboard.press("ArrowDown")
                    page.wait_for_timeout(50)
                    reached["chosen"] = "solid" if shown(page) != before else "none"
            for name in ("q", *site.AXES, "chosen"):
                if reached.get(name, "none") == "none":
                    wrong.append(f"{path.name}: {name} is not reached by keys, or has no visible focus")
    return wrong


def printed(browser: Browser, folder: pathlib.Path, summaries: Iterable[pathlib.Path]) -> list[str]:
    """How many pages the summary needs on paper."""
    wrong = []
    for path in summaries:
        with browser.page() as page:
            page.goto(path.as_uri())
            pages = len(re.findall(rb"/Type\s*/Page\b", page.pdf(prefer_css_page_size=True)))
        print(f"{path.relative_to(folder)}: {pages} printed pages", flush=True)
        if pages > PRINTED_PAGES or pages == 0:
            wrong.append(f"{path.relative_to(folder)} prints on {pages} pages")
    return wrong


# 1/96 of an inch, as CSS counts.
PIXELS_PER_MILLIMETRE = 96 / 25.4
LENGTHS = {"A4": 210.0, "A4 landscape": 297.0}
PAGE_RULE = re.compile(r"@page\s*(\w*)\s*\{\s*size:\s*([^;]+);\s*margin:\s*([\d.]+)mm\s*\}")

# What is beside the paper, cut at the border of something or over the next cell, of the elements that this kind of page is for.
CUT = """([name, width]) => [...document.querySelectorAll('main, main *')].filter(one => {
    if (one.ownerSVGElement || !one.checkVisibility()) return false;
    let room = one;
    while (room && getComputedStyle(room).page === 'auto') room = room.parentElement;
    if ((room ? getComputedStyle(room).page : '') !== name) return false;
    const box = one.getBoundingClientRect();
    const closed = getComputedStyle(one).overflowX !== 'visible' || ['TD', 'TH'].includes(one.tagName);
    const hidden = closed && one.clientWidth > 1 && one.scrollWidth > one.clientWidth + 1;
    return box.width > 0 && (box.right > width + 0.5 || box.left < -0.5) || hidden;
}).map(one => `${one.tagName.toLowerCase()} “${one.textContent.trim().slice(0, 30)}”`)"""


def papers(folder: pathlib.Path) -> dict[str, float]:
    """The width between the margins of every kind of printed page, in pixels, by its name."""
    rules = PAGE_RULE.findall((folder / "style.css").read_text())
    return {name: (LENGTHS[size.strip()] - 2 * float(margin)) * PIXELS_PER_MILLIMETRE for name, size, margin in rules}


def on_paper(browser: Browser, folder: pathlib.Path, pages: Iterable[pathlib.Path]) -> list[str]:
    """What is cut off in print, with everything opened."""
    wrong, kinds = [], papers(folder)
    if "" not in kinds:
        return ["style.css names no paper"]
    with browser.page() as page:
        page.emulate_media(media="print", color_scheme="light")
        for path in pages:
            page.goto(path.as_uri())
            page.evaluate(EVERYTHING_OPEN)
            for name, width in kinds.items():
                # the page is laid out in whole pixels: a fraction less than the paper
                page.set_viewport_size({"width": int(width), "height": 900})
                cut = page.evaluate(CUT, [name, int(width)])
                if cut:
                    wrong.append(f"{path.relative_to(folder)}: {len(cut)} parts are cut off on paper: {', '.join(cut[:3])}")
    return wrong


def look(browser: Browser, folder: pathlib.Path, axe: str) -> list[str]:
    """Every check on every page that it is for."""
    every = site.pages(folder)
    of = lambda name: [folder / name, folder / "zh" / name]
    wrong = site.too_large(folder) + site.lost_links(folder) + site.unlabelled(folder) + site.told_otherwise(folder) + statements.cut(folder)
    for name, check in (
        ("errors", lambda: errors(browser, folder, every)),
        ("shapes", lambda: shapes(browser, folder, every)),
        ("filters", lambda: filters(browser, folder, of("claims.html"))),
        ("explored", lambda: explored(browser, folder, of("explorer.html"))),
        ("keyboard", lambda: keyboard(browser, folder, of("claims.html"))),
        ("on paper", lambda: on_paper(browser, folder, every)),
        ("printed", lambda: printed(browser, folder, of("summary.html"))),
        ("axe", lambda: accessible(browser, folder, every, axe)),
    ):
        begin = time.monotonic()
        wrong += check()
        print(f"{time.monotonic() - begin:6.1f} s  {name}, {len(every)} pages", flush=True)
    return wrong
