// The discussion of question 7 says what the numbers say: a number is changed in a study, and the words change with it.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {
using namespace testing_tools;

namespace {

std::string told(const DenoisingGrid& grid) {
    report::Section section;
    add_discussion(section, {grid});
    return report::plain(answer_of({grid})) + " " + report::plain(summary_of({grid})) + prose_of(section);
}

bool has(const std::string& text, std::string_view words) { return text.find(words) != std::string::npos; }

const auto cube = library_mesh(cube_mesh(10), "cube_told");
const auto ball = library_mesh(icosphere(2), "ball_told");

}   // namespace

TEST(DenoisingDiscussion, EdgesAreRoundedOnlyWhereTheDistanceIsLarger) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    EXPECT_TRUE(has(told(grid), "no edge to lose")) << told(grid);
    grid.feature_vertices = 10;
    for (NoisyTrial& trial : grid.trials) {
        trial.found.by_shape.step = 3;
        trial.taken.features = {2, 1};
    }
    EXPECT_TRUE(has(told(grid), "Edges are rounded even without noise: the clean ball_told, smoothed alike, is 2.0 times as far off"))
        << told(grid);
    for (NoisyTrial& trial : grid.trials) trial.taken.features = {1, 2};
    EXPECT_FALSE(has(told(grid), "Edges are rounded")) << told(grid);
    grid.feature_vertices = 100;   // of 162
    EXPECT_TRUE(has(told(grid), "edges and tessellation cannot be told apart")) << told(grid);
}

TEST(DenoisingDiscussion, SaysWhereTheDistanceLeftIsLargest) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto spread = [&](Uneven features, Uneven curved) {
        for (NoisyTrial& trial : grid.trials) {
            trial.found.by_shape.step = 3;
            trial.remains.features = features;
            trial.remains.curved = curved;
        }
        return told(grid);
    };
    EXPECT_FALSE(has(spread({1.1, 1}, {1.1, 1}), "The distance left"));
    EXPECT_TRUE(has(spread({3, 1}, {2, 1}), "The distance left is 2.0 times as large in the most curved tenth")) << "a ball has no edges";
    grid.feature_vertices = 10;
    EXPECT_TRUE(has(spread({3, 1}, {2, 1}), "The distance left is 3.0 times as large at the edges"));
}

TEST(DenoisingDiscussion, VerdictsCountTheCasesOfEachMeasure) {
    DenoisingGrid grid = denoising_grid(cube, quick_settings());
    for (NoisyTrial& trial : grid.trials) {
        trial.found.by_rms.rms = trial.found.noisy.rms / 3;
        trial.found.by_angle.angle = trial.found.noisy.angle / 1.5;
        trial.found.by_shape.shape = trial.found.noisy.shape;
    }
    EXPECT_TRUE(has(told(grid), "Smoothing works in 0 of 2 cases and helps in 0 by surface distance, ")) << told(grid);
    EXPECT_TRUE(has(told(grid), "in 2 and 0 of 2 by places")) << told(grid);
    EXPECT_TRUE(has(told(grid), "in 0 and 2 of 2 by normals")) << told(grid);
}

TEST(DenoisingDiscussion, WhereTheVolumeIsLostThereIsNoSuccess) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    for (NoisyTrial& trial : grid.trials) {
        trial.found.by_shape.step = 3;
        trial.found.by_shape.shape = trial.found.noisy.shape / 3;
        trial.found.by_shape.volume = 0.95 * trial.clean_volume;
    }
    EXPECT_TRUE(has(told(grid), "On ball_told smoothing works")) << told(grid);
    EXPECT_FALSE(has(report::plain(answer_of({grid})), "It counts as failing where more than 15"));
    for (NoisyTrial& trial : grid.trials) trial.found.by_shape.volume = 0.74 * trial.clean_volume;
    EXPECT_FALSE(has(told(grid), "On ball_told smoothing works")) << told(grid);
    EXPECT_TRUE(has(told(grid), "but only 74\u202f% of the volume is left")) << told(grid);
    EXPECT_TRUE(has(report::plain(answer_of({grid})), "It counts as failing where more than 15"));
}

TEST(DenoisingDiscussion, TheErrorIsSaidToRiseAtOnceWhereItDoes) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto with = [&](double taken, double after) {
        NoisyTrial& trial = grid.trials.front();
        grid.without_noise[1] = taken * trial.found.noisy.shape;
        for (SearchState& state : trial.states)
            if (state.step == 1) state.shape = after * trial.found.noisy.shape;
        return has(told(grid), "the error rises at once");
    };
    EXPECT_TRUE(with(2, 1.5));
    EXPECT_FALSE(with(0.5, 1.5)) << "the loss is small";
    EXPECT_FALSE(with(2, 0.9)) << "it falls";
}

TEST(DenoisingDiscussion, TheAnswerNamesTheNoiseWhereItBeginsToHelp) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto gains = [&](double low, double high) {
        NoisyTrial &first = grid.trials.front(), &last = grid.trials.back();
        first.found.by_shape.shape = first.found.noisy.shape / low;
        last.found.by_shape.shape = last.found.noisy.shape / high;
        return report::plain(answer_of({grid}));
    };
    EXPECT_TRUE(has(gains(1.5, 3), "Smoothing halves the surface distance when σ is at least")) << gains(1.5, 3);
    EXPECT_TRUE(has(gains(1.5, 3), "It gains least at")) << gains(1.5, 3);
    EXPECT_TRUE(has(gains(1.05, 3), "It fails at")) << gains(1.05, 3);
    EXPECT_TRUE(has(gains(3, 4), "works in 2 of 2 cases and helps in 0")) << gains(3, 4);
    EXPECT_TRUE(has(gains(3, 1.05), "works in 1 of 2 cases and helps in 0")) << "more noise, less gain: no such limit";
    EXPECT_TRUE(has(gains(1.05, 1.05), "Smoothing fails here")) << gains(1.05, 1.05);
}

TEST(DenoisingDiscussion, WhetherMoreNoiseAsksForMoreSmoothingIsRead) {
    DenoisingGrid grid = denoising_grid(cube, quick_settings());
    const auto best_at = [&](NoisyTrial& trial, int step) { trial.found.by_shape.value = 0.1, trial.found.by_shape.step = step; };
    best_at(grid.trials.front(), 1);
    best_at(grid.trials.back(), 5);
    EXPECT_TRUE(has(told(grid), "the best λt grows from 0.10 to 0.50 h̄² on cube_told")) << told(grid);
    best_at(grid.trials.front(), 7);
    EXPECT_TRUE(has(told(grid), "the best λt falls from 0.70 to 0.50 h̄² on cube_told")) << told(grid);
    best_at(grid.trials.front(), 5);
    EXPECT_FALSE(has(told(grid), "More noise asks")) << told(grid);
}

TEST(DenoisingDiscussion, NoNoiseIsTooStrongWhereTheStrongestGainsMost) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    NoisyTrial &first = grid.trials.front(), &last = grid.trials.back();
    first.found.by_shape.shape = first.found.noisy.shape / 2;
    last.found.by_shape.shape = last.found.noisy.shape / 3;
    last.found.by_shape.volume = 0.95 * last.clean_volume;
    first.found.noisy.angle = last.found.noisy.angle = 1;
    first.found.by_angle.angle = 0.5, last.found.by_angle.angle = 0.25;
    EXPECT_TRUE(has(told(grid), "By surface distance no noise tried was too strong on ball_told")) << told(grid);
    EXPECT_FALSE(has(told(grid), "By normals the gain")) << "the strongest gains most by normals too";
    first.found.by_angle.angle = 0.2;
    EXPECT_TRUE(has(told(grid), "By normals the gain is largest earlier: 5.0 at")) << told(grid);
    last.found.by_shape.volume = 0.5 * last.clean_volume;
    EXPECT_FALSE(has(told(grid), "too strong")) << "the volume went with it";
    last.found.by_shape.volume = 0.95 * last.clean_volume;
    last.found.by_shape.shape = last.found.noisy.shape / 1.5;
    EXPECT_FALSE(has(told(grid), "too strong")) << told(grid);
}

TEST(DenoisingDiscussion, FailuresCountWhatShrinks) {
    DenoisingGrid grid = denoising_grid(library_mesh(icosphere(2), "ball_counts"), quick_settings());
    for (NoisyTrial& trial : grid.trials) {
        trial.found.by_shape = {
            .step = 1, .shape = trial.found.noisy.shape / 3, .rms = trial.found.noisy.rms, .volume = trial.clean_volume};
        trial.found.by_rms = trial.found.by_angle = trial.found.noisy;
    }
    EXPECT_NE(report::plain(answer_of({grid})).find("in 0 of 2 cases by surface distance, 2 of 2 by places and 2 of 2 by normals"),
              std::string::npos)
        << report::plain(answer_of({grid}));
    grid.trials[1].found.by_shape.volume *= 0.5;
    EXPECT_NE(report::plain(answer_of({grid})).find("in 1 of 2 cases by surface distance"), std::string::npos);
    EXPECT_NE(report::plain(answer_of({grid})).find("50\u202f% is left of ball_counts"), std::string::npos);
    EXPECT_NE(report::plain(summary_of({grid})).find("works in 1 of 2 cases"), std::string::npos);
}

TEST(DenoisingDiscussion, NoiseAlongTheSurfaceIsToldByWhatSmoothingRemoves) {
    DenoisingGrid grid = denoising_grid(library_mesh(icosphere(2), "ball_along"), quick_settings());
    const auto with = [&](double across, double along) {   // the shares of the squared errors that are left
        for (NoisyTrial& trial : grid.trials) {
            SearchResult& found = trial.found;
            found.noisy.shape = 1, found.noisy.rms = std::sqrt(2);
            found.by_shape = {.step = 1, .shape = std::sqrt(across), .rms = std::sqrt(across + along), .volume = trial.clean_volume};
        }
        return told(grid);
    };
    const std::string less = with(0.2, 0.6);
    EXPECT_TRUE(has(less, "it removes less than across: 40\u202f% of the squared error on ball_along, against 80\u202f%")) << less;
    EXPECT_TRUE(has(less, "Smoothing removes less along the surface")) << less;
    const std::string more = with(0.6, 0.2);
    EXPECT_FALSE(has(more, "long the surface")) << "more is removed along than across: " << more;
    const std::string grown = with(0.2, 1.5);
    EXPECT_TRUE(has(grown, "grows by 50\u202f%")) << grown;
    EXPECT_FALSE(has(grown, "removes less")) << grown;
}

TEST(DenoisingDiscussion, OtherSamplesAreToldWhereTheyWereTaken) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    EXPECT_FALSE(has(told(grid), "samples of the noise")) << "a quick run has one alone";
    for (NoisyTrial& trial : grid.trials) {
        trial.found.by_shape = {
            .step = 1, .shape = trial.found.noisy.shape / 3, .rms = trial.found.noisy.rms, .volume = trial.clean_volume};
        trial.further_gains = {3, 3};
    }
    grid.trials[0].further_gains = {3.3, 2.7};   // deviations 0.3 and −0.3 of three: 0.3
    EXPECT_NEAR(grid.trials[0].spread(), 0.3, 1e-12);
    EXPECT_TRUE(has(told(grid), "Over 3 samples of the noise")) << told(grid);
    EXPECT_TRUE(has(told(grid), "at most 10\u202f%; none crosses")) << told(grid);
    grid.trials[1].further_gains = {3, 1.9};
    EXPECT_TRUE(has(told(grid), "In 1 case it lies so near")) << told(grid);
}

TEST(DenoisingDiscussion, OptimaAtTheEndOfTheGridAreCounted) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto with = [&](int step) {
        for (NoisyTrial& trial : grid.trials)
            for (const Measure& measure : measures)
                trial.found.*measure.best = {.value = 0.1, .step = step, .shape = 1, .rms = 1, .angle = 1};
        return told(grid);
    };
    EXPECT_FALSE(has(with(grid.iterations - 2), "end of the grid"));
    EXPECT_TRUE(has(with(grid.iterations - 1), "0 of 6 optima lie at the end of the grid and 6 one iteration"));
    EXPECT_TRUE(has(with(grid.iterations), "6 of 6 optima lie at the end of the grid and 0 one iteration"));
}

TEST(DenoisingDiscussion, TheLargerAreaIsTheReasonOnlyWhereItExplainsTheVolume) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto with = [&](double kept, double alike, double less) {
        for (NoisyTrial& trial : grid.trials) {
            trial.found.by_shape = {.value = 0.1, .step = 3, .shape = 0.5, .rms = 1, .volume = kept * trial.clean_volume};
            trial.taken.volume = alike;
        }
        grid.noisy_area = 2.5, grid.kept_by_less = less;
        return has(told(grid), "noise makes its area 2.5 times as large");
    };
    EXPECT_TRUE(with(0.74, 0.47, 0.68));
    EXPECT_FALSE(with(0.74, 0.47, 0.5)) << "a smaller λ does not bring it back";
    EXPECT_FALSE(with(0.74, 0.74, 0.8)) << "nothing to explain";
}

}   // namespace meshfolio::q7_denoising
