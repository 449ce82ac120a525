# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the table of hard cases: settings, truth, result and verdict.

The verdict is one of
    met        the number is within its bound of the truth
    warned     it is not, and the run gives a warning; for errors up to 50 %
    off        it is not, and there is no warning; only for errors of motions up to 20 %
    refused    the run ended with exit code 2, 3 or 4 and a message, without a wrong number
    WRONG      a wrong number without a warning, an end without a message, or no end
    open       the case has no program yet
"""
import dataclasses
import math

from program import NoResult

WARNED_UP_TO = 0.5  # largest relative error allowed with a warning
SILENT_UP_TO = 0.2  # largest error of a motion allowed without a warning
REFUSALS = {2: "deck", 3: "model", 4: "solver"}
CASES = {}


@dataclasses.dataclass
class Row:
    variant: str
    parameter: str
    truth: str
    found: str
    verdict: str
    deviation: float = math.nan
    bound: float = math.nan
    note: str = ""
    required: bool = False  # a refusal counts as a failure
    cost: float = math.nan  # CPU time divided by that of the easy variant
    counters: dict = dataclasses.field(default_factory=dict)

    @property
    def failed(self):
        return self.verdict == "WRONG" or (self.verdict == "refused" and self.required)


@dataclasses.dataclass
class Plot:
    """Curves of a case: series[label] = [(x, y), ...]; labels that begin with "truth" are lines."""
    name: str
    title: str
    x: str
    y: str
    series: dict
    log: str = ""  # "", "x", "y" or "xy"


@dataclasses.dataclass
class Case:
    number: int
    title: str
    sweep: str
    must: str
    easy: str
    function: object


def case(number, title, sweep, must, easy=""):
    """Registers a generator of rows and plots; its arguments are the program and whether the run is
    short."""
    def register(function):
        if number in CASES:
            raise ValueError(f"case {number} is there twice")
        CASES[number] = Case(number, title, sweep, must, easy, function)
        return function

    return register


def number(value, digits=4):
    return f"{value:.{digits}g}" if isinstance(value, float) else str(value)


def judged(run, variant, parameter, measure, bound, required=False, easy=None, note="",
           motion=False):
    """The row of a run. measure(): (truth, found, deviation), called if the run is done; numbers
    are formatted, texts are not changed. `motion`: the deviation is an error of a motion."""
    common = {"required": required, "counters": run.counters(), "bound": bound}
    if easy is not None and easy.work() > 0:
        common["cost"] = run.work() / easy.work()
    if run.code in REFUSALS:
        return Row(variant, parameter, "", "", "refused", note=f"({run.code}) {run.sentence()}",
                   **common)
    if not run.done:
        return Row(variant, parameter, "", "", "WRONG",
                   note=f"exit code {run.code}: {run.sentence()}", **common)
    try:
        truth, found, deviation = measure()
    except NoResult as missing:
        return Row(variant, parameter, "", "", "WRONG", note=f"no truth: {missing}", **common)
    warnings = run.warnings()
    if deviation <= bound:  # false for NaN
        verdict = "met"
    elif warnings and deviation <= WARNED_UP_TO:
        verdict = "warned"
    elif motion and deviation <= SILENT_UP_TO:
        verdict = "off"
    else:
        verdict = "WRONG"
    said = "; ".join([note] * bool(note) + warnings)
    return Row(variant, parameter, number(truth), number(found), verdict, float(deviation),
               note=said, **common)


def against(truth, found, scale=None):
    """(truth, found, relative deviation), for judged()."""
    return truth, found, abs(found - truth) / (abs(truth) if scale is None else scale)


def refusal(run, variant, parameter, words, codes=(3, 4)):
    """The row of a run that must be refused with these words."""
    said = run.sentence() + " " + run.output
    good = run.code in codes and all(word in " ".join(said.split()) for word in words)
    return Row(variant, parameter, f"refused ({', '.join(map(str, codes))})",
               f"exit code {run.code}", "met" if good else "WRONG", note=run.sentence())


def statement(variant, parameter, truth, found, good, note="", counters=None, cost=math.nan):
    """The row of a statement that is true or false."""
    return Row(variant, parameter, truth, found, "met" if good else "WRONG", note=note,
               counters=counters or {}, cost=cost)
