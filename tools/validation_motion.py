# SPDX-License-Identifier: BSD-3-Clause
"""Tables of docs/validation.md on the motion of the reference scene.

    tools/validation.py --only motion,nodes,source
"""

FULL = ["--without", "Reduction", "--without", "Substructures"]


def reference(bench):
    return bench.run("full_rk4", "helical_170m", [
        *FULL, "--set", "Transient/Integrator=RK4", "--set", "Transient/Step=4e-5", "--set",
        f"Transient/End Time={bench.end}"
    ])


def motion_table(bench):
    """Range of the bit speed of the full model in windows of time, and the errors of the implicit
    runs against it."""
    ref = reference(bench)
    rows = [
        "| run | dofs | steps | CPU [s] | CPU per simulated s | bit speed min / max [rpm] | eps_t "
        "max, 0-3 s | eps_n max, 0-3 s | vibration error, 0-3 s | energy residual |",
        "|---|---|---|---|---|---|---|---|---|---|"
    ]
    variants = [
        ("full_rk4", None, "full, RK4, step 40 us (reference)"),
        ("full_rk4a_3s", [*FULL, "--set",
                          "Transient/Integrator=RK4 adaptive"], "full, RK4 adaptive, 3 s"),
        ("full_ga_2500us", [*FULL, "--set",
                            "Transient/Step=0.0025"], "full, generalized-alpha 2.5 ms"),
        ("full_ga", [*FULL], "full, generalized-alpha, step of the deck"),
        ("reduced_2500us", ["--set", "Transient/Step=0.0025"], "reduced, generalized-alpha 2.5 ms"),
        ("reduced", [], "reduced, generalized-alpha (the deck as it is)"),
    ]
    for name, arguments, title in variants:
        end = min(3.0, bench.end) if name.endswith("_3s") else bench.end
        summary = ref if arguments is None else bench.run(
            name, "helical_170m", [*arguments, "--set", f"Transient/End Time={end}"])
        if summary is None:
            rows.append(f"| {title} | failed |||||||||")
            continue
        t = summary["transient"]
        errors = ["-"] * 4 if arguments is None else [
            f"{e:.2e}" for e in bench.compare(name, "full_rk4", min(3.0, bench.end))
        ]
        dofs = summary["reduction"]["reduced_dofs"] if t["model"] == "reduced" else summary[
            "model"]["free_dofs"]
        speed = t["bit_speed_rpm"]
        rows.append(f"| {title} | {dofs} | {t['steps']} | {t['cpu_s']:.2f} | "
                    f"{t['cpu_s'] / end:.3f} | {speed['min']:.1f} / {speed['max']:.1f} | "
                    f"{errors[0]} | {errors[2]} | {errors[3]} | {t['energy_residual']:.1e} |")
    return bench.taken() + "\n" + "\n".join(rows) + "\n"


def speed_windows(bench):
    """Bit speed of the full RK4 run in windows of 2.5 s, from motion.csv."""
    reference(bench)
    bench.taken()
    rows = ["| window [s] | min [rpm] | max [rpm] |", "|---|---|---|"]
    lines = (bench.work / "full_rk4" / "motion.csv").read_text().splitlines()
    samples = [[float(x) for x in line.split(",")] for line in lines[1:]]
    begin = 0.0
    while begin < bench.end - 1e-9:
        speeds = [s[2] * 60.0 / 6.283185307179586 for s in samples if begin <= s[0] <= begin + 2.5]
        rows.append(f"| {begin:g} - {begin + 2.5:g} | {min(speeds):.1f} | {max(speeds):.1f} |")
        begin += 2.5
    return "\n".join(rows) + "\n"


def node_table(bench):
    """Contact duty of the nodes named in the paper and lateral vibration of pipes and bottom-hole
    assembly, from results.h5 of the full RK4 run."""
    import h5py
    import numpy
    reference(bench)
    bench.taken()
    with h5py.File(bench.work / "full_rk4" / "results.h5") as results:
        clearance = results["/model/clearance"][:]
        lateral = results["/transient/displacement"][:, :, :2]
        still = results["/static/displacement"][:, :2]
        axial = results["/static/axial_force"][:]
    touching = numpy.hypot(lateral[:, :, 0], lateral[:, :, 1]) > clearance
    rows = ["| node | published | share of the samples in contact |", "|---|---|---|"]
    for node, published in ((3, "intermittent"), (21, "free"), (44, "intermittent"), (82, "free"),
                            (147, "always in contact")):
        rows.append(f"| {node} | {published} | {100.0 * touching[:, node - 1].mean():.1f} % |")
    vibration = numpy.sqrt(((lateral - still)**2).sum(axis=2).mean(axis=0))
    rows += [
        "", "Lateral vibration, rms over time and nodes: drill pipes (nodes 1 to 55) "
        f"{1e3 * numpy.sqrt((vibration[:55] ** 2).mean()):.2f} mm, bottom-hole assembly (nodes 56 "
        f"to 163) {1e3 * numpy.sqrt((vibration[55:] ** 2).mean()):.2f} mm. Axial force of elements "
        f"146, 147 and 148: {axial[145]:.1f}, {axial[146]:.1f} and {axial[147]:.1f} N."
    ]
    return "\n".join(rows) + "\n"


def source_table(bench):
    """The choices of the source over its mode counts."""
    published = {
        0: (147.99, 9.44), 60: (155.97, 8.95), 180: (461.83, 3.02), 220: (1553.48, 0.89),
        300: (4475.19, 0.31)
    }
    full = bench.run("full_rk4a", "helical_170m", [
        *FULL, "--set", "Transient/Integrator=RK4 adaptive", "--set",
        f"Transient/End Time={bench.end}"
    ])
    reference(bench)
    window = min(3.0, bench.end)
    rows = [
        f"| eta | initial state | dofs | CPU [s] for {bench.end:g} s | full / reduced | published "
        f"full / reduced | eps_t max | eps_n max | vibration error (0-{window:g} s) |",
        "|---|---|---|---|---|---|---|---|---|"
    ]
    for state in ("Least squares", "Keep static"):
        for eta, (_, ratio) in published.items():
            name = f"source_{eta}_{state.split()[0].lower()}"
            summary = bench.run(name, "helical_170m_source", [
                "--set", f"Reduction/Mode Selection/Modes={eta}", "--set",
                f"Reduction/Initial State={state}", "--set", f"Transient/End Time={bench.end}"
            ])
            if summary is None:
                rows.append(f"| {eta} | {state} | failed |||||||")
                continue
            t = summary["transient"]
            errors = bench.compare(name, "full_rk4", window)
            rows.append(f"| {eta} | {state} | {summary['reduction']['reduced_dofs']} | "
                        f"{t['cpu_s']:.2f} | {full['transient']['cpu_s'] / t['cpu_s']:.2f} | "
                        f"{ratio} | {errors[0]:.2e} | {errors[2]:.2e} | {errors[3]:.2e} |")
    return bench.taken() + "\n" + "\n".join(rows) + "\n"
