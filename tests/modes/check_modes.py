#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`tooljoint modes` on structures for which it was not tuned: check_modes.py PROGRAM MPIEXEC

Free and pinned beams (closed forms), frames and solids with repeated frequencies, undamped,
lightly, proportionally and strongly damped, and rotors: values against scipy's dense solver of the
companion form, counts and times against the documentation.
"""
import csv
import json
import pathlib
import resource
import subprocess
import sys

import h5py
import numpy as np
from scipy import sparse
from scipy.linalg import eigh
from scipy.sparse.linalg import eigsh

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import structures as st  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from checks import expect, finish, tooljoint  # noqa: E402
from spectra import TWO_PI, column, companion, proportional, same, values  # noqa: E402

PROGRAM = sys.argv[1]
E, RHO = st.STEEL["E"], st.STEEL["rho"]
SECONDS = 3.0  # CPU time of the whole command for 600 dofs


def modes(name, structure, count=12, reduction=None, parts=None, joints=()):
    """Rows of modes.csv and damped_modes.csv, text, CPU seconds."""
    if structure is not None:
        structure.write(f"{name}.h5")
        parts = {"part": f"{name}.h5"}
    st.deck(f"{name}.xml", parts, joints, reduction)
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(
        [PROGRAM, "modes", f"{name}.xml", "--count",
         str(count), "--output", f"{name}_out"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, check=False, timeout=600)
    cpu = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    expect(f"{name}: exit code 0", done.returncode == 0,
           f"{cpu:.1f} s" if done.returncode == 0 else done.stdout[-600:])
    table = lambda file: [{k.split(" ")[0]: float(v) if v else np.nan for k, v in row.items()}
                          for row in csv.DictReader(open(file, encoding="utf-8"))]
    if done.returncode != 0:
        return None, None, done.stdout, cpu
    return table(f"{name}_out/modes.csv"), table(f"{name}_out/damped_modes.csv"), done.stdout, cpu


def undamped():
    # free-free and pinned Euler-Bernoulli beams; consistent elements converge as h^4 from above
    rows, damped, _, _ = modes("free_beam", st.beam(40, direction=(1, 2, 3)))
    if rows:
        wave = np.sqrt(E * 0.05**2 / 4 / RHO) / 10.0**2 / TWO_PI
        exact = np.repeat(np.array([4.73004074, 7.85320462, 10.9956078])**2 * wave, 2)
        expect("free beam: six rigid-body modes are zero", np.all(column(rows, "full")[:6] == 0))
        error = np.abs(column(rows, "full")[6:12] / exact - 1).max()
        expect("free beam: pairs of the closed form", error < 1e-4, f"{error:.1e}")
        expect(
            "free beam: six damped rigid-body modes",
            np.all(column(damped, "full")[:6] == 0)
            and np.abs(column(damped, "full")[6:12] / exact - 1).max() < 1e-4)
    beam = st.pinned_beam(100)
    rows, damped, text, cpu = modes("pinned_beam", beam, 10)
    if rows:
        exact = np.repeat(
            (np.pi * np.arange(1, 6))**2 * np.sqrt(E * 0.05**2 / 4 / RHO) / 10.0**2 / TWO_PI, 2)
        error = np.abs(column(rows, "full") / exact - 1).max()
        expect("pinned beam: pairs of the closed form", error < 1e-5, f"{error:.1e}")
        expect(
            "pinned beam: damped modes are the undamped ones",
            np.abs(column(damped, "full_im") / column(rows, "full") - 1).max() < 1e-9
            and np.all(column(damped, "full_damping") == 0))
        with h5py.File("pinned_beam_out/modes.h5") as file:
            shapes = file["modes/shape"][:]
        sizes = np.linalg.norm(shapes[:, :, :3], axis=2)
        waves = np.abs(
            np.sin(np.pi *
                   np.outer(np.repeat(np.arange(1, 6), 2), np.linspace(0, 1, shapes.shape[1]))))
        error = np.abs(sizes / sizes.max(axis=1)[:, None] -
                       waves / waves.max(axis=1)[:, None]).max()
        expect("pinned beam: shapes are sines", shapes.shape == (10, 101, 6) and error < 1e-5,
               f"{error:.1e}")
        expect("pinned beam: the largest displacement is 1",
               np.abs(np.abs(shapes[:, :, :3]).max(axis=(1, 2)) - 1).max() < 1e-12)
        found = json.loads(
            pathlib.Path("pinned_beam_out/summary.json").read_text(encoding="utf-8"))["modes"]
        expect(
            "pinned beam: frequencies of the summary", found["count"] == 10
            and found["growing"] == 0 and np.allclose([found["lowest_hz"], found["highest_hz"]],
                                                      [exact[0], exact[-1]], rtol=1e-5))
        expect("pinned beam: time", cpu < SECONDS, f"{cpu:.1f} s for {beam.M.shape[0]} dofs")
    for name, structure in (
        ("free_solid", st.solid(3, 3, 9, (0.3, 0.3, 2.0))),
        ("free_frame", st.frame(1, 4, fixed=False)),
        ("frame", st.frame(2, 7)),
    ):
        rows, damped, text, cpu = modes(name, structure, 16)
        if not rows:
            continue
        exact = np.sqrt(
            np.abs(
                eigh(structure.K.toarray(), structure.M.toarray(), eigvals_only=True,
                     subset_by_index=[0, 15]))) / TWO_PI
        zeros = int((exact < 1e-4 * exact[-1]).sum())
        expect(f"{name}: {zeros} rigid-body modes are zero",
               int((column(rows, "full") == 0).sum()) == zeros)
        error = np.abs(column(rows, "full")[zeros:] / exact[zeros:] - 1).max()
        expect(f"{name}: frequencies", error < 1e-7, f"{error:.1e}")
        expect(f"{name}: damped list",
               np.abs(column(damped, "full_im")[zeros:] / exact[zeros:] - 1).max() < 1e-7)
        expect(f"{name}: time", cpu < SECONDS, f"{cpu:.1f} s for {structure.M.shape[0]} dofs")


def damped():
    for name, structure in (
        ("pinned", st.pinned_beam(30)),
        ("frame", st.frame(2, 7)),
        ("solid", st.solid(3, 3, 12, (0.3, 0.3, 2.0)).held([
            (node, c) for node in range(1, 17) for c in (1, 2, 3)
        ])),
    ):
        first = np.sqrt(
            eigh(structure.K.toarray(), structure.M.toarray(), eigvals_only=True,
                 subset_by_index=[0, 0])[0])
        for kind, alpha, beta, tolerance in (
            ("light", 1e-3 * first, 1e-5 / first, 1e-8),
            ("proportional", 0.1 * first, 0.02 / first, 1e-8),
            ("overdamped", 5 * first, 0.0, 1e-8),
            ("critical", 2 * first, 0.0, 1e-4),
        ):
            structure.C = alpha * structure.M + beta * structure.K
            _, rows, _, cpu = modes(f"{name}_{kind}", structure, 12)
            if rows:
                exact = proportional(structure, alpha, beta, 40)
                # rounding makes each of the two lowest modes two real values or one complex one
                if kind == "critical":
                    exact = np.append(exact, [-first, -first])
                expect(f"{name}, {kind}: values", *same(values(rows), exact, tolerance))
                expect(
                    f"{name}, {kind}: the lowest ones",
                    abs(values(rows)[-1]) <=
                    abs(proportional(structure, alpha, beta, 14 if kind == "critical" else 12)[-1])
                    * (1 + 1e-6))  # double values may split in either way
                expect(f"{name}, {kind}: time", cpu < SECONDS,
                       f"{cpu:.1f} s for {structure.M.shape[0]} dofs")
    # 600 dofs with a range of four decades between the lowest frequency and the stiffest element
    structure = st.pinned_beam(100)
    structure.C = 0.01 * structure.M + 1e-5 * structure.K
    _, rows, _, cpu = modes("fine_beam", structure, 12)
    if rows:
        omega2 = np.repeat((np.pi * np.arange(1, 7) / 10)**4 * E * 0.05**2 / 4 / RHO, 2)
        exact = -(0.01 + 1e-5 * omega2) / 2 + 1j * np.sqrt(omega2 - (0.01 + 1e-5 * omega2)**2 / 4)
        expect("fine beam: values of the closed form", *same(values(rows), exact, 1e-5))
        expect("fine beam: time", cpu < SECONDS, f"{cpu:.1f} s for {structure.M.shape[0]} dofs")
    # dashpots at two nodes: not proportional
    structure = st.frame(1, 8)
    c = np.zeros(structure.M.shape[0])
    c[[0, 1, 50, 51, 52]] = 2e3
    structure.C = sparse.diags(c).tocsr()
    _, rows, _, _ = modes("dashpots", structure, 12)
    if rows:
        expect("dashpots: values of the companion form",
               *same(values(rows), companion(structure, 30), 1e-7))


def gyroscopic():
    # pinned spinning shaft: omega = sqrt((g/2m)^2 + omega_0^2) -+ g/2m, g/m = rho I_p Omega (k pi /
    # L)^2 / (rho A)
    radius, length = 0.4, 10.0
    for speed in (50.0, 5000.0):
        shaft = st.pinned_beam(100, radius=radius, speed=speed)
        _, rows, _, cpu = modes(f"shaft_{speed:.0f}", shaft, 8)
        if rows:
            k = np.pi * np.arange(1, 30) / length
            omega0 = k**2 * radius / 2 * np.sqrt(E / RHO)
            half = radius**2 / 2 * speed * k**2 / 2
            whirl = np.concatenate(
                [np.sqrt(half**2 + omega0**2) - half,
                 np.sqrt(half**2 + omega0**2) + half])
            axial = np.concatenate([
                np.pi * (np.arange(1, 20) - 0.5) / length * np.sqrt(E / RHO),
                np.pi * (np.arange(1, 20) - 0.5) / length * np.sqrt(E / 2.6 / RHO)
            ])
            exact = 1j * np.sort(np.concatenate([whirl, axial]))
            expect(f"shaft at {speed:.0f} rad/s: closed form", *same(values(rows), exact[:20],
                                                                     2e-3))
            expect(f"shaft at {speed:.0f} rad/s: nothing is damped",
                   np.abs(column(rows, "full_damping")).max() < 1e-10)
            expect(f"shaft at {speed:.0f} rad/s: time", cpu < SECONDS,
                   f"{cpu:.1f} s for {shaft.M.shape[0]} dofs")
    free = st.beam(30, radius=radius, speed=2000.0)
    _, rows, _, _ = modes("free_rotor", free, 14)
    if rows:
        exact = companion(free, 60)
        found = values(rows)
        floor = 1e-4 * np.abs(found).max()
        expect("free rotor: values of the companion form",
               *same(found[np.abs(found) > floor], exact[np.abs(exact) > floor], 1e-7))


def reduced():
    """Two halves of a free beam and of a tower: every coupled mode appears once, rigid-body modes
    are zero, no basis fails."""
    half = st.beam(20, length=5.0, direction=(1, 2, 3))
    half.write("half.h5", {"left": [1], "right": [21]})
    parts, joints = {"a": "half.h5", "b": "half.h5"}, ["a:right = b:left"]
    for basis in ("Craig-Bampton", "Rubin", "Craig-Chang", "MacNeal", "Dual Craig-Bampton",
                  "Dual Craig-Bampton+"):
        own = ('<ParameterList name="Dual Craig-Bampton"><Parameter name="Residual Mass" '
               'type="bool" value="true"/></ParameterList>')
        text = (f'<Parameter name="Basis" type="string" value="{basis.rstrip("+")}"/>'
                '<ParameterList name="Mode Selection"><Parameter name="Modes" type="int" '
                'value="14"/></ParameterList>' + (own if basis.endswith("+") else ""))
        name = "halves_" + basis.replace(" ", "_").replace("+", "_mass")
        rows, lists, output, _ = modes(name, None, 12, text, parts, joints)
        if not rows:
            continue
        for kind, table in (("undamped", rows), ("damped", lists)):
            partner = column(table, "coupled_mode")
            expect(f"{name}, {kind}: no coupled mode twice", len(set(partner)) == len(partner))
            expect(
                f"{name}, {kind}: rigid-body modes are zero",
                np.all(column(table, "full")[:6] == 0)
                and np.all(column(table, "coupled")[:6] == 0))
            expect(f"{name}, {kind}: subspaces agree",
                   column(table, "mac").min() > 0.99, f"{column(table, 'mac').min():.4f}")
            expect(f"{name}, {kind}: errors",
                   np.abs(column(table, "error")).max() < 0.02,
                   f"{np.abs(column(table, 'error')).max():.1e}")
        expect(f"{name}: nothing is called buckled", "buckled" not in output
               and "buckles" not in output)

    # the frame of xml/ with the mass of the residual flexibility: its spurious negative values are
    # not listed
    done = subprocess.run([
        PROGRAM, "modes",
        str(ROOT / "xml" / "frame.xml"), "--count", "8", "--without", "Parts/Starts", "--output",
        "frame_dual_out", "--set", "Reduction/Basis=Dual Craig-Bampton", "--set",
        "Reduction/Dual Craig-Bampton/Residual Mass=true"
    ], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, timeout=300)
    expect("frame, dual with residual mass: exit code 0", done.returncode == 0,
           "" if done.returncode == 0 else done.stdout[-300:])
    for file in ("modes.csv", "damped_modes.csv") if done.returncode == 0 else ():
        errors = [
            abs(float(row["error"]))
            for row in csv.DictReader(open(f"frame_dual_out/{file}", encoding="utf-8"))
        ]
        expect(f"frame, dual with residual mass, {file}: errors",
               len(errors) == 8 and max(errors) < 1e-5, f"{max(errors):.1e}")


def floating():
    """Multilevel on free bodies, one and two in a part: estimates against true errors; fields
    without a matching mode or an estimate are empty."""
    body, other = st.solid(2, 2, 6, (1, 1, 4.0)), st.solid(2, 2, 4, (1, 1, 3.0))
    labels = np.vstack([body.labels, other.labels + [body.labels[:, 0].max(), 0]])
    both = st.Structure(sparse.block_diag([body.M, other.M]), sparse.block_diag([body.K, other.K]),
                        nodes=labels, components=3)
    multilevel = ('<Parameter name="Basis" type="string" value="Multilevel"/><ParameterList '
                  'name="Multilevel"><Parameter name="Parts" type="int" value="4"/><Parameter '
                  'name="Accuracy" type="double" value="1e9"/></ParameterList><ParameterList '
                  'name="Mode Selection"><Parameter name="Modes" type="int" value="24"/>'
                  '</ParameterList>')
    for name, structure, bodies in (("one_body", body, 1), ("two_bodies", both, 2)):
        rows, _, text, _ = modes(name, structure, 30, multilevel)
        if not rows:
            continue
        zeros = 6 * bodies
        found = [row for row in rows[zeros:] if row["coupled_mode"] > 0][:10]
        errors, estimates = column(found, "error"), column(found, "estimate")
        expect(f"{name}: {zeros} rigid-body modes",
               np.all(column(rows, "coupled")[:zeros] == 0) and errors.min() > -1e-9)
        real = errors > 1e-7
        expect(
            f"{name}: estimates within 3 of the errors",
            real.sum() > 3 and np.all(estimates[real] < 3 * errors[real])
            and np.all(estimates[real] > errors[real] / 3) and np.all(estimates[~real] < 1e-6),
            f"{errors}, {estimates}")
        alone = [row for row in rows if np.isnan(row["coupled_mode"])]
        expect(
            f"{name}: no numbers of coupled modes that are none",
            len(alone) >= 30 - 24 - bodies and all(
                np.isnan(row[key]) for row in alone
                for key in ("coupled", "coupled_im", "coupled_damping", "mac", "error", "estimate",
                            "definite")), text[:1500])
    macneal = ('<Parameter name="Basis" type="string" value="MacNeal"/><ParameterList name="Mode '
               'Selection"><Parameter name="Modes" type="int" value="14"/></ParameterList>')
    rows, _, _, _ = modes("macneal", body, 14, macneal)
    done = tooljoint("modes", "macneal.xml", "--coupled", "--count", "14", "--output",
                     "macneal_coupled")
    expect("a basis without estimates: coupled modes are listed", done.returncode == 0, done.stderr)
    if rows and done.returncode == 0:
        with open("macneal_coupled/modes.csv", encoding="utf-8") as file:
            listed = list(csv.DictReader(file))
        expect(
            "a basis without estimates: the same frequencies, no estimates",
            np.allclose([float(row["coupled [Hz]"]) for row in listed][6:],
                        column(rows, "coupled")[6:], rtol=1e-6)
            and all(row["estimate"] == "" for row in listed), str(listed[:8]))
    loose = st.beam(6, length=5.0)
    K = loose.K.tolil()
    K[20, :] = K[:, 20] = 0  # w of node 4
    st.Structure(loose.M, K, nodes=loose.labels).write("loose.h5", {"left": [1], "right": [7]})
    st.deck(
        "loose.xml", {"a": "loose.h5", "b": "loose.h5"}, ["a:right = b:left"],
        '<ParameterList name="Mode Selection"><Parameter name="Modes" type="int" value="2"/>'
        '</ParameterList>')
    done = tooljoint("modes", "loose.xml")
    expect("a loose dof of joined parts has the number of its file", done.returncode == 3
           and 'w of node 4 of part "a"' in done.stderr, done.stderr)
    massless = loose.M.tolil()
    massless[20, :] = massless[:, 20] = 0
    st.Structure(massless, loose.K, C=1e-3 * loose.K,
                 nodes=loose.labels).write("loose.h5", {"left": [1], "right": [7]})
    st.deck(
        "massless.xml", {"a": "loose.h5", "b": "loose.h5"}, ["a:right = b:left"],
        '<Parameter name="Basis" type="string" value="Complex Craig-Bampton"/><ParameterList '
        'name="Mode Selection"><Parameter name="Modes" type="int" value="2"/></ParameterList>')
    done = tooljoint("modes", "massless.xml")
    expect("Complex Craig-Bampton names the dof without mass", done.returncode == 3
           and 'singular, least at w of node 4 of part "a"' in done.stderr, done.stderr)
    done = tooljoint("modes", "one_body.xml", "--without", "Reduction", "--count", "100000")
    expect("all modes are listed, and that it takes long is not said of few", done.returncode == 0
           and "take long" not in done.stdout, done.stderr)
    done = tooljoint("modes", "two_bodies.xml", "--without", "Reduction", "--count", "100000")
    expect("that many modes take long is said", done.returncode == 0
           and "324 of 324 dofs are computed" in done.stdout, done.stdout[:600] + done.stderr)


WELL = """<ParameterList name="well">
  <ParameterList name="Well">
    <Parameter name="Trajectory" type="string" value="Arc"/>
    <ParameterList name="Arc">
      <Parameter name="Kick-off Depth" type="double" value="60"/>
      <Parameter name="Radius" type="double" value="150"/>
      <Parameter name="End Inclination" type="string" value="60 deg"/>
      <Parameter name="Tangent Length" type="double" value="200"/>
    </ParameterList>
    <Parameter name="Bore Radius" type="double" value="0.108"/>
  </ParameterList>
  <ParameterList name="Drillstring"><ParameterList name="Components">
    <ParameterList name="body"><Parameter name="Length" type="double" value="9"/>
    <Parameter name="Elements" type="int" value="2"/>
      <Parameter name="Outer Radius" type="double" value="0.0635"/>
      <Parameter name="Inner Radius" type="double" value="0.0543"/></ParameterList>
    <ParameterList name="joint"><Parameter name="Length" type="double" value="0.5"/>
    <Parameter name="Elements" type="int" value="1"/>
      <Parameter name="Outer Radius" type="double" value="0.084"/>
      <Parameter name="Inner Radius" type="double" value="0.0413"/></ParameterList>
    <ParameterList name="stand">
    <Parameter name="Parts" type="Array(string)" value="{body, joint}"/></ParameterList>
    </ParameterList>
    <Parameter name="Assembly" type="Array(string)" value="{40*stand}"/>
  </ParameterList>
  <ParameterList name="Contact">
    <Parameter name="Stiffness" type="double" value="1e7"/>
    <Parameter name="Damping" type="double" value="1e4"/>
    <ParameterList name="Friction"><Parameter name="Static" type="double" value="0.25"/>
    <Parameter name="Dynamic" type="double" value="0.25"/></ParameterList>
  </ParameterList>
  <ParameterList name="Loads">
    <Parameter name="Gravity" type="double" value="9.81"/>
    <Parameter name="Weight On Bit" type="string" value="10 kN"/>
    <Parameter name="Torque On Bit" type="string" value="1 kN m"/>
  </ParameterList>
  <ParameterList name="Rotary Speed"><Parameter name="Law" type="string" value="Constant"/>
    <ParameterList name="Constant">
    <Parameter name="Speed" type="string" value="120 rpm"/></ParameterList></ParameterList>
</ParameterList>
"""


def sliding_string():
    """A rotating string on the wall with friction: the symmetric part without friction has no
    negative value."""
    pathlib.Path("well.xml").write_text(WELL, encoding="utf-8")
    done = subprocess.run([PROGRAM, "modes", "well.xml", "--count", "12", "--output", "well_out"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                          timeout=600)
    expect("sliding string: exit code 0", done.returncode == 0,
           "" if done.returncode == 0 else done.stdout[-600:])
    if done.returncode == 0:
        found = [
            float(row["full [Hz]"])
            for row in csv.DictReader(open("well_out/modes.csv", encoding="utf-8"))
        ]
        expect("sliding string: undamped modes are positive",
               min(found) > 0, f"{min(found):.4g} Hz")
        expect("sliding string: they say that friction is left out", "friction left out"
               in done.stdout)
        expect("sliding string: stability is judged by the damped modes", "damped modes listed"
               in done.stdout)


BLOCKS = """<ParameterList name="blocks"><ParameterList name="Parts"><ParameterList name="Imported">
  <ParameterList name="short"><Parameter name="File" type="string" value="short.h5"/>
    <Parameter name="Fixed" type="Array(string)" value="{root}"/>
    <Parameter name="Retained" type="Array(string)" value="{tip}"/></ParameterList>
  <ParameterList name="long"><Parameter name="File" type="string" value="long.h5"/>
    <Parameter name="Fixed" type="Array(string)" value="{root}"/>
    <Parameter name="Retained" type="Array(string)" value="{tip}"/></ParameterList>
</ParameterList></ParameterList>
<ParameterList name="Coupling">
  <Parameter name="Node Numbers" type="string" value="Own"/></ParameterList>
<ParameterList name="Reduction"><ParameterList name="Mode Selection">
  <Parameter name="Modes" type="int" value="12"/></ParameterList></ParameterList></ParameterList>
"""


def clamped_frequencies(path, count):
    """The lowest frequencies [Hz] of a part file with the set `root` held, and rows and entries of
    its stiffness."""
    with h5py.File(path, "r") as file:
        n = len(file["dofs"])
        K, M = (sparse.csr_matrix((file[name]["value"], (file[name]["row"], file[name]["column"])),
                                  shape=(n, n)) for name in ("stiffness", "mass"))
        free = np.flatnonzero(~np.isin(file["dofs"][:, 0], file["interfaces/root"]))
    K, M = K[free][:, free].tocsc(), M[free][:, free].tocsc()
    return np.sqrt(eigsh(K, count, M, sigma=0)[0]) / TWO_PI, len(free), K.nnz


def solids_on_two_ranks():
    """Two solid parts factored by MUMPS, one on each rank: frequencies against scipy and against
    one rank."""
    block = ROOT / "examples" / "12_solid_block" / "make_block.py"
    exact = []
    for name, counts, length in (
        ("short", ("24", "6", "3"), "0.8"),
        ("long", ("26", "6", "3"), "0.9"),
    ):
        subprocess.run([
            sys.executable, block, *counts, "--size", length, "0.2", "0.1", "--joined", "6",
            "--out", f"{name}.h5"
        ], check=True)
        hertz, rows, entries = clamped_frequencies(f"{name}.h5", 6)
        expect(f"{name} block: large and filling", rows >= 2000 and entries > 18 * rows,
               f"{rows} rows, {entries} entries")
        exact += list(hertz)
    exact = np.sort(exact)[:6]
    pathlib.Path("blocks.xml").write_text(BLOCKS, encoding="utf-8")
    tables = {}
    for ranks in (1, 2):
        done = tooljoint("modes", "blocks.xml", "--count", "6", "--output", f"blocks_{ranks}",
                         ranks=ranks)
        expect(f"blocks on {ranks} ranks: exit code 0", done.returncode == 0, done.stderr[-600:])
        if done.returncode != 0:
            return
        with open(f"blocks_{ranks}/modes.csv", encoding="utf-8") as file:
            tables[ranks] = np.array([[float(row["full [Hz]"]),
                                       float(row["coupled [Hz]"])] for row in csv.DictReader(file)])
    expect("blocks: full frequencies are those of scipy",
           np.allclose(tables[2][:, 0], exact, rtol=1e-7, atol=0), f"{tables[2][:, 0]}, {exact}")
    above = tables[2][:, 1] / exact - 1
    expect("blocks: reduced frequencies lie above, by 1e-3 at most",
           above.min() > -1e-9 and above.max() < 1e-3, f"{above}")
    expect("blocks: two ranks give the numbers of one",
           np.allclose(tables[1], tables[2], rtol=1e-9, atol=0),
           f"{np.abs(tables[1] / tables[2] - 1).max():.1e}")


undamped()
damped()
floating()
solids_on_two_ranks()
sliding_string()
gyroscopic()
reduced()
sys.exit(finish())
