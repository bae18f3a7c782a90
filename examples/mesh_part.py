"""From a surface to a simulation: mesh_part.py INPUT OUTPUT.xdmf"""
import sys
import ccdt

surface = ccdt.read(sys.argv[1])
diagnosis = ccdt.check(surface)
for fault in diagnosis.faults:
    print(f"{fault.count} {fault.what}")
if not diagnosis.is_valid:
    largest = (surface.vertices.max(axis=0) - surface.vertices.min(axis=0)).max()
    surface = ccdt.repair(surface, limit=largest).surface

low, high = surface.vertices.min(axis=0), surface.vertices.max(axis=0)
size = (high - low).max()

def edge_length(points):
    """Short edges at the low end of the first axis, long ones at the other."""
    return size * (0.04 + 0.1 * (points[:, 0] - low[0]) / (high[0] - low[0]))

mesh = ccdt.mesh(surface, surface="refine", edge_length=size / 5, size_function=edge_length)
angles = mesh.dihedral_angles()
print(f"{len(mesh.tetrahedra)} tetrahedra, dihedral angles from {angles.min():.0f} to {angles.max():.0f} degrees")
for problem in mesh.verify(surface).problems:
    sys.exit(f"{problem.name}: {problem.examples[0]}")
ccdt.write(mesh, sys.argv[2])  # FEniCSx reads .xdmf
try:
    from matplotlib import pyplot
except ImportError:
    sys.exit()
pyplot.hist(angles.ravel(), bins=90)
pyplot.savefig(sys.argv[2] + ".png")
