"""Sphinx extension: formulas as MathML, and docstrings that are plain text.

MathML needs no script, font or network to be read.
"""

from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx


def inline(page: Any, node: Any) -> None:
    """Write a formula that stands in a line."""
    page.body.append(tex2mathml(node.astext()))
    raise nodes.SkipNode


def block(page: Any, node: Any) -> None:
    """Write a formula that stands alone."""
    page.body.append(tex2mathml(node.astext(), as_block=True))
    raise nodes.SkipNode


def plain(*docstring: Any) -> None:
    """Keep the bars of a docstring's |x| from being taken for markup."""
    lines = docstring[-1]
    lines[:] = [line.replace("|", r"\|") for line in lines]


def setup(site: Sphinx) -> dict[str, bool]:
    """Tell Sphinx of both."""
    site.connect("autodoc-process-docstring", plain)
    site.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
