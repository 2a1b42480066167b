"""Sphinx: the documentation, built without asking any network."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "ilmek"
author = "The ilmek developers"
extensions = ["myst_parser", "sphinx.ext.autodoc", "catalogue"]
myst_enable_extensions = ["colon_fence", "deflist", "smartquotes"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = "ilmek"
html_show_sphinx = False
html_static_path = ["_static"]
autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_docstring_signature = False
exclude_patterns = ["_build", "reference/generated/verdicts.md"]  # included by verification.md
