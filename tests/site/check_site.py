#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the documentation site and checks it: check_site.py CMAKE BUILD PROJECT

Every link within the site leads to an existing file and anchor, every picture exists, every page of
docs/ is in the site and in the navigation of the first page, long tables are CSV files, and the
reference of the Python package lists all public names. If Chromium is installed, a page has no
errors in it and its theme switch works. Links to other hosts are those listed here; they are not
opened (target `docs-linkcheck`).
"""
import csv
import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "support"), str(TESTS / "report")]
import browser  # noqa: E402
from checks import expect, finish  # noqa: E402
from pictured import RECORD  # noqa: E402

GENERATED = {"index.html", "genindex.html",
             "search.html"}  # made by Sphinx, or redirection to the first page
# bytes; pictures are read over slow connections and remain in the repository
LARGEST_PICTURE = 150_000
ELSEWHERE = {"https://uscilab.github.io/cereal/"
             }  # links to other hosts, which only `docs-linkcheck` opens
THEME = {"https://github.com/pradyunsg/furo",
         "https://pradyunsg.me"}  # links that the theme writes into each page
# Target or tool of each figure of the documents; all but the first belong to the target `records`.
MAKERS = {
    "architecture.svg": "tests/lint/picture.py", "cms_variants_*.png": "cms-variants",
    "hard_*.svg": "hard-cases", "map_*.svg": "maps", "step_error.svg": "step_accuracy",
    "scale_*.svg": "scale", "speed_*.svg": "speed_against_error", "strategies.svg": "strategies",
    "modes_*.svg": "speed_against_error", "drilling_*.png": "docs-pictures",
    "python_*.png": "docs-pictures", "report_*.png": "docs-pictures",
    "tutorial_*.png": "docs-pictures"
}
PLOTS_FIRST = ("cms-variants", "scale", "speed-against-error", "step-error", "strategies"
               )  # pages of benchmarks
LONGEST_TABLE = 90  # rows of a table in a page; longer ones are files of docs/tables


OFFERED = """
import inspect, tooljoint, tooljoint.plots
for module in (tooljoint, tooljoint.plots):
    for name in module.__all__:
        one = getattr(module, name)
        if inspect.ismodule(one):
            continue
        own = vars(one) if inspect.isclass(one) and module is tooljoint else {}
        offered = [each for each, what in own.items() if not each.startswith("_")
                   and (callable(getattr(one, each)) or isinstance(what, property))]
        public = f"{module.__name__}.{name}"
        print(public, *[f"{public}.{each}" for each in offered])
"""  # names of the package, with the methods and properties of its classes


class Page(html.parser.HTMLParser):
    """Anchors, links and pictures of a page, and the links of its navigation."""
    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.navigation, self.depth = set(), set(), set(), 0
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        self.anchors |= {named[key] for key in ("id", "name") if named.get(key)}
        if tag == "div" and (self.depth or "sidebar-tree" in (named.get("class") or "").split()):
            self.depth += 1
        for key in ("href", "src"):
            if named.get(key):
                self.links.add(named[key])
                if self.depth and tag == "a":
                    self.navigation.add(named[key])

    def handle_endtag(self, tag):
        if tag == "div" and self.depth:
            self.depth -= 1


def target(page, link):
    """(file, anchor) of a link in a page, or None for another host."""
    parts = urllib.parse.urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = urllib.parse.unquote(parts.path)
    return ((page.parent / path).resolve() if path else page), urllib.parse.unquote(parts.fragment)


def broken(pages):
    """Each broken link as a text."""
    for path, page in pages.items():
        for link in sorted(page.links):
            led = target(path, link)
            if led is None:
                continue
            file, anchor = led
            if not file.is_file():
                yield f"{path.name}: {link}: no such file"
            elif anchor and file in pages and anchor not in pages[file].anchors:
                yield f"{path.name}: {link}: no such anchor"


def elsewhere(pages):
    """Links to other hosts."""
    return {
        link for path, page in pages.items() for link in page.links if target(path, link) is None
    } - THEME


def self_test(folder):
    """The checks detect a page without an anchor, a file and an entry in the navigation."""
    folder.mkdir(exist_ok=True)
    (folder / "a.html").write_text(
        '<div class="sidebar-tree"><div><a href="a.html">a</a></div></div><a '
        'href="b.html#there">b</a><a href="b.html#gone">b</a>', encoding="utf-8")
    (folder / "b.html").write_text(
        '<h1 id="there">b</h1><img src="gone.png"><a href="https://example.org/gone">elsewhere</a>',
        encoding="utf-8")
    pages = read(folder.resolve())
    expect(
        "the checks find a broken link",
        sorted(broken(pages)) == [
            "a.html: b.html#gone: no such anchor", "b.html: gone.png: no such file"
        ], str(sorted(broken(pages))))
    expect("a link to another host",
           elsewhere(pages) == {"https://example.org/gone"}, sorted(elsewhere(pages)))
    expect("and a page outside of the navigation",
           unlisted(pages,
                    folder.resolve() / "a.html") == ["b.html"],
           str(unlisted(pages,
                        folder.resolve() / "a.html")))


def read(site):
    """The pages, without those of Doxygen."""
    return {
        path: Page(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")
        if "doxygen" not in path.relative_to(site).parts
    }


def unlisted(pages, first):
    """Names of the pages missing in the navigation of the first page."""
    listed = {target(first, link)[0] for link in pages[first].navigation if target(first, link)}
    return sorted(
        path.name for path in pages if path not in listed | {first} and path.name not in GENERATED)


def main():
    cmake, build, project = sys.argv[1], *(pathlib.Path(argument).resolve()
                                           for argument in sys.argv[2:4])
    self_test(pathlib.Path("self_test"))
    for folder in ("docs", "examples"):  # Sphinx keeps the pages of removed sources
        shutil.rmtree(build / "docs/html" / folder, ignore_errors=True)
    done = subprocess.run([cmake, "--build", str(build), "--target", "docs"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    expect("the site is built without a warning", done.returncode == 0, done.stdout[-4000:])
    if done.returncode:
        return finish()
    site = (build / "docs/html").resolve()
    pages = read(site)
    sources = sorted(
        path.relative_to(project).with_suffix(".html") for path in (project / "docs").rglob("*.md"))
    missing = [str(source) for source in sources if site / source not in pages]
    expect("every page of docs/ is on the site", sources and not missing, ", ".join(missing))
    wrong = sorted(broken(pages))
    expect(
        f"the {sum(len(page.links) for page in pages.values())} links of {len(pages)} pages lead "
        "somewhere", not wrong, "\n".join(wrong))
    abroad = elsewhere(pages)
    expect(
        "links to other hosts are well-formed and listed in this test", abroad == ELSEWHERE
        and all(re.fullmatch(r"https://[\w-]+(\.[\w-]+)+/[\w./~#-]*", link) for link in abroad),
        sorted(abroad ^ ELSEWHERE))
    outside = unlisted(pages, site / "docs/index.html")
    expect("every page stands in the navigation", not outside, ", ".join(outside))
    recorded = json.loads(RECORD.read_text(encoding="utf-8"))
    shown = {
        path.name for kind in ("tutorial_*.png", "report_*.png")
        for path in (project / "docs/figures").glob(kind)
    }
    expect("each picture of a report has its figures on record", shown == set(recorded),
           f"{sorted(shown ^ set(recorded))}")
    expect(
        "the reports in README.md and of a motion have no warning",
        all(recorded[name]["notes"] == ["No warnings; all checks are met."]
            for name in ("report_string.png", "report_motion.png")))
    figures = sorted(path for path in (project / "docs/figures").iterdir() if path != RECORD)
    large = [path.name for path in figures if path.stat().st_size > LARGEST_PICTURE]
    expect("figures are small", figures and not large, ", ".join(large))
    unmade = [path.name for path in figures if sum(path.match(pattern) for pattern in MAKERS) != 1]
    records = re.search(r"if\(PYTHON3_FOR_FIGURES AND .*?\nendif",
                        (project / "cmake/DeveloperTools.cmake").read_text(encoding="utf-8"),
                        re.S)[0]
    unmade += [
        maker for maker in list(MAKERS.values())[1:] if not re.search(rf"[ (]{maker}[ )]", records)
    ]
    expect("every figure has a maker, which the target records runs", not unmade, ", ".join(unmade))
    written = "".join(
        path.read_text(encoding="utf-8")
        for path in [*(project / "docs").rglob("*.md"), project / "README.md"])
    unseen = [path.name for path in figures if f"figures/{path.name}" not in written]
    expect("every figure is on a page", not unseen, ", ".join(unseen))
    tabulated(project / "docs")
    tables = [
        name for name in PLOTS_FIRST
        if not re.search(r"\A[^|]*^!\[", (project / f"docs/{name}.md").read_text(
            encoding="utf-8"), re.M)
    ]
    expect("pages of benchmarks have a figure before their first table", not tables,
           ", ".join(tables))
    if (build / "python/tooljoint/__init__.py").exists():
        documented(build / "python", pages, site / "docs/api")
    if browser.program():
        clicked(site / "docs/index.html")
    return finish()


def tabulated(docs):
    """Long tables are CSV files, each linked from a page that states the number of rows."""
    texts = {path: path.read_text(encoding="utf-8") for path in docs.rglob("*.md")}
    long = [
        f"{path.name}: {rows}" for path, text in texts.items()
        for table in re.findall(r"(?:^\|.*\n)+", text, re.M)
        if (rows := table.count("\n") - 2) > LONGEST_TABLE
    ]
    expect(f"tables in pages have at most {LONGEST_TABLE} rows", not long, ", ".join(long))
    text = "\n".join(texts.values())
    said = {
        name: int(rows) for rows, name in re.findall(
            r"\b(?:All|of|The) (\d+) [\w ]+\(?\[[^\]]+\]\(tables/(\w+\.csv)\)",
            text.replace(": [", " ["))
    }
    found = {}
    for path in (docs / "tables").glob("*.csv"):
        with open(path, newline="", encoding="utf-8") as file:
            found[path.name] = len(list(csv.reader(file))) - 1
    expect(f"{len(found)} tables have the rows that the pages say",
           len(found) > 30 and said == found, sorted(set(said.items()) ^ set(found.items())))


def documented(package, pages, folder):
    """The pages of the Python package list every public name."""
    done = subprocess.run([sys.executable, "-c", OFFERED],
                          env={**os.environ, "PYTHONPATH": str(package)}, stdout=subprocess.PIPE,
                          text=True, check=True)
    offered = set(done.stdout.split())
    shown = set().union(*(page.anchors for path, page in pages.items() if path.parent == folder))
    expect(f"the {len(offered)} names of the Python package are in its reference",
           len(offered) > 100 and offered <= shown, ", ".join(sorted(offered - shown)))


def clicked(page):
    """In Chromium: no error on the console, and the switch changes the theme."""
    with browser.Browser() as shown:
        shown.open(page, 1400)
        expect("a page is without errors in Chromium", not shown.faults(),
               "; ".join(shown.faults()))
        themes = [shown.value("document.body.dataset.theme")]
        for _ in range(2):
            shown.value("[...document.querySelectorAll('.theme-toggle')].find(button => "
                        "button.offsetParent)?.click()")
            themes.append(shown.value("document.body.dataset.theme"))
        expect("its switch changes the theme", len(set(themes)) == 3, str(themes))


if __name__ == "__main__":
    sys.exit(main())
