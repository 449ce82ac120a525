# SPDX-License-Identifier: BSD-3-Clause
"""Margins to yield of the string: pressure of the mud, grades of drill pipe."""
import math
import pathlib

from checks import expect
from runs import DECK, SOURCES, near, rows, run


def pressure():
    """Margins to yield with mud pressure: von Mises stress of a thick wall from the loads of the
    profile, friction losses of the flow, the pump pressure."""
    survey = pathlib.Path("straight.csv").resolve()
    density, flow, friction, hole = 1300.0, 0.03, 0.013, 0.108
    mud = [
        "Well/Trajectory=Survey", f"Well/Survey/File={survey}", "Supports/Bit=none",
        f"Mud/Density={density}", f"Mud/Friction Coefficient={friction}", "Torque and Drag/Count=1",
        "Torque and Drag/Yield Strength=724 MPa", "Drillstring/Assembly={150*stand}"
    ]

    def loss(outer, inner):  # pressure loss of both flows per length
        inside, outside = (flow / (math.pi * area)
                           for area in (inner * inner, hole * hole - outer * outer))
        return friction * density / math.pi * (inside**2 / inner + outside**2 / (hole - outer))

    def drag(outer, inner):  # drag of the mud in the annulus per length
        return friction * density * outer * (flow / (math.pi * (hole * hole - outer * outer)))**2

    body, joint = (0.0635, 0.0543), (0.084, 0.0413)
    section = {pipe: math.pi * (pipe[0]**2 - pipe[1]**2) for pipe in (body, joint)}

    def thrust(outer):  # thrust of the pressure loss in the annulus on the area of the string
        speed = flow / (math.pi * (hole * hole - outer * outer))
        return math.pi * outer**2 * friction * density / math.pi * speed**2 / (hole - outer)

    # down the string, or down the annulus
    for folder, pump, down, pushed in (("pressure_flow", None, 1, 0),
                                       ("pressure_pump", 3.5e7, 1, 1), ("pressure_reverse", 3.5e7,
                                                                        -1, 1)):
        hanging = 150 * sum(part * (
            (7850 - density) * 9.81 * math.cos(math.radians(50)) * section[pipe] - down *
            (drag(*pipe) + pushed * thrust(pipe[0]))) for part, pipe in ((9.0, body), (0.5, joint)))
        through = down * 150 * (9.0 * loss(*body) + 0.5 * loss(*joint))
        table = run(folder, *mud, f"Mud/Flow Rate={down * flow}",
                    f"Mud/Annular Thrust={'true' if pushed else 'false'}",
                    *([f"Torque and Drag/Pump Pressure={pump} Pa"] if pump is not None else []))
        profile = [
            row for row in rows(folder, "torque_drag_profile.csv")
            if row["operation"] == "Drill rotating"
        ]
        off_bottom = next(row for row in table if row["operation"] == "Rotate off bottom")
        near(f"{folder}: hook load, buoyed weight less the drag of the mud",
             float(off_bottom["hook_load"]), hanging, 1e-6)
        near(f"{folder}: the same of the stiff string", float(off_bottom["stiff_hook_load"]),
             hanging, 1e-5)
        surface = through if pump is None else pump
        bit_side = surface - through
        for row, difference in ((profile[-1], surface), (profile[0], bit_side)):
            tension, torque, depth = (float(row[name]) for name in ("tension", "torque", "depth"))
            candidates = []  # the point belongs to the body or to the joint
            for outer, inner in (body, joint):
                area, polar = math.pi * (outer**2 - inner**2), math.pi / 2 * (outer**4 - inner**4)
                outside = 1.4e7  # any
                inside = outside + difference
                a = (inside * inner**2 - outside * outer**2) / (outer**2 - inner**2)
                b = difference * (inner * outer)**2 / (outer**2 - inner**2)
                axial = (tension + math.pi * (inside * inner**2 - outside * outer**2)) / area
                stresses = [
                    math.sqrt(0.5 * ((axial - (a - b / r**2))**2 + (2 * b / r**2)**2 +
                                     (a + b / r**2 - axial)**2) + 3 * (torque * r / polar)**2)
                    for r in (inner, outer)
                ]
                candidates.append(max(stresses))
            found = float(row["von_mises"])
            nearest = min(candidates, key=lambda value: abs(value - found))
            near(f"{folder}: von Mises at {depth:.0f} m of a thick wall", found, nearest, 1e-6)
        least = min(724e6 / float(row["von_mises"]) for row in profile)
        near(
            f"{folder}: margin to yield",
            float(
                next(row for row in table if row["operation"] == "Drill rotating")["yield_margin"]),
            least, 1e-6)
        stiff_profile = [
            row for row in rows(folder, "torque_drag_stiff_profile.csv")
            if row["operation"] == "Trip out" and row["von_mises"]
        ]
        expect(f"{folder}: the stiff string bears the pressure too",
               all(float(row["von_mises"]) > 0 for row in stiff_profile))
    still, pumped = ({row["operation"]: float(row["yield_margin"]) for row in rows(folder)}
                     for folder in ("pressure_flow", "pressure_pump"))
    expect("a pump pressure takes of the margin in every operation",
           all(pumped[name] < still[name] for name in still), (still, pumped))


def bends():
    """At the start and end of a bend the profile has a point on both sides, each with the stress
    and the limits of its own side: bending only in the bend, the clearance of its own bore."""
    radius = '<Parameter name="Bore Radius" type="double" value="0.108"/>'
    casing = "".join(f'<Parameter name="{name}" type="double" value="{value}"/>'
                     for name, value in (("From", 0), ("To", 1200), ("Radius", 0.2)))
    text = pathlib.Path(DECK).read_text(encoding="utf-8").replace(
        radius, f'{radius}<ParameterList name="Bore"><ParameterList name="casing">{casing}'
        "</ParameterList></ParameterList>")
    pathlib.Path("bends.xml").write_text(text, encoding="utf-8")
    run("bends", "Torque and Drag/Count=1", "Torque and Drag/Stiff String=None",
        "Torque and Drag/Operations={Trip out, Drill sliding}", deck="bends.xml")
    profile = rows("bends", "torque_drag_profile.csv")

    def sides(operation, depth):  # rows of the piece below and of that above
        found = [
            row for row in profile
            if row["operation"] == operation and abs(float(row["depth"]) - depth) < 1e-6
        ]
        expect(f"two points of {operation} at {depth} m", len(found) == 2, found)
        return found

    bending = 210e9 * math.radians(3) / 30
    for depth, sign in ((400, 1), (1000, -1)):
        below, above = (float(one["von_mises"]) for one in sides("Trip out", depth))
        expect(
            f"bending stress ends with the bend at {depth} m",
            any(
                abs(sign * (below - above) - bending * outer) < 1e-6 * bending * outer
                for outer in (0.0635, 0.084)), (below, above))
    below, above = (float(one["sinusoidal_limit"]) for one in sides("Drill sliding", 1200))
    expect(
        "the limit of buckling takes the clearance of its own side at 1200 m",
        any(
            abs(below / above - math.sqrt((0.2 - outer) / (0.108 - outer))) < 1e-6
            for outer in (0.0635, 0.084)), (below, above))


def neutral_point():
    """In a freely hanging string the weight below the neutral point is the weight on bit."""
    table = run("neutral", "Well/Trajectory=Vertical", "Well/Vertical/Length=1500",
                "Supports/Bit=none", "Torque and Drag/Count=1", "Torque and Drag/Stiff String=None",
                "Torque and Drag/Operations={Trip out, Drill sliding}", "Loads/Weight On Bit=20 kN")
    mass = 7850 * math.pi * (9.0 * (0.0635**2 - 0.0543**2) + 0.5 * (0.084**2 - 0.0413**2)) / 9.5
    near("above the neutral point nothing is compressed", float(table[1]["neutral_depth"]),
         1425 - 20e3 / (9.81 * mass), 1e-9)
    near("without weight on bit that is the bit", float(table[0]["neutral_depth"]), 1425, 1e-12)


def grades():
    """A hanging string of two grades from the table of drill pipe: its margin to yield is the
    smaller of the two ratios of strength to stress, computed by hand."""
    table = run(
        "grades", "Well/Trajectory=Vertical", "Well/Vertical/Length=1300", "Supports/Bit=none",
        "Torque and Drag/Count=1", "Torque and Drag/Stiff String=None",
        "Torque and Drag/Operations={Trip out}",
        f"Drillstring/Pipe Table={SOURCES / 'xml/components/api_drill_pipe.csv'}",
        "Drillstring/Assembly={7*5 in 19.50 S-135 NC50 stand, 36*5 in 19.50 E-75 NC50 stand}")
    inch, psi = 0.0254, 4.4482216152605 / 0.0254**2

    def area(outer, inner):
        return math.pi / 4 * (outer**2 - inner**2) * inch**2

    body = area(5, 4.276)

    def joint(inner):  # weight of 9.45 m
        return 7850 * 9.81 * (17 * inch * area(6.625, inner) + 0.3 * area(5.125, inner) +
                              (9.15 - 17 * inch) * body)

    weak, strong = 75000 * psi * body, 135000 * psi * body
    below = 108 * joint(3.75)
    whole = below + 21 * joint(2.75)
    near("the hook carries both grades", float(table[0]["hook_load"]), whole, 1e-6)
    near("the weaker pipe yields first", float(table[0]["yield_margin"]),
         weak / (below - 9.81 * 7850 * (10 * inch * area(6.625, 3.75) + 0.15 * area(5.125, 3.75))),
         1e-3)
    expect("and that is below the margin of the stronger one at the surface",
           float(table[0]["yield_margin"]) < strong / whole)
    near("where it begins", float(table[0]["yield_margin_depth"]), 21 * 9.45 + 10 * inch + 0.15,
         1e-3)
