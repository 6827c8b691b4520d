# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Formulas in TeX, as docstrings and notebooks may have them, set by KaTeX in the browser, without a network.

The Markdown writes its formulas as text and needs none of this. Pages with a formula load KaTeX from the site itself.
"""
import pathlib
import shutil

from docutils import nodes
from sphinx.errors import ExtensionError

KATEX = pathlib.Path("/usr/share/javascript/katex")
NEEDED = ("katex.min.js", "katex.min.css", "fonts")
DRAW = """document.addEventListener("DOMContentLoaded", () => {
  for (const place of document.querySelectorAll(".math"))
    katex.render(place.textContent, place, {displayMode: place.tagName === "DIV", throwOnError: false});
});"""


def visit_inline(translator, node):
    translator.body.append(translator.starttag(node, "span", "", CLASS="math") + translator.encode(node.astext()) + "</span>")
    raise nodes.SkipNode


def visit_display(translator, node):
    translator.body.append(translator.starttag(node, "div", CLASS="math") + translator.encode(node.astext()) + "</div>")
    raise nodes.SkipNode


def has_formula(doctree):
    return doctree is not None and any(True for kind in (nodes.math, nodes.math_block) for _ in doctree.findall(kind))


def copy_katex(destination):
    if not KATEX.is_dir():
        raise ExtensionError(f"a page has a formula, and {KATEX} was not found; run: scripts/install-dependencies docs")
    for name in NEEDED:
        source, copy = KATEX / name, destination / name
        if source.is_dir():
            shutil.copytree(source, copy, dirs_exist_ok=True)
        else:
            destination.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, copy)


def add_katex(app, page, template, context, doctree):
    if app.builder.format == "html" and has_formula(doctree):
        copy_katex(pathlib.Path(app.outdir) / "_static" / "katex")
        app.add_css_file("katex/katex.min.css")
        app.add_js_file("katex/katex.min.js")
        app.add_js_file(None, body=DRAW)


def setup(app):
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_display, None))
    app.connect("html-page-context", add_katex)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
