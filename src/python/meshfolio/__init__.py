"""Curvature, spectra, smoothing and pictures of triangle meshes, with NumPy arrays in and out.

    import meshfolio
    mesh = meshfolio.load("bunny.obj")              # or meshfolio.Mesh(vertices, faces)
    meshfolio.inspect(mesh)["lambda_crit"]          # the largest stable step of explicit smoothing [length^2]
    meshfolio.render(mesh, field="h-cotan")         # six views; a notebook shows them
    meshfolio.figure(mesh, ["h-cotan", "gauss"], "bunny.pdf", camera=(35, 22))
    mesh.attributes.update(meshfolio.curvature(mesh))
    meshfolio.save(mesh, "curved.ply")              # with the curvatures as properties of its vertices

Every function takes a Mesh, a tuple (vertices, faces), or a mesh of trimesh, PyVista, meshio or Open3D: any object with vertices or points,
and faces. Lengths are in the unit of the mesh. A refused call raises a meshfolio.Error with the message of the command line; a doubtful one
warns with a RuntimeWarning. Long calls leave Python to its other threads. Ctrl-C ends them at once; where a factorisation is under way, its
threads compute on for some seconds in a session that goes on. save() and figure() leave no half-written file.
"""

from __future__ import annotations

import base64
import copy
import html
import os
from typing import Any, Dict, Literal, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arguments import attributes_of, checked, is_mesh, mesh_of, name_of, options, parts_of, shown, triangles_or_counted, worded
from ._core import Error, InputError, Mesh, MeshError, MissingFileError, OutputError, SolverError, Spectrum, UsageError, __version__

__all__ = [
    "Error", "InputError", "Mesh", "MeshError", "MissingFileError", "OutputError", "Picture", "SolverError", "Spectrum", "UsageError",
    "compare", "curvature", "distances", "figure", "inspect", "laplacian", "load", "noise", "render", "sample", "save", "smooth",
    "spectrum",
]  # fmt: skip

# Words of annotations; _arguments.KINDS says what each takes.
MeshLike = Any  # a Mesh, a tuple (vertices, faces), or an object with vertices or points, and faces
Operator = Literal[
    "cotan", "uniform", "cotan-no-half", "clamped", "opposite-mean", "edge-normalised", "idt", "idt-original-mass", "tufted"
]  # fmt: skip
Area = Literal["barycentric", "voronoi", "mixed"]
Scheme = Literal["explicit", "implicit", "taubin"]
StepUnit = Literal["raw", "tau", "h2"]
NoiseUnit = Literal["raw", "bbox", "diagonal", "h"]
Axis = Literal["x", "y", "z"]
Fit = Literal["each", "common"]
Words = Union[str, Sequence[str]]  # with commas
Labels = Union[str, Sequence[str]]
Size = Union[int, Tuple[int, int]]
Path = Union[str, "os.PathLike[str]"]
Limits = Tuple[float, float]
Camera = Union[str, Sequence[float]]
Color = str


class _Attributes(dict):
    """Arrays by name, of one row a vertex: others are refused when they are set."""

    def __init__(self, rows, arrays):
        self._rows = rows
        self.update(arrays)

    def __setitem__(self, name, values):
        self.update({name: values})

    def update(self, *arrays, **named):
        try:
            new = dict(*arrays, **named)
        except (TypeError, ValueError):
            raise UsageError(f"attributes must be a dict of names and arrays, not {shown(*arrays[:1])}") from None
        for name, values in new.items():  # all or none
            _core._attribute(checked("the name of an attribute", str(name), "str"), values, self._rows)
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


# ---- meshes ----------------------------------------------------------------------------------------------------------------


@worded
def load(path: Path) -> Mesh:
    """Returns the mesh of `path`, an OBJ, OFF, PLY, STL, VTP or GLB file, perhaps packed by gzip. `attributes` are the values that the
    file holds for its vertices. Raises MissingFileError, a FileNotFoundError, where there is no file."""
    return _core.load(path)


@worded
def sample(name: str, subdivide: int = 0) -> Mesh:
    """Returns the bundled mesh called name, its triangles divided into four `subdivide` times, with new vertices on its surface."""
    return _core.sample(name, subdivide)


@worded
def save(mesh: MeshLike, path: Path) -> None:
    """Writes the mesh to the OBJ, OFF, PLY, STL, VTP or GLB file `path`, which is replaced as a whole. PLY, VTP and GLB take the
    attributes: an n x k array as columns NAME_0, NAME_1, ... An OBJ file's texture coordinates, groups and materials go into OBJ."""
    _core.save(mesh, path)


@worded
def curvature(
    mesh: MeshLike, *, area: Area = "barycentric", operator: Operator = "cotan", jets: bool = False
) -> Dict[str, NDArray[numpy.float64]]:
    """Returns a dict of n float64 each, NaN where undefined: area [length^2], h_uniform [length], k_gauss [1/length^2], h_cotan and
    h_uniform_scaled [1/length].

    area: the areas around the vertices by which sums are divided.
    operator: another Laplacian, which adds h_<operator>. jets: fit polynomials, too, which adds h_jet and k_jet.
    """
    return _core.curvature(mesh, area, operator, jets)


@worded
def laplacian(mesh: MeshLike, *, operator: Operator = "cotan", area: Area = "barycentric") -> Tuple[Any, NDArray[numpy.float64]]:
    """Returns C (n x n, scipy.sparse, negative semidefinite) and M (n masses [length^2]) of the Laplacian M^-1 C called operator.

    Of vertices that edges without length join, the first has the row and the mass of all; the others, like unreferenced vertices, have
    zeros. area: the areas around the vertices, which are the masses.
    """
    return _core.laplacian(mesh, operator, area)


@worded
def spectrum(mesh: MeshLike, k: int, *, operator: Operator = "cotan", area: Area = "barycentric") -> Spectrum:
    """Returns the k smallest eigenpairs of a Laplacian, M-orthonormal, with a certificate; fewer, with a warning, on a mesh of fewer
    vertices. operator, area: as for laplacian()."""
    return _core.spectrum(mesh, k, operator, area)


@worded
def smooth(
    mesh: MeshLike, step: Optional[float] = None, *, scheme: Scheme = "explicit", operator: Operator = "cotan", unit: StepUnit = "raw",
    iterations: int = 1, rebuild: bool = False, adaptive: bool = False, mu: Optional[float] = None,
) -> Mesh:  # fmt: skip
    """Returns a smoothed mesh. Raises SolverError when it blows up.

    step: lambda in unit raw [length^2], tau (1 is the largest stable step) or h2 (mean edge squared); default: half the largest stable one.
    scheme: explicit or implicit (Euler), or taubin: steps of lambda and of mu, which is chosen by default.
    operator: the Laplacian. iterations: steps. rebuild: compute the Laplacian anew in each. adaptive: shorten explicit steps that are
    not stable.
    """
    return _core.smooth(mesh, step, scheme, operator, unit, iterations, rebuild, adaptive, mu)


@worded
def noise(mesh: MeshLike, sigma: float, *, seed: int = 1, unit: NoiseUnit = "raw") -> Mesh:
    """Returns a mesh with Gaussian noise of standard deviation sigma per coordinate: in unit raw [length], or as a share of each
    extent (bbox), of the diagonal of the bounding box, or of the mean edge (h). The same seed gives the same noise."""
    return _core.noise(mesh, sigma, seed, unit)


@worded
def compare(a: MeshLike, b: MeshLike, *, surfaces: bool = False, accuracy: float = 1e-3) -> Dict[str, Union[float, int]]:
    """Returns a dict of errors of b against a: rms, max, hausdorff, hausdorff_bound [length], mean_normal_angle_deg, volume_ratio,
    area_ratio and more. Vertex by vertex where both have the same faces, else, or if surfaces is true, from surface to surface.
    The Hausdorff distance lies between hausdorff and hausdorff_bound, which is larger by the share accuracy at most."""
    return _core.compare(a, b, surfaces, accuracy)


@worded
def distances(a: MeshLike, b: MeshLike) -> NDArray[numpy.float64]:
    """Returns n float64: the distance of every vertex of a to the surface of b, NaN where no face uses the vertex [length]."""
    return _core.distances(a, b)


@worded
def inspect(mesh: MeshLike, *, operator: Operator = "cotan") -> Dict[str, Any]:
    """Returns a dict: counts, defects, Gauss-Bonnet, lambda_crit [length^2] of the operator and its proof, None where not defined; as
    `inspect --json`."""
    return _core.inspect(mesh, operator)


# ---- pictures --------------------------------------------------------------------------------------------------------------


class Picture(numpy.ndarray):
    """height x width x 4 uint8: red, green, blue (sRGB) and alpha, rows from the top. A notebook shows it."""

    def _repr_png_(self) -> Optional[bytes]:
        is_picture = self.ndim == 3 and self.shape[2] == 4 and self.dtype == numpy.uint8 and self.size > 0
        return _core.encode_png(self) if is_picture else None

    @worded
    def save(self, path: Path) -> None:
        """Writes the PNG file `path`."""
        _core.save_png(self, path)


@worded
def render(
    mesh: MeshLike, field: str = "none", *, values: Optional[ArrayLike] = None, label: str = "value", views: Words = (),
    camera: Optional[Camera] = None, zoom: float = 1, up: Optional[Axis] = None, size: Size = 512,
    colormap: Path = "", range: Optional[Limits] = None, isolines: float = 0, edges: bool = False, transparent: bool = False,
) -> Picture:  # fmt: skip
    """Returns a Picture, height x width x 4 uint8: of one view the view alone, of several a sheet with title, names and colour bar.

    field: none, h-uniform, h-cotan, gauss, area, x, y, z, id or h-<operator>; values: n numbers instead, NaN where undefined, called label.
    views: some of +x, -x, +y, -y, +z, -z, hero (from above, where most is seen) and camera: a list, or one word with commas; default: the
    camera, else the six.
    camera: (azimuth, elevation) or (azimuth, elevation, roll) in degrees: from the front to the right, upwards, and anticlockwise.
    zoom: factor of the size in the picture. up: the axis x, y or z that points up; default: y, and for hero the likely one.
    size: pixels of one view, N or (width, height). colormap: a name, or a file. range: (low, high) of the colours; default: robust.
    isolines: lines where the value is a multiple of this; 0: none. edges: draw those of triangles. transparent: no background.
    """
    background = "none" if transparent else "white"
    style = options(
        field=field, views=views, camera=camera, zoom=zoom, up=up, size=size, colormap=colormap, range=range, isolines=isolines or None,
        edges=edges, background=background,
    )  # fmt: skip
    return _core.draw(mesh, values, label, style).view(Picture)


@worded
def figure(
    meshes: Union[MeshLike, Sequence[MeshLike]], fields: Words = "none", path: Optional[Path] = None, *, values: Any = None,
    labels: Optional[Labels] = None, views: Words = (), camera: Optional[Camera] = None, zoom: float = 1, up: Optional[Axis] = None,
    fit: Fit = "each", columns: Optional[int] = None, width_mm: Optional[float] = None, dpi: float = 300, title: str = "", bar: bool = True,
    background: Color = "white", colormap: Path = "", range: Optional[Limits] = None, isolines: float = 0, edges: bool = False,
) -> Optional[Picture]:  # fmt: skip
    """Draws a grid of meshes and fields for a paper. Writes it to `path`, a .pdf, .svg or .png file; without a path, returns a Picture.

    meshes: one, or a list. fields: one, or a list, of those of render(), or distance, to the surface of the first mesh.
    values: numbers instead or besides: an array for each mesh, or a dict of label and such arrays; one array for one mesh.
    labels: words below the meshes; default: their names.
    views, camera, zoom, up, colormap, isolines, edges: as for render(); views default to hero. range: of all fields.
    fit: each mesh fills its picture, or all are in one common frame, so that their sizes can be compared.
    columns: pictures in a line. width_mm: of the figure; default: 85 for one picture in a line, else 170. dpi: pixels per inch.
    title: above. bar: a colour bar for each field. background: white, none or #rrggbb.
    """
    several = isinstance(meshes, (list, tuple)) and not is_mesh(meshes)
    drawn = [mesh_of(mesh, f"meshes[{i}]") for i, mesh in enumerate(meshes)] if several else [mesh_of(meshes, "meshes")]
    if not drawn:
        raise UsageError("meshes is empty; give one or more")
    if labels and len(labels) != len(drawn):
        raise UsageError(f"labels must be as many as meshes, not {len(labels)} for {len(drawn)}")
    arrays = _arrays_by_label(values, len(drawn))
    style = options(
        views=views, camera=camera, zoom=zoom, up=up, fit=fit, columns=columns, width_mm=width_mm, dpi=dpi, title=title, bar=bar,
        background=background, colormap=colormap, range=range, isolines=isolines or None, edges=edges,
    )  # fmt: skip
    picture = _core.figure(drawn, labels or [], [] if arrays and fields == ["none"] else fields, arrays, path, style)
    return picture if picture is None else picture.view(Picture)


def _arrays_by_label(values, meshes):
    """Returns a list of label and a list of arrays, one for each of so many meshes."""
    found = []
    for label, arrays in dict(values if hasattr(values, "keys") else {} if values is None else {"value": values}).items():
        if meshes == 1 and not (isinstance(arrays, (list, tuple)) and len(arrays) == 1):
            arrays = [arrays]
        if not hasattr(arrays, "__len__") or len(arrays) != meshes:
            raise UsageError(f"values need a list of {meshes} arrays, one for each mesh, not {shown(arrays)}")
        found.append((checked("the label of values", str(label), "str"), list(arrays)))
    return found


# ---- the class Mesh ----------------------------------------------------------------------------------------------------------

_made = Mesh.__init__


def _init(self, vertices, faces=None, name: Optional[str] = None, attributes=None) -> None:
    """vertices: n x 3 coordinates in any unit of length; or a mesh of another package, or a tuple (vertices, faces), without faces.
    faces: m x 3 rows of vertices, counter-clockwise seen from outside; polygons are cut into triangles.
    name: for titles and messages; default: that of the other package, else "mesh".
    attributes: names with n numbers each, or n x k; default: those of the other package."""
    thing = vertices
    if faces is None:
        vertices, faces = parts_of(thing, "the argument of Mesh() without faces")
        attributes = attributes_of(thing, vertices) if attributes is None else attributes
    _made(self, vertices, triangles_or_counted(faces), name or name_of(thing), {} if attributes is None else attributes)


def _copy(self) -> Mesh:
    """Returns the same surface, with attributes of its own."""
    return copy.copy(self)


def _mesh_png(mesh):
    return render(mesh, views="hero", size=400)._repr_png_()


def _mesh_html(mesh):
    words = f"{mesh.name}: {len(mesh.vertices)} vertices, {len(mesh.faces)} faces"
    words = html.escape("; ".join([words, *mesh.warnings]))
    picture = base64.b64encode(_mesh_png(mesh)).decode("ascii")
    image = f'<img width="400" height="400" alt="{words}" src="data:image/png;base64,{picture}">'
    return f"<figure>{image}<figcaption>{words}</figcaption></figure>"


_init.__name__, _copy.__name__ = "Mesh", "copy"
for _name, _method in (("__init__", worded(_init)), ("copy", worded(_copy)), ("_repr_png_", _mesh_png), ("_repr_html_", _mesh_html)):
    setattr(Mesh, _name, _method)
for _shown in (Error, InputError, MeshError, MissingFileError, OutputError, SolverError, UsageError, Mesh, Spectrum):
    _shown.__module__ = __name__
