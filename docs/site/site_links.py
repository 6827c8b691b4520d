# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the pages of a site, and finds what leads nowhere: files that are not there, anchors that no page has, and scripts,
styles and pictures that a browser would have to fetch from the web."""
import html.parser
import pathlib
import sys
import urllib.parse

# What a browser fetches by itself. A link (`a`) to the web is for the reader to follow
FETCHED = {("script", "src"), ("link", "href"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("object", "data")}
NOT_FETCHED_LINKS = {"canonical", "license"}


class Page(html.parser.HTMLParser):
    """The anchors of a page, and where its links go: (line, target, whether a browser fetches it by itself)."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(values[name] for name in ("id", "name") if values.get(name))
        for name in ("href", "src", "data"):
            if values.get(name) and not (tag == "link" and values.get("rel") in NOT_FETCHED_LINKS):
                self.links.append((self.getpos()[0], values[name], (tag, name) in FETCHED))


def read_pages(site):
    return {path: Page(path.read_text(errors="replace")) for path in sorted(site.rglob("*.html"))}


def file_of(target, page, site):
    """The file that a path means in a page. A folder means its index."""
    path = urllib.parse.unquote(target)
    start = site if path.startswith("/") else page.parent
    file = (start / path.lstrip("/")).resolve() if path else page
    return file / "index.html" if file.is_dir() else file


def fault(target, fetched, page, pages, site):
    """Why a link of a page is wrong; nothing when it is right."""
    address = urllib.parse.urlsplit(target)
    if address.scheme == "data":
        return None
    if address.scheme or address.netloc:
        return "is fetched from elsewhere" if fetched else None
    file = file_of(address.path, page, site)
    if not file.is_relative_to(site) or not file.is_file():
        return "is not there"
    anchor = urllib.parse.unquote(address.fragment)
    # The scripts of a theme understand an empty anchor, as browsers do: the top of the page
    if anchor and file in pages and anchor not in pages[file].anchors:
        return "has no such anchor"
    return None


def dead_links(site):
    """`page:line target: why`, for all pages of a site."""
    site = pathlib.Path(site).resolve()
    pages = read_pages(site)
    for path, page in pages.items():
        for line, target, fetched in page.links:
            why = fault(target, fetched, path, pages, site)
            if why:
                yield f"{path.relative_to(site)}:{line} {target}: {why}"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: docs/site/site_links.py FOLDER")
    found = list(dead_links(sys.argv[1]))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
