#include "output/draw/write_glb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "color/colormap.h"
#include "color/srgb.h"
#include "draw_mesh.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "output/draw/figure_request.h"
#include "output/draw/flat_mesh.h"

using namespace meshfolio;
using namespace meshfolio::output;
using testing_tools::flat_mesh;
using testing_tools::undefined;

namespace {

/// A GLB file as a reader of the format sees it.
struct Glb {
    nlohmann::json json;
    std::string binary;

    explicit Glb(const std::string& bytes) {
        const auto number = [&](std::size_t at) {
            std::uint32_t n;
            std::memcpy(&n, bytes.data() + at, 4);
            return n;
        };
        EXPECT_EQ(bytes.substr(0, 4), "glTF");
        EXPECT_EQ(number(4), 2U);
        EXPECT_EQ(number(8), bytes.size());
        EXPECT_EQ(bytes.substr(16, 4), "JSON");
        json = nlohmann::json::parse(bytes.substr(20, number(12)));
        binary = bytes.substr(20 + number(12) + 8);
    }

    const nlohmann::json& primitive() const { return json["meshes"][0]["primitives"][0]; }
    const nlohmann::json& extras() const { return json["meshes"][0]["extras"]; }
    bool has(const std::string& attribute) const { return primitive()["attributes"].contains(attribute); }
    const nlohmann::json& accessor(const std::string& attribute) const {
        return json["accessors"][attribute == "indices" ? primitive()["indices"].get<std::size_t>()
                                                        : primitive()["attributes"].at(attribute).get<std::size_t>()];
    }

    /// The numbers of an attribute as they are stored, one row a vertex.
    template <class Stored> Eigen::MatrixXd rows(const std::string& attribute) const {
        const auto& described = accessor(attribute);
        const auto& view = json["bufferViews"][described["bufferView"].get<std::size_t>()];
        const int columns = described["type"] == "VEC3" ? 3 : 1;
        const std::size_t stride = view.value("byteStride", sizeof(Stored));
        Eigen::MatrixXd all(described["count"].get<int>(), columns);
        for (int i = 0; i < all.rows(); ++i) {
            for (int k = 0; k < columns; ++k) {
                Stored stored;
                std::memcpy(&stored,
                            binary.data() + view["byteOffset"].get<std::size_t>() + static_cast<std::size_t>(i) * stride +
                                static_cast<std::size_t>(k) * sizeof(Stored),
                            sizeof(Stored));
                all(i, k) = static_cast<double>(stored);
            }
        }
        return all;
    }

    double step() const { return json["nodes"][0]["scale"][0].get<double>(); }
    Positions positions() const {
        const auto& t = json["nodes"][0]["translation"];
        const Eigen::RowVector3d low(t[0].get<double>(), t[1].get<double>(), t[2].get<double>());
        return (step() * rows<std::uint16_t>("POSITION")).rowwise() + low;
    }
};

ColorRange range_of(const Vector& values, const std::string& colormap = "viridis") {
    return robust_range({{"", "", nullptr, values}}, colormap, "height z", "length", 1e-9, 0);
}

std::string glb_of(const TriangleMesh& mesh, const Vector& values) { return write_glb(mesh, values, range_of(values), ball_around(mesh)); }

std::vector<TriangleMesh> meshes() {
    TriangleMesh far = icosphere(2);
    far.X = (1e-3 * far.X).rowwise() + Eigen::RowVector3d(1e3, -2e3, 5);
    return {icosphere(3), cube_mesh(4), flat_mesh(5), far};
}

}   // namespace

TEST(WriteGlb, PositionsComeBackWithinHalfAStepOfTheGrid) {
    for (const TriangleMesh& mesh : meshes()) {
        const Glb glb(glb_of(mesh, mesh.X.col(2)));
        const double largest = bounding_box(mesh).extent().maxCoeff();
        EXPECT_NEAR(glb.step(), largest / 65535, 1e-12 * largest);
        EXPECT_LE((glb.positions() - mesh.X).cwiseAbs().maxCoeff(), 0.5001 * glb.step() + 1e-12 * mesh.X.cwiseAbs().maxCoeff());
    }
}

TEST(WriteGlb, BoundsAreThoseOfTheStoredPositions) {
    for (const TriangleMesh& mesh : meshes()) {
        const Glb glb(glb_of(mesh, mesh.X.col(2)));
        const Eigen::MatrixXd stored = glb.rows<std::uint16_t>("POSITION");
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(glb.accessor("POSITION")["min"][static_cast<std::size_t>(k)], stored.col(k).minCoeff());
            EXPECT_EQ(glb.accessor("POSITION")["max"][static_cast<std::size_t>(k)], stored.col(k).maxCoeff());
        }
    }
}

TEST(WriteGlb, TrianglesKeepTheirOrderAndWinding) {
    const TriangleMesh mesh = icosphere(2);
    const Glb glb(glb_of(mesh, mesh.X.col(2)));
    const Eigen::MatrixXd indices = glb.rows<std::uint16_t>("indices");
    ASSERT_EQ(indices.rows(), mesh.F.size());
    for (int i = 0; i < mesh.F.size(); ++i) EXPECT_EQ(indices(i, 0), mesh.F(i / 3, i % 3));
}

TEST(WriteGlb, NormalsAreTheUnitNormalsOfTheMesh) {
    for (const TriangleMesh& mesh : meshes()) {
        const Eigen::MatrixXd normals = Glb(glb_of(mesh, mesh.X.col(2))).rows<std::int8_t>("NORMAL") / 127;
        EXPECT_LT((normals.rowwise().norm().array() - 1).abs().maxCoeff(), 0.00674) << "what the official validator allows";
        EXPECT_LE((normals - vertex_normals(mesh)).cwiseAbs().maxCoeff(), 0.5 / 127 + 1e-9);
    }
}

TEST(WriteGlb, ValuesAreExactAndUndefinedValuesAreMasked) {
    const TriangleMesh mesh = icosphere(2);
    Vector values = mesh.X.col(0) * 3 - mesh.X.col(1);
    EXPECT_FALSE(Glb(glb_of(mesh, values)).has("_DEFINED")) << "where nothing is undefined";
    values[7] = values[0] = undefined;
    values[9] = 1e300;
    const Glb glb(glb_of(mesh, values));
    const Eigen::MatrixXd stored = glb.rows<float>("_VALUE"), mask = glb.rows<std::uint8_t>("_DEFINED");
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        EXPECT_EQ(mask(v, 0), std::isnan(values[v]) ? 0 : 1) << v;
        const double expected = std::isnan(values[v]) ? 0 : std::min(values[v], double(std::numeric_limits<float>::max()));
        EXPECT_EQ(stored(v, 0), double(static_cast<float>(expected))) << v;
    }
    EXPECT_EQ(glb.extras()["value"]["defined"], "_DEFINED");
}

TEST(WriteGlb, ColoursAreThoseOfTheMapInLinearLight) {
    TriangleMesh mesh = icosphere(1);
    Vector values = mesh.X.col(2);
    ColorRange range = range_of(values);
    range.low = -0.5, range.high = 0.75;
    values[0] = -9, values[1] = 9, values[2] = undefined;
    const Eigen::MatrixXd stored = Glb(write_glb(mesh, values, range, {})).rows<std::uint16_t>("COLOR_0") / 65535;
    const render::Colormap& map = render::colormap_named("viridis");
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const render::Rgba color = v == 2 ? render::DrawOptions().undefined_color : render::color_at(map, (values[v] + 0.5) / 1.25);
        const std::array<std::uint8_t, 3> channels{color.r, color.g, color.b};
        for (int k = 0; k < 3; ++k) {
            const double c = channels[static_cast<std::size_t>(k)] / 255.0;
            const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);   // IEC 61966-2-1
            EXPECT_NEAR(stored(v, k), linear, 1e-5) << v;
        }
    }
}

TEST(WriteGlb, ExtrasHoldQuantityUnitRangeAndFrame) {
    const TriangleMesh mesh = icosphere(1);
    const Glb glb(glb_of(mesh, mesh.X.col(2)));
    const auto& value = glb.extras()["value"];
    EXPECT_EQ(value["quantity"], "height z");
    EXPECT_EQ(value["unit"], "length");
    EXPECT_EQ(value["range"][0], range_of(mesh.X.col(2)).low);
    EXPECT_EQ(value["range"][1], range_of(mesh.X.col(2)).high);
    EXPECT_EQ(value["colors"].size(), render::colormap_named("viridis").stops.size());
    EXPECT_EQ(value["colors"].front(), "#440154");
    EXPECT_EQ(value["colors"].back(), "#fde725");
    EXPECT_NEAR(glb.extras()["frame"]["radius"].get<double>(), 1, 0.1);
}

TEST(WriteGlb, WithoutARangeThereAreNoValues) {
    const Glb glb(write_glb(cube_mesh(2), {}, {}, {}));
    EXPECT_FALSE(glb.has("COLOR_0") || glb.has("_VALUE") || glb.has("_DEFINED"));
    EXPECT_FALSE(glb.extras().contains("value"));
    EXPECT_EQ(glb.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"].size(), 4U);
}

TEST(WriteGlb, AVertexOfNoTriangleDoesNotCoarsenTheGrid) {
    TriangleMesh mesh = icosphere(2);
    const double step = Glb(glb_of(mesh, mesh.X.col(2))).step();
    mesh.X.conservativeResize(mesh.X.rows() + 1, 3);
    mesh.X.bottomRows(1) << 1e6, 0, -1e6;
    const Glb glb(glb_of(mesh, mesh.X.col(2)));
    EXPECT_EQ(glb.step(), step);
    EXPECT_EQ(glb.accessor("POSITION")["count"], mesh.vertex_count());
}

TEST(WriteGlb, LargeMeshesHaveLongIndices) {
    EXPECT_EQ(Glb(glb_of(icosphere(4), icosphere(4).X.col(2))).accessor("indices")["componentType"], 5123);
    const TriangleMesh large = flat_mesh(257);
    ASSERT_GT(large.vertex_count(), 65535);
    const Glb glb(glb_of(large, large.X.col(0)));
    EXPECT_EQ(glb.accessor("indices")["componentType"], 5125);
    EXPECT_EQ(glb.rows<std::uint32_t>("indices").maxCoeff(), large.vertex_count() - 1);
}

TEST(WriteGlb, RefusesMeshesThatCannotBeModels) {
    TriangleMesh blown_up = icosphere(1);
    blown_up.X(3, 1) = std::numeric_limits<double>::infinity();
    TriangleMesh point = icosphere(1);
    point.X.setOnes();
    for (const TriangleMesh& mesh : {blown_up, point, TriangleMesh{}}) {
        EXPECT_FALSE(can_be_a_model(mesh));
        EXPECT_THROW(write_glb(mesh, {}, {}, {}), MeshError);
    }
    EXPECT_THROW(write_glb(icosphere(1), Vector::Zero(3), range_of(Vector::Zero(3)), {}), MeshError);
}
