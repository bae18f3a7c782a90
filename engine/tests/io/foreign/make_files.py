#!/usr/bin/python3
"""Makes the files of this folder by programs that are not ccdt.

    engine/tests/io/foreign/make_files.py     with Debian's gmsh, python3-meshio and python3-vtk9

Most of them have the same mesh: two tetrahedra of the regions 7 and -8, two faces with the markers 5 and 6, and an edge
with the marker 3. The files of Gmsh have the mesh that Gmsh makes from corner.geo, or the surface that it makes from
named.geo. surface.vtp and surface.vtu have a pyramid: four triangles with the marker 4, and a square with the marker 9
that is two triangles in surface.vtu. surface.stl.gz is the pyramid by VTK, compressed by gzip.
"""
import gzip
import os
import subprocess

import meshio
import numpy
import vtk

os.chdir(os.path.dirname(os.path.abspath(__file__)))

points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1 / 3, 1.1, 1.2]]
cells = [("tetra", [[0, 1, 2, 3], [1, 2, 3, 4]]), ("triangle", [[0, 2, 1], [1, 2, 4]]), ("line", [[0, 1]])]
attributes = [[7, -8], [5, 6], [3]]


def write_medit():
    blocks = [(kind, numpy.array(corners)) for kind, corners in cells]
    references = {"medit:ref": [numpy.array(values) for values in attributes]}
    meshio.write("meshio.meshb", meshio.Mesh(numpy.array(points, dtype=float), blocks, cell_data=references))


def write_vtk():
    grid = vtk.vtkUnstructuredGrid()
    vertices = vtk.vtkPoints()
    vertices.SetDataTypeToDouble()
    for point in points:
        vertices.InsertNextPoint(point)
    grid.SetPoints(vertices)
    types = {"tetra": vtk.VTK_TETRA, "triangle": vtk.VTK_TRIANGLE, "line": vtk.VTK_LINE}
    region, marker = vtk.vtkIntArray(), vtk.vtkIntArray()
    region.SetName("region")
    marker.SetName("marker")
    for (kind, members), values in zip(cells, attributes):
        for corners, value in zip(members, values):
            grid.InsertNextCell(types[kind], len(corners), corners)
            region.InsertNextValue(value if kind == "tetra" else 0)
            marker.InsertNextValue(0 if kind == "tetra" else value)
    grid.GetCellData().AddArray(region)
    grid.GetCellData().AddArray(marker)
    for kind in ["ascii", "inline", "inline-zlib", "inline-zlib-big-64", "raw-zlib", "raw-big-64", "base64-zlib-64",
                 "base64-big"]:
        parts = kind.split("-")
        mode, compressed, big, wide = parts[0], "zlib" in parts, "big" in parts, "64" in parts
        writer = vtk.vtkXMLUnstructuredGridWriter()
        writer.SetFileName(f"vtk-{kind}.vtu")
        writer.SetInputData(grid)
        writer.SetDataMode({"ascii": writer.Ascii, "inline": writer.Binary}.get(mode, writer.Appended))
        writer.SetEncodeAppendedData(mode == "base64")
        if compressed:
            writer.SetCompressorTypeToZLib()
            writer.SetBlockSize(32)  # bytes: an array has several blocks, and the last one is not full
        else:
            writer.SetCompressorTypeToNone()
        writer.SetByteOrderToBigEndian() if big else writer.SetByteOrderToLittleEndian()
        writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
        assert writer.Write()


def write_surfaces():
    corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1 / 3]]
    sides = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    faces, markers = numpy.array([*sides, [0, 2, 1], [0, 3, 2]]), [4, 4, 4, 4, 9, 9]
    meshio.write("surface.vtu", meshio.Mesh(numpy.array(corners), [("triangle", faces)],
                                            cell_data={"marker": [numpy.array(markers)]}))
    surface, points, cells, marker = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkIntArray()
    points.SetDataTypeToDouble()
    for corner in corners:
        points.InsertNextPoint(corner)
    marker.SetName("marker")
    for polygon, value in [*((side, 4) for side in sides), ([3, 2, 1, 0], 9)]:
        cells.InsertNextCell(len(polygon), polygon)
        marker.InsertNextValue(value)
    surface.SetPoints(points)
    surface.SetPolys(cells)
    surface.GetCellData().AddArray(marker)
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetFileName("surface.vtp")
    writer.SetInputData(surface)
    assert writer.Write()
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputData(surface)
    stl = vtk.vtkSTLWriter()
    stl.SetFileName("surface.stl")
    stl.SetInputConnection(triangles.GetOutputPort())
    assert stl.Write()
    with open("surface.stl", "rb") as plain, gzip.GzipFile("surface.stl.gz", "wb", mtime=0) as packed:
        packed.write(plain.read())
    os.remove("surface.stl")


def write_gmsh():
    for version in ["msh22", "msh41"]:
        for binary in [False, True]:
            name = f"gmsh-{version}-{'binary' if binary else 'text'}.msh"
            for dimension, model, file in [("-3", "corner.geo", name), ("-2", "named.geo", "named-" + name)]:
                command = ["gmsh", dimension, model, "-format", version, "-o", file] + ["-bin"] * binary
                subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


write_medit()
write_vtk()
write_surfaces()
write_gmsh()
