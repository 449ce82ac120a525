# SPDX-License-Identifier: BSD-3-Clause
"""A report opened in a browser at two widths and on paper: nothing is cut off, overlaps or is too
small to read, and the view in space is drawn and moves."""
import base64
import re

from checks import expect

PIXELS = """(() => {
  const view = document.querySelector("#view canvas"), copy = document.createElement("canvas");
  copy.width = view.width; copy.height = view.height;
  const context = copy.getContext("2d");
  context.drawImage(view, 0, 0);
  const data = context.getImageData(0, 0, copy.width, copy.height).data;
  const pixels = new Uint32Array(data.buffer), counts = new Map();
  let sum = 0;
  for (let i = 0; i < pixels.length; ++i) {
    counts.set(pixels[i], (counts.get(pixels[i]) || 0) + 1);
    sum = (sum * 31 + pixels[i]) >>> 0;
  }
  return {colours: counts.size, drawn: 1 - Math.max(...counts.values()) / pixels.length, sum: sum};
})()"""

# Texts of plots that are cut off or overlap. Slanted texts are not compared, since their boxes are
# larger than the texts.
TEXTS = """[...document.querySelectorAll("figure svg")].flatMap((svg) => {
  const frame = svg.getBoundingClientRect(), faults = [];
  const slants = (t) => /rotate\\(-(?!0|90)/.test(t.getAttribute("transform") || "");
  const boxes = [...svg.querySelectorAll("text")].map(
      (t) => [t.textContent, t.getBoundingClientRect(), slants(t)]);
  boxes.forEach(([text, box, slanted], i) => {
    if (box.left < frame.left - 2 || box.right > frame.right + 2 ||
        box.top < frame.top - 2 || box.bottom > frame.bottom + 2) faults.push("cut: " + text);
    for (const [other, second, slanted2] of boxes.slice(i + 1)) {
      const across = Math.min(box.right, second.right) - Math.max(box.left, second.left);
      const down = Math.min(box.bottom, second.bottom) - Math.max(box.top, second.top);
      if (!slanted && !slanted2 && across > 2 && down > 3) faults.push(text + " on " + other);
    }
  });
  return faults.map((fault) => svg.closest("figure").id + ": " + fault);
})"""

# texts of the axes in space that overlap or are outside of the picture
AXES = """(() => {
  const view = document.getElementById("view"), texts = view.labels();
  const canvas = view.querySelector("canvas");
  const cut = (a) => Math.max(-a.left, a.right) > canvas.clientWidth / 2 ||
      Math.max(-a.low, a.high) > canvas.clientHeight / 2;
  const meet = (a, b) => a.left < b.right && a.right > b.left && a.low < b.high && a.high > b.low;
  const faults = texts.filter(cut).map((a) => "cut: " + a.text);
  texts.forEach((a, i) => texts.slice(i + 1).forEach((b) => {
    if (meet(a, b)) faults.push(a.text + " on " + b.text);
  }));
  return faults;
})()"""
NAMES = ('document.getElementById("view").labels().map((one) => one.text).filter((text) => '
         'text.endsWith("[m]")).length')
WHEEL = """(() => {
  const canvas = document.querySelector("#view canvas");
  const turn = {deltaY: %d, bubbles: true, cancelable: true};
  for (let i = 0; i < 8; ++i) canvas.dispatchEvent(new WheelEvent("wheel", turn));
})()"""

# For each figure: name, size [px] of the smallest text, excess width over its place, and whether it
# is a large one.
SMALLEST = """[...document.querySelectorAll("figure")].map((figure) => {
  const svg = figure.querySelector("svg"), width = svg.getBoundingClientRect().width;
  const scale = width / svg.viewBox.baseVal.width;
  const sizes = [...svg.querySelectorAll("text")].map(
      (text) => parseFloat(getComputedStyle(text).fontSize) * scale);
  const large = figure.classList.contains("large");
  return [figure.id, Math.min(...sizes), width - figure.clientWidth, large];
})"""
LEAST = 8.4  # [px] of a text of a plot on a screen
MARGIN = 14  # of a printed page [mm]
# elements wider than a page of this width, or higher than a page
CUT = """[...document.querySelectorAll("figure, .card, #view canvas, table")].filter((one) => {
  const box = one.getBoundingClientRect();
  return box.width > 0 && (box.left < -1 || box.right > %d + 1 ||
                           (one.tagName !== "TABLE" && box.height > %d));
}).map((one) => [one, one.getBoundingClientRect()]).map(([one, box]) =>
    (one.id || one.tagName) + " " + Math.round(box.right) + " " + Math.round(box.height))"""
FLAT = """[...document.querySelectorAll("figure")].filter(
    (f) => f.querySelector("svg").getBoundingClientRect().height < 60).map((f) => f.id)"""
CROWDED = """[...document.querySelectorAll(".card, .notes li")].filter(
    (card) => card.scrollWidth > card.clientWidth).map((card) => card.textContent)"""
SEEN = '[...document.querySelectorAll("%s")].some((one) => one.getClientRects().length > 0)'


def look(title, path, chromium, view=True, moves=True):
    """Opens a page at two widths."""
    for width in (1280, 400):
        chromium.open(path, width)
        across = chromium.value("document.scrollingElement.scrollWidth")
        expect(f"{title}, {width} px: nothing stands out on the right", across <= width, across)
        if view and width == 1280:
            expect(f"{title}: the view says it is drawn",
                   chromium.value("document.body.dataset.view") == "drawn")
            rest = chromium.value(PIXELS)
            expect(f"{title}: the canvas is drawn", rest["colours"] > 20
                   and 0.003 < rest["drawn"] < 0.9, rest)
            if moves:
                chromium.value('(() => { const s = document.getElementById("view-slider"); s.value '
                               '= s.max; s.dispatchEvent(new Event("input")); })()')
                last = chromium.value(PIXELS)
                shown = chromium.value('document.getElementById("view-time").textContent')
                expect(f"{title}: the slider moves the picture", last["sum"] != rest["sum"]
                       and shown.endswith(" s"), shown)
                chromium.value('document.getElementById("view-rest").click()')
                expect(f"{title}: and back to rest", chromium.value(PIXELS)["sum"] == rest["sum"])
            if chromium.value('document.getElementById("view-field").length') > 1:
                chromium.value('(() => { const f = document.getElementById("view-field"); f.value '
                               '= 1; f.dispatchEvent(new Event("change")); })()')
                expect(f"{title}: another colour field is another picture",
                       chromium.value(PIXELS)["sum"] != rest["sum"])
        if view:
            expect(f"{title}, {width} px: the axes in space have their names",
                   chromium.value(NAMES) == 3, chromium.value(NAMES))
            for zoom in (0, 100, -100, -100):  # initial view, farther away, nearer
                if zoom:
                    chromium.value(WHEEL % zoom)
                faults = chromium.value(AXES)
                expect(
                    f"{title}, {width} px: no text of the axes in space is cut off or lies on "
                    "another", not faults, faults)
        small = chromium.value(FLAT)
        expect(f"{title}, {width} px: figures have a size", not small, small)
        texts = chromium.value(SMALLEST)
        expect(f"{title}, {width} px: no text of a plot is too small",
               all(size >= LEAST for _, size, _, _ in texts),
               [one for one in texts if one[1] < LEAST])
        expect(f"{title}, {width} px: plots fit the screen, but for large ones on a narrow one",
               all(out < 1 for _, _, out, large in texts if not large or width > 400), texts)
        wide = chromium.value(CROWDED)
        expect(f"{title}, {width} px: figures fit into their cards", not wide, wide)
        texts = chromium.value(TEXTS)
        expect(f"{title}, {width} px: no text of a plot is cut off or lies on another", not texts,
               texts[:8])
        expect(f"{title}, {width} px: the console is empty", not chromium.faults(),
               chromium.faults())
    on_paper(title, path, chromium, view)


def on_paper(title, path, chromium, view):
    """A4 pages on which no element is split; the view has its colour scale in words and numbers."""
    width, height = (round(length / 25.4 * 96) for length in (210 - 2 * MARGIN, 297 - 2 * MARGIN))
    chromium.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=False)
    chromium.call("Emulation.setEmulatedMedia", media="print")
    across = chromium.value("document.scrollingElement.scrollWidth")
    expect(f"{title}, on paper: nothing stands out on the right", across <= width, across)
    cut = chromium.value(CUT % (width, height))
    expect(f"{title}, on paper: each figure fits on a page", not cut, cut)
    small = chromium.value(SMALLEST)
    expect(f"{title}, on paper: texts of figures of a column and of half a page have 5.8 points",
           all(size >= 5.8 / 72 * 96 for _, size, _, large in small if not large), small)
    tops = chromium.value('["bit-speed", "torques"].map((name) => '
                          'document.getElementById(name)).filter((one) => one).map((one) => '
                          'one.getBoundingClientRect().top)')
    expect(f"{title}, on paper: two wide figures fill a row", len(set(tops)) <= 1, tops)
    if view:
        key, field = chromium.value(
            'document.getElementById("view-legend").innerText'), chromium.value(
                'document.getElementById("view-field").selectedOptions[0].text')
        most = chromium.value('document.getElementById("view-most").textContent')
        expect(
            f"{title}, on paper: the view says what its colours are",
            key.startswith("Colour: " + field.partition(" [")[0]) and most and most in key
            and "at rest" in key, key)
        expect(
            f"{title}, on paper: there are no controls and no hint for the mouse",
            "Drag to turn" not in chromium.value("document.body.innerText")
            and not chromium.value(SEEN % ".controls"))
    chromium.call("Emulation.setEmulatedMedia", media="")
    if view:
        expect(f"{title}: the scale on paper is not on the screen",
               not chromium.value(SEEN % "#view-legend"))
    content = base64.b64decode(
        chromium.call("Page.printToPDF", preferCSSPageSize=True, printBackground=False)["data"])
    boxes = {
        tuple(float(size) for size in box.split())
        for box in re.findall(rb"/MediaBox \[([^\]]*)\]", content)
    }
    a4 = (0, 0, 210 / 25.4 * 72, 297 / 25.4 * 72)
    expect(
        f"{title}: it prints on A4", boxes
        and all(len(box) == 4 and max(abs(x - y) for x, y in zip(box, a4)) < 1 for box in boxes),
        boxes)
    expect(f"{title}: and holds its figures there", len(content) > 20_000, len(content))
