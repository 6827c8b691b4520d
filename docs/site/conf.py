# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""How Sphinx makes the site. scripts/docs gathers its sources, and sets what differs from one build to another."""
import pathlib
import re
import sys

from sphinx.ext.napoleon import NumpyDocstring

SITE = pathlib.Path(__file__).resolve().parent
ROOT = SITE.parent.parent
sys.path.insert(0, str(SITE))

project = "Far-LoD"
author = "The Far-LoD authors"
project_copyright = author
version = release = re.search(r"^project\(farlod VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]

extensions = [
    "myst_parser", "nbsphinx", "breathe",
    "sphinx.ext.autodoc", "sphinx.ext.autosummary", "sphinx.ext.napoleon", "sphinx.ext.viewcode",
    "repository_links", "formulas",
]
root_doc = "index"
# A notebook's own folder of checkpoints is none of ours
exclude_patterns = ["**.ipynb_checkpoints"]

# Markdown: headings of all levels have the anchors that a repository browser gives them
myst_heading_anchors = 6
myst_ref_domains = ["std"]
suppress_warnings = ["myst.header"]

# Python: python_pages.py has written a page for each public name
autosummary_generate = False
autodoc_member_order = "bysource"
# Docstrings say the types, with their shapes
autodoc_typehints = "none"
napoleon_google_docstring = False
napoleon_use_rtype = False
# A property's docstring begins with a sentence, which may have a colon. napoleon takes what is before it for the type
NumpyDocstring._consume_inline_attribute = lambda self: ("", type(self)(self._dedent(self._consume_to_end()), self._config).lines())
# References to our own names must lead somewhere; those to other libraries have nowhere to go without a network
nitpicky = True
nitpick_ignore_regex = [(r"py:.*", r"(?!farlod\b).*"), (r"cpp:.*", r".*")]

# Notebooks are shown as they are, unless scripts/docs says otherwise; none of them needs a script from the web
nbsphinx_execute = "never"
nbsphinx_requirejs_path = ""
nbsphinx_widgets_path = ""

# C++: what doxygen read is in the folder that scripts/docs names
breathe_default_project = "farlod"
breathe_default_members = ("members",)
breathe_show_include = False
cpp_id_attributes = ["FARLOD_EXPORT"]

html_theme = "furo"
html_title = f"Far-LoD {release}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"navigation_with_keys": True}
pygments_style = "friendly"
# A block without a language is a command, a formula or a layout, and never Python
highlight_language = "none"
html_math_renderer = "katex"
