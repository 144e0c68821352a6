#!/usr/bin/env python3
"""Opens what `meltpoint sample` writes with the programs that it is written for: Gmsh and VTK, which ParaView reads with.

    readers.py MELTPOINT_PROGRAM     exit 1 and a message where a reader sees something else than was written
"""

import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import vtk

COUNT = 1234


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{' '.join(map(str, command))}: {done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def points_of_ply(path):
    """The positions and normals of the PLY file: six floats first in each row of 36 bytes."""
    body = path.read_bytes().split(b"end_header\n", 1)[1]
    return [struct.unpack_from("<6f", body, row * 36) for row in range(len(body) // 36)]


def check_vtk(path, expected):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append("error"))
    reader.Update()
    cloud = reader.GetOutput()
    assert not errors, "VTK reports errors"
    assert cloud.GetNumberOfPoints() == COUNT and cloud.GetNumberOfVerts() == COUNT, "wrong number of points or cells"
    data = cloud.GetPointData()
    normals = data.GetNormals()
    assert normals is not None and normals.GetNumberOfTuples() == COUNT, "the normals are not seen as normals"
    assert data.GetArray("triangle").GetNumberOfTuples() == COUNT
    assert data.GetArray("barycentric").GetNumberOfComponents() == 2
    for i, row in enumerate(expected):
        assert cloud.GetPoint(i) == row[:3] and normals.GetTuple3(i) == row[3:], f"point {i} differs"
        assert cloud.GetCell(i).GetPointId(0) == i


def check_gmsh(path, expected):
    # Gmsh saves the view of the normals as a text: VP(x,y,z){nx,ny,nz};
    script = path.with_suffix(".geo")
    saved = path.with_suffix(".pos")
    script.write_text(f'Merge "{path}";\nPrintf("%g nodes, %g views", Mesh.NbNodes, PostProcessing.NbViews);\n'
                      f'Save View[0] "{saved}";\n')
    text = run("gmsh", script, "-", "-v", "4")
    assert "Error" not in text and f"{COUNT} nodes, 1 views" in text, text
    view = saved.read_text()
    assert view.startswith('View "normals"'), view[:100]
    lines = re.findall(r"VP\((.*)\)\{(.*)\};", view)
    vectors = [tuple(map(float, f"{place},{normal}".split(","))) for place, normal in lines]
    assert len(vectors) == COUNT, f"{len(vectors)} vectors in the view"
    for i, (vector, row) in enumerate(zip(vectors, expected)):
        assert all(abs(a - b) < 1e-12 for a, b in zip(vector, row)), f"vector {i} differs: {vector}, {row}"


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        files = {ending: Path(folder) / f"points.{ending}" for ending in ("ply", "vtp", "msh")}
        for path in files.values():
            run(program, "sample", "builtin:torus", "-o", path, "--count", str(COUNT))
        expected = points_of_ply(files["ply"])
        assert len(expected) == COUNT
        check_vtk(files["vtp"], expected)
        check_gmsh(files["msh"], expected)
    print(f"VTK {vtk.vtkVersion.GetVTKVersion()} and Gmsh {run('gmsh', '--version').strip()} read {COUNT} points and normals")


if __name__ == "__main__":
    main(sys.argv[1])
