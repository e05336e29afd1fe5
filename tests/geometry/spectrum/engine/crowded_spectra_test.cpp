// Spectra of ordinary CAD meshes: wheels, bipyramids, capped cylinders, combs of equal bodies, fans on one edge. Their eigenvalues are
// multiple, or so close to each other that a Krylov space hardly tells them apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/operators/laplace_operator.h"
#include "geometry/solver_test_meshes.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/spectrum_certificate.h"
#include "geometry/spectrum/spectrum_expectations.h"

using namespace meshfolio;
using namespace meshfolio::testing;

namespace {

/// `hubs` vertices on the axis, first in order, each joined to all n of a rim.
TriangleMesh wheel(int n, int hubs) {
    TriangleMesh mesh{Positions(n + hubs, 3), Faces(n * hubs, 3)};
    for (int h = 0; h < hubs; ++h) mesh.X.row(h) << 0, 0, h == 0 ? 0.3 : -0.3;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * pi * i / n;
        mesh.X.row(hubs + i) << std::cos(angle), std::sin(angle), 0;
        const int a = hubs + i, b = hubs + (i + 1) % n;
        mesh.F.row(i) << 0, a, b;
        if (hubs == 2) mesh.F.row(n + i) << 1, b, a;
    }
    return mesh;
}

/// Returns the eigenvalues of the uniform operator: 1 − cos(2πj/n) · 2/(2 + hubs) of the rim, and those of the hubs.
Vector wheel_spectrum(int n, int hubs) {
    std::vector<double> mu = hubs == 1 ? std::vector{0.0, 4.0 / 3} : std::vector{0.0, 1.0, 1.5};
    for (int j = 1; j < n; ++j) mu.push_back(1 - 2.0 / (2 + hubs) * std::cos(2 * pi * j / n));
    std::sort(mu.begin(), mu.end());
    return Eigen::Map<const Vector>(mu.data(), static_cast<Eigen::Index>(mu.size()));
}

/// A tube of two rings of n vertices, closed by a fan at each end.
TriangleMesh capped_cylinder(int n, double height) {
    TriangleMesh mesh{Positions(2 * n + 2, 3), Faces(4 * n, 3)};
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * pi * i / n;
        mesh.X.row(i) << std::cos(angle), std::sin(angle), 0;
        mesh.X.row(n + i) << std::cos(angle), std::sin(angle), height;
        const int a = i, b = (i + 1) % n, c = n + a, d = n + b;
        mesh.F.row(4 * i) << a, b, d;
        mesh.F.row(4 * i + 1) << a, d, c;
        mesh.F.row(4 * i + 2) << 2 * n, b, a;
        mesh.F.row(4 * i + 3) << 2 * n + 1, c, d;
    }
    mesh.X.row(2 * n) << 0, 0, 0;
    mesh.X.row(2 * n + 1) << 0, 0, height;
    return mesh;
}

/// n equal triangles on one edge, turned about it.
TriangleMesh book(int n) {
    TriangleMesh mesh{Positions(n + 2, 3), Faces(n, 3)};
    mesh.X.row(0) << 0, 0, 0;
    mesh.X.row(1) << 0, 0, 1;
    for (int i = 0; i < n; ++i) {
        mesh.X.row(i + 2) << std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0.5;
        mesh.F.row(i) << 0, 1, i + 2;
    }
    return mesh;
}

/// n equal cubes in a row, each joined to the next by a narrow triangle.
TriangleMesh comb(int n) {
    const TriangleMesh tooth = cube_mesh(4);
    TriangleMesh all = tooth;
    for (int i = 1; i < n; ++i) all = side_by_side(all, moved_by(tooth, {1.5 * i, 2.0 * i, 3.0 * i}));
    const int size = tooth.vertex_count();
    Faces faces(all.face_count() + n - 1, 3);
    faces.topRows(all.face_count()) = all.F;
    for (int i = 1; i < n; ++i) faces.row(all.face_count() + i - 1) << size * (i - 1), size * (i - 1) + 1, size * i;
    all.F = faces;
    return all;
}

void expect_dense_values(const LaplaceBeltrami& laplacian, int k, const std::string& what) {
    const Spectrum dense = smallest_eigenpairs(laplacian, k, by_dense), sliced = smallest_eigenpairs(laplacian, k, by_lanczos);
    const double unit = 1e-3 * dense.eigenvalues[k - 1];
    EXPECT_LT(((sliced.eigenvalues - dense.eigenvalues).array() / (dense.eigenvalues.array() + unit)).abs().maxCoeff(), 1e-9) << what;
    EXPECT_LT(orthonormality_error(sliced, laplacian.M), 1e-10) << what;
}

}   // namespace

TEST(CrowdedSpectra, OfWheelsAndBipyramidsAreTheirClosedForms) {
    for (const int hubs : {1, 2}) {
        for (const int n : {300, 1000, 6000}) {
            const LaplaceBeltrami laplacian = laplace_operator(wheel(n, hubs), OperatorKind::uniform);
            const Vector exact = wheel_spectrum(n, hubs);
            for (const int k : {2, 5, 30}) {
                const Spectrum spectrum = smallest_eigenpairs(laplacian, k);
                EXPECT_LT((spectrum.eigenvalues - exact.head(k)).cwiseAbs().maxCoeff(), 1e-11) << n << ", k = " << k;
                EXPECT_LT(orthonormality_error(spectrum, laplacian.M), 1e-11) << n;
            }
        }
    }
}

TEST(CrowdedSpectra, OfAWheelAreCompleteForEveryK) {
    constexpr int n = 60;
    const LaplaceBeltrami laplacian = laplace_operator(wheel(n, 1), OperatorKind::uniform);
    const Vector exact = wheel_spectrum(n, 1);
    for (int k = 1; k <= n + 1; ++k) {
        const Spectrum spectrum = smallest_eigenpairs(laplacian, k, by_lanczos);
        EXPECT_LT((spectrum.eigenvalues - exact.head(k)).cwiseAbs().maxCoeff(), 1e-12) << k;
    }
}

TEST(CrowdedSpectra, UnderEveryOperatorAreThoseOfTheDenseSolver) {
    const std::vector<std::pair<std::string, TriangleMesh>> meshes = {{"wheel", wheel(400, 1)},
                                                                      {"bipyramid", wheel(300, 2)},
                                                                      {"cylinder", capped_cylinder(150, 0.01)},
                                                                      {"tall", capped_cylinder(150, 5)},
                                                                      {"book", book(200)},
                                                                      {"comb", comb(8)},
                                                                      {"strip", grid_mesh(120, 2, 120, 1)}};
    for (const auto& [name, mesh] : meshes) {
        for (const OperatorEntry& entry : operator_list()) {
            const bool intrinsic = entry.kind == OperatorKind::idt || entry.kind == OperatorKind::idt_original_mass;
            if (intrinsic && name == "book") continue;   // no manifold
            const LaplaceBeltrami laplacian = laplace_operator(mesh, entry.kind);
            const int n = mesh.vertex_count();
            if (definiteness(laplacian, assembly_of(entry.kind)).indefinite()) continue;
            for (const int k : {5, 40, n - 3})
                expect_dense_values(laplacian, k, name + ", " + std::string(entry.name) + ", k = " + std::to_string(k));
        }
    }
}

// All n apexes alike: one eigenvalue of multiplicity n − 1.
TEST(CrowdedSpectra, OfManyTrianglesOnOneEdgeHaveOneValueOfAllButOne) {
    for (const int n : {300, 4000}) {
        const LaplaceBeltrami laplacian = laplace_beltrami(book(n));
        const Spectrum spectrum = smallest_eigenpairs(laplacian, 12);
        const double stiffness = -laplacian.C.coeff(2, 2) / laplacian.M[2];
        for (int j = 1; j < 12; ++j) EXPECT_NEAR(spectrum.eigenvalues[j] / stiffness, 1, 1e-9) << n;
        EXPECT_LT(orthonormality_error(spectrum, laplacian.M), 1e-10);
    }
}
