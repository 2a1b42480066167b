"""Every view of the example project in Turkish: nothing that is read, or read aloud, is English."""

import re
from collections.abc import Iterator

from english_words import ENGLISH_ALONE, words
from playwright.sync_api import Browser
from studio_browser import VIEWS, Studio, context_of, data_of, open_view, settled

TEXTS = """
() => {
  const texts = [];
  const walker = document.createTreeWalker(document.querySelector("#studio"), NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    if (!["SCRIPT", "STYLE", "NOSCRIPT"].includes(walker.currentNode.parentElement.tagName))
      texts.push(walker.currentNode.textContent);
  }
  for (const name of ["aria-label", "title", "placeholder"])
    document.querySelectorAll(`[${name}]`).forEach((one) => texts.push(one.getAttribute(name)));
  return texts;
}
"""


PRESS = "cyclograms/press.toml"


def texts_in(data: object) -> Iterator[str]:
    """The texts of data of a file."""
    if isinstance(data, str):
        yield data
    for one in data.values() if isinstance(data, dict) else data if isinstance(data, list) else ():
        yield from texts_in(one)


def without(given: set[str], text: str) -> str:
    """A text without what a file gives it to say, and without names of parameters and their values."""
    for own in sorted(given, key=len, reverse=True):
        text = text.replace(own, "")
    return re.sub(r"\w+[-_][\w-]+", "", text)


def test_every_view_says_no_english(browser: Browser, running: Studio) -> None:
    """Parameters, choices their values (`through`) and what the project gives keep their words."""
    given = {text for table in ("relations", "exclusions") for text in texts_in(data_of(running.project, PRESS)[table])}
    english: list[str] = []
    with context_of(browser) as context:
        context.add_init_script("localStorage.setItem('ilmek.language', 'tr')")
        page = context.new_page()
        for view in VIEWS:
            open_view(page, running, view)
            settled(page)
            shown = {without(given, text) for text in page.evaluate(TEXTS)}
            assert len(shown) > 50, view
            english += sorted(f"{view}: {text}" for text in shown if words(text) & ENGLISH_ALONE - {"through"})
    assert english == [], "\n".join(english)
