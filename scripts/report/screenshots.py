"""Pictures of some pages, for docs/report.md and for whoever changes them."""

import pathlib

from .browser import DESKTOP, PHONE, Browser

LOW = {"width": 1280, "height": 620}

# name, page, anchor, size, scheme
PICTURES = (
    ("front", "index.html", {"width": 1280, "height": 800}, "light"),
    ("front-dark", "index.html", DESKTOP, "dark"),
    ("front-phone", "zh/index.html", PHONE, "light"),
    ("claim", "section-S4.html#S4.copos-plus", LOW, "light"),
    ("claim-phone", "zh/section-S4.html#S4.copos-plus", PHONE, "dark"),
    ("claims", "claims.html#q=zeno&verdict=false", DESKTOP, "light"),
    ("errata", "zh/errata.html", DESKTOP, "light"),
    ("scoreboard", "scoreboard.html", DESKTOP, "light"),
    ("scoreboard-phone", "scoreboard.html", PHONE, "dark"),
    ("pictures", "pictures.html", DESKTOP, "light"),
    ("explorer", "explorer.html", DESKTOP, "light"),
    ("explorer-phone", "zh/explorer.html", PHONE, "dark"),
    ("summary", "summary.html", {"width": 794, "height": 1123}, "print"),
)


def take(browser: Browser, folder: pathlib.Path, out: pathlib.Path) -> None:
    """One PNG each."""
    out.mkdir(parents=True, exist_ok=True)
    for name, link, size, scheme in PICTURES:
        path, _, anchor = link.partition("#")
        if not (folder / path).is_file():
            continue
        with browser.page(size, "light" if scheme == "print" else scheme) as page:
            if scheme == "print":
                page.emulate_media(media="print", color_scheme="light")
            page.goto((folder / path).as_uri() + (f"#{anchor}" if anchor else ""))
            page.wait_for_timeout(300)
            page.screenshot(path=out / f"{name}.png")
