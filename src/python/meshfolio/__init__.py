"""Curvature, spectra, smoothing and pictures of triangle meshes, with NumPy arrays in and out.

    import meshfolio
    mesh = meshfolio.load("bunny.obj")              # or meshfolio.Mesh(vertices, faces)
    meshfolio.inspect(mesh)["lambda_crit"]          # the largest stable step of explicit smoothing [length^2]
    meshfolio.render(mesh, field="h-cotan")         # six views; a notebook shows them
    mesh.attributes.update(meshfolio.curvature(mesh))
    meshfolio.save(mesh, "curved.ply")              # with the curvatures as properties of its vertices

Lengths are in the unit of the mesh. A refused call raises a meshfolio.Error with the message of the command line; a doubtful one
warns with a RuntimeWarning. Long calls leave Python to its other threads. Ctrl-C ends them at once; where a factorisation is under way, its
threads compute on for some seconds in a session that goes on. save() is not left half done.
"""

import base64
import html

import numpy

from . import _core
from ._core import (
    Error,
    InputError,
    Mesh,
    MeshError,
    MissingFileError,
    OutputError,
    SolverError,
    Spectrum,
    UsageError,
    __version__,
    compare,
    curvature,
    distances,
    inspect,
    laplacian,
    load,
    noise,
    sample,
    save,
    smooth,
    spectrum,
)

__all__ = [
    "Error", "InputError", "Mesh", "MeshError", "MissingFileError", "OutputError", "Picture", "SolverError", "Spectrum", "UsageError",
    "compare", "curvature", "distances", "inspect", "laplacian", "load", "noise", "render", "sample", "save", "smooth", "spectrum",
]  # fmt: skip


class _Attributes(dict):
    """Arrays by name, of one row a vertex: others are refused when they are set."""

    def __init__(self, rows, arrays):
        self._rows = rows
        self.update(arrays)

    def __setitem__(self, name, values):
        _core._check_attribute(str(name), values, self._rows)
        super().__setitem__(name, values)

    def update(self, *arrays, **named):
        new = dict(*arrays, **named)
        for name, values in new.items():  # all or none
            _core._check_attribute(str(name), values, self._rows)
        super().update(new)

    def setdefault(self, name, values=None):
        if name not in self:
            self[name] = values
        return self[name]

    def __ior__(self, arrays):
        self.update(arrays)
        return self

    def __reduce__(self):
        return _Attributes, (self._rows, dict(self))


class Picture(numpy.ndarray):
    """height x width x 4 uint8: red, green, blue (sRGB) and alpha, rows from the top. A notebook shows it."""

    def _repr_png_(self):
        is_picture = self.ndim == 3 and self.shape[2] == 4 and self.dtype == numpy.uint8 and self.size > 0
        return _core.encode_png(self) if is_picture else None

    def save(self, path):
        """Writes a PNG file."""
        with open(path, "wb") as file:
            file.write(_core.encode_png(self))


def render(
    mesh, field="none", *, values=None, label="value", views="", size=512, colormap="", range=None, isolines=0.0, edges=False, transparent=False
):
    """A Picture, height x width x 4 uint8: of one view the view alone, of several a sheet with title, names and colour bar.

    field: none, h-uniform, h-cotan, gauss, area, x, y, z, id or h-<operator>; values: n numbers instead, NaN where undefined, called label.
    views: some of +x,-x,+y,-y,+z,-z and hero (from above, where most is seen), by commas; default: the six.
    size: pixels of one view, N or (width, height). range: (low, high) of the colours; default: robust.
    isolines: lines where the value is a multiple of this; 0: none.
    """
    picture = _core.draw(mesh, field, values, label, views, size, colormap, range, isolines, edges, transparent)
    return picture.view(Picture)


def _mesh_png(mesh):
    return render(mesh, views="hero", size=400)._repr_png_()


def _mesh_html(mesh):
    words = f"{mesh.name}: {len(mesh.vertices)} vertices, {len(mesh.faces)} faces"
    words = html.escape("; ".join([words, *mesh.warnings]))
    picture = base64.b64encode(_mesh_png(mesh)).decode("ascii")
    return f'<figure><img width="400" height="400" alt="{words}" src="data:image/png;base64,{picture}"><figcaption>{words}</figcaption></figure>'


Mesh._repr_png_ = _mesh_png
Mesh._repr_html_ = _mesh_html
for _shown in (Error, InputError, MeshError, MissingFileError, OutputError, SolverError, UsageError, Mesh, Spectrum):
    _shown.__module__ = __name__
