# SPDX-License-Identifier: BSD-3-Clause
"""Figures in files and in pages."""
from __future__ import annotations

import io
import os
import re
from typing import Any

import matplotlib.pyplot as plt


def save(made: Any, path: str | os.PathLike) -> None:
    """Writes a figure by the ending of `path` and closes it.
    An SVG is the same file from the same numbers: it has no date."""
    made.savefig(path, metadata={"Date": None} if str(path).endswith(".svg") else None)
    plt.close(made)


def inline_svg(made: Any, name: str, tight: bool = False) -> str:
    """The figure as <svg> text for a page; `name` keeps its ids apart from those of others.
    `tight`: cut or widened to what is drawn, which takes twice the time and which figures of
    figure() do not need. The figure is closed."""
    out = io.StringIO()
    made.savefig(out, format="svg", bbox_inches="tight" if tight else None,
                 metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(made)
    text = out.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>\s*|<!--.*?-->\s*", "", text, flags=re.S)
    text = re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>{name}-", text)
    # Coordinates to a hundredth of a point; texts between the tags stay as they are.
    text = re.sub(r"<[^>]*>", lambda tag: re.sub(r"(\d\.\d\d)\d+", r"\1", tag.group()), text)
    return re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1",
                  re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", text, count=1), count=1)
