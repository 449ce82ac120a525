# SPDX-License-Identifier: BSD-3-Clause
"""`tooljoint paraview` of a string and of parts: a strict reader, and VTK if it is installed, read
the numbers of results.h5 from its files.

    check_paraview.py PROGRAM
"""
import base64
import os
import pathlib
import shutil
import sys
import xml.etree.ElementTree as ET

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from checks import expect, finish, tooljoint  # noqa: E402

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    vtk = None

TYPES = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8"}
SINGLE = 1e-6  # relative, of numbers of four bytes


def array(element):
    """Values of a DataArray; its header must state the number of bytes after it."""
    data = base64.b64decode(element.text, validate=True)
    length = int(np.frombuffer(data[:8], "<u8")[0])
    if length != len(data) - 8 or element.get("format") != "binary":
        raise ValueError(f"{element.get('Name')}: {length} bytes announced, {len(data) - 8} found")
    values = np.frombuffer(data[8:], TYPES[element.get("type")])
    return values.reshape(-1, int(
        element.get("NumberOfComponents"))) if element.get("NumberOfComponents") else values


def read(path):
    """{group: {name: values}} of a .vtp file, according to the format."""
    root = ET.parse(path).getroot()
    wanted = {
        "type": "PolyData", "byte_order": "LittleEndian", "header_type": "UInt64", "version": "1.0"
    }
    if root.tag != "VTKFile" or dict(root.attrib) != wanted:
        raise ValueError(f"{path}: {root.tag} {root.attrib}")
    piece = root.find("PolyData/Piece")
    found = {
        group.tag: {each.get("Name"): array(each) for each in group
                    } for group in [*piece, *root.findall("PolyData/FieldData")]
    }
    count = int(piece.get("NumberOfPoints"))
    if len(found["Points"]["Points"]) != count or any(
            len(values) != count for values in found["PointData"].values()):
        raise ValueError(f"{path}: not all fields have {count} points")
    cells = 0
    for kind in ("Verts", "Lines", "Polys"):
        number = int(piece.get(f"NumberOf{kind}"))
        cells += number
        if number and (len(found[kind]["offsets"]) != number
                       or found[kind]["offsets"][-1] != len(found[kind]["connectivity"])
                       or found[kind]["connectivity"].max() >= count):
            raise ValueError(f"{path}: offsets of {kind} do not fit")
    if any(len(values) != cells for values in found["CellData"].values()):
        raise ValueError(f"{path}: not all fields have {cells} cells")
    return found


def by_vtk(path):
    """The same from VTK's own reader."""
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    shown = reader.GetOutput()
    arrays = {
        data.GetArray(i).GetName(): vtk_to_numpy(data.GetArray(i))
        for data in (shown.GetPointData(), shown.GetCellData())
        for i in range(data.GetNumberOfArrays())
    }
    return vtk_to_numpy(shown.GetPoints().GetData()), arrays


def near(what, found, wanted, bound=SINGLE):
    found, wanted = np.asarray(found, float), np.asarray(wanted, float)
    scale = np.abs(wanted).max() or 1.0
    error = np.abs(found - wanted).max() / scale if found.shape == wanted.shape else np.inf
    expect(what, error <= bound, f"({error:.1e}, shapes {found.shape} and {wanted.shape})")


def pictures(folder, name):
    """(time, content) of every picture a .pvd names."""
    root = ET.parse(folder / f"{name}.pvd").getroot()
    rows = root.findall("Collection/DataSet")
    found = [(float(row.get("timestep")), read(folder / row.get("file"))) for row in rows]
    expect(f"{name}: the collection names all files",
           {row.get("file") for row in rows
            } == {path.name for path in folder.glob(f"{name}_*.vtp")})
    if vtk:
        for row, (_, own) in zip(rows, found):
            points, arrays = by_vtk(folder / row.get("file"))
            same = np.array_equal(points, own["Points"]["Points"]) and all(
                np.array_equal(arrays[field], values) for group in ("PointData", "CellData")
                for field, values in own[group].items())
            if not same:
                expect(f"{row.get('file')}: VTK reads the same numbers", False)
        expect(f"{name}: read by VTK {vtk.vtkVersion.GetVTKVersion()}", True)
    return found


def run(deck, folder, *settings):
    done = tooljoint("run", str(deck), "--output", folder,
                     *(word for setting in settings for word in ("--set", setting)))
    expect(f"{folder}: runs", done.returncode == 0, done.stderr[-300:])
    return pathlib.Path(folder)


def check_string():
    folder = run(ROOT / "tests/effects/scene.xml", "string", "Transient/End Time=0.1",
                 "Output/Report=false")
    done = tooljoint("paraview", str(folder), "--magnify", "50", "--pictures", "6")
    expect(
        "string: written", done.returncode == 0 and "string.pvd: 6 pictures" in done.stdout
        and "wall.vtp" in done.stdout, done.stdout + done.stderr)
    shown = pictures(folder / "paraview", "string")
    with h5py.File(folder / "results.h5") as file:
        data = {
            name: file[name][()]
            for name in ("/path/position", "/model/frame", "/model/clearance",
                         "/model/contact_radius", "/model/s", "/static/axial_force",
                         "/static/torque", "/transient/time", "/transient/displacement",
                         "/transient/velocity", "/transient/normal_force", "/transient/speed")
        }
    times = data["/transient/time"]
    expect("string: first and last sample are shown",
           len(shown) == 6 and shown[0][0] == times[0] and shown[-1][0] == times[-1],
           [time for time, _ in shown])
    nodes = len(data["/model/s"])
    for time, own in (shown[0], shown[-1]):
        sample = int(np.abs(times - time).argmin())
        moved = np.einsum("nij,nj->ni", data["/model/frame"],
                          data["/transient/displacement"][sample][:, :3])
        near(f"t = {time:g} s: points are magnified", own["Points"]["Points"],
             data["/path/position"] + 50 * moved, 1e-12)
        near("displacements are true", own["PointData"]["displacement [m]"], moved)
        near(
            "velocities", own["PointData"]["velocity [m/s]"],
            np.einsum("nij,nj->ni", data["/model/frame"],
                      data["/transient/velocity"][sample][:, :3]))
        near("spin", own["PointData"]["spin [rad/s]"],
             data["/transient/speed"][sample] + data["/transient/velocity"][sample][:, 5])
        near("contact forces", own["PointData"]["contact_force [N]"],
             data["/transient/normal_force"][sample])
        near("measured depth", own["PointData"]["measured_depth [m]"], data["/model/s"])
        near("time and magnification stand in the file",
             [own["FieldData"]["TimeValue"][0], own["FieldData"]["magnification"][0]], [time, 50],
             0)
    first = shown[0][1]
    near("axial force of the start is that of the static state",
         first["CellData"]["axial_force [N]"], data["/static/axial_force"], 1e-5)
    near("torque of the start, too", first["CellData"]["torque [N m]"], data["/static/torque"],
         1e-5)
    stress = shown[-1][1]["CellData"]["von_mises_stress [Pa]"]
    expect("stresses are there",
           len(stress) == nodes - 1 and (stress > 0).any() and np.isfinite(stress).all())
    expect(
        "cells join neighbours", first["Lines"]["connectivity"].tolist() == [
            n for i in range(nodes - 1) for n in (i, i + 1)
        ])
    wall = read(folder / "paraview/wall.vtp")
    ring = wall["Points"]["Points"].reshape(nodes, -1, 3)
    radius = np.linalg.norm(ring - data["/path/position"][:, None], axis=2)
    near(
        "the wall stands at the magnified clearance", radius,
        np.repeat((data["/model/contact_radius"] + 50 * data["/model/clearance"])[:, None],
                  ring.shape[1], 1), 1e-9)
    expect("the wall is closed",
           wall["Polys"]["connectivity"].size == 4 * (nodes - 1) * ring.shape[1])
    if vtk:
        expect("the wall: read by VTK",
               np.array_equal(by_vtk(folder / "paraview/wall.vtp")[0], wall["Points"]["Points"]))
    again = tooljoint("paraview", str(folder), "--pictures", "2", "-o", str(folder / "paraview"))
    expect("fewer pictures leave none of before", again.returncode == 0
           and len(list((folder / "paraview").glob("string_*.vtp"))) == 2)


def check_static():
    folder = pathlib.Path("static")
    done = tooljoint("run", str(ROOT / "tests/effects/scene.xml"), "--without", "Transient",
                     "--set", "Output/Report=false", "--output", str(folder))
    expect("static: runs", done.returncode == 0, done.stderr[-300:])
    done = tooljoint("paraview", str(folder), "--output", "shown")
    expect("static: one picture", done.returncode == 0 and "string.pvd: 1 picture," in done.stdout,
           done.stdout + done.stderr)
    own = pictures(pathlib.Path("shown"), "string")[0][1]
    with h5py.File(folder / "results.h5") as file:
        near("static: contact forces", own["PointData"]["contact_force [N]"],
             file["/static/normal_force"][:])


def check_parts():
    folder = run(ROOT / "xml/frame.xml", "parts", "Transient/End Time=0.02", "Output/Report=false")
    done = tooljoint("paraview", str(folder), "--magnify", "10")
    expect("parts: written, with a magnification to try", done.returncode == 0
           and "--magnify" in done.stdout, done.stdout + done.stderr)
    shown = pictures(folder / "paraview", "parts")
    with h5py.File(folder / "results.h5") as file:
        rows, position, motion = file["/model/located"][:] - 1, file["/model/position"][:], file[
            "/transient/displacement"][:]
        near("parts: points are magnified", shown[-1][1]["Points"]["Points"],
             position + 10 * motion[-1][rows][:, :3], 1e-12)
        expect(
            "parts: each node once, in lines or alone",
            set(shown[0][1]["Lines"]["connectivity"])
            | set(shown[0][1].get("Verts", {}).get("connectivity", [])) == set(range(len(rows))))


def check_faults():
    shutil.rmtree("damaged", ignore_errors=True)
    for what, words, code, said in (
        ("no results", ["nowhere"], 5, "holds no results.h5"),
        ("no factor", ["string", "--magnify", "0"], 1, "--magnify"),
        ("no pictures", ["string", "--pictures", "0"], 1, "--pictures"),
        ("a folder that cannot be", ["string", "-o",
                                     "string/results.h5/x"], 5, "cannot be written"),
    ):
        done = tooljoint("paraview", *words)
        expect(f"{what}: exit code {code} and a sentence", done.returncode == code
               and said in done.stderr, f"{done.returncode} {done.stderr}")
    shutil.copytree("static", "damaged")
    results = pathlib.Path("damaged/results.h5")
    whole = results.read_bytes()
    for what, content in (
        ("half a file", whole[:len(whole) // 2]),
        ("a file with a hole",
         whole[:len(whole) // 3] + bytes(len(whole) // 3) + whole[-(len(whole) // 3):]),
    ):
        results.write_bytes(content)
        done = tooljoint("paraview", "damaged")
        expect(
            f"{what}: cannot be read", done.returncode == 5
            and "damaged/results.h5 cannot be read: it is damaged" in done.stderr
            and "Error" not in done.stderr, f"{done.returncode} {done.stderr}")
    results.write_bytes(whole)
    if os.geteuid() > 0:  # root can read every file
        results.chmod(0)
        done = tooljoint("paraview", "damaged")
        expect(
            "a file without permission: cannot be read", done.returncode == 5
            and "damaged/results.h5 cannot be read: Permission denied" in done.stderr,
            f"{done.returncode} {done.stderr}")
        results.chmod(0o600)
    part = pathlib.Path("damaged/paraview/string_0000.vtp.part")
    part.parent.mkdir(exist_ok=True)
    part.symlink_to("/dev/full")
    done = tooljoint("paraview", "damaged")
    expect(
        "a full disk: a sentence, and nothing is left", done.returncode == 5
        and "cannot be written: the disk is full" in done.stderr and not part.is_symlink(),
        f"{done.returncode} {done.stderr}")


check_string()
check_static()
check_parts()
check_faults()
sys.exit(finish())
