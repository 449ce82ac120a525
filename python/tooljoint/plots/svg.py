# SPDX-License-Identifier: BSD-3-Clause
"""Figures as files and for pages."""
from __future__ import annotations

import io
import os
import re
from typing import Any

import matplotlib.pyplot as plt


def save(made: Any, path: str | os.PathLike) -> None:
    """Writes a figure in the format of the extension of `path` and closes it. An SVG contains no
    date: equal data give equal files."""
    made.savefig(path, metadata={"Date": None} if str(path).endswith(".svg") else None)
    plt.close(made)


def inline_svg(made: Any, name: str, tight: bool = False) -> str:
    """The figure as <svg> text for a page; `name` makes its ids unique in the page. `tight`:
    cropped or extended to the drawing, which takes twice the time and is not needed for figures of
    figure(). The figure is closed."""
    out = io.StringIO()
    made.savefig(out, format="svg", bbox_inches="tight" if tight else None,
                 metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(made)
    text = out.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<metadata>.*?</metadata>\s*|<!--.*?-->\s*", "", text, flags=re.S)
    text = re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>{name}-", text)
    # rounds coordinates to a hundredth of a point; texts between the tags are kept
    text = re.sub(r"<[^>]*>", lambda tag: re.sub(r"(\d\.\d\d)\d+", r"\1", tag.group()), text)
    return re.sub(r'(<svg[^>]*?) width="[^"]*"', r"\1",
                  re.sub(r'(<svg[^>]*?) height="[^"]*"', r"\1", text, count=1), count=1)
