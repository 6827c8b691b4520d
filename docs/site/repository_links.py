# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Links of the Markdown to what is no page of the site.

The documents link to files of the repository as a repository browser follows them. A link to a folder leads to the page about
the folder, where there is one. Any other leads to the file below `repository_url`; without such an address the site gets a copy
of the file. A page about a folder lists the pages of the folder in the navigation.
"""
import pathlib
import posixpath
import shutil

from docutils import nodes
from sphinx.util.nodes import make_refnode

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
COPIES = "_repository"
LIST_OF_FOLDER = "\n\n```{toctree}\n:hidden:\n:glob:\n\n*\n```\n"


def path_in_repository(target, page):
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), target))


def page_about(folder, pages):
    return next((page for page in (f"{folder}/README", f"{folder}/index") if page in pages), None)


def copy_of(path, app):
    """The address of a copy of the file from the root of the site; nothing where there is no such file."""
    if not (ROOT / path).is_file():
        return None
    copy = pathlib.Path(app.outdir) / COPIES / path
    copy.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / path, copy)
    return f"{COPIES}/{path}"


def address(path, page, app):
    """The address of a file or folder of the repository, as the page has to write it."""
    if app.config.repository_url and (ROOT / path).exists():
        return f"{app.config.repository_url.rstrip('/')}/{path}"
    copy = copy_of(path, app)
    return copy and posixpath.relpath(copy, posixpath.dirname(page) or ".")


def resolve(app, env, node, contents):
    # A link of Markdown that no page answers comes here as a reference of any kind
    if node.get("reftype") not in ("myst", "any"):
        return None
    target, page = node["reftarget"], node["refdoc"]
    path = path_in_repository(target, page)
    about = page_about(path, env.found_docs)
    if about:
        return make_refnode(app.builder, page, about, None, contents.deepcopy())
    where = address(path, page, app)
    return nodes.reference("", "", contents.deepcopy(), internal=False, refuri=where) if where else None


def list_folder(app, page, source):
    folder, name = posixpath.split(page)
    if folder and name == "README" and f"{folder}/index" not in app.env.found_docs:
        source[0] += LIST_OF_FOLDER


def setup(app):
    app.add_config_value("repository_url", "", "html")
    app.connect("missing-reference", resolve)
    app.connect("source-read", list_folder)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
