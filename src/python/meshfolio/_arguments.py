"""Arguments of the functions: meshes of other packages, and errors in words."""

import difflib
import functools
import inspect
import operator
import os
import re
import reprlib

import numpy

from . import _core
from ._core import Mesh, MeshError, UsageError

CELLS = ("triangle", "quad", "polygon", 5, 9)  # surfaces, as meshio and PyVista name them


def shown(value):
    """Returns a value and its type as words for a message."""
    kind = type(value).__name__
    if isinstance(value, numpy.ndarray):
        return f"an array of shape {value.shape}"
    if value is None:
        return "None"
    return f"{kind} {reprlib.repr(value)}" if type(value).__module__ == "builtins" else f"an object of type {kind}"


# ---- meshes ----------------------------------------------------------------------------------------------------------------


def _first(thing, *names):
    """Returns the first of these attributes that is there and not None."""
    return next((value for value in (getattr(thing, name, None) for name in names) if value is not None), None)


def _is_pair(thing):
    """True for a tuple (vertices, faces); two vertices, and two faces, are none."""
    try:
        return isinstance(thing, tuple) and len(thing) == 2 and numpy.ndim(thing[0]) == 2
    except ValueError:  # rows of several lengths
        return False


def is_mesh(thing):
    """True for an object with vertices, and for a tuple (vertices, faces)."""
    if isinstance(thing, tuple):
        return len(thing) == 2 and not any(_first(part, "vertices", "points") is not None or _is_pair(part) for part in thing)
    return _first(thing, "vertices", "points") is not None


def parts_of(thing, name):
    """Returns the vertices and faces of a mesh of another package. Raises UsageError for another object, which is called `name`."""
    if isinstance(thing, tuple) and is_mesh(thing):
        return thing
    vertices, faces = _first(thing, "vertices", "points"), _first(thing, "faces", "triangles", "cells_dict", "cells")
    if vertices is not None and faces is not None:
        return vertices, faces
    hint = ""
    if isinstance(thing, (str, os.PathLike)):
        hint = "; load(path) reads a file"
    elif hasattr(thing, "extract_surface"):
        hint = "; take its extract_surface()"
    elif hasattr(thing, "geometry"):
        hint = "; take its to_mesh()"
    raise UsageError(
        f"{name} must be a Mesh, a tuple (vertices, faces), or an object with vertices or points, and faces "
        f"(of trimesh, PyVista, meshio or Open3D), not {shown(thing)}{hint}"
    )


def triangles_or_counted(faces):
    """Returns triangles as they are, other polygons as one array: k, then k vertices, and so on, as PyVista has them."""
    if isinstance(faces, dict):  # cells by kind
        polygons = [faces[kind] for kind in CELLS if kind in faces]
        if not polygons:
            raise MeshError(f"the cells are no triangles, but {', '.join(map(str, faces))}; extract the surface")
    else:
        try:
            array = numpy.asarray(faces)
        except ValueError:  # rows of several lengths
            array = None
        if array is not None and array.size == 0:
            raise MeshError("there are no faces; give m x 3 vertices")
        if array is not None and (array.ndim != 2 or array.shape[1] == 3 or array.dtype.kind not in "iu"):
            return faces
        if array is not None and (array[:, 0] == array.shape[1] - 1).all():
            raise MeshError(f"all faces begin with {array.shape[1] - 1}, their number of corners; take faces[:, 1:]")
        polygons = faces if array is None else [array]
    rows = [numpy.atleast_2d(numpy.asarray(part)) for part in polygons]
    return numpy.concatenate([numpy.insert(part, 0, part.shape[1], axis=1).ravel() for part in rows])


def name_of(thing):
    """Returns the name that another package gives its mesh, or "mesh"."""
    known = getattr(thing, "metadata", None)
    known = known if isinstance(known, dict) else {}
    source = getattr(thing, "source", None)
    names = (getattr(thing, "name", None), known.get("name"), known.get("file_name"), getattr(source, "file_name", None))
    return next((name for name in names if isinstance(name, str) and name), "mesh").encode("utf-8", "replace").decode()


def attributes_of(thing, vertices):
    """Returns the arrays that another package keeps for the vertices, if they have a row of numbers for each vertex."""
    kept, arrays = {}, _first(thing, "vertex_attributes", "point_data", "attributes")
    for name, values in dict(arrays).items() if hasattr(arrays, "keys") and hasattr(vertices, "__len__") else ():
        try:
            kept[str(name)] = _core._attribute(checked("name", str(name), "str"), values, len(vertices))
        except (MeshError, UsageError):  # words, or rows of something else
            pass
    return kept


def mesh_of(thing, name):
    """Returns the Mesh of anything that is one. Raises UsageError for another object, which is called `name`."""
    if isinstance(thing, Mesh):
        return thing
    vertices, faces = parts_of(thing, name)
    return Mesh(vertices, faces, name_of(thing), attributes_of(thing, vertices))


# ---- checks of arguments ---------------------------------------------------------------------------------------------------


def _word(value):
    if not isinstance(value, str):
        raise TypeError
    value.encode()  # raises UnicodeEncodeError, a ValueError, for half a surrogate
    return value


def _labels(value):
    return [_word(word) for word in ([value] if isinstance(value, str) else value)]


def _words(value):
    return [part for word in _labels(value) for part in word.split(",")]


def _number(value):
    if isinstance(value, (str, bytes)):
        raise TypeError
    return float(value)


def _whole(value):
    if not -(2**63) <= operator.index(value) < 2**63:
        raise OverflowError
    return operator.index(value)


def _truth(value):
    if value not in (0, 1):
        raise TypeError
    return bool(value)


def _path(value):
    if b"\0" in os.fsencode(value):
        raise ValueError
    return os.fsencode(value)


def _numbers(value):
    return ",".join(repr(_number(number)) for number in value)


def _limits(value):
    low, high = value
    return _numbers((low, high))


def _camera(value):
    return _word(value) if isinstance(value, str) else _numbers(value)


def _size(value):
    if hasattr(value, "__index__"):
        return str(_whole(value))
    width, height = value
    return f"{_whole(width)}x{_whole(height)}"


KINDS = {  # annotation of an argument: words for it, and a function that returns its value or raises an error
    "str": ("a word", _word),
    "Words": ("a word or a list of words", _words),
    "Labels": ("a word or a list of words", _labels),
    "int": ("a whole number", _whole),
    "float": ("a number", _number),
    "bool": ("True or False", _truth),
    "Path": ("a path", _path),
    "Limits": ("two numbers (low, high)", _limits),
    "Camera": ("(azimuth, elevation) or (azimuth, elevation, roll) in degrees", _camera),
    "Size": ("N or (width, height)", _size),
    **dict.fromkeys(("Area", "Axis", "Color", "Fit", "NoiseUnit", "Operator", "Scheme", "StepUnit"), ("a word", _word)),
}


def checked(name, value, kind):
    """Returns the value of an argument. Raises UsageError if it is not of the kind that the annotation names."""
    optional = re.fullmatch(r"Optional\[(.*)\]", kind)
    kind = optional[1] if optional else kind
    if kind == "MeshLike":
        return mesh_of(value, name)
    if kind not in KINDS or (optional and value is None):
        return value
    words, convert = KINDS[kind]
    try:
        return convert(value)
    except (TypeError, ValueError, OverflowError):
        raise UsageError(f"{name} must be {words}, not {shown(value)}") from None


def options(**given):
    """Returns options as words of the command line, without those that are None."""
    def text(value):
        if isinstance(value, (bool, list)):
            return ",".join(value) if isinstance(value, list) else "on" if value else "off"
        return value if isinstance(value, (str, bytes)) else repr(value)

    return {name: text(value) for name, value in given.items() if value is not None}


def worded(function):
    """Makes a function take meshes of other packages, and refuse wrong arguments with an error in words."""
    signature, name = inspect.signature(function), function.__name__
    kinds = {key: str(argument.annotation) for key, argument in signature.parameters.items()}

    @functools.wraps(function)
    def call(*given, **named):
        try:
            bound = signature.bind(*given, **named)
        except TypeError as wrong:
            near = difflib.get_close_matches(str(wrong).rpartition("argument ")[2].strip("'"), kinds, 1)
            hint = f"; did you mean {near[0]!r}" if near and near[0] not in str(wrong) else ""
            raise UsageError(f"{name}(): {wrong}{hint}; it takes {', '.join(key for key in kinds if key != 'self') or 'nothing'}") from None
        keys = list(bound.arguments)
        bound.apply_defaults()
        for key, value in bound.arguments.items():
            bound.arguments[key] = checked(key, value, kinds[key])
        try:
            return function(*bound.args, **bound.kwargs)
        except UsageError as error:  # names options of the command line
            raise UsageError(re.sub("--([a-z-]+)", lambda option: option[1].replace("-", "_"), str(error))) from None
        except TypeError as wrong:
            if "incompatible function arguments" not in str(wrong):
                raise
            raise UsageError(f"{name}() cannot take " + ", ".join(f"{key} = {shown(bound.arguments[key])}" for key in keys)) from None

    return call
