#include "questions/bench/defects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/chapter.h"

namespace meshfolio {
namespace {

MeshFacts facts_of(const TriangleMesh& mesh) { return mesh_facts(prepare_mesh({mesh, "m.obj", {}, {}})); }

/// Returns "key count" of each defect found.
std::set<std::string> found(const TriangleMesh& mesh) {
    std::set<std::string> list;
    for (const auto& [defect, count] : defects_of(facts_of(mesh))) list.insert(std::string(defect->key) + " " + std::to_string(count));
    return list;
}

TriangleMesh with_face(TriangleMesh mesh, int a, int b, int c) {
    mesh.F.conservativeResize(mesh.F.rows() + 1, 3);
    mesh.F.bottomRows(1) << a, b, c;
    return mesh;
}

TriangleMesh with_vertex(TriangleMesh mesh, double x, double y, double z) {
    mesh.X.conservativeResize(mesh.X.rows() + 1, 3);
    mesh.X.bottomRows(1) << x, y, z;
    return mesh;
}

using Set = std::set<std::string>;

}   // namespace

TEST(MeshDefects, ASoundMeshHasNone) { EXPECT_EQ(found(icosphere(2)), Set{}); }

TEST(MeshDefects, EachPlantedDefectIsFoundAndNoOther) {
    const TriangleMesh ball = icosphere(1);
    EXPECT_EQ(found(with_face(ball, 3, 3, 5)), Set{"dropped_degenerate_faces 1"});
    EXPECT_EQ(found(with_face(with_face(ball, ball.F(4, 1), ball.F(4, 2), ball.F(4, 0)), ball.F(4, 0), ball.F(4, 1), ball.F(4, 2))),
              Set{"dropped_duplicate_faces 2"});
    TriangleMesh turned = ball;
    std::swap(turned.F(7, 0), turned.F(7, 1));
    EXPECT_EQ(found(turned), Set{"flipped_faces 1"});
    TriangleMesh inside_out = ball;
    inside_out.F.col(0).swap(inside_out.F.col(1));
    EXPECT_EQ(found(inside_out), Set{"inside_out_components 1"});
    EXPECT_EQ(found(with_vertex(ball, 0, 0, 0)), Set{"unreferenced_vertices 1"});
    EXPECT_EQ(found(grid_mesh(5, 5, 1, 1)), Set{"boundary_loops 1"});
    TriangleMesh two = ball;
    two.X.conservativeResize(2 * ball.X.rows(), 3);
    two.X.bottomRows(ball.X.rows()) = ball.X.rowwise() + Eigen::RowVector3d(4, 0, 0);
    two.F.conservativeResize(2 * ball.F.rows(), 3);
    two.F.bottomRows(ball.F.rows()) = ball.F.array() + ball.vertex_count();
    EXPECT_EQ(found(two), Set{"further_components 1"});
    two.X.bottomRows(ball.X.rows()) = ball.X;
    EXPECT_EQ(found(two), (Set{"further_components 1", "duplicated_positions " + std::to_string(ball.vertex_count())}));
    EXPECT_EQ(found({1e-9 * ball.X, ball.F}), Set{"unusual_scale 1"});
    EXPECT_EQ(found({1e9 * ball.X, ball.F}), Set{"unusual_scale 1"});
    EXPECT_EQ(found({ball.X.rowwise() + Eigen::RowVector3d(1e4, 0, 0), ball.F}), Set{"far_from_origin 1"});
    EXPECT_EQ(found({ball.X.rowwise() + Eigen::RowVector3d(1e10, 0, 0), ball.F}), Set{"far_from_origin 1"});
    EXPECT_EQ(found({ball.X.rowwise() + Eigen::RowVector3d(1e13, 0, 0), ball.F}), (Set{"far_from_origin 1", "coarse_coordinates 1"}));
    EXPECT_EQ(found({((ball.X * 1000).array().round() / 1000).matrix(), ball.F}), Set{"coarse_coordinates 1"}) << "three decimals";
    EXPECT_EQ(found({((ball.X * 1e6).array().round() / 1e6).matrix(), ball.F}), Set{}) << "six decimals";
}

TEST(MeshDefects, SharedEdgesAndPointsAreFound) {
    TriangleMesh book;
    book.X.resize(5, 3);
    book.X << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0;
    book.F.resize(3, 3);
    book.F << 0, 1, 2, 1, 0, 3, 0, 1, 4;
    EXPECT_TRUE(found(book).contains("nonmanifold_edges 1"));
    TriangleMesh tie = book;
    tie.F.resize(2, 3);
    tie.F << 0, 1, 2, 0, 3, 4;
    EXPECT_TRUE(found(tie).contains("nonmanifold_vertices 1"));
}

TEST(MeshDefects, ThinTrianglesAreFound) {
    TriangleMesh needle;
    needle.X.resize(3, 3);
    needle.X << 0, 0, 0, 1, 0, 0, 1, 0.01, 0;
    needle.F.resize(1, 3);
    needle.F << 0, 1, 2;
    EXPECT_TRUE(found(needle).contains("needle_faces 1"));
    needle.X.row(2) << 2, 0, 0;
    EXPECT_TRUE(found(needle).contains("zero_area_faces 1"));
    EXPECT_FALSE(found(needle).contains("needle_faces 1"));
}

TEST(MeshDefects, EachDefectNamesItsQuestionsConsequenceAndRepair) {
    std::set<std::string_view> keys;
    for (const Defect& defect : defect_list()) {
        EXPECT_TRUE(keys.insert(defect.key).second) << defect.key;
        EXPECT_FALSE(defect.name().empty() || defect.breaks().empty() || defect.done().empty()) << defect.key;
        const std::vector<std::string> ids = affected_questions(defect);
        ASSERT_FALSE(ids.empty()) << defect.key;
        EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
        std::string joined;
        for (const std::string& id : ids) {
            EXPECT_TRUE(chapter_of_id(id).is_question()) << id;
            joined += (joined.empty() ? "" : ",") + id;
        }
        EXPECT_EQ(joined, defect.questions);
    }
    EXPECT_EQ(affected_for_people(defect_list()[2]), "Q1, Q3, Q7");
}

}   // namespace meshfolio
