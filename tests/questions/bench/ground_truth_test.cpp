#include "questions/bench/ground_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesh/triangle_measures.h"
#include "questions/truth/parts.h"
#include "report/bibliography.h"
#include "report/writers.h"

using namespace meshfolio;

namespace {

const GroundTruth& quick_truth() {
    static const GroundTruth truth = ground_truth(1, true, [](std::string_view) {});
    return truth;
}

}   // namespace

TEST(GroundTruthMeshes, PointsLieOnTheSurfaceAndTrianglesLookOutwards) {
    for (const TruthSurface& s : truth_surfaces()) {
        for (const MeshKind kind : mesh_kinds) {
            const TruthMesh t = truth_mesh(s, kind, 3, 1);
            const std::string where = s.surface.name + ", " + std::string(name_of(kind));
            EXPECT_TRUE(t.topology.oriented_manifold) << where;
            const double off = kind == MeshKind::noisy ? 0.06 * t.mean_edge : 1e-13;
            for (const auto& p : t.mesh.X.rowwise()) EXPECT_LT((s.surface.projected(p.transpose()) - p.transpose()).norm(), off) << where;
            const Positions faces = face_normals(t.mesh);
            int inwards = 0;
            for (int f = 0; f < t.mesh.face_count(); ++f) inwards += faces.row(f).dot(t.normals.row(t.mesh.F(f, 0))) > 0 ? 0 : 1;
            EXPECT_LE(inwards, kind == MeshKind::random ? 1 : 0) << where;
        }
    }
}

TEST(GroundTruthMeshes, EachLevelHalvesTheEdges) {
    for (const TruthSurface& s : truth_surfaces()) {
        for (const MeshKind kind : mesh_kinds) {
            EXPECT_NEAR(truth_mesh(s, kind, 4, 1).mean_edge / truth_mesh(s, kind, 3, 1).mean_edge, 0.5, 0.04) << s.surface.name;
        }
    }
}

TEST(GroundTruthMeshes, KindsAreWhatTheyAreCalled) {
    for (const TruthSurface& s : truth_surfaces()) {
        const auto mean_longest_over_shortest = [&](MeshKind kind) {
            const CornerValues lengths = edge_lengths(truth_mesh(s, kind, 4, 1).mesh);
            return (lengths.rowwise().maxCoeff().array() / lengths.rowwise().minCoeff().array()).mean();
        };
        const auto valences = [&](MeshKind kind) {
            const MeshTopology topology = truth_mesh(s, kind, 4, 1).topology;
            std::set<int> found;
            for (int v = 0; v < static_cast<int>(topology.on_boundary.size()); ++v) {
                if (!topology.on_boundary[static_cast<std::size_t>(v)]) found.insert(topology.neighbours.size(v));
            }
            return found;
        };
        EXPECT_LE(valences(MeshKind::regular).size(), 2u) << s.surface.name;
        EXPECT_GE(valences(MeshKind::random).size(), 4u) << s.surface.name;
        EXPECT_GT(mean_longest_over_shortest(MeshKind::anisotropic), 1.4 * mean_longest_over_shortest(MeshKind::regular)) << s.surface.name;
    }
}

TEST(GroundTruthMeshes, WhatIsMeasuredIsTheSamePartAtEveryLevel) {
    for (const TruthSurface& s : truth_surfaces()) {
        const auto measured_share = [&](int level) {
            const TruthMesh t = truth_mesh(s, MeshKind::regular, level, 1);
            double inside = 0;
            for (std::size_t v = 0; v < t.measured.size(); ++v) inside += t.measured[v] ? t.areas[static_cast<Eigen::Index>(v)] : 0;
            return inside / t.areas.sum();
        };
        EXPECT_GT(measured_share(2), 0.15) << s.surface.name;
        EXPECT_NEAR(measured_share(5), measured_share(6), 0.05) << s.surface.name;
    }
}

TEST(GroundTruth, OrderIsTheExponentAndItsErrorTheScatter) {
    const FittedOrder exact = order_with_error({1, 0.5, 0.25, 0.125}, {3, 0.75, 0.1875, 0.046875});
    EXPECT_NEAR(exact.order, 2, 1e-12);
    EXPECT_NEAR(exact.standard_error, 0, 1e-12);
    // log₂ errors 0, 1, 0 over log₂ h 0, 1, 2: slope 0, residual sum of squares ⅔, Σ(x − x̄)² = 2, one degree of freedom.
    const FittedOrder scattered = order_with_error({1, 2, 4}, {1, 2, 1});
    EXPECT_NEAR(scattered.order, 0, 1e-12);
    EXPECT_NEAR(scattered.standard_error, std::sqrt(1.0 / 3), 1e-12);
    EXPECT_TRUE(std::isnan(order_with_error({1, 0.5}, {1, 0.5}).standard_error));
    EXPECT_TRUE(std::isnan(order_with_error({1, 0.5, 0.25}, {1e-15, 1e-14, 1e-13}).order)) << "rounding has no order";
    EXPECT_EQ(words_of({-0.5, 0.25}), "−0.50\u202f±\u202f0.25");
    EXPECT_EQ(words_of({1.98, 0.0002}), "1.98\u202f±\u202f<\u202f0.001");
    EXPECT_EQ(words_of({1.98, 0.004}), "1.98\u202f±\u202f0.004");
    EXPECT_EQ(words_of({std::nan(""), std::nan("")}), "exact");
}

TEST(GroundTruth, AllItsChecksHold) {
    const std::vector<report::Check> checks = ground_truth_checks(quick_truth());
    EXPECT_GE(checks.size(), 50u);
    std::set<std::string> names;
    for (const report::Check& check : checks) {
        EXPECT_TRUE(check.passed()) << check.name << ": " << check.measured;
        EXPECT_TRUE(names.insert(check.name).second) << "twice: " << check.name;
    }
}

TEST(GroundTruth, ChecksNoticeWhenAnEstimatorIsWrong) {
    const auto failures = [](const GroundTruth& truth) {
        int failed = 0;
        for (const report::Check& check : ground_truth_checks(truth)) failed += check.passed() ? 0 : 1;
        return failed;
    };
    GroundTruth doubled = quick_truth();   // as from areas twice too large: H is off by a half, everywhere
    for (PanelRun& run : doubled.runs) {
        for (PanelLevel& level : run.levels) {
            for (EstimateError& error : level.H) error.l2 += 0.5;
        }
    }
    EXPECT_GT(failures(doubled), 5);
    GroundTruth jet = quick_truth();
    jet.reference.H[estimator_index(Quantity::H, "jet")].l2 *= 1.2;
    EXPECT_EQ(failures(jet), 1);
}

TEST(GroundTruth, SectionIsWellFormedAndCanBeWritten) {
    report::Document document;
    document.sections.push_back(truth::ground_truth_section(quick_truth()));
    for (const report::Block& block : document.sections[0].blocks) {
        if (const auto* table = std::get_if<report::Table>(&block)) {
            for (const auto& row : table->rows) EXPECT_EQ(row.size(), table->columns.size()) << table->id;
        }
        if (const auto* paragraph = std::get_if<report::Paragraph>(&block)) {
            EXPECT_EQ(report::plain(paragraph->text).find("nan"), std::string::npos) << report::plain(paragraph->text);
        }
    }
    EXPECT_FALSE(report::write_html(document, {}, report::Templates()).empty());   // throws where a reference leads nowhere
    EXPECT_FALSE(report::write_json(document, {}).empty());
    const report::Table all = truth::ground_truth_table(quick_truth());
    EXPECT_EQ(all.rows.size(), quick_truth().runs.size() * 3 * (estimators_of(Quantity::H).size() + estimators_of(Quantity::K).size()));
    EXPECT_EQ(all.rows[0].size(), all.columns.size());
}

TEST(GroundTruth, SameSeedSameNumbers) {
    const GroundTruth again = ground_truth(1, true, [](std::string_view) {});
    EXPECT_EQ(report::write_csv(truth::ground_truth_table(again)), report::write_csv(truth::ground_truth_table(quick_truth())));
}
