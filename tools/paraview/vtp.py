# SPDX-License-Identifier: BSD-3-Clause
"""Polydata in VTK's XML format (VTK User's Guide, 11th edition, section 19.3): arrays are base64
with a header of their length."""
import base64
import xml.sax.saxutils

import numpy as np

TYPES = {"f8": "Float64", "f4": "Float32", "i8": "Int64"}
HEADER = ('<?xml version="1.0"?>\n<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" '
          'header_type="UInt64">\n')


def attribute(text):
    return xml.sax.saxutils.quoteattr(str(text))


def array(name, values, kind, components=()):
    """<DataArray> of n values or of n x k; `components` are the names of the k."""
    values = np.ascontiguousarray(values, "<" + kind)
    data = np.array([values.nbytes], "<u8").tobytes() + values.tobytes()
    names = "".join(f" ComponentName{i}={attribute(each)}" for i, each in enumerate(components))
    size = f' NumberOfComponents="{values.shape[1]}"' if values.ndim == 2 else ""
    return (f'<DataArray type="{TYPES[kind]}" Name={attribute(name)}{size}{names} '
            f'format="binary">{base64.b64encode(data).decode()}</DataArray>\n')


def cells(name, corners):
    """<Lines>, <Polys> or <Verts> of m cells of equally many points (m x k, counted from 0)."""
    corners = np.asarray(corners, int)
    offsets = corners.shape[1] * np.arange(1, len(corners) + 1)
    return f"<{name}>\n" + array("connectivity", corners.ravel(), "i8") + array(
        "offsets", offsets, "i8") + f"</{name}>\n"


def data(name, fields, components):
    return f"<{name}>\n" + "".join(
        array(each, values, "f4", components if np.ndim(values) == 2 else ())
        for each, values in fields.items()) + f"</{name}>\n"


def polydata(points, kinds, axes, point_fields=None, cell_fields=None, field_data=None):
    """The text of a .vtp file.
    `points` n x 3; `kinds`: "Verts", "Lines", "Polys" -> corners of the cells, in this order;
    fields: name -> n values or n x 3, with the names of `axes`; `field_data`: name -> number."""
    numbers = {name: len(kinds.get(name, ())) for name in ("Verts", "Lines", "Polys")}
    text = HEADER.format(kind="PolyData") + "<PolyData>\n"
    if field_data:
        text += "<FieldData>\n" + "".join(
            array(name, [value], "f8").replace("<DataArray ", '<DataArray NumberOfTuples="1" ')
            for name, value in field_data.items()) + "</FieldData>\n"
    text += f'<Piece NumberOfPoints="{len(points)}" ' + " ".join(
        f'NumberOf{name}="{count}"' for name, count in numbers.items()) + ' NumberOfStrips="0">\n'
    text += data("PointData", point_fields or {}, axes) + data("CellData", cell_fields or {}, axes)
    text += "<Points>\n" + array("Points", points, "f8", axes) + "</Points>\n"
    return text + "".join(cells(name, kinds[name]) for name in numbers
                          if numbers[name]) + "</Piece>\n</PolyData>\n</VTKFile>\n"


def collection(files):
    """The text of a .pvd file: (time [s], name of a file beside it) of all pictures."""
    rows = "".join(f'<DataSet timestep="{time:.17g}" part="0" file={attribute(name)}/>\n'
                   for time, name in files)
    return HEADER.format(
        kind="Collection") + "<Collection>\n" + rows + "</Collection>\n</VTKFile>\n"
