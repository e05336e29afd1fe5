"""Compares the Python module with NumPy and SciPy on the same meshes. Skipped (77) if NumPy or SciPy is missing."""

import ast
import copy
import errno
import gc
import importlib
import inspect
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest
import warnings
from pathlib import Path

try:
    import numpy as np
    import scipy.linalg
    import scipy.sparse
    import scipy.sparse.linalg
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

import meshfolio

SOURCE = Path(__file__).resolve().parents[2]


def triangle_geometry(mesh):
    """Returns corners (m x 3 x 3), angles and cotangents (m x 3, of corner k) and areas (m)."""
    corners = mesh.vertices[mesh.faces]
    u, v = np.roll(corners, -1, axis=1) - corners, np.roll(corners, -2, axis=1) - corners
    dots, crosses = np.einsum("tki,tki->tk", u, v), np.linalg.norm(np.cross(u, v), axis=2)
    return corners, np.arctan2(crosses, dots), dots / crosses, crosses[:, 0] / 2


def cotangent_laplacian(mesh):
    """Returns C with C_ij = (cot alpha + cot beta)/2 and rows that sum to 0, and M with a third of the areas around each vertex."""
    _, _, cotangents, areas = triangle_geometry(mesh)
    n = len(mesh.vertices)
    C = scipy.sparse.csc_matrix((n, n))
    for k in range(3):
        i, j = mesh.faces[:, (k + 1) % 3], mesh.faces[:, (k + 2) % 3]
        half = scipy.sparse.csc_matrix((cotangents[:, k] / 2, (i, j)), shape=(n, n))
        C = C + half + half.T
    C = C - scipy.sparse.diags(np.asarray(C.sum(axis=1)).ravel())
    return C, np.bincount(mesh.faces.ravel(), np.repeat(areas / 3, 3), n)


def all_eigenvalues(mesh):
    C, M = cotangent_laplacian(mesh)
    scale = 1 / np.sqrt(M)
    return scipy.linalg.eigvalsh(-C.toarray() * scale[:, None] * scale[None, :])


TETRAHEDRON = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


class Arrays(unittest.TestCase):
    def test_a_mesh_shows_its_own_memory_read_only_and_keeps_it(self):
        mesh = meshfolio.sample("torus")
        vertices, faces = mesh.vertices, mesh.faces
        self.assertEqual((vertices.dtype, faces.dtype), (np.float64, np.int32))
        self.assertEqual((vertices.shape[1], faces.shape[1]), (3, 3))
        self.assertTrue(np.shares_memory(vertices, mesh.points))
        self.assertTrue(np.shares_memory(faces, mesh.faces))
        with self.assertRaises(ValueError):
            vertices[0, 0] = 1
        before = vertices.copy()
        del mesh
        gc.collect()
        np.testing.assert_array_equal(vertices, before)

    def test_views_keep_the_memory_of_meshes_that_are_gone_or_moved(self):
        views, copies = [], []
        for i in range(200):
            mesh = meshfolio.Mesh(TETRAHEDRON[0] + i, TETRAHEDRON[1])
            views += [mesh.vertices, mesh.faces, mesh.vertices[1:, ::2]]
            copies += [view.copy() for view in views[-3:]]
            mesh.vertices = mesh.vertices * -2
        del mesh
        gc.collect()
        for view, kept in zip(views, copies):
            np.testing.assert_array_equal(view, kept)

    def test_moved_vertices_make_the_mesh_that_a_new_one_would_be(self):
        mesh = meshfolio.Mesh(*TETRAHEDRON, name="t", attributes={"h": range(4)})
        old, faces = mesh.vertices, mesh.faces
        picture = meshfolio.render(mesh, views="+x", size=60)
        mesh.points = np.asfortranarray(10 * old.astype(np.float32))
        new = meshfolio.Mesh(10 * TETRAHEDRON[0], TETRAHEDRON[1])
        np.testing.assert_array_equal(old, TETRAHEDRON[0])
        np.testing.assert_array_equal(mesh.vertices, new.vertices)
        np.testing.assert_array_equal(mesh.faces, faces)
        self.assertAlmostEqual(mesh.area, new.area)
        self.assertEqual(meshfolio.inspect(mesh)["area"], meshfolio.inspect(new)["area"])
        self.assertEqual(list(mesh.attributes["h"]), [0, 1, 2, 3])
        for other in (mesh, new, pickle.loads(pickle.dumps(mesh)), meshfolio.smooth(mesh, iterations=0)):
            np.testing.assert_array_equal(meshfolio.render(other, views="+x", size=60), picture, "fills its picture")
        for wrong in (old[:3], old[:, :2], "no", old * np.nan, old * 1e200, old * 0):
            with self.assertRaises(meshfolio.MeshError):
                mesh.vertices = wrong
            np.testing.assert_array_equal(mesh.vertices, new.vertices)

    def test_name_and_attributes_can_be_set_and_faces_cannot(self):
        mesh = meshfolio.Mesh(*TETRAHEDRON)
        mesh.name, mesh.attributes = "other", {"h": [1, 2, 3, 4]}
        self.assertEqual((mesh.name, mesh.attributes), ("other", {"h": [1, 2, 3, 4]}))
        for setting in (lambda: mesh.__setattr__("attributes", {"h": [1]}), lambda: mesh.__setattr__("name", 5), lambda: mesh.__setattr__("point_data", 5)):
            self.assertRaises(meshfolio.Error, setting)
        self.assertEqual((mesh.name, mesh.attributes), ("other", {"h": [1, 2, 3, 4]}))
        with self.assertRaisesRegex(AttributeError, "make a new one"):
            mesh.faces = mesh.faces

    def test_arrays_and_files_give_back_what_went_in(self):
        mesh = meshfolio.sample("creature")
        again = meshfolio.Mesh(mesh.vertices, mesh.faces.astype(np.uint16), "again")
        np.testing.assert_array_equal(again.vertices, mesh.vertices)
        np.testing.assert_array_equal(again.faces, mesh.faces)
        self.assertEqual(again.name, "again")
        self.assertIn(f"{len(mesh.faces)} faces", repr(again))
        with tempfile.TemporaryDirectory() as folder:
            for ending in ("obj", "off", "ply"):
                path = Path(folder) / f"mesh.{ending}"
                meshfolio.save(mesh, path)
                read = meshfolio.load(path)
                np.testing.assert_array_equal(read.vertices, mesh.vertices)
                np.testing.assert_array_equal(read.faces, mesh.faces)

    def test_lists_are_accepted_and_repairs_are_reported(self):
        square = meshfolio.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 3, 2], [0, 1, 2]])
        self.assertEqual(len(square.faces), 2)
        self.assertGreaterEqual(len(square.warnings), 2, square.warnings)


class Attributes(unittest.TestCase):
    def setUp(self):
        self.mesh = meshfolio.sample("cube8")
        self.given = {
            "quality": np.linspace(-1, 1, 8), "red": np.arange(8, dtype=np.uint8), "id": np.arange(8) + 16777210, "far": np.arange(8) + 2**40,
            "flow": np.arange(16, dtype=np.float32).reshape(8, 2), "inside": np.arange(8) % 2 == 0,
        }  # fmt: skip

    def test_attributes_are_saved_read_again_and_kept_by_new_positions(self):
        self.mesh.attributes.update(self.given)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "cube.ply"
            meshfolio.save(self.mesh, path)
            read = meshfolio.load(path)
            again = Path(folder) / "again.ply"
            meshfolio.save(meshfolio.smooth(read), again)
            kept = meshfolio.load(again).attributes
        columns = dict(self.given, flow_0=self.given["flow"][:, 0], flow_1=self.given["flow"][:, 1])
        del columns["flow"]
        types = {"quality": "f8", "red": "u1", "id": "i4", "far": "f8", "flow_0": "f4", "flow_1": "f4", "inside": "u1"}
        for found in (read.attributes, kept, meshfolio.noise(read, 0.1).attributes):
            self.assertEqual({name: values.dtype.str[1:] for name, values in found.items()}, types)
            for name, values in columns.items():
                np.testing.assert_array_equal(found[name], values, name)
        self.assertIs(read.attributes, read.vertex_attributes)
        self.assertIs(read.attributes, read.point_data)

    def test_normals_of_a_file_are_written_anew_and_textures_stay_in_obj(self):
        with tempfile.TemporaryDirectory() as folder:
            ply, obj = Path(folder) / "m.ply", Path(folder) / "m.obj"
            ply.write_text(
                "ply\nformat ascii 1.0\nelement vertex 3\n" + "".join(f"property float {p}\n" for p in ("x", "y", "z", "nx", "ny", "nz"))
                + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n3 0 1 2\n"
            )  # fmt: skip
            obj.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\nusemtl brass\nf 1/1 2/1 3/1\n")
            for path, words in ((ply, b"property float nx"), (obj, b"usemtl brass")):
                mesh = meshfolio.load(path)
                self.assertEqual(mesh.attributes, {})
                for other in (mesh, pickle.loads(pickle.dumps(mesh)), meshfolio.noise(mesh, 0.1)):
                    meshfolio.save(other, path)
                    self.assertIn(words, path.read_bytes())

    def test_arrays_that_do_not_fit_are_refused(self):
        for values, words in (([1.0] * 7, "7 values, the mesh has 8 vertices"), (["a"] * 8, "no numbers"), (np.zeros((8, 1, 1)), "axis")):
            for setting in (lambda a: a.__setitem__("wrong", values), lambda a: a.update(wrong=values), lambda a: a.setdefault("wrong", values)):
                with self.subTest(words=words), self.assertRaisesRegex(meshfolio.MeshError, f"'wrong'.*{words}"):
                    setting(self.mesh.attributes)
            self.assertNotIn("wrong", self.mesh.attributes)
            with self.assertRaisesRegex(meshfolio.MeshError, words):
                meshfolio.Mesh(self.mesh.vertices, self.mesh.faces, attributes={"wrong": values})

    def test_copies_are_equal_and_independent(self):
        mesh = meshfolio.noise(meshfolio.Mesh(self.mesh.vertices, self.mesh.faces, "named", self.given), 0.01)
        copies = [mesh.copy(), copy.copy(mesh), copy.deepcopy(mesh), pickle.loads(pickle.dumps(mesh))]
        for other in copies:
            np.testing.assert_array_equal(other.vertices, mesh.vertices)
            np.testing.assert_array_equal(other.faces, mesh.faces)
            self.assertEqual((other.name, other.warnings, other.euler_number), (mesh.name, mesh.warnings, 2))
            self.assertEqual(meshfolio.inspect(other), meshfolio.inspect(mesh))
            other.attributes["quality"][0] = 7
            del other.attributes["id"]
        np.testing.assert_array_equal(mesh.attributes["quality"], self.given["quality"])
        self.assertIn("id", mesh.attributes)
        found = meshfolio.spectrum(self.mesh, 3)
        again = pickle.loads(pickle.dumps(found))
        np.testing.assert_array_equal(again.eigenvectors, found.eigenvectors)
        self.assertEqual(again.certificate, found.certificate)


class Measures(unittest.TestCase):
    def test_measures_of_a_cube_and_of_an_open_sheet_are_right(self):
        cube = meshfolio.sample("cube8")
        self.assertEqual((cube.n_points, cube.n_cells, cube.euler_number, cube.is_watertight), (8, 12, 2, True))
        np.testing.assert_array_equal(cube.bounds, [cube.vertices.min(axis=0), cube.vertices.max(axis=0)])
        edge = np.ptp(cube.vertices[:, 0])
        np.testing.assert_allclose((cube.area, cube.volume), (6 * edge**2, edge**3), rtol=1e-14)
        self.assertTrue((np.sum(cube.vertex_normals * cube.vertices, axis=1) > 0).all(), "outwards")
        corners = cube.vertices[cube.faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / edge**2
        np.testing.assert_allclose(cube.face_normals, normals, atol=1e-15)
        sheet = meshfolio.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [9, 9, 9]], [[0, 1, 2]])
        self.assertEqual((sheet.is_watertight, sheet.euler_number, sheet.area), (False, 1, 0.5))
        self.assertTrue(np.isnan(sheet.volume))
        self.assertIn('open', sheet.why_no_volume)
        self.assertEqual(cube.why_no_volume, '')
        np.testing.assert_array_equal(sheet.bounds, [[0, 0, 0], [1, 1, 0]])

    def test_the_version_is_that_of_the_project(self):
        self.assertIn(f"project(meshfolio VERSION {meshfolio.__version__} ", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))


class Errors(unittest.TestCase):
    def test_each_type_is_a_class_with_the_words_of_the_command_line(self):
        mesh = meshfolio.sample("cube8")
        for kind, also, words, call in (
            (meshfolio.InputError, OSError, "no.obj", lambda: meshfolio.load("no.obj")),
            (meshfolio.MissingFileError, FileNotFoundError, "no.obj", lambda: meshfolio.load("no.obj")),
            (meshfolio.InputError, OSError, "is a folder", lambda: meshfolio.load(SOURCE)),
            (meshfolio.UsageError, ValueError, "unknown operator 'cotann'; did you mean 'cotan'", lambda: meshfolio.laplacian(mesh, operator="cotann")),
            (meshfolio.UsageError, ValueError, "it takes barycentric, ", lambda: meshfolio.curvature(mesh, area="all")),
            (meshfolio.UsageError, ValueError, "did you mean 'h-cotan'", lambda: meshfolio.render(mesh, "h-cotam")),
            (meshfolio.UsageError, ValueError, "did you mean 'viridis'", lambda: meshfolio.render(mesh, colormap="virdis")),
            (meshfolio.UsageError, ValueError, "did you mean 'implicit'", lambda: meshfolio.smooth(mesh, 1, scheme="implicite")),
            (meshfolio.UsageError, ValueError, "it takes raw, tau, h2", lambda: meshfolio.smooth(mesh, 1, unit="tua")),
            (meshfolio.UsageError, ValueError, "did you mean 'bbox'", lambda: meshfolio.noise(mesh, 1, unit="box")),
            (meshfolio.UsageError, ValueError, "step '-1' is not a finite number > 0", lambda: meshfolio.smooth(mesh, -1)),
            (meshfolio.UsageError, ValueError, "step 'nan' is not", lambda: meshfolio.smooth(mesh, np.nan)),
            (meshfolio.UsageError, ValueError, "iterations '-1' is not an integer from 0", lambda: meshfolio.smooth(mesh, 1, iterations=-1)),
            (meshfolio.UsageError, ValueError, "adaptive is for scheme explicit", lambda: meshfolio.smooth(mesh, 1, scheme="taubin", adaptive=True)),
            (meshfolio.UsageError, ValueError, "k '0' is not an integer from 1", lambda: meshfolio.spectrum(mesh, 0)),
            (meshfolio.UsageError, ValueError, "sigma '-1' is not", lambda: meshfolio.noise(mesh, -1)),
            (meshfolio.UsageError, ValueError, "size", lambda: meshfolio.render(mesh, size=0)),
            (meshfolio.UsageError, ValueError, "lo < hi", lambda: meshfolio.render(mesh, "x", range=(2, 1))),
            (meshfolio.MeshError, ValueError, "4 x 2", lambda: meshfolio.Mesh(np.zeros((4, 2)), mesh.faces)),
            (meshfolio.MeshError, ValueError, "3, a, b, c", lambda: meshfolio.Mesh(mesh.vertices, [0, 1, 2])),
            (meshfolio.MeshError, ValueError, "face 1", lambda: meshfolio.Mesh(mesh.vertices, [[0, 1, 2], [0, 1, 8]])),
            (meshfolio.MeshError, ValueError, "vertex 0", lambda: meshfolio.Mesh(mesh.vertices * np.nan, mesh.faces)),
            (meshfolio.MeshError, ValueError, "integers", lambda: meshfolio.Mesh(mesh.vertices, mesh.faces * 1.0)),
            (meshfolio.MeshError, ValueError, "1 value, the mesh has", lambda: meshfolio.render(mesh, values=[1.0])),
            (meshfolio.OutputError, OSError, "nowhere", lambda: meshfolio.save(mesh, "/nowhere/at/all.ply")),
            (meshfolio.UsageError, ValueError, "mesh.txt", lambda: meshfolio.save(mesh, "mesh.txt")),
        ):
            with self.subTest(words=words), self.assertRaises(kind) as caught:
                call()
            self.assertIsInstance(caught.exception, meshfolio.Error)
            self.assertIsInstance(caught.exception, also)
            self.assertIn(words, str(caught.exception))

    def test_things_that_are_no_meshes_or_words_are_refused_in_words(self):
        X, F = TETRAHEDRON
        mesh, half = meshfolio.Mesh(X, F), "\ud800"
        for words, call in (
            ("vertices", lambda: meshfolio.curvature((5, 6))), ("vertices", lambda: meshfolio.curvature((None, F))),
            ("vertices", lambda: meshfolio.Mesh(5, F)), ("vertices", lambda: meshfolio.curvature(thing(vertices=5, faces=F))),
            ("attributes", lambda: meshfolio.Mesh(X, F, attributes=5)), ("faces", lambda: meshfolio.Mesh(X, [["x"]])),
            ("faces", lambda: meshfolio.Mesh(X, [["x", "y", "z", "w"]])), ("a Mesh", lambda: meshfolio.curvature(((X, F), (X, F)))),
            ("name", lambda: meshfolio.Mesh(X, F, half)), ("name", lambda: setattr(mesh, "name", half)), ("up", lambda: meshfolio.render(mesh, up=half)),
            ("camera", lambda: meshfolio.render(mesh, camera=half)), ("path", lambda: meshfolio.save(mesh, half)),
            ("title", lambda: meshfolio.figure(mesh, title=half)), ("views", lambda: meshfolio.figure(mesh, views=[half])),
            ("views", lambda: meshfolio.render(mesh, views=b"+x")), ("fit", lambda: meshfolio.figure(mesh, fit=half)),
            ("attribute", lambda: mesh.attributes.update({half: X[:, 0]})), ("label", lambda: meshfolio.figure(mesh, values={half: X[:, 0]})),
            ("colour map", lambda: meshfolio.figure(mesh, colormap=b"\xff")), ("colormap", lambda: meshfolio.render(mesh, colormap=half)),
            ("empty", lambda: meshfolio.Mesh.__new__(meshfolio.Mesh).vertices), ("empty", lambda: meshfolio.curvature(meshfolio.Mesh.__new__(meshfolio.Mesh))),
            ("empty", lambda: meshfolio.Spectrum.__new__(meshfolio.Spectrum).eigenvalues), ("spectrum", lambda: meshfolio.Spectrum()),
            ("spectrum", lambda: meshfolio.Spectrum(1, k=2)), ("1 value, ", lambda: meshfolio.render(mesh, values=[1])),
            (r"shape \(\)", lambda: meshfolio.figure([mesh, mesh], values=[1, 2])),
        ):  # fmt: skip
            with self.subTest(words=words), self.assertRaisesRegex(meshfolio.Error, words) as caught:
                call()
            str(caught.exception).encode()
        self.assertEqual(list(meshfolio.Mesh(thing(vertices=X, faces=F, point_data=[1])).attributes), [])
        self.assertEqual(meshfolio.Mesh(thing(vertices=X, faces=F, name=half)).name, "?")

    def test_a_file_called_by_other_bytes_has_a_name_that_can_be_printed(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a\udcff.ply"
            meshfolio.save(TETRAHEDRON, path)
            mesh = meshfolio.load(path)
            self.assertTrue(mesh.name.endswith("a\ufffd.ply"), ascii(mesh.name))
            self.assertEqual(pickle.loads(pickle.dumps(meshfolio.Mesh(mesh))).name, mesh.name)
            self.assertIsNone(meshfolio.figure(mesh, path=Path(folder) / "b\udcff.png", dpi=36))

    def test_a_missing_file_has_its_number(self):
        with self.assertRaises(FileNotFoundError) as caught:
            meshfolio.load(Path("no") / "mesh.ply")
        self.assertEqual(caught.exception.errno, errno.ENOENT)

    def test_truncated_spectra_and_growing_modes_are_warned_of(self):
        mesh = meshfolio.sample("cube8")
        with self.assertWarnsRegex(RuntimeWarning, "has 8 modes, fewer than the 9 asked for"):
            self.assertEqual(len(meshfolio.spectrum(mesh, 9).eigenvalues), 8)
        with self.assertWarnsRegex(RuntimeWarning, "each iteration multiplies the highest mode by"):
            meshfolio.smooth(meshfolio.sample("sphere"), 1.2, unit="tau", scheme="taubin", mu=-1e-3)

    def test_steps_beyond_the_limit_warn_and_then_blow_up(self):
        mesh = meshfolio.sample("cube")
        with self.assertWarnsRegex(RuntimeWarning, "largest stable step"):
            meshfolio.smooth(mesh, 1.1, unit="tau")
        with self.assertRaisesRegex(meshfolio.SolverError, "blew up in iteration"):
            meshfolio.smooth(mesh, 3, unit="tau", iterations=200)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            meshfolio.smooth(mesh, 0.9, unit="tau")


class Numbers(unittest.TestCase):
    def setUp(self):
        self.mesh = meshfolio.sample("cube")

    def test_the_laplacian_is_the_cotangent_one_of_every_mesh(self):
        for name in ("cube", "lily", "creature", "fandisk_noisy"):
            mesh = meshfolio.sample(name)
            C, M = meshfolio.laplacian(mesh)
            theirs, masses = cotangent_laplacian(mesh)
            with self.subTest(name=name):
                self.assertLess(abs(C - theirs).max(), 1e-10 * abs(theirs).max())
                np.testing.assert_allclose(M, masses, rtol=1e-12, atol=0)

    def test_eigenvalues_are_those_of_a_dense_solver_and_proved_complete(self):
        found = meshfolio.spectrum(self.mesh, 25)
        C, M = cotangent_laplacian(self.mesh)
        np.testing.assert_allclose(found.eigenvalues[1:], all_eigenvalues(self.mesh)[1:25], rtol=1e-8)
        self.assertEqual(found.eigenvalues[0], 0)
        Phi = found.eigenvectors
        self.assertEqual(Phi.shape, (len(self.mesh.vertices), 25))
        np.testing.assert_allclose(Phi.T @ (M[:, None] * Phi), np.eye(25), atol=1e-9)
        np.testing.assert_allclose(-C @ Phi, M[:, None] * Phi * found.eigenvalues, atol=1e-6)
        self.assertEqual(found.certificate, "proved")
        self.assertLess(found.residuals.max(), 1e-8)

    def test_the_largest_stable_step_is_two_over_the_largest_eigenvalue(self):
        facts = meshfolio.inspect(self.mesh)
        self.assertAlmostEqual(facts["lambda_crit"] * all_eigenvalues(self.mesh)[-1] / 2, 1, delta=1e-8)
        low, high = facts["lambda_crit_proved"]
        self.assertLessEqual(low, high)
        self.assertEqual((facts["vertices"], facts["euler_characteristic"]), (len(self.mesh.vertices), 2))
        self.assertAlmostEqual(facts["area"], triangle_geometry(self.mesh)[3].sum(), delta=1e-12)

    def test_curvatures_agree_with_their_formulas(self):
        mesh = meshfolio.sample("torus")
        columns = meshfolio.curvature(mesh, jets=True)
        self.assertLessEqual({"area", "h_uniform", "k_gauss", "h_cotan", "h_uniform_scaled", "h_jet", "k_jet"}, set(columns))
        C, M = cotangent_laplacian(mesh)
        np.testing.assert_allclose(columns["area"], M, rtol=1e-12)
        H = np.linalg.norm(C @ mesh.vertices, axis=1) / M / 2
        np.testing.assert_allclose(abs(columns["h_cotan"]), H, rtol=1e-8, atol=1e-10)
        angles = triangle_geometry(mesh)[1]
        deficits = 2 * np.pi - np.bincount(mesh.faces.ravel(), angles.ravel())
        np.testing.assert_allclose(columns["k_gauss"], deficits / M, atol=1e-9)
        self.assertTrue(np.isnan(meshfolio.curvature(meshfolio.sample("lily"))["k_gauss"]).any(), "undefined on the boundary")

    def test_smoothing_steps_agree_with_their_formulas(self):
        C, M = cotangent_laplacian(self.mesh)
        X, limit = self.mesh.vertices, 2 / all_eigenvalues(self.mesh)[-1]
        explicit = meshfolio.smooth(self.mesh, 0.3 * limit)
        np.testing.assert_allclose(explicit.vertices, X + 0.3 * limit * (C @ X) / M[:, None], atol=1e-12)
        np.testing.assert_allclose(explicit.vertices, meshfolio.smooth(self.mesh, 0.3, unit="tau").vertices, atol=1e-9)
        implicit = meshfolio.smooth(self.mesh, 10 * limit, scheme="implicit")
        solution = scipy.sparse.linalg.spsolve((scipy.sparse.diags(M) - 10 * limit * C).tocsc(), M[:, None] * X)
        np.testing.assert_allclose(implicit.vertices, solution, atol=1e-10)
        self.assertTrue((explicit.faces == self.mesh.faces).all())
        self.assertLess(meshfolio.inspect(implicit)["area"], meshfolio.inspect(self.mesh)["area"], "of the new positions")

    def test_noise_has_its_deviation_and_its_seed(self):
        mesh = meshfolio.sample("sphere")
        noisy = meshfolio.noise(mesh, 0.01, seed=3)
        self.assertAlmostEqual((noisy.vertices - mesh.vertices).std(), 0.01, delta=0.0005)
        np.testing.assert_array_equal(noisy.vertices, meshfolio.noise(mesh, 0.01, seed=3).vertices)
        self.assertTrue((noisy.vertices != meshfolio.noise(mesh, 0.01, seed=4).vertices).any())
        np.testing.assert_array_equal(meshfolio.noise(mesh, 0).vertices, mesh.vertices)
        difference = meshfolio.compare(mesh, noisy)
        distances = np.linalg.norm(noisy.vertices - mesh.vertices, axis=1)
        self.assertAlmostEqual(difference["rms"], np.sqrt((distances**2).mean()), delta=1e-14)
        self.assertEqual(difference["max"], distances.max())
        self.assertLessEqual(difference["hausdorff"], difference["max"])
        self.assertLessEqual(difference["hausdorff"], difference["hausdorff_bound"])
        self.assertLessEqual(difference["hausdorff_bound"], 1.001 * difference["hausdorff"])
        narrow = meshfolio.compare(mesh, noisy, accuracy=1e-6)
        self.assertLessEqual(narrow["hausdorff_bound"], (1 + 1e-6) * narrow["hausdorff"])
        with self.assertRaises(meshfolio.UsageError):
            meshfolio.compare(mesh, noisy, accuracy=0)
        self.assertIsInstance(difference["inverted_faces"], int)

    def test_surfaces_with_other_faces_are_as_far_apart_as_their_planes(self):
        ramp = meshfolio.Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        ground = meshfolio.Mesh([[-9, -9, -3], [9, -9, -3], [9, 9, -3], [-9, 9, -3], [0, 0, 7]], [[0, 1, 2], [0, 2, 3]])
        np.testing.assert_allclose(meshfolio.distances(ramp, ground), [3, 3, 3], rtol=1e-14)
        self.assertTrue(np.isnan(meshfolio.distances(ground, ramp)[4]))
        difference = meshfolio.compare(ramp, ground)
        self.assertAlmostEqual(difference["rms_a_to_b"], 3, delta=1e-12)
        self.assertNotIn("inverted_faces", difference)


    def test_every_wrong_argument_is_refused_in_words(self):
        mesh = meshfolio.sample("cube8")
        wrong = {"MeshLike": ["no.obj", 5, None, mesh.vertices, object()], "str": [["x"], 5], "int": ["5", 5.5, 2**70], "float": ["x", 1j, [1, 2]],
                 "bool": ["yes", 2], "Path": [5, None, "a\0b"], "Limits": [5, (1,), ("a", "b")], "Camera": [5, (1,), ("a", 2), (0, 91)],
                 "Color": ["red", 5, "#12345"], "Words": [5, [5]]}  # fmt: skip
        right = {"MeshLike": mesh, "Path": "mesh.obj", "k": 1, "sigma": 0.1, "name": "cube8", "meshes": mesh, "str": "cube8"}
        tried = 0
        for function in (getattr(meshfolio, name) for name in meshfolio.__all__ if not isinstance(getattr(meshfolio, name), type)):
            arguments = inspect.signature(function).parameters
            needed = {n: right.get(n, right.get(a.annotation)) for n, a in arguments.items() if a.default is inspect.Parameter.empty}
            for name, argument in arguments.items():
                kind = argument.annotation.replace("Optional[", "").rstrip("]")
                for value in wrong.get(kind, [["x"], 5] if kind in ("Area", "Operator", "Scheme", "StepUnit", "NoiseUnit", "Axis", "Fit") else []):
                    if value is None and kind != argument.annotation:
                        continue
                    tried += 1
                    with self.subTest(function=function.__name__, name=name, value=value), self.assertRaises(meshfolio.Error) as caught:
                        function(**dict(needed, **{name: value}))
                    self.assertRegex(str(caught.exception), rf"\b{name}\b|azimuth|elevation|no\.obj")
                    self.assertNotRegex(str(caught.exception), "incompatible|meshfolio\\.|--")
            for call in (lambda: function(*[mesh] * 9), lambda: function(**needed, wrong=1), lambda: function(**dict(list(needed.items())[1:]))):
                with self.subTest(function=function.__name__), self.assertRaisesRegex(meshfolio.UsageError, rf"^{function.__name__}\(\): .*it takes"):
                    call()
        self.assertGreater(tried, 100)
        with self.assertRaisesRegex(meshfolio.UsageError, "did you mean 'operator'"):
            meshfolio.curvature(mesh, opertor="cotan")

    def test_warnings_name_the_line_of_the_caller(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            meshfolio.spectrum(meshfolio.sample("cube8"), 9)
        self.assertEqual(caught[0].filename, __file__)


def thing(**attributes):
    return types.SimpleNamespace(**attributes)


class OtherPackages(unittest.TestCase):
    """Stand-ins have the attributes of the other packages' classes."""

    def setUp(self):
        self.X, self.F = TETRAHEDRON
        self.counted = np.insert(self.F, 0, 3, axis=1).ravel()

    def meshes(self):
        h = {"h": np.arange(4.0), "words": ["a"] * 4, "of_faces": np.zeros(5)}
        yield "h", "x.obj", thing(vertices=np.asfortranarray(self.X), faces=self.F, vertex_attributes=h, metadata={"file_name": "x.obj"})   # trimesh
        yield "h", "mesh", thing(points=self.X.astype(np.float32), faces=self.counted, point_data=h)   # PyVista
        yield "", "mesh", thing(points=self.X, cells_dict={5: self.F, 10: [[0, 1, 2, 3]]})   # PyVista's grid
        yield "", "mesh", thing(points=self.X.astype(int), cells_dict={"line": [[0, 1]], "triangle": self.F.astype(np.uint64)})   # meshio
        yield "", "open3d", thing(vertices=self.X.tolist(), triangles=self.F.tolist(), name="open3d")
        yield "", "mesh", (self.X, self.F)
        yield "", "mesh", (self.X.tolist(), [[0, 2, 1], [0, 1, 3], (0, 3, 2), [1, 2, 3]])

    def test_every_function_takes_their_meshes(self):
        own = meshfolio.Mesh(self.X, self.F)
        for attribute, name, theirs in self.meshes():
            with self.subTest(theirs=theirs), tempfile.TemporaryDirectory() as folder:
                mesh = meshfolio.Mesh(theirs)
                self.assertEqual((list(mesh.attributes), mesh.name), ([attribute] if attribute else [], name))
                np.testing.assert_array_equal(mesh.vertices, own.vertices)
                np.testing.assert_array_equal(mesh.faces, own.faces)
                np.testing.assert_array_equal(meshfolio.curvature(theirs)["k_gauss"], meshfolio.curvature(own)["k_gauss"])
                np.testing.assert_array_equal(meshfolio.laplacian(theirs)[1], meshfolio.laplacian(own)[1])
                np.testing.assert_array_equal(meshfolio.spectrum(theirs, 2).eigenvalues, meshfolio.spectrum(own, 2).eigenvalues)
                for function, arguments in ((meshfolio.smooth, ()), (meshfolio.noise, (0.1,))):
                    result = function(theirs, *arguments)
                    self.assertIsInstance(result, meshfolio.Mesh)
                    np.testing.assert_array_equal(result.vertices, function(own, *arguments).vertices)
                self.assertEqual(meshfolio.compare(theirs, theirs)["max"], 0)
                self.assertEqual(meshfolio.distances(theirs, own).max(), 0)
                self.assertEqual(meshfolio.inspect(theirs)["area"], own.area)
                np.testing.assert_array_equal(meshfolio.render(theirs, views="+x", size=40), meshfolio.render(own, views="+x", size=40))
                meshfolio.save(theirs, Path(folder) / "t.ply")
                self.assertEqual(list(meshfolio.load(Path(folder) / "t.ply").attributes), list(mesh.attributes))

    def test_polygons_are_cut_into_triangles_of_one_area(self):
        X = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0], [1, 2, 0]])
        for faces in ([[0, 1, 2, 3]], np.array([[0, 1, 2, 3]], dtype=np.uint8), [4, 0, 1, 2, 3], {"quad": [[0, 1, 2, 3]]}):
            mesh = meshfolio.Mesh(X, faces)
            self.assertEqual((len(mesh.faces), mesh.area), (2, 2))
        for faces in ([[0, 1, 2, 3], [3, 2, 4]], [4, 0, 1, 2, 3, 3, 3, 2, 4], {"quad": [[0, 1, 2, 3]], "triangle": [[3, 2, 4]]}, [[0, 1, 2, 4, 3]]):
            mesh = meshfolio.Mesh(X, faces)
            self.assertEqual((len(mesh.faces), mesh.area), (3, 3))
        for faces, words in (
            ([4, 0, 1, 2], "not the number of corners"), ([-1, 0, 1], "not the number"), ([[3, 0, 1, 2], [3, 0, 2, 3]], "begin with 3"), ([], "no faces"),
            (np.zeros((0, 3), int), "no faces"), ({"tetra": [[0, 1, 2, 3]]}, "tetra; extract"), ([[0, 1, 2, 7]], "vertex 7"), ([["a", "b", "c"]], "no integers"),
            (np.ma.masked_array([[0, 1, 2]], [[0, 0, 1]]), "no integers"), ([[0.0, 1.0, 2.0]], "no integers"),
        ):  # fmt: skip
            with self.subTest(faces=faces), self.assertRaisesRegex(meshfolio.MeshError, words):
                meshfolio.Mesh(X, faces)

    def test_masked_and_read_only_arrays_mean_what_they_say(self):
        masked = np.ma.masked_array(self.X, np.eye(4, 3, dtype=bool))
        with self.assertRaisesRegex(meshfolio.MeshError, "vertex 0 is not finite"):
            meshfolio.Mesh(masked, self.F)
        X = self.X.copy()
        X.setflags(write=False)
        values = np.ma.masked_array([0, 1, 2, 3], [0, 0, 0, 1])
        for field in (values, [0, 1, 2, np.nan], np.array([[0], [1], [2], [np.nan]])):
            np.testing.assert_array_equal(
                meshfolio.render((X, self.F), values=field, size=40), meshfolio.render((X, self.F), values=values.astype(float).filled(np.nan), size=40)
            )
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "t.ply"
            meshfolio.save(meshfolio.Mesh(X, self.F, attributes={"m": values}), path)
            np.testing.assert_array_equal(meshfolio.load(path).attributes["m"], [0, 1, 2, np.nan])

    def test_the_packages_themselves(self):
        real = {
            "trimesh": lambda p: p.Trimesh(self.X, self.F, process=False), "meshio": lambda p: p.Mesh(self.X, [("triangle", self.F)]),
            "pyvista": lambda p: p.PolyData(self.X, self.counted),
        }  # fmt: skip
        tried = 0
        for name, make in real.items():
            try:
                theirs = make(importlib.import_module(name))
            except ImportError:
                continue
            tried += 1
            np.testing.assert_array_equal(meshfolio.Mesh(theirs).faces, self.F)
        try:
            pandas = importlib.import_module("pandas")
            np.testing.assert_array_equal(meshfolio.Mesh(pandas.DataFrame(self.X), pandas.DataFrame(self.F)).vertices, self.X)
        except ImportError:
            pass
        if tried == 0:
            self.skipTest("trimesh, meshio and PyVista are not installed")


class Figures(unittest.TestCase):
    def setUp(self):
        self.mesh = meshfolio.sample("cube8")

    def test_each_ending_has_its_format_and_without_a_path_there_is_a_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            for ending, begins in ((".pdf", b"%PDF-"), (".svg", b"<"), (".PNG", b"\x89PNG")):
                path = Path(folder) / f"figure{ending}"
                self.assertIsNone(meshfolio.figure([self.mesh, TETRAHEDRON], ["x", "gauss"], path, dpi=72, camera=(35, 22)))
                self.assertEqual(path.read_bytes()[: len(begins)], begins)
                first = path.read_bytes()
                meshfolio.figure([self.mesh, TETRAHEDRON], "x,gauss", str(path), dpi=72, camera="35,22")
                self.assertEqual(path.read_bytes(), first)
            self.assertEqual(len(list(Path(folder).iterdir())), 3)
        picture = meshfolio.figure(self.mesh, width_mm=25.4, dpi=100)
        self.assertIsInstance(picture, meshfolio.Picture)
        self.assertEqual(picture.shape[1], 100)

    def test_values_are_fields_and_labels_are_counted(self):
        x = self.mesh.vertices[:, 0]
        by_name = meshfolio.figure(self.mesh, "x", dpi=72, bar=False, range=(-1, 1), colormap="viridis")
        for values in (x, [x], {"x": x}, {"x": [x]}, {"x": x.tolist()}):
            drawn = meshfolio.figure(self.mesh, values=values, dpi=72, bar=False, range=(-1, 1), colormap="viridis")
            np.testing.assert_array_equal(drawn, by_name)
        for wrong in (dict(values=x), dict(values=[x]), dict(values=[x, x[:5]]), dict(values={"x": 5}), dict(labels=["a"]), dict(labels=5)):
            with self.subTest(wrong=wrong), self.assertRaises(meshfolio.Error):
                meshfolio.figure([self.mesh, self.mesh], **wrong)
        with self.assertRaisesRegex(meshfolio.UsageError, "empty"):
            meshfolio.figure([])
        for fields in ([], "", (), {}, ",", ["x", ""]):
            with self.subTest(fields=fields), self.assertRaisesRegex(meshfolio.UsageError, "field"):
                meshfolio.figure(self.mesh, fields)
        np.testing.assert_array_equal(meshfolio.figure(self.mesh, [], values=x, dpi=72), meshfolio.figure(self.mesh, values=x, dpi=72))
        with self.assertRaisesRegex(meshfolio.UsageError, "id does not go with a figure"):
            meshfolio.figure(self.mesh, "id")
        for path in ("figure", "figure.eps", "/nowhere/at/all.pdf"):
            with self.assertRaisesRegex(meshfolio.Error, path):
                meshfolio.figure(self.mesh, path=path)

    def test_labels_are_words_with_commas_even_of_one_mesh(self):
        with tempfile.TemporaryDirectory() as folder:
            for meshes, labels in ((self.mesh, "one, of one"), (self.mesh, ["one, of one"]), ([self.mesh] * 2, ["one, of one", "b"])):
                path = Path(folder) / "f.svg"
                meshfolio.figure(meshes, "x", path, labels=labels, dpi=72)
                self.assertEqual(len(re.findall("<text[^>]*>one, of one<", path.read_text(encoding="utf-8"))), 1)
            meshfolio.figure(self.mesh, "x", path, labels="mine", views="+x,hero,camera", camera=(20, 5), dpi=72)
            for words in ("mine, +x", "mine, three-quarter view", "mine, camera"):
                self.assertIn(f">{words}<", path.read_text(encoding="utf-8"))
        with self.assertRaisesRegex(meshfolio.UsageError, "as many as meshes"):
            meshfolio.figure(self.mesh, labels=["a", "b"])
        pair = ((self.mesh.vertices, self.mesh.faces), (self.mesh.vertices, self.mesh.faces))
        np.testing.assert_array_equal(meshfolio.figure(pair, dpi=72), meshfolio.figure(list(pair), dpi=72))


class Pictures(unittest.TestCase):
    def test_a_camera_along_an_axis_sees_what_its_view_shows(self):
        mesh = meshfolio.sample("creature")
        for view, camera in (("+z", (0, 0)), ("+x", (90, 0)), ("-z", (180, 0))):
            seen = meshfolio.render(mesh, camera=camera, size=80)
            shown = meshfolio.render(mesh, views=[view], size=80)
            self.assertLess(abs(seen.astype(float) - shown).mean(), 6, view)
        small = meshfolio.render(mesh, views="+z", zoom=0.5, size=80, transparent=True)[:, :, 3].sum()
        large = meshfolio.render(mesh, views="+z", size=80, transparent=True)[:, :, 3].sum()
        self.assertAlmostEqual(large / small, 4, delta=0.3)
        self.assertFalse((meshfolio.render(mesh, camera=(35, 22), up="z", size=80) == meshfolio.render(mesh, camera=(35, 22), size=80)).all())
        sheet = meshfolio.render(mesh, views=["+x", "camera"], camera=(35, 22, 10), size=80)
        np.testing.assert_array_equal(sheet, meshfolio.render(mesh, views="+x,camera", camera="35,22,10", size=80))


    def test_a_view_is_an_array_and_covers_the_disc_of_a_sphere(self):
        sphere = meshfolio.sample("sphere")
        picture = meshfolio.render(sphere, views="+z", size=(120, 80))
        self.assertIsInstance(picture, np.ndarray)
        self.assertEqual((picture.shape, picture.dtype), ((80, 120, 4), np.uint8))
        self.assertTrue((picture[0, 0] == 255).all(), "white ground")
        self.assertTrue((picture[40, 60, :3] < 255).any(), "something in the middle")
        clear = meshfolio.render(sphere, views="+z", size=80, transparent=True)
        disc = np.pi * (0.92 * 80 / 2) ** 2
        self.assertAlmostEqual((clear[:, :, 3] / 255).sum(), disc, delta=0.01 * disc)

    def test_values_are_coloured_and_six_views_are_a_sheet(self):
        torus = meshfolio.sample("torus")
        by_name = meshfolio.render(torus, "x", views="+y", size=100, range=(-1, 1), colormap="viridis")
        by_values = meshfolio.render(torus, values=torus.vertices[:, 0], views="+y", size=100, range=(-1, 1), colormap="viridis")
        np.testing.assert_array_equal(by_name, by_values)
        sheet = meshfolio.render(torus, size=60)
        self.assertGreater(min(sheet.shape[:2]), 120)

    def test_a_notebook_shows_meshes_and_pictures(self):
        mesh = meshfolio.sample("cube8")
        picture = meshfolio.render(mesh, views="hero", size=50)
        for shown in (picture, mesh):
            self.assertEqual(shown._repr_png_()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertIn("12 faces", mesh._repr_html_())
        self.assertIsNone(picture[0]._repr_png_(), "a row is no picture")
        with tempfile.TemporaryDirectory() as folder:
            picture.save(Path(folder) / "cube.png")
            self.assertEqual((Path(folder) / "cube.png").read_bytes(), picture._repr_png_())
            picture[::2, ::-1].save(Path(folder) / "half.png")
            for wrong in (picture[:0], picture[0], picture / 255, picture[:, :, :3], picture.astype(int)):
                with self.assertRaisesRegex(meshfolio.UsageError, "height x width x 4 uint8"):
                    wrong.save(Path(folder) / "wrong.png")


LONG = "meshfolio.smooth(meshfolio.sample('sphere', 1), 0.5, unit='tau', iterations=1_000_000)"


class LongCalls(unittest.TestCase):
    def test_python_goes_on_meanwhile(self):
        counted = 0
        done = threading.Event()

        def count():
            nonlocal counted
            while not done.is_set():
                counted += 1
                time.sleep(0.01)

        thread = threading.Thread(target=count)
        thread.start()
        began = time.monotonic()
        meshfolio.smooth(meshfolio.sample("sphere", 1), 0.5, unit="tau", iterations=20_000)
        took = time.monotonic() - began
        done.set()
        thread.join()
        self.assertGreater(counted, 0.05 * took / 0.01 - 1)

    def test_control_c_ends_long_calls_and_their_process_without_delay(self):
        far = "a, b = (meshfolio.sample(name, 3) for name in ('sphere', 'cube'))\n"
        for words in (LONG, far + "print('ready', flush=True)\nmeshfolio.compare(a, b)", far + "print('ready', flush=True)\nmeshfolio.spectrum(a, 40)"):
            if words is LONG:
                words = f"print('ready', flush=True)\n{LONG}"
            words = f"import meshfolio, sys\ntry:\n    " + words.replace("\n", "\n    ") + "\nexcept KeyboardInterrupt:\n    sys.exit(7)"
            began = time.monotonic()
            with self.subTest(words=words), subprocess.Popen([sys.executable, "-c", words], stdout=subprocess.PIPE, text=True) as process:
                self.assertEqual(process.stdout.readline(), "ready\n")
                most = 3 + time.monotonic() - began   # longer on a busy machine
                time.sleep(0.5)
                self.assertIsNone(process.poll(), "it takes long")
                asked = time.monotonic()
                process.send_signal(signal.SIGINT)
                self.assertEqual(process.wait(timeout=60), 7)
                self.assertLess(time.monotonic() - asked, most)


class Stubs(unittest.TestCase):
    def test_annotations_and_docstrings_are_complete(self):
        stubs = ast.parse((SOURCE / "src/python/meshfolio/_core.pyi").read_text(encoding="utf-8"))
        classes = {node.name: node for node in stubs.body if isinstance(node, ast.ClassDef)}
        for name in meshfolio.__all__:
            thing = getattr(meshfolio, name)
            self.assertTrue(thing.__doc__ or name.endswith("Error"), name)
            if name in ("Mesh", "Spectrum"):
                named = [getattr(member, "name", None) or member.target.id for member in classes.pop(name).body]
                members = {member for member in named if not member.startswith("__")}
                self.assertEqual(members, {member for member in dir(thing) if not member.startswith("__")}, name)
                self.assertTrue(all(getattr(thing, member).__doc__ for member in members if not member.startswith("_")), name)
            elif isinstance(thing, type):
                classes.pop(name, None)
            else:
                for argument in inspect.signature(thing).parameters.values():
                    self.assertTrue(argument.annotation, argument)
                    self.assertTrue(argument.name == "mesh" or re.search(rf"\b{argument.name}\b", thing.__doc__), (name, argument.name))
        self.assertFalse(classes)


if __name__ == "__main__":
    unittest.main(verbosity=2)
