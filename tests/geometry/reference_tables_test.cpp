// Areas, curvatures, stability limits and eigenvalues against tests/reference: tables made by another program, in long double, from other
// formulas. The meshes of the project are always there; the shared ones skip where they are absent or another file has taken the name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string>

#include "base/sha256.h"
#include "geometry/curvature/curvature.h"
#include "geometry/operator_test_meshes.h"
#include "geometry/operators/uniform_laplacian.h"
#include "geometry/reference_tables.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "geometry/spectrum/stability.h"
#include "mesh/mesh_checks.h"
#include "mesh/triangle_measures.h"
#include "source_dir.h"

namespace meshfolio {
namespace {

using namespace testing;

constexpr double relative = 1e-9;
/// Closer, so that one vertex among thousands is not lost in a sum.
constexpr double relative_of_sums = 1e-12;
constexpr double relative_of_eigenvalues = 1e-8;
/// A curvature or a Voronoi area is a sum of terms that may cancel, to 0 on a plane; its rounding is a fraction of the terms, not of the
/// sum.
constexpr double of_terms = 1e-13;

/// Undefined in both, or as close as asked to the reference or to 1e-13 of the terms it is the sum of.
void expect_close(double ours, const TableRow& row, const std::string& column, double terms = 0, double asked = relative) {
    const double reference = number(row, column);
    EXPECT_EQ(std::isnan(ours), std::isnan(reference)) << column;
    if (std::isnan(ours) || std::isnan(reference)) return;
    EXPECT_LE(std::abs(ours - reference), asked * std::abs(reference) + of_terms * terms)
        << column << ": " << ours << ", reference " << reference;
}
/// Compares columns by the size of their terms, given in further columns.
void expect_close_for_terms(double ours, const TableRow& row, const std::string& column, double asked = relative) {
    expect_close(ours, row, column, number(row, column + "_terms"), asked);
}

class ReferenceTables : public ::testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        const std::filesystem::path path = path_of_reference_mesh(GetParam());
        if (!std::filesystem::exists(path)) {
            ASSERT_FALSE(is_bundled(GetParam())) << path << " is gone; see tests/reference/README.md";
            GTEST_SKIP() << "no mesh at " << path;
        }
        row = rows_of_mesh("meshes", GetParam()).at(0);
        if (sha256(read_file(path)) != row.at("sha256")) {
            ASSERT_FALSE(is_bundled(GetParam())) << path << " has changed: make the tables anew, see tests/reference/README.md";
            GTEST_SKIP() << path << " is not the file the table was made from";
        }
        prepared = prepare_mesh(read_mesh(path));
    }

    const TriangleMesh& mesh() const { return prepared.mesh; }
    const MeshTopology& topology() const { return prepared.topology; }

    TableRow row;
    PreparedMesh prepared;
};

std::string name_of_test(const ::testing::TestParamInfo<std::string>& mesh) {
    std::string name = mesh.param;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Meshes, ReferenceTables, ::testing::ValuesIn(reference_meshes()), name_of_test);

struct Measured {
    std::map<AreaForm, Vector> areas;
    Vector angle_deficit, H, K;   // by barycentric areas
};
Measured measured(const TriangleMesh& mesh, const MeshTopology& topology) {
    Measured all;
    for (const AreaForm form : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed}) all.areas[form] = vertex_areas(mesh, form);
    all.angle_deficit = angle_deficit(mesh, topology);
    all.H = cotangent_mean_curvature(mesh, topology, laplace_beltrami(mesh));
    all.K = gaussian_curvature(mesh, topology, all.areas[AreaForm::barycentric]);
    return all;
}

void expect_vertices(const Measured& ours, const std::vector<TableRow>& rows) {
    for (const TableRow& row : rows) {
        const int v = whole_number(row, "vertex");
        SCOPED_TRACE("vertex " + std::to_string(v));
        for (const auto& [form, areas] : ours.areas) {
            expect_close(areas[v], row, std::string(name_of(form)), number(row, "barycentric"));
        }
        expect_close(ours.angle_deficit[v], row, "deficit", 2 * pi);
        expect_close_for_terms(ours.H[v], row, "h_cotan");
        expect_close_for_terms(ours.K[v], row, "k_gauss");
    }
}

/// Over all vertices in use, so that none escapes.
void expect_sums_of_areas(const Measured& ours, const MeshTopology& topology, const TableRow& row) {
    for (const auto& [form, areas] : ours.areas) {
        const std::string name(name_of(form));
        std::vector<double> in_use;
        for (int v = 0; v < areas.size(); ++v) {
            if (topology.vertex_faces.size(v) > 0) in_use.push_back(areas[v]);
        }
        const auto [least, largest] = std::minmax_element(in_use.begin(), in_use.end());
        expect_close(areas.sum(), row, name + "_sum", 0, relative_of_sums);
        expect_close(*least, row, name + "_min", number(row, "barycentric_min"));
        expect_close(*largest, row, name + "_max");
    }
    expect_close(ours.angle_deficit.sum(), row, "deficit_sum", 2 * pi * number(row, "vertices"), relative_of_sums);
}

/// ∫|f| and √∫f² by barycentric areas where f is defined, and its signs.
void expect_norms(const Vector& A, const Vector& f, const TableRow& row, const std::string& column) {
    double l1 = 0, square = 0;
    int negative = 0;
    for (Eigen::Index v = 0; v < f.size(); ++v) {
        if (std::isnan(f[v])) continue;
        l1 += A[v] * std::abs(f[v]);
        square += A[v] * f[v] * f[v];
        negative += f[v] < 0 ? 1 : 0;
    }
    expect_close_for_terms(l1, row, column + "_l1", relative_of_sums);
    expect_close_for_terms(std::sqrt(square), row, column + "_l2", relative_of_sums);
    const int surely_negative = whole_number(row, column + "_negative");
    EXPECT_GE(negative, surely_negative) << column;
    EXPECT_LE(negative, surely_negative + whole_number(row, column + "_undecided")) << column;
}

TEST_P(ReferenceTables, Counts) {
    EXPECT_EQ(prepared.preflight.vertices_in_use, whole_number(row, "vertices"));
    EXPECT_EQ(prepared.preflight.triangles, whole_number(row, "triangles"));
    EXPECT_EQ(prepared.preflight.euler_characteristic, whole_number(row, "euler"));
    expect_close(prepared.preflight.area, row, "area");
}

TEST_P(ReferenceTables, AreasAndCurvatures) {
    const Measured ours = measured(mesh(), topology());
    expect_vertices(ours, rows_of_mesh("vertices", GetParam()));
    expect_sums_of_areas(ours, topology(), row);
    expect_norms(ours.areas.at(AreaForm::barycentric), ours.H, row, "h_cotan");
    expect_norms(ours.areas.at(AreaForm::barycentric), ours.K, row, "k_gauss");
}

TEST_P(ReferenceTables, UniformMeanCurvature) {
    const Vector H = uniform_mean_curvature(mesh(), topology());
    for (const TableRow& vertex : rows_of_mesh("vertices", GetParam())) {
        SCOPED_TRACE("vertex " + vertex.at("vertex"));
        expect_close_for_terms(H[whole_number(vertex, "vertex")], vertex, "h_uniform");
    }
    expect_norms(vertex_areas(mesh(), AreaForm::barycentric), H, row, "h_uniform");
}

TEST_P(ReferenceTables, StabilityLimits) {
    const LargestEigenvalue top = largest_eigenvalue(laplace_beltrami(mesh()));
    expect_close(top.value, row, "mu_max");
    expect_close(largest_stable_step(top), row, "lambda_crit");
    expect_close(top.upper_bound, row, "gershgorin");

    expect_close(largest_stable_step(largest_eigenvalue(uniform_operator(topology()))), row, "lambda_crit_uniform");
}

TEST_P(ReferenceTables, Eigenvalues) {
    const std::vector<TableRow> rows = rows_of_mesh("eigenvalues", GetParam());
    const Spectrum spectrum = smallest_eigenpairs(laplace_beltrami(mesh()), whole_number(rows.back(), "index") + 1);
    for (const TableRow& wanted : rows) {
        const int i = whole_number(wanted, "index");
        const double mu = number(wanted, "eigenvalue");
        EXPECT_LE(std::abs(spectrum.eigenvalues[i] - mu), relative_of_eigenvalues * mu)
            << "eigenvalue " << i << ": " << spectrum.eigenvalues[i] << ", reference " << mu;
    }
}

// Laws that the tables themselves must obey.
TEST(ReferenceTablesThemselves, CoverEveryBundledMesh) {
    const std::vector<std::string> known = reference_meshes();
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(MESHFOLIO_SOURCE_DIR) / "data")) {
        if (entry.path().extension() != ".obj") continue;
        const std::string name = "data/" + entry.path().filename().string();
        EXPECT_EQ(std::count(known.begin(), known.end(), name), 1) << name << " has no reference values; see tests/reference/README.md";
    }
}

TEST(ReferenceTablesThemselves, ObeyTheLaws) {
    for (const TableRow& row : reference_table("meshes")) {
        SCOPED_TRACE(row.at("mesh"));
        EXPECT_NEAR(number(row, "deficit_sum"), 2 * pi * number(row, "euler"), 1e-14);   // Gauss–Bonnet
        for (const std::string form : {"barycentric", "voronoi", "mixed"}) {
            EXPECT_NEAR(number(row, form + "_sum") / number(row, "area"), 1, 1e-15) << form;
        }
        EXPECT_LT(number(row, "mu_max"), number(row, "gershgorin"));
        EXPECT_GE(number(row, "lambda_crit_uniform"), 1);   // the spectrum lies in [0, 2]
    }
    double before = 0;
    for (const TableRow& row : reference_table("eigenvalues")) {
        const double mu = number(row, "eigenvalue");
        const bool first = whole_number(row, "index") == 0;
        EXPECT_EQ(mu == 0, first) << row.at("mesh");   // every mesh here is one component
        EXPECT_GE(mu, first ? 0 : before * (1 - 1e-12)) << row.at("mesh");
        before = mu;
    }
}

}   // namespace
}   // namespace meshfolio
