"""The Python module against what NumPy and SciPy compute of the same meshes. Skipped (77) where NumPy or SciPy is missing."""

import ast
import gc
import signal
import subprocess
import sys
import tempfile
import threading
import time
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
    """Corners (m x 3 x 3), angles and cotangents (m x 3, of corner k), areas (m)."""
    corners = mesh.vertices[mesh.faces]
    u, v = np.roll(corners, -1, axis=1) - corners, np.roll(corners, -2, axis=1) - corners
    dots, crosses = np.einsum("tki,tki->tk", u, v), np.linalg.norm(np.cross(u, v), axis=2)
    return corners, np.arctan2(crosses, dots), dots / crosses, crosses[:, 0] / 2


def cotangent_laplacian(mesh):
    """C_ij = (cot alpha + cot beta)/2 off the diagonal, rows summing to 0; M a third of the areas around."""
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

    def test_lists_are_taken_and_repairs_are_told(self):
        square = meshfolio.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 3, 2], [0, 1, 2]])
        self.assertEqual(len(square.faces), 2)
        self.assertGreaterEqual(len(square.warnings), 2, square.warnings)


class Errors(unittest.TestCase):
    def test_each_type_is_a_class_with_the_words_of_the_command_line(self):
        mesh = meshfolio.sample("cube8")
        for kind, also, words, call in (
            (meshfolio.InputError, OSError, "no.obj", lambda: meshfolio.load("no.obj")),
            (meshfolio.UsageError, ValueError, "cotan", lambda: meshfolio.laplacian(mesh, operator="cotann")),
            (meshfolio.UsageError, ValueError, "barycentric", lambda: meshfolio.curvature(mesh, area="all")),
            (meshfolio.UsageError, ValueError, "h-cotan", lambda: meshfolio.render(mesh, "h-cotam")),
            (meshfolio.UsageError, ValueError, "size", lambda: meshfolio.render(mesh, size=0)),
            (meshfolio.UsageError, ValueError, "lo < hi", lambda: meshfolio.render(mesh, "x", range=(2, 1))),
            (meshfolio.MeshError, ValueError, "4 x 2", lambda: meshfolio.Mesh(np.zeros((4, 2)), mesh.faces)),
            (meshfolio.MeshError, ValueError, "reshape", lambda: meshfolio.Mesh(mesh.vertices, [3, 0, 1, 2])),
            (meshfolio.MeshError, ValueError, "face 1", lambda: meshfolio.Mesh(mesh.vertices, [[0, 1, 2], [0, 1, 8]])),
            (meshfolio.MeshError, ValueError, "vertex 0", lambda: meshfolio.Mesh(mesh.vertices * np.nan, mesh.faces)),
            (meshfolio.MeshError, ValueError, "integers", lambda: meshfolio.Mesh(mesh.vertices, mesh.faces * 1.0)),
            (meshfolio.MeshError, ValueError, "values", lambda: meshfolio.render(mesh, values=[1.0])),
            (meshfolio.OutputError, OSError, "nowhere", lambda: meshfolio.save(mesh, "/nowhere/at/all.ply")),
            (meshfolio.UsageError, ValueError, "mesh.txt", lambda: meshfolio.save(mesh, "mesh.txt")),
        ):
            with self.subTest(words=words), self.assertRaises(kind) as caught:
                call()
            self.assertIsInstance(caught.exception, meshfolio.Error)
            self.assertIsInstance(caught.exception, also)
            self.assertIn(words, str(caught.exception))

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

    def test_curvatures_are_those_of_their_formulas(self):
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

    def test_steps_are_those_of_their_formulas(self):
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
        self.assertIsInstance(difference["inverted_faces"], int)

    def test_surfaces_with_other_faces_are_as_far_apart_as_their_planes(self):
        ramp = meshfolio.Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        ground = meshfolio.Mesh([[-9, -9, -3], [9, -9, -3], [9, 9, -3], [-9, 9, -3], [0, 0, 7]], [[0, 1, 2], [0, 2, 3]])
        np.testing.assert_allclose(meshfolio.distances(ramp, ground), [3, 3, 3], rtol=1e-14)
        self.assertTrue(np.isnan(meshfolio.distances(ground, ramp)[4]))
        difference = meshfolio.compare(ramp, ground)
        self.assertAlmostEqual(difference["rms_a_to_b"], 3, delta=1e-12)
        self.assertNotIn("inverted_faces", difference)


class Pictures(unittest.TestCase):
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

    def test_control_c_ends_a_long_call(self):
        words = f"import meshfolio\nprint('ready', flush=True)\n{LONG}"
        with subprocess.Popen([sys.executable, "-c", words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            self.assertEqual(process.stdout.readline(), "ready\n")
            time.sleep(1)
            self.assertIsNone(process.poll(), "it takes long")
            asked = time.monotonic()
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=60)
            self.assertIn("KeyboardInterrupt", errors)
            self.assertLess(time.monotonic() - asked, 10)


class Stubs(unittest.TestCase):
    def test_stubs_name_all_that_is_there_and_everything_is_explained(self):
        stubs = ast.parse((SOURCE / "src/python/meshfolio/__init__.pyi").read_text(encoding="utf-8"))
        named = {node.name: node for node in stubs.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(set(named), set(meshfolio.__all__))
        for name, node in named.items():
            thing = getattr(meshfolio, name)
            self.assertTrue(issubclass(thing, meshfolio.Error) if name.endswith("Error") else thing.__doc__, name)
            if isinstance(node, ast.FunctionDef) and name != "render":   # pybind11 writes the signature into the first line
                for argument in node.args.args + node.args.kwonlyargs:
                    self.assertIn(f"{argument.arg}: ", thing.__doc__.splitlines()[0])


if __name__ == "__main__":
    unittest.main(verbosity=2)
