#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "mesh/triangle_measures.h"
#include "questions/core/study_laws.h"
#include "questions/stability/study.h"

namespace meshfolio::stability {
using namespace testing_tools;

namespace {

SmoothingMaps maps_on(const TriangleMesh& mesh, const std::string& name, std::vector<double> lambda = {}, std::vector<int> t = {}) {
    QuestionSettings settings = quick_settings();
    settings.lambda = std::move(lambda);
    settings.iterations = std::move(t);
    return smoothing_maps(library_mesh(mesh, name), settings);
}

const TriangleMesh& egg() {
    static const TriangleMesh mesh = ellipsoid_mesh(2, {1.5, 1, 0.8});
    return mesh;
}
const SmoothingMaps& egg_maps() {
    static const SmoothingMaps maps = maps_on(egg(), "egg_maps");
    return maps;
}

}   // namespace

TEST(StabilityPlanes, IterationsAreSpacedAlikeAndEndWhereAsked) {
    EXPECT_EQ(spaced_iterations(30, 2), (std::vector{1, 3, 10, 30}));
    EXPECT_EQ(spaced_iterations(1, 5), (std::vector{1}));
    EXPECT_EQ(spaced_iterations(7, 1), (std::vector{1, 7}));
    for (const int last : {2, 99, 200}) {
        const auto counts = spaced_iterations(last, 8);
        EXPECT_EQ(counts.front(), 1);
        EXPECT_EQ(counts.back(), last);
        EXPECT_TRUE(std::is_sorted(counts.begin(), counts.end()));
    }
}

TEST(StabilityPlanes, TheLimitLiesHalfWayBetweenTwoSteps) {
    const SmoothingMaps& maps = egg_maps();
    double nearest_below = 0, nearest_beyond = INFINITY;
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
        (maps.relative(step) < 1 ? nearest_below : nearest_beyond) =
            maps.relative(step) < 1 ? std::max(nearest_below, maps.relative(step)) : std::min(nearest_beyond, maps.relative(step));
    }
    EXPECT_NEAR(nearest_below * nearest_beyond, 1, 1e-12);
}

TEST(StabilityPlanes, EachCellEqualsARunOfItsOwn) {
    const SmoothingMaps& maps = egg_maps();
    for (const SchemeMap& map : maps.schemes) {
        for (const std::size_t step : {std::size_t{0}, std::size_t{3}, maps.lambdas.size() - 1}) {
            for (const std::size_t row : {std::size_t{0}, maps.iterations.size() - 1}) {
                SmoothingOptions options;
                options.scheme = map.scheme;
                options.lambda = maps.lambdas[step];
                options.iterations = maps.iterations[row];
                const Smoothed run = smooth(egg(), options);
                const std::size_t i = maps.index(step, row);
                if (run.blew_up) {
                    EXPECT_TRUE(std::isnan(map.moved[i]));
                    EXPECT_EQ(map.blow_up[step], run.blow_up_iteration);
                    continue;
                }
                const MeshDifference moved = compare_meshes(egg(), moved_to(egg(), run.X));
                EXPECT_NEAR(map.moved[i], moved.rms / moved.box_diagonal, 1e-10 * map.moved[i]);
                if (std::isnan(map.inverted[i])) continue;
                EXPECT_NEAR(map.size[i], moved.volume_ratio, 1e-9);
                EXPECT_EQ(map.inverted[i], double(moved.inverted_faces) / egg().face_count());
            }
        }
    }
}

TEST(StabilityPlanes, EachImplicitStepSizeIsFactorisedOnce) {
    const SmoothingMaps& maps = egg_maps();
    EXPECT_EQ(maps.implicit_map().factorisations, int(maps.lambdas.size()));
    EXPECT_EQ(maps.explicit_map().factorisations, 0);
}

TEST(StabilityPlanes, RunsBlowUpOnlyBeyondTheLimitAndWhenTheModesPredict) {
    const SmoothingMaps& maps = egg_maps();
    ASSERT_TRUE(maps.all.has_value());
    int blown = 0;
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
        EXPECT_EQ(maps.implicit_map().blow_up[step], 0);
        const int when = maps.explicit_map().blow_up[step];
        if (maps.relative(step) < 1) {
            EXPECT_EQ(when, 0);
            EXPECT_TRUE(std::isnan(maps.top.blow_up(maps.lambdas[step])));
            EXPECT_TRUE(std::isnan(maps.all->blow_up(maps.lambdas[step])));
        }
        if (when == 0) continue;
        ++blown;
        EXPECT_NEAR(when, std::ceil(maps.all->blow_up(maps.lambdas[step])), 1);
        EXPECT_GE(when, maps.all->earliest(maps.lambdas[step], 1000));
        EXPECT_GE(maps.top.blow_up(maps.lambdas[step]), maps.all->blow_up(maps.lambdas[step]) * (1 - 1e-6));
    }
    EXPECT_GE(blown, 4);
}

// The height and the growth factor of a mode give the iteration in closed form.
TEST(GrowingModes, FollowTheClosedForm) {
    GrowingModes modes;
    modes.eigenvalues = Vector::Constant(1, 4.0);
    modes.heights = Vector::Constant(1, 1e-3);
    modes.rounding = 1e-16;
    modes.distance = 1e3;
    EXPECT_NEAR(modes.blow_up(0.75), std::log(1e6) / std::log(2.0), 1e-12);   // doubles: λμ = 3
    EXPECT_EQ(modes.earliest(0.75, 100), 20);
    EXPECT_EQ(modes.earliest(0.75, 10), 0);
    EXPECT_TRUE(std::isnan(modes.blow_up(0.5)));
    modes.heights[0] = 0;
    EXPECT_NEAR(modes.blow_up(0.75), std::log(1e19) / std::log(2.0), 1e-9) << "the height is at least the rounding";
    EXPECT_TRUE(std::isnan(modes.blow_up(0.75, modes.noticeable()))) << "but rounding is no reliable height";
}

TEST(StabilityPlanes, AreTheSameInAnyUnit) {
    TriangleMesh large = egg();
    large.X *= 1000;
    const SmoothingMaps maps = maps_on(large, "egg_large");
    for (std::size_t i = 0; i < maps.implicit_map().moved.size(); ++i) {
        EXPECT_NEAR(maps.implicit_map().moved[i], egg_maps().implicit_map().moved[i], 1e-9);
        EXPECT_EQ(std::isnan(maps.explicit_map().moved[i]), std::isnan(egg_maps().explicit_map().moved[i]));
    }
}

TEST(StabilityPlanes, OnlyTheBundledNoisyMeshesHaveACleanOne) {
    EXPECT_FALSE(egg_maps().clean.has_value());
    EXPECT_TRUE(egg_maps().implicit_map().error.empty());
    const SmoothingMaps plane = smoothing_maps(MeshLibrary({}, {}).role("plane_ns"), quick_settings());
    ASSERT_TRUE(plane.clean.has_value());
    EXPECT_NEAR(plane.clean->X.col(2).cwiseAbs().maxCoeff(), 0, 0);
    const auto best = plane.best(plane.implicit_map());
    ASSERT_TRUE(best.has_value());
    EXPECT_LT(plane.implicit_map().error[*best], 0.85 * plane.input_error) << "smoothing denoises";
    for (const double error : plane.implicit_map().error) EXPECT_GE(error, plane.implicit_map().error[*best]);
    EXPECT_FALSE(plane.subject.preflight().encloses_volume());
}

// Different cells of the two schemes blow up, so the counts are of usable cells.
TEST(StabilityPlanes, TurnedTrianglesAreCountedAmongTheCellsThatHaveThem) {
    SmoothingMaps maps = egg_maps();
    std::fill(maps.schemes[0].inverted.begin(), maps.schemes[0].inverted.end(), NAN);
    maps.schemes[0].inverted[0] = 0;
    maps.schemes[0].inverted[1] = 0.25;
    maps.schemes[0].inverted[2] = 0.5;
    std::fill(maps.schemes[1].inverted.begin(), maps.schemes[1].inverted.end(), 0);
    const report::Table table = region_table({maps});
    EXPECT_EQ(numbers(table, "usable"), (std::vector<double>{3, double(maps.schemes[1].inverted.size())}));
    EXPECT_EQ(numbers(table, "turned"), (std::vector<double>{2, 0}));
    EXPECT_EQ(numbers(table, "at most"), (std::vector<double>{50, 0}));
}

TEST(StabilityPlanes, TheCaptionStatesTheSizeThatTheLargestStepLeaves) {
    Answer answer;
    SmoothingMaps maps = egg_maps();
    const auto place = std::ranges::find(maps.places, "d", &MapPlace::letter);
    ASSERT_NE(place, maps.places.end());
    maps.schemes[1].size[maps.index(place->step, place->row)] = 0.18;
    add_place_figure(answer, {maps});
    const auto& figure = std::get<report::Figure>(answer.section.blocks.back());
    EXPECT_NE(figure.caption.find("with 18\u202f% of egg_maps left"), std::string::npos) << figure.caption;
    ASSERT_EQ(answer.figures.size(), 1u);
    EXPECT_EQ(answer.figures.front().panels.size(), answer.figures.front().columns.size());
    for (const output::Panel& panel : answer.figures.front().panels) EXPECT_TRUE(panel.mesh) << panel.label;
}

TEST(StabilityPlanes, TakesTheStepsAndIterationsOfTheSettings) {
    const SmoothingMaps maps = maps_on(egg(), "egg_settings", {0.02, 0.01}, {5});
    EXPECT_EQ(maps.lambdas, (std::vector{0.01, 0.02}));
    EXPECT_EQ(maps.iterations.back(), 5);
}

TEST(StabilitySection, IsWellFormedOnDegenerateMeshes) {
    for (const TriangleMesh& mesh : {cube_mesh(1), icosphere(0)}) {
        const Answer answer = chapter_of_id("stability").answer(library_of(mesh, "tiny_maps"), quick_settings(), no_progress);
        expect_well_formed(answer);
        expect_checks_pass(answer.section);
    }
}

}   // namespace meshfolio::stability
