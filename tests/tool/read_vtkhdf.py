"""Reads a .hdf file with VTK and prints what it found as JSON."""
import json
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

reader = vtkHDFReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()


def arrays(data):
    return {
        data.GetArrayName(k): [None if v != v else v for v in vtk_to_numpy(data.GetArray(k)).ravel().tolist()]
        for k in range(data.GetNumberOfArrays())
    }


cells = []
for k in range(grid.GetNumberOfCells()):
    ids = grid.GetCell(k).GetPointIds()
    cells.append([ids.GetId(p) for p in range(ids.GetNumberOfIds())])
json.dump(
    {
        "points": vtk_to_numpy(grid.GetPoints().GetData()).ravel().tolist(),
        "types": [grid.GetCellType(k) for k in range(grid.GetNumberOfCells())],
        "cells": cells,
        "point_data": arrays(grid.GetPointData()),
        "cell_data": arrays(grid.GetCellData()),
    },
    sys.stdout,
)
