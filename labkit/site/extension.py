"""Sphinx extension: formulas as MathML, and docstrings that are plain text.

MathML needs no script, font or network to be read.
"""

import re
from functools import partial
from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx

# docutils puts the index of an accented letter below it: q with a dot and an i.
_BELOW = re.compile(
    r"<munderover>\s*(<mi>[^<]*</mi>)(.*?)(<mo[^>]*>[˙¨]</mo>)\s*</munderover>",
    re.DOTALL,
)
_BESIDE = r'<msub><mover accent="true">\1\3</mover>\2</msub>'


def mathml(formula: str, as_block: bool = False) -> str:
    """Return a formula of LaTeX as MathML."""
    return _BELOW.sub(_BESIDE, tex2mathml(formula, as_block=as_block))


def write(page: Any, node: Any, as_block: bool = False) -> None:
    """Write a formula that stands in a line, or alone."""
    page.body.append(mathml(node.astext(), as_block))
    raise nodes.SkipNode


def plain(*docstring: Any) -> None:
    """Keep the bars of a docstring's |x| from being taken for markup."""
    lines = docstring[-1]
    lines[:] = [line.replace("|", r"\|") for line in lines]


def fields(*member: Any) -> bool | None:
    """Leave out the fields of a named tuple: its own docstring tells them."""
    return True if type(member[3]).__name__ == "_tuplegetter" else None


def setup(site: Sphinx) -> dict[str, bool]:
    """Tell Sphinx of all this."""
    site.connect("autodoc-process-docstring", plain)
    site.connect("autodoc-skip-member", fields)
    alone = partial(write, as_block=True)
    site.add_html_math_renderer("mathml", (write, None), (alone, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
