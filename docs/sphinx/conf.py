# SPDX-License-Identifier: GPL-2.0-or-later
"""Sphinx: the guides (docs/*.md) and the API pages. scripts/build_docs starts it inside YADE, where all classes can be
imported.
"""
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from class_page import write_classes

import timber_houses

project, author, copyright = "yade-timber", "The yade-timber developers", "the yade-timber developers, GPL-2.0-or-later"
version = release = timber_houses.__version__
extensions = ["sphinx.ext.autodoc", "numpydoc", "myst_parser"]
exclude_patterns = ["docs/sphinx", "py", "scripts"]
html_theme = "sphinx_rtd_theme"
html_show_sourcelink = False
html_static_path, html_css_files = ["static"], ["pages.css"]
default_role = "py:obj"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_typehints = "none"
autodoc_mock_imports = ["vtkmodules"]  # a recommended package
numpydoc_show_class_members = False
myst_heading_anchors = 4
myst_all_links_external = False


def give_title(_app, page, source):
    """Tables that scripts write have no heading: the name of the file is their title."""
    if page.startswith("docs/") and not source[0].lstrip().startswith("# "):
        source[0] = f"# {Path(page).name.replace('_', ' ').capitalize()}\n\n{source[0]}"


def setup(app):
    app.connect("source-read", give_title)
    app.connect("builder-inited", lambda app: write_classes(Path(app.srcdir) / "api" / "classes.rst"))
