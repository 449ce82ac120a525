# SPDX-License-Identifier: BSD-3-Clause
"""The folders and their allowed includes. docs/architecture.md shows this table (`lint.py
--rooms`)."""

GROUND = "common deck linalg model statics"
MODELS = f"{GROUND} coupling io reduction"
CASES = f"{MODELS} estimate parts stability transient"

# Folder: (folders of its own side it may include, contents in words). src/ never includes
# substructures/, except in app.
TOOLKIT = {
    "common": ("", "errors, log, ranks, text, constants"),
    "deck": ("common", "from XML to checked values, the manual, registries"),
    "linalg": ("common", "Trilinos solvers, block-sparse kernels"),
    "model": ("common deck linalg", "SecondOrderModel, Substructure, laws"),
    "statics": ("common linalg model", "NOX drivers"),
    "io": ("common deck", "files: HDF5, XDMF, CSV, Matrix Market, summary.json"),
    "reduction": ("common deck io linalg model", "from a part to its reduced model"),
    "coupling": ("common deck linalg model reduction", "from parts to one model"),
    "transient": ("common coupling deck io linalg model", "time integration"),
    "parts": (MODELS, "parts from files and into files"),
    "estimate": (f"{MODELS} transient", "errors of a reduced model, without the full one"),
    "stability": (f"{MODELS} estimate", "stability of a state at rest"),
    "cases": (CASES, "a case; run, record, restart, check"),
    "study": (f"{CASES} cases", "speed against error over many runs, maps over parameters"),
    "response": (f"{CASES} cases", "Campbell diagrams and harmonic responses of any case"),
    "texts": ("cases common deck io",
              "texts of the program: last screens, manual pages, completions, templates"),
    "app": (f"{CASES} cases response study texts", "the program: a file for each command"),
}
PROGRAM = ("app", "texts")  # folders of src/ that are not in the installed library
# Folder: (folders of substructures/, folders of src/, contents in words)
DRILLSTRING = {
    "well": ("", GROUND, "trajectories, surveys, bore"),
    "beam": ("", GROUND, "sections, elements, rotations"),
    "loads": ("beam", GROUND, "gravity, forces, unbalance, rotary speed"),
    "contact": ("", GROUND, "the borehole wall"),
    "drilling": ("beam loads", GROUND, "laws of the bit and of the top drive"),
    "mud": ("beam", GROUND, "added mass, drag, flow"),
    "path": ("beam well", GROUND, "bending of the string into the well"),
    "softstring": ("beam well", GROUND, "torque and drag of a string without bending stiffness"),
    "equilibrium": ("beam contact", GROUND, "the static state"),
    "drillstring": ("beam contact drilling loads mud path well", GROUND,
                    "components, mesh, supports, equations"),
    "drillstring/figures": ("beam drillstring path", f"{GROUND} io cases",
                            "figures of merit of a bit and of bending"),
    "drillstring/scene": (
        "beam contact drilling drillstring equilibrium loads mud path softstring well",
        f"{CASES} cases", "from a deck to typed values and the static state"),
    "drillstring/case": ("beam contact drilling drillstring drillstring/figures drillstring/scene "
                         "equilibrium loads mud path softstring well", f"{CASES} cases",
                         "a string as a case: records, results, figures"),
    "drillstring/buckling": ("beam contact drilling drillstring drillstring/case drillstring/scene "
                             "equilibrium loads mud path softstring well", f"{CASES} cases",
                             "a string beyond buckling"),
    "drillstring/analyses": ("beam contact drilling drillstring drillstring/case "
                             "drillstring/figures drillstring/scene equilibrium loads mud path "
                             "softstring well", f"{CASES} cases",
                             "engineering analyses of a string other than its motion"),
}


def room_of(path):
    """(side, room) of a path in pieces, or None if the path is in none."""
    if len(path) < 3 or path[0] not in ("src", "substructures"):
        return None
    if path[0] == "substructures" and len(path) > 3 and "/".join(path[1:3]) in DRILLSTRING:
        return path[0], "/".join(path[1:3])
    return path[0], path[1]


def included_room(included):
    """(side, room) of an included path, or None for headers of other projects."""
    path = included.removeprefix("tooljoint/").removeprefix("../").split("/")
    if path[0] not in ("src", "substructures"):
        path = ["src", *path]
    found = room_of(path)
    known = found and found[1] in (TOOLKIT if found[0] == "src" else DRILLSTRING)
    return found if known else None


def include_problem(path, included):
    """Reason why a file at `path` (in pieces) may not include `included`, or None."""
    room, target = room_of(path), included_room(included)
    if path[0] == "python" and target and (target[0] != "src" or target[1] in PROGRAM):
        return (f"python/core binds the toolkit, and may not include {'/'.join(target)} "
                "(tests/lint/rooms.py)")
    if room is None or target is None or room == target:
        return None
    side, name = room
    if name not in (TOOLKIT if side == "src" else DRILLSTRING):
        return f"the room {side}/{name} is not in tests/lint/rooms.py"
    if side == "src":
        allowed = {("src", other) for other in TOOLKIT[name][0].split()}
        if name == "app":
            allowed |= {("substructures", other) for other in DRILLSTRING}
    else:
        own, toolkit, _ = DRILLSTRING[name]
        allowed = {("substructures", other)
                   for other in own.split()} | {("src", other) for other in toolkit.split()}
    return None if target in allowed else (f"{side}/{name} may not include {'/'.join(target)} "
                                           "(tests/lint/rooms.py)")


def table():
    """Both sides as Markdown."""
    lines = ["| Folder | contents | may include |", "|---|---|---|"]
    for name, (rooms, holds) in TOOLKIT.items():
        extra = ", substructures/" if name == "app" else ""
        lines.append(f"| src/{name} | {holds} | {', '.join(sorted(rooms.split())) or '-'}{extra} |")
    for name, (own, toolkit, holds) in DRILLSTRING.items():
        allowed = [*sorted(own.split()), "src/{" + ",".join(sorted(toolkit.split())) + "}"]
        lines.append(f"| substructures/{name} | {holds} | {', '.join(allowed)} |")
    lines.append("| python/core | the library in Python, a file for each concept | src/ but "
                 "app and texts |")
    return "\n".join(lines) + "\n"
