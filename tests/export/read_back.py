# Reads an exported run back with h5py and VTK: python3 read_back.py FOLDER STEM. Ends with 0 if all files say the same, 77 without them.
import os
import sys
import xml.etree.ElementTree as ElementTree

try:
    import h5py
    import numpy
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(missing)
    sys.exit(77)

folder, stem = sys.argv[1:3]
file = os.path.join(folder, stem)


def grid(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def cells(grid, name):
    return vtk_to_numpy(grid.GetCellData().GetArray(name))


def volume(grid):
    total, at = 0.0, vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    for c in range(grid.GetNumberOfCells()):
        ids = [grid.GetCell(c).GetPointId(i) for i in range(grid.GetCell(c).GetNumberOfPoints())]
        for i in range(1, len(ids) - 1):
            total += numpy.dot(at[ids[0]], numpy.cross(at[ids[i]], at[ids[i + 1]])) / 6
    return total


h5 = h5py.File(file + ".h5", "r")
times = h5["/time_s"][:]
frames, blocks = h5["/blocks/position_m"].shape[:2]
assert len(times) == frames == len(h5["/blocks/damage"]) and frames > 1
assert numpy.allclose(numpy.linalg.norm(h5["/blocks/rotation_wxyz"][:], axis=2), 1, atol=1e-5)
assert len(h5["/blocks/name"]) == blocks
assert numpy.all(h5["/joints/area_m2"][:] > 0)

tractions = "normal_stress_Pa" in h5["/joints"]  # of a scene with frame_stress
print("with tractions" if tractions else "without tractions")
volumes = []
for f in range(frames):
    whole, joints = grid(f"{file}_{f:05}.vtu"), grid(f"{file}_joints_{f:05}.vtu")
    points = vtk_to_numpy(whole.GetPoints().GetData())
    assert numpy.allclose(points, h5["/block_mesh/points_m"][f], atol=1e-6)
    owner = cells(whole, "block")
    assert numpy.allclose(cells(whole, "displacement_m"), h5["/blocks/displacement_m"][f][owner], atol=1e-6)
    assert numpy.allclose(cells(whole, "velocity_m_s"), h5["/blocks/velocity_m_s"][f][owner], atol=1e-5)
    volumes.append(volume(whole))
    which = cells(joints, "joint")
    for name in ("damage", "opening_m") + (("normal_stress_Pa", "shear_stress_Pa", "force_N") if tractions else ()):
        assert numpy.allclose(cells(joints, name), h5["/joints/" + name][f][which], rtol=1e-5), name
assert numpy.ptp(volumes) < 1e-4 * volumes[0]  # blocks are rigid

# Each HDF item of the XDMF is an array of the file with the shape it is said to have.
tree = ElementTree.parse(file + ".xdmf")
data = h5py.File(file + ".xdmf.h5", "r")
items = [i for i in tree.iter("DataItem") if i.get("Format") == "HDF"]
assert items
for item in items:
    name, place = item.text.strip().rsplit(":", 1)
    assert name == os.path.basename(file + ".xdmf.h5"), name
    assert data[place].shape == tuple(int(n) for n in item.get("Dimensions").split()), place
steps = [float(t.get("Value")) for t in tree.iter("Time")]
assert numpy.allclose(steps, times)
topology = data["/block_mesh/topology"][:]
at = polygons = 0
while at < len(topology):
    assert topology[at] == 3
    at += 2 + topology[at + 1]
    polygons += 1
assert polygons == len(data["/block_mesh/owner"]) == len(owner)
assert numpy.array_equal(data["/block_mesh/owner"][:], owner)
print(f"{frames} frames, {blocks} blocks, {volumes[0]:.6g} m3")
