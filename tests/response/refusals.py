# SPDX-License-Identifier: BSD-3-Clause
"""Refused lists Campbell and Response, each with a message."""
from scenes import SOURCES, expect, tooljoint

STRING = str(SOURCES / "xml/helical_170m.xml")


def refusals():
    for name, words, command, settings in (
        ("no list", "has no list Campbell", "campbell", []),
        ("no range", "Highest Speed", "campbell", ["Campbell/Modes=3"]),
        ("more modes than dofs", "Campbell/Modes is 5000, but the model has", "campbell",
         ["Campbell/Highest Speed=10", "Campbell/Modes=5000"]),
        ("falling speeds", "Give a larger one", "campbell",
         ["Campbell/Lowest Speed=20", "Campbell/Highest Speed=10"]),
        ("half a window", "without Highest Frequency", "campbell",
         ["Campbell/Highest Speed=10", "Campbell/Lowest Frequency=1"]),
        ("falling window", "Give a larger one", "campbell", [
            "Campbell/Highest Speed=10", "Campbell/Lowest Frequency=2",
            "Campbell/Highest Frequency=1"
        ]),
        ("window and target", "both Highest Frequency and Target Frequency", "campbell", [
            "Campbell/Highest Speed=10", "Campbell/Highest Frequency=2",
            "Campbell/Target Frequency=1"
        ]),
        ("lobes of no motor", "no effect without Motor Speed", "campbell",
         ["Campbell/Highest Speed=10", "Campbell/Motor Lobes=5"]),
        ("no list Response", "has no list Response", "response", []),
        ("no sweep", "neither", "response", ["Response/Points=3"]),
        ("no output", "Outputs holds no dof", "response", ["Response/Highest Speed=10"]),
        ("two sweeps", "Give one", "response",
         ["Response/Highest Speed=10", "Response/Highest Frequency=10"]),
    ):
        arguments = [word for setting in settings for word in ("--set", setting)]
        done = tooljoint(command, STRING, "--output", "refused", *arguments)
        expect(f"refused: {name}", done.returncode == 2 and words in done.stderr,
               f"{done.returncode} {done.stderr[-400:]}")
    for name, words, settings in (
        ("no unbalance", "no mass off its axis", ["!Response/Unbalance"]),
        ("unbalance by frequency", "no meaning for an unbalance",
         ["!Response/Highest Speed", "Response/Highest Frequency=10"]),
        ("order of an unbalance", "has the order 1", ["Response/Order=2"]),
        ("order of an unbalance below a motor", "has the order 1",
         ["Response/Motor Speed=3", "Response/Motor Order=2"]),
        ("motor without a mass below it", "there are none",
         ["!Response/Unbalance", "Response/Motor Speed=3"]),
        ("motor by frequency", "no effect in a sweep by frequency",
         ["!Response/Highest Speed", "Response/Highest Frequency=10", "Response/Motor Speed=3"]),
        ("speed of the other sweep", "has no effect in a sweep by speed",
         ["Response/Rotary Speed=3"]),
        ("no load", "Loads holds no load", ["Response/Excitation=Harmonic"]),
        ("node", "no such node", ["Response/Outputs/x/Node=5"]),
        ("component", "have the components", ["Response/Outputs/x/Component=w"]),
        ("part", "but no part has this name", ["Response/Outputs/x/Part=motor"]),
        ("held", "is held", ["Parts/Imported/rotor/Fixed={1 v}"]),
    ):
        arguments = [
            word for one in settings
            for word in (("--without", one[1:]) if one.startswith("!") else ("--set", one))
        ]
        done = tooljoint("response", "laval.xml", "--output", "refused", *arguments)
        expect(f"refused: {name}", done.returncode == 2 and words in done.stderr,
               f"{done.returncode} {done.stderr[-400:]}")
