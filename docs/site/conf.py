# SPDX-License-Identifier: BSD-3-Clause
"""How Sphinx makes the documentation of the folder that `docs/site/layout.py` lays out."""

import builtins
import re
from importlib.metadata import version as version_of
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.util.inspect import TypeAliasForwardRef

project = "forcetorque"
author = "the forcetorque authors"
version = release = version_of("forcetorque")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
html_theme = "furo"
html_title = f"forcetorque {version}"
html_copy_source = False
html_show_sphinx = False
html_show_copyright = False
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = ["copy_buttons.js"]
html_search_scorer = str(Path(__file__).with_name("pages_first.js"))

# as GitHub names the headings that links point to
myst_heading_anchors = 4

# `name` in a docstring is code, as it is in Markdown
default_role = "code"
add_module_names = False
python_maximum_signature_line_length = 100
napoleon_google_docstring = True
napoleon_numpy_docstring = False
autodoc_member_order = "bysource"
# by name, where numpy would spell them out
autodoc_type_aliases = {name: name for name in ("BoolArray", "FloatArray", "IntArray")}
TypeAliasForwardRef.__repr__ = lambda self: self.name  # also in unions, where Sphinx shows its own class


def leave_types_to_annotations(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Have napoleon take words before a colon as words: the empty type before another colon ends its search."""
    if lines and what in ("attribute", "data", "property"):
        lines[0] = f": {lines[0]}"
    for k, line in enumerate(lines[:-1]):
        if line in ("Returns:", "Yields:"):
            lines[k + 1] = re.sub(r"^ +", r"\g<0>: ", lines[k + 1])


def show_commands_as_code(app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Have the star of a file name in an example not be taken for emphasis."""
    lines[:] = [re.sub(r"^Example: (forcetorque .*)$", r"Example: ``\1``", line) for line in lines]


def leave_out_empty_arguments(*event: Any) -> tuple[str, None] | None:
    """Show no arguments of pydantic's models where they only say that there are some: the fields follow."""
    *_, arguments, _ = event
    return ("", None) if arguments == "(**data: Any)" else None


AMBIGUOUS = {"Experiment"}
"""Classes of several modules, which an annotation in quotes does not distinguish."""


def leave_builtins_alone(app: Sphinx, doctree: nodes.document) -> None:
    """Have `type` and its like in an annotation not be taken for fields of that name, nor link ambiguous names."""
    for node in list(doctree.findall(pending_xref)):
        target = node.get("reftarget")
        if node.get("refdomain") == "py" and (hasattr(builtins, target) or target in AMBIGUOUS):
            node.replace_self(node.children)


def setup(app: Sphinx) -> None:
    """Change docstrings before napoleon reads them, signatures, and references before they are resolved."""
    app.connect("autodoc-process-docstring", leave_types_to_annotations, priority=400)
    app.connect("autodoc-process-docstring", show_commands_as_code, priority=400)
    app.connect("autodoc-process-signature", leave_out_empty_arguments)
    app.connect("doctree-read", leave_builtins_alone)
