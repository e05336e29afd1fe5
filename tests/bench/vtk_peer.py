"""Draws the six views of a mesh offscreen with VTK; prints the seconds of each stage as JSON. Needs a display (Xvfb suffices).

    vtk_peer.py [--plain] [--samples N] MESH.ply FOLDER
"""
import argparse
import json
import time

begun = time.perf_counter()
import vtkmodules.vtkInteractionStyle  # noqa: F401, E402
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, E402
from vtkmodules.vtkFiltersCore import vtkElevationFilter, vtkPolyDataNormals  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGWriter  # noqa: E402
from vtkmodules.vtkIOPLY import vtkPLYReader  # noqa: E402
from vtkmodules.vtkRenderingCore import (  # noqa: E402
    vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

from six_views import FILL, SIDE, VIEWS, camera_position  # noqa: E402

VIRIDIS = [(0.267, 0.005, 0.329), (0.229, 0.322, 0.546), (0.127, 0.566, 0.551), (0.369, 0.789, 0.383), (0.993, 0.906, 0.144)]

options = argparse.ArgumentParser()
options.add_argument("--plain", action="store_true", help="one grey instead of colours by height")
options.add_argument("--samples", type=int, default=0, help="per pixel; 0: no antialiasing")
options.add_argument("mesh")
options.add_argument("folder")
options = options.parse_args()
seconds = {}


def stage(name):
    """Ends a stage: adds the time since the last stage to `name`."""
    global begun
    now = time.perf_counter()
    seconds[name] = seconds.get(name, 0) + now - begun
    begun = now


stage("import")

reader = vtkPLYReader()
reader.SetFileName(options.mesh)
reader.Update()
bounds = reader.GetOutput().GetBounds()
stage("load")

normals = vtkPolyDataNormals()
normals.SetInputConnection(reader.GetOutputPort())
normals.SplittingOff()
heights = vtkElevationFilter()  # the value of a vertex is its height y, from 0 to 1
heights.SetInputConnection(normals.GetOutputPort())
heights.SetLowPoint(0, bounds[2], 0)
heights.SetHighPoint(0, bounds[3], 0)
heights.Update()
stage("normals")

viridis = vtkColorTransferFunction()
for number, color in enumerate(VIRIDIS):
    viridis.AddRGBPoint(number / (len(VIRIDIS) - 1), *color)
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(heights.GetOutputPort())
mapper.SetLookupTable(viridis)
mapper.SetScalarVisibility(not options.plain)
mapper.InterpolateScalarsBeforeMappingOn()
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(0.8, 0.8, 0.82)
actor.GetProperty().SetInterpolationToPhong()
renderer = vtkRenderer()
renderer.AddActor(actor)
renderer.SetBackground(1, 1, 1)
window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(options.samples)
window.SetSize(SIDE, SIDE)
window.AddRenderer(renderer)

low, high = bounds[0::2], bounds[1::2]
camera = renderer.GetActiveCamera()
camera.ParallelProjectionOn()
camera.SetParallelScale(max(b - a for a, b in zip(low, high)) / 2 / FILL)


def look(towards, up):
    camera.SetFocalPoint([(a + b) / 2 for a, b in zip(low, high)])
    camera.SetPosition(camera_position(low, high, towards, distance=3))
    camera.SetViewUp(up)
    renderer.ResetCameraClippingRange()


look(*VIEWS[0][1:])
window.Render()
window.WaitForCompletion()
stage("first frame")  # sets up OpenGL, uploads the mesh

for name, towards, up in VIEWS:
    look(towards, up)
    window.Render()
    window.WaitForCompletion()
    stage("6 renders")
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    image.ShouldRerenderOff()
    image.Update()
    stage("read-back")
    writer = vtkPNGWriter()
    writer.SetFileName(f"{options.folder}/{name}.png")
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    stage("png")

seconds["total"] = sum(seconds.values())
print(json.dumps(seconds))
