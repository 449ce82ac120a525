# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx configuration of the documentation site (target `docs`, cmake/Documentation.cmake).

The source folder is the project's, not docs/: links between docs/, README.md, CONTRIBUTING.md and
examples/ are then the same on the site and on a repository page.
"""
import pathlib
import re
import sys

PROJECT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PROJECT / "docs"))

project = "Tooljoint"
author = "The Tooljoint authors"
release = re.search(r"project\(Tooljoint VERSION (\S+)",
                    (PROJECT / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)

root_doc = "docs/index"
include_patterns = [
    "docs/**.md", "README.md", "CONTRIBUTING.md", "CHANGELOG.md", "examples/*/README.md"
]
exclude_patterns = ["build", "results", ".*", "src", "substructures", "tests", "tools", "xml"]
extensions = ["myst_parser", "sphinx.ext.mathjax", "breathe", "python_reference"]
add_module_names = False

myst_heading_anchors = 5
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_dmath_allow_space = False
myst_dmath_allow_digits = False
highlight_language = "none"

# KaTeX of the distribution (libjs-katex) draws the formulas, so the site needs no network;
# sphinx.ext.mathjax only writes their markup.
KATEX = "/usr/share/javascript/katex"
html_static_path = [KATEX, "site.css"]
html_css_files = ["katex.min.css", "site.css"]
html_js_files = [
    ("katex.min.js", {"defer": "defer"}),
    ("contrib/auto-render.js", {"defer": "defer", "onload": "renderMathInElement(document.body)"}),
]
mathjax_path = "katex.min.js"
mathjax_options = {"defer": "defer"}
myst_update_mathjax = False

# Doxygen's XML of the headers; its folder is given on the command line, -D
# breathe_projects.tooljoint=FOLDER.
breathe_projects = {"tooljoint": ""}
breathe_default_project = "tooljoint"
breathe_default_members = ("members",)

html_theme = "furo"
html_title = f"Tooljoint {release}"
html_copy_source = False
html_show_sphinx = False

linkcheck_timeout = 20
linkcheck_retries = 2


def write_entry(app, exception):
    """The root page is in docs/; index.html at the top of the site redirects to it."""
    if exception is None and app.builder.name == "html":
        entry = ('<!doctype html>\n<meta charset="utf-8">\n<title>Tooljoint</title>\n'
                 '<meta http-equiv="refresh" content="0; url=docs/index.html">\n'
                 '<a href="docs/index.html">Tooljoint</a>\n')
        (pathlib.Path(app.outdir) / "index.html").write_text(entry, encoding="utf-8")


def join_scripts(app, exception):
    """Joins the two files of furo's script. Debian ships it as an ES module that imports another
    file, but pages load it as a plain script, in which `import` is a syntax error: no theme switch,
    no scroll spy. Modules would not help: browsers refuse them from file://."""
    script = pathlib.Path(app.outdir) / "_static/scripts/furo.js"
    if exception is not None or app.builder.name != "html" or not script.is_file():
        return
    text = script.read_text(encoding="utf-8")
    imported = re.match(r'import Gumshoe from "\./(.+?)";\n', text)
    if imported:  # other packages of furo ship a joined file
        gumshoe = script.with_name(imported.group(1)).read_text(encoding="utf-8")
        script.write_text(gumshoe + "\n" + text[imported.end():], encoding="utf-8")


def inline_normalize(app, exception):
    """Puts the text of normalize.css in the place of its import, which Debian's furo gives as a
    path on a web server."""
    style = pathlib.Path(app.outdir) / "_static/styles/furo.css"
    if exception is not None or app.builder.name != "html" or not style.is_file():
        return
    text = style.read_text(encoding="utf-8")
    normalize = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")
    own = normalize.read_text(encoding="utf-8") if normalize.is_file() else ""
    changed = re.sub(
        r'@import\s*(?:url\()?["\']?/javascript/normalize\.css/normalize\.css["\']?\)?;',
        lambda _: own, text)
    if changed != text:
        style.write_text(changed, encoding="utf-8")


def setup(app):
    app.connect("build-finished", inline_normalize)
    app.connect("build-finished", write_entry)
    app.connect("build-finished", join_scripts)
