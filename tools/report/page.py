# SPDX-License-Identifier: BSD-3-Clause
"""Puts sections into one self-contained HTML file."""
import contextlib
import json
import math
import pathlib
import re
import string
from html import escape

from report.files import Unreadable, reading

WEB = pathlib.Path(__file__).resolve().parent / "web"
THREE = pathlib.Path("/usr/share/javascript/three")  # from the Debian package libjs-three
VIEWER = ("three.min.js", "examples/js/controls/OrbitControls.js")
# [px] of a plot on a narrow screen; wider plots scroll horizontally
LEAST_TEXT = 8.5
LICENCE = """three.js, (c) 2010-2019 three.js authors. Permission is hereby granted, free of
charge, to any person obtaining a copy of this software and associated documentation files (the
"Software"), to deal in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software,
and to permit persons to whom the Software is furnished to do so, subject to the following
conditions: The above copyright notice and this permission notice shall be included in all copies
or substantial portions of the Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY
KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS
FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS
BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR
OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE."""


def template(name, **words):
    return string.Template((WEB / name).read_text(encoding="utf-8").replace(
        "<!-- SPDX-License-Identifier: BSD-3-Clause -->\n", "")).substitute(words)


def without_addresses(script):
    """JavaScript without the addresses in its comments, escaped for use inside a page."""
    kept = [
        line for line in script.splitlines()
        if not ("//" in line and line.lstrip().startswith(("*", "//", "/*")))
    ]
    return "\n".join(kept).replace("</script", "<\\/script").replace("https://", "")


def viewer():
    """three.js as installed by the distribution, or None."""
    try:
        return "\n".join(
            without_addresses((THREE / name).read_text(encoding="utf-8")) for name in VIEWER)
    except OSError:
        return None


class Page:
    """Sections in the order in which they are added; empty ones are left out."""
    def __init__(self, title, conditions=""):
        self.title, self.conditions = title, conditions
        self.damaged, self.notes, self.sections, self.scripts, self.footer = [], [], [], [], ""

    @contextlib.contextmanager
    def section(self, path):
        """Errors in this file leave its section out of the page; the page lists them at its top."""
        try:
            with reading(path):
                yield
        except Unreadable as fault:
            if str(fault) not in self.damaged:
                self.damaged.append(str(fault))

    def note(self, text, good=False):
        self.notes.append(
            f'<li class="good">{escape(text)}</li>' if good else f"<li>{escape(text)}</li>")

    def add(self, name, title, content):
        if content:
            self.sections.append((name, title, content))

    def plots(self, name, title, figures, before="", after=""):
        """A section of figures."""
        if figures:
            grid = "".join(figure_html(figure) for figure in figures)
            self.add(name, title, f'{before}<div class="plots">{grid}</div>{after}')

    def sort_tables(self):
        """Tables of the kind "sortable" are sorted by a click on a title."""
        self.scripts.append(f"<script>{(WEB / 'sort.js').read_text(encoding='utf-8')}</script>")

    def view(self, data, note):
        """The 3-D view, or the reason why there is none."""
        library = viewer()
        if library is None:
            self.add(
                "space", "In space", '<p class="remark">The 3-D view needs three.js (Debian: '
                'libjs-three) where the report is written.</p>')
            return
        is_string = data["kind"] == "string"
        forces = ('<label><input id="view-forces" type="checkbox" checked> contact '
                  'forces</label>') if is_string else ""
        scale = "lateral scale" if is_string else "displacements"
        turn = "Drag to turn, roll or pinch to zoom, drag with the right button to move."
        what = ("Bore, pipe and lateral displacements are enlarged by the lateral scale, lengths "
                "along the well are true.") if is_string else ""
        self.add(
            "space", "In space",
            template("view.html", scale=scale, forces=forces, turn=escape(turn),
                     note=escape(f"{what} {note}".strip())))
        scene = json.dumps(data,
                           separators=(",", ":")).replace("<",
                                                          "\\u003c")  # a name cannot end the script
        self.scripts += [
            f"<script>/* {LICENCE} */\n{library}</script>",
            f"<script>const SCENE = {scene};</script>",
            f"<script>{(WEB / 'viewer.js').read_text(encoding='utf-8')}</script>"
        ]

    def text(self):
        links = "".join(
            f'<a href="#{name}">{escape(title)}</a>' for name, title, _ in self.sections)
        sections = "\n".join(f'<section id="{name}"><h2>{escape(title)}</h2>\n{content}\n</section>'
                             for name, title, content in self.sections)
        damaged = [
            f"<li>{escape(fault)} This page leaves out what it shows.</li>"
            for fault in self.damaged
        ]
        notes = (f'<ul class="notes">{"".join(damaged + self.notes)}</ul>'
                 if damaged or self.notes else "")
        style = (WEB / "page.css").read_text(encoding="utf-8")
        return template("page.html", title=escape(self.title), conditions=escape(self.conditions),
                        notes=notes, links=links, sections=sections, style=style,
                        footer=escape(self.footer), scripts="\n".join(self.scripts))


def least_width(svg):
    """Width [px] at which the smallest text of a plot has the size LEAST_TEXT."""
    width = float(re.search(r'viewBox="\S+ \S+ (\S+) ', svg).group(1))
    sizes = [float(size) for size in re.findall(r"font(?:-size)?: ([\d.]+)px", svg)]
    return math.ceil(LEAST_TEXT / min(sizes) * width) if sizes else 0


def figure_html(figure):
    return (f'<figure id="{figure.name}" class="{figure.size}" '
            f'style="--least: {least_width(figure.svg)}px"><div '
            'class="scrolled" role="img" '
            f'aria-label="{escape(figure.caption)}">{figure.svg}</div>'
            f"<figcaption>{escape(figure.caption)}</figcaption></figure>")


def cards(entries):
    """Headline figures: (name, value, value in units of the field, remark, whether it is bad)."""
    def card(name, value, field, remark, bad):
        return (f'<div class="card{" bad" if bad else ""}"><div class="name">{escape(name)}</div>'
                f'<div class="value">{escape(value)}</div><div class="field">{escape(field)}</div>'
                f'<div class="remark">{escape(remark)}</div></div>')

    return f'<div class="figures-of-run">{"".join(card(*entry) for entry in entries)}</div>'
