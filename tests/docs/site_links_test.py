# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Plants each kind of dead link into a site of two pages."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "site"))
sys.dont_write_bytecode = True
from site_links import dead_links  # noqa: E402, the folder is known only now


class SiteLinks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.site = pathlib.Path(folder.name) / "site"
        self.write("deep/there.html", '<h1 id="höhe-1">Heights</h1>')
        self.write("picture.png", "")

    def write(self, name, text):
        path = self.site / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def found(self, link):
        self.write("index.html", f"<p>\n{link}</p>")
        return list(dead_links(self.site))

    def assert_dead(self, link, message):
        self.assertEqual(self.found(link), [f"index.html:2 {message}"])

    def test_right_links_are_left_alone(self):
        for link in ('<a href="deep/there.html#h%C3%B6he-1">', '<img src="picture.png">', '<a id="here" href="#here">', '<a href="#">',
                     '<a href="https://example.org/gone">', '<img src="data:image/png;base64,AAAA">', '<a href="mailto:a@b.org">'):
            self.assertEqual(self.found(link), [], link)

    def test_a_file_that_is_not_there(self):
        self.assert_dead('<a href="deep/gone.html">', "deep/gone.html: is not there")
        self.assert_dead('<img src="gone.png">', "gone.png: is not there")
        self.assert_dead('<a href="deep">', "deep: is not there")

    def test_a_file_outside_of_the_site(self):
        self.write("../outside.html", "")
        self.assert_dead('<a href="../outside.html">', "../outside.html: is not there")

    def test_an_anchor_that_no_page_has(self):
        self.assert_dead('<a href="deep/there.html#depths">', "deep/there.html#depths: has no such anchor")
        self.assert_dead('<a href="#there">', "#there: has no such anchor")

    def test_what_a_browser_would_fetch_from_the_web(self):
        self.assert_dead('<script src="https://example.org/a.js">', "https://example.org/a.js: is fetched from elsewhere")
        self.assert_dead('<link rel="stylesheet" href="//example.org/a.css">', "//example.org/a.css: is fetched from elsewhere")
        self.assert_dead('<script src="file:///usr/share/a.js">', "file:///usr/share/a.js: is fetched from elsewhere")


if __name__ == "__main__":
    unittest.main()
