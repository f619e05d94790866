"""Chromium without a network, which opens pages from the disk and tells what went wrong on them."""

import contextlib
import pathlib
from collections.abc import Iterator

from playwright.sync_api import Page, sync_playwright

FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--host-resolver-rules=MAP * ~NOTFOUND",
]
DESKTOP = {"width": 1280, "height": 900}
PHONE = {"width": 360, "height": 740}
EVERYTHING_OPEN = "document.querySelectorAll('details').forEach(one => { one.open = true; })"


class Browser:
    """One browser with an empty profile."""

    def __init__(self, program: pathlib.Path, profile: pathlib.Path) -> None:
        self.program, self.profile = program, profile
        self.driver = sync_playwright()

    def __enter__(self) -> "Browser":
        browser = self.driver.start().chromium
        self.context = browser.launch_persistent_context(str(self.profile), executable_path=str(self.program), args=FLAGS, headless=True, viewport=DESKTOP)
        self.scriptless = None
        return self

    def __exit__(self, *_: object) -> None:
        self.context.close()
        self.driver.__exit__()

    @contextlib.contextmanager
    def page(self, size: dict[str, int] = DESKTOP, scheme: str = "light") -> Iterator[Page]:
        """An empty tab, whose `wrong` collects errors and everything that is asked of elsewhere."""
        page = self.context.new_page()
        page.wrong = []
        page.on("console", lambda message: page.wrong.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: page.wrong.append(str(error)))
        page.on("request", lambda request: page.wrong.append(f"asks for {request.url}") if not request.url.startswith(("file:", "data:", "blob:")) else None)
        page.on("requestfailed", lambda request: page.wrong.append(f"does not get {request.url}"))
        page.set_viewport_size(size)
        page.emulate_media(color_scheme=scheme)
        try:
            yield page
        finally:
            page.close()
