#!/usr/bin/env python3
"""Is the documentation a sound site? Builds it without warnings and walks through its pages.

usage: site.py SOURCE_DIR SITE_DIR

Nothing may be loaded from outside, links and anchors within the site must lead somewhere, pictures need words for
those who do not see them, and every page must be in the navigation.
"""
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADS = {"script": "src", "link": "href", "img": "src", "iframe": "src", "object": "data", "source": "src", "use": "href"}


class Page(HTMLParser):
    """What a page loads, where it links to, and where links may lead to in it."""

    def __init__(self, path):
        super().__init__()
        self.loads, self.links, self.anchors, self.wrong = [], [], set(), []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        has = dict(attributes)
        self.anchors |= {has[key] for key in ("id", "name") if has.get(key)}
        if tag in LOADS and has.get(LOADS[tag]):
            self.loads.append(has[LOADS[tag]])
        if tag == "a" and has.get("href"):
            self.links.append(has["href"])
        if tag == "img" and not has.get("alt"):
            self.wrong.append(f"picture without words: {has.get('src')}")


def from_outside(address):
    return bool(urlsplit(address).netloc)


def faults(site):
    pages = {path: Page(path) for path in site.rglob("*.html")}
    for path, page in pages.items():
        if path.name == "404.html":  # its addresses begin at the server's root
            continue
        name = path.relative_to(site)
        yield from (f"{name}: {fault}" for fault in page.wrong)
        yield from (f"{name}: loads {address}" for address in page.loads if from_outside(address))
        for address in page.loads + page.links:
            parts = urlsplit(address)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not target.exists():
                yield f"{name}: {address} leads nowhere"
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                yield f"{name}: no such place: {address}"
    for path in site.rglob("*.css"):
        for address in re.findall(r"(?:url\(|@import)\s*['\"]?(https?:|//)", path.read_text()):
            yield f"{path.relative_to(site)}: loads from {address}"
    for path in site.rglob("*.svg"):
        for address in re.findall(r"(?:href|src)=['\"](?!#|data:)([^'\"]+)", path.read_text()):
            yield f"{path.relative_to(site)}: loads {address}"


def main():
    source, site = map(Path, sys.argv[1:])
    built = subprocess.run(["mkdocs", "build", "--strict", "--site-dir", site.resolve()], cwd=source,
                           capture_output=True, text=True)
    found = re.findall(r"^.*WARNING.*$|^.*ERROR.*$|^RuntimeError.*$", built.stderr, re.M) if built.returncode else []
    if built.returncode and not found:
        found = [built.stderr]
    listed = (source / "mkdocs.yml").read_text()
    for path in (source / "docs").rglob("*.md"):
        if f" {path.relative_to(source / 'docs')}\n" not in listed:
            found.append(f"{path} is not in the navigation of mkdocs.yml")
    if not built.returncode:
        found += faults(site.resolve())
    print("\n".join(found))
    sys.exit(bool(found))


main()
