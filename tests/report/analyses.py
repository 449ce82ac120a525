# SPDX-License-Identifier: BSD-3-Clause
"""Reports of analyses."""
import html
import json
import pathlib
import re
import shutil

from checks import expect, tooljoint
from opened import look
from pictured import compare
from written import EFFECTS, ROOT, STRING, figures, page


def analysis(chromium, title, command, deck, wanted, *arguments):
    """Makes and checks the report of an analysis: its title, warnings first, headline figures
    before the sections, the deck; its text and its summary, {} if there is none."""
    folder = f"analysis_{command}"
    shutil.rmtree(folder, ignore_errors=True)
    done = tooljoint(command, deck, "--output", folder, *arguments)
    expect(f"{command} succeeds", done.returncode == 0, done.stderr[-300:])
    report_page, text = page(command, folder, wanted)
    if chromium:
        look(command, report_page, chromium, view=False)
    path = pathlib.Path(folder, "summary.json")
    summary = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
    expect(f"{command}: the title says what it is", f"<h1>{title}: " in text,
           re.findall("<h1>.*?</h1>", text))
    order = [
        section for section in re.findall(r'<section id="([^"]+)"', text) if section != "numerics"
    ]
    expect(f"{command}: figures come first, the deck last", order[0] == "figures"
           and (order[-1] == "deck" or not summary), order)
    if summary:
        first = re.search(r'<ul class="notes"><li[^>]*>(.*?)</li>', text).group(1)
        expect(f"{command}: warnings come first",
               html.unescape(first) == (summary["warnings"] or ["No warnings."])[0], first)
    expect(f"{command}: no number is minus zero", not re.search(r">-0(\.0+)?( [^<]*)?<", text),
           re.findall(r".{20}>-0(?:\.0+)?(?: [^<]*)?<", text)[:3])
    return text, summary


def card(name, value):
    return f'<div class="name">{name}</div><div class="value">{value}</div>'


def cells(text, column):
    """Texts of a column of the first table that is not a list of pairs."""
    rows = re.findall(
        r"<tr>(.*?)</tr>",
        re.search(r"<table><caption>.*?</table>|<table><thead>.*?</table>", text, re.S).group(),
        re.S)
    return [re.findall(r"<td[^>]*>(.*?)</td>", row)[column] for row in rows[1:]]


def analyses(chromium):
    text, summary = analysis(chromium, "Torque and drag", "torque-drag", STRING,
                             {"hook-load", "surface-torque", "buckling-1", "broomstick-hook-load"},
                             "--set", "Torque and Drag/Depths={40, 42}", "--set",
                             "Torque and Drag/Broomstick={0.1, 0.3}", "--set",
                             "Torque and Drag/Yield Strength=931 MPa")
    rows = summary["torque_drag"]["rows"]
    expect(
        "torque-drag: its largest hook load",
        card("Largest hook load", f"{max(row['hook_load'] for row in rows) / 1e3:.1f} kN") in text)
    expect(
        "torque-drag: conditions",
        re.search(
            r'class="conditions">string of 42 m, up to 120 rpm, WOB 10 kN, .*mud 1200 kg/m3, bore '
            r'radius 108 mm, static friction 0.3', text) is not None,
        re.findall('class="conditions">.*', text))
    expect("torque-drag: tensions under the same limits share a figure", "buckling-2"
           not in figures(text), sorted(figures(text)))
    broom = re.search(r'<figure id="broomstick-hook-load".*?</figure>', text, re.S).group()
    expect(
        "torque-drag: a broomstick names operations and friction",
        all(f">{name}<" in broom
            for name in ("Trip out", "Drill rotating", "friction 0.1", "friction 0.3"))
        and "measured" not in broom)
    margins = [value for value in cells(text, 5) if value != "-"]
    expect("torque-drag: margins have two decimals", margins
           and all(re.fullmatch(r"\d+\.\d\d", value) for value in margins), margins)
    text, summary = analysis(
        chromium, "Bottom-hole assembly", "bha", str(ROOT / "xml/bha_motor_1500m.xml"),
        {"bha-high", "bha-right", "bha-moment"}, *[
            part for name, values in (("Weight On Bit", "120 kN"), ("Inclination", "45 deg"),
                                      ("Tool Face", "0 deg"))
            for part in ("--set", f"Bottom-Hole Assembly/{name}={{{values}}}")
        ])
    compare("report_bha.png", text)
    expect(
        "bha: headline figures in both units",
        all(f'<div class="name">{name}</div>' in text
            for name in ("Side force, high side", "Tangency", "Unstable states"))
        and "klbf)" in text and " lbf<" in text)
    marked = sum("UNSTABLE" in state for state in cells(text, 0))
    expect(
        "bha: unstable states are marked",
        marked == sum(not row["stable"] for row in summary["bha"]["rows"])
        and card("Unstable states", marked) in text, marked)
    text, summary = analysis(chromium, "Buckling", "buckling", str(EFFECTS / "buckling.xml"),
                             {"buckling-path", "buckling-contact", "buckling-shape"})
    expect(
        "buckling: its last weight on bit",
        card("Last weight on bit", f"{summary['buckling']['last_weight_on_bit'] / 1e3:.1f} kN")
        in text)
    text, summary = analysis(chromium, "Campbell diagram", "campbell", STRING,
                             {"campbell", "campbell-shapes"}, "--set",
                             "Campbell/Highest Speed=200 rpm", "--set", "Campbell/Modes=4", "--set",
                             "Campbell/Points=5")
    ratios = [one["damping"] for one in summary["campbell"]["crossings"]]
    expect(
        "campbell: the diagram stands before the critical speeds", 0 <
        text.index('<figure id="campbell"') < text.index(f"<summary>{len(ratios)} critical speeds"))
    expect(
        "campbell: damping ratios have four decimals, negative ones are marked",
        cells(text,
              4) == [f"{ratio:.4f}" + (" UNSTABLE" if ratio < -1e-9 else "") for ratio in ratios],
        cells(text, 4)[:3])
    analysis(chromium, "Harmonic response", "response", str(EFFECTS / "rotor.xml"), {"response"})
    text, _ = analysis(chromium, "Modes", "modes", STRING, {
        "modes-frequencies", "damped-modes-frequencies", "mode-damping", "mode-errors",
        "mode-shapes"
    }, "--count", "6")
    expect(
        "modes: frequencies have the same decimals",
        len({len(value.partition(".")[2]) for value in cells(text, 1)}) == 1
        and max(map(len, cells(text, 1))) <= 7, cells(text, 1))
    expect("modes: the lowest frequency", '<div class="name">Lowest frequency</div>' in text)
