// The discussion of question 7 follows its numbers: each test changes a number of a study and expects other words.
#include <gtest/gtest.h>

#include <cmath>

#include "base/number_text.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {
using namespace testing_tools;

namespace {

std::string told(const DenoisingGrid& grid) {
    const Grids grids{grid};
    std::string words;
    for (const auto of : {answer_of, summary_of, explanation_of, reading_of, strength_of, amount_of, limits_of, beyond_of})
        words += report::plain(of(grids)) + " ";
    return words;
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
    EXPECT_TRUE(has(told(grid), "we cannot say which edges belong to the shape")) << told(grid);
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
        trial.found.by_rms.volume = trial.found.by_angle.volume = trial.clean_volume;
    }
    grid.trials[1].found.by_angle.volume = 0.6 * grid.trials[1].clean_volume;
    const report::Table table = count_table({grid});
    EXPECT_EQ(numbers(table, "works"), (std::vector<double>{0, 2, 0}));
    EXPECT_EQ(numbers(table, "helps"), (std::vector<double>{0, 0, 1}));
    EXPECT_EQ(numbers(table, "fails"), (std::vector<double>{2, 0, 1}));
    EXPECT_EQ(numbers(table, "fails by shrinking"), (std::vector<double>{0, 0, 1}));
    EXPECT_TRUE(has(std::get<std::string>(cells(table, "volume left")[2]), "cube_told at σ\u00a0=\u00a01.0\u202f% (60\u202f%)"));
}

TEST(DenoisingDiscussion, TheCountsFollowFromTheGainsThatArePrinted) {
    EXPECT_EQ(rounded_down(1.0999, 3), 1.09);
    const DenoisingGrid grid = denoising_grid(cube, quick_settings());
    for (const report::Column& column : result_table({grid}).columns)
        if (column.unit == "×") {
            EXPECT_EQ(column.rounding, report::Column::Rounding::down) << column.name;
            EXPECT_EQ(column.digits, 3);
        }
}

TEST(DenoisingDiscussion, EdgesAreRoundedWhereSmoothingAloneMovesThem) {
    DenoisingGrid grid = denoising_grid(cube, quick_settings());
    const auto with = [&](double times) {
        for (NoisyTrial& trial : grid.trials) trial.found.by_shape.step = 1, trial.taken.features = {times, 1};
        return report::plain(answer_of({grid}));
    };
    EXPECT_TRUE(
        has(with(3), "Sharp edges are rounded: on the clean cube_told the same smoothing moves them 3.0 times as far off the surface"));
    EXPECT_FALSE(has(with(1.1), "Sharp edges"));
}

TEST(DenoisingDiscussion, TheRadiusThatABallKeepsIsThatOfASmoothedBall) {
    DenoisingGrid grid = denoising_grid(library_mesh(icosphere(4), "ball_kept"), quick_settings());
    NoisyTrial& trial = const_cast<NoisyTrial&>(grid.pictured());
    trial.found.by_shape.value = 1, trial.found.by_shape.step = 20;
    SmoothingOptions options{.scheme = SmoothingScheme::implicit_euler, .lambda = grid.mean_edge * grid.mean_edge, .iterations = 20};
    const double radius = smooth(grid.clean->mesh(), options).X.rowwise().norm().mean();
    EXPECT_NEAR(grid.thickness * grid.mean_edge, 1, 0.01) << "3V/A of a ball is its radius";
    EXPECT_NEAR(grid.ball_kept(), radius, 0.01);
    EXPECT_LT(radius, 0.9) << "something has been lost";
}

TEST(DenoisingDiscussion, ThinIsWhatSmoothingTakesMostFrom) {
    DenoisingGrid thin = denoising_grid(ball, quick_settings()), thick = denoising_grid(cube, quick_settings());
    EXPECT_NEAR(thick.thickness * thick.mean_edge, 0.5, 1e-12) << "a cube of side 1: 3·1/6";
    for (DenoisingGrid* grid : {&thin, &thick})
        for (NoisyTrial& trial : grid->trials)
            trial.found.by_shape = {.value = 1, .step = 1, .shape = trial.found.noisy.shape / 3, .rms = 1, .volume = trial.clean_volume};
    for (NoisyTrial& trial : thin.trials) trial.found.by_shape.volume *= 0.5;
    thin.thickness = 1, thick.thickness = 2;
    const auto told_of_both = [&] { return report::plain(limits_of({thin, thick})); };
    EXPECT_TRUE(has(report::plain(answer_of({thin, thick})), "It fails by shrinking: ball_told at"));
    EXPECT_TRUE(has(told_of_both(), "leave 33\u202f% of the radius of such a ball. Elsewhere they leave at least 67\u202f%"))
        << told_of_both();
    thin.thickness = 3;
    EXPECT_FALSE(has(told_of_both(), "is thin")) << "another is thinner and does not shrink";
    EXPECT_FALSE(has(report::plain(limits_of({thin})), "Elsewhere they")) << "nothing to compare it with";
}

TEST(DenoisingDiscussion, WithoutTheCleanMeshTheRuleReachesAShareOfTheBestGain) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    for (NoisyTrial& trial : grid.trials) {
        trial.stopped = {.step = 1, .gain = 2, .best = 2};
    }
    grid.trials[1].stopped.gain = 1;
    EXPECT_TRUE(has(told(grid), "reaches in the mean 75\u202f% of the best gain that this λ allows")) << told(grid);
    EXPECT_TRUE(has(told(grid), "The least is 50\u202f%, on ball_told at σ = 1.0")) << told(grid);
    EXPECT_FALSE(has(told(grid), "It fails in")) << "no worse than the noisy mesh: " << told(grid);
    grid.trials[1].stopped.gain = 0.25;
    grid.fitted_to_clean = 0.5 * grid.trials[1].sigma / grid.mean_edge;
    EXPECT_TRUE(has(told(grid), "It fails in 1 of 2 cases: ball_told at 1.0")) << told(grid);
    EXPECT_TRUE(has(told(grid), "ends 4.0 times as far off as it was")) << told(grid);
    EXPECT_FALSE(has(told(grid), "shape is taken for noise")) << "the noise is larger than that: " << told(grid);
    grid.fitted_to_clean *= 4;
    EXPECT_TRUE(has(told(grid), "There shape is taken for noise")) << told(grid);
    for (NoisyTrial& trial : grid.trials) trial.stopped.gain = NAN;
    EXPECT_FALSE(has(told(grid), "Without the clean mesh")) << told(grid);
}

TEST(DenoisingDiscussion, TheRuleStopsNearTheBestOnASmoothSurface) {
    const DenoisingGrid grid = denoising_grid(library_mesh(icosphere(4), "ball_stopped"), quick_settings());
    const NoisyTrial& trial = grid.trials.back();
    ASSERT_GT(trial.stopped.step, 0);
    EXPECT_GT(trial.stopped.gain, 1.1) << "better than the noisy mesh";
    EXPECT_LE(trial.stopped.share(), 1);
    EXPECT_GT(trial.stopped.share(), 0.8) << "of the best of the same run";
}

TEST(DenoisingDiscussion, TheLeastAndTheLargestGainArePicturedBesideTheMeshesOwn) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto gains = [&](double low, double high) {
        for (std::size_t i = 0; i < 2; ++i) {
            SearchResult& found = grid.trials[i].found;
            found.by_shape.step = 3, found.by_shape.shape = found.noisy.shape / (i == 0 ? low : high);
        }
        return pictured_cases({grid}).size();
    };
    EXPECT_EQ(gains(2.5, 4), 2u) << "the first is halved, the second gains most";
    EXPECT_TRUE(has(told(grid), "The largest gain is 4.0, on ball_told at σ = 1.0")) << told(grid);
    EXPECT_EQ(gains(1.05, 4), 2u);
    EXPECT_TRUE(has(told(grid), "least gain is 1.05, on ball_told at σ = 0.30")) << told(grid);
}

TEST(DenoisingDiscussion, ACurveEndsWhereItHasJoinedThatWithoutNoise) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    NoisyTrial& trial = grid.trials.back();
    const auto shown = [&](double after_five) {   // of the distance without noise
        for (SearchState& state : trial.states)
            if (state.value == grid.middle_lambda())
                state.shape = grid.without_noise[static_cast<std::size_t>(state.step)] * (state.step > 5 ? after_five : 3);
        return error_plot(grid).series[1].x.back();
    };
    const double last = shown(3);
    EXPECT_GE(last, 12) << "apart to the end of the run";
    EXPECT_EQ(shown(1.05), 6) << "joined for good";
}

TEST(DenoisingDiscussion, WhereTheVolumeIsLostThereIsNoSuccess) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    for (NoisyTrial& trial : grid.trials) {
        trial.found.by_shape.step = 3;
        trial.found.by_shape.shape = trial.found.noisy.shape / 3;
        trial.found.by_shape.volume = 0.95 * trial.clean_volume;
    }
    EXPECT_TRUE(has(told(grid), "On ball_told smoothing works")) << told(grid);
    EXPECT_FALSE(has(report::plain(answer_of({grid})), "by shrinking"));
    for (NoisyTrial& trial : grid.trials) trial.found.by_shape.volume = 0.74 * trial.clean_volume;
    EXPECT_FALSE(has(told(grid), "On ball_told smoothing works")) << told(grid);
    EXPECT_TRUE(has(told(grid), "but only 74\u202f% of the volume is left")) << told(grid);
    EXPECT_TRUE(has(report::plain(answer_of({grid})), "keeps only 74\u202f% of its volume"));
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
    EXPECT_TRUE(has(gains(1.5, 3), "of noise on smoothing at least halves the surface distance (1 of 2 cases)")) << gains(1.5, 3);
    EXPECT_TRUE(has(gains(1.55, 3), "or less it gains at most 1.5; no noise between was tried")) << "rounded down: " << gains(1.55, 3);
    EXPECT_FALSE(has(gains(1.5, 3), "The least gain is")) << gains(1.5, 3);
    EXPECT_TRUE(has(report::plain(summary_of({grid})), "The least gain is")) << "no failure, and so no part of the verdict";
    EXPECT_TRUE(has(gains(1.05, 3), "It fails when the noise is much smaller than an edge")) << gains(1.05, 3);
    EXPECT_TRUE(has(gains(3, 4), "halves the surface distance in 2 of 2 cases, and lowers it by less in 0")) << gains(3, 4);
    EXPECT_TRUE(has(gains(3, 1.05), "halves the surface distance in 1 of 2 cases, and lowers it by less in 0"))
        << "more noise, less gain: no such limit";
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
    EXPECT_TRUE(has(told(grid), " was not too strong on ball_told")) << told(grid);
    EXPECT_FALSE(has(told(grid), "By normals the gain")) << "the strongest gains most by normals too";
    first.found.by_angle.angle = 0.2;
    EXPECT_TRUE(has(told(grid), "By normals the gain is largest earlier: 5.0 at")) << told(grid);
    last.found.by_shape.volume = 0.5 * last.clean_volume;
    EXPECT_FALSE(has(told(grid), "too strong")) << "the volume went with it";
    last.found.by_shape.volume = 0.95 * last.clean_volume;
    last.found.by_shape.shape = last.found.noisy.shape / 1.5;
    EXPECT_FALSE(has(told(grid), "too strong")) << told(grid);
}

TEST(DenoisingDiscussion, NoiseAlongTheSurfaceIsRecognisedByWhatSmoothingRemoves) {
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
    EXPECT_TRUE(has(less, "less along the surface than across it: on ball_along 40\u202f% of the squared error there, against 80\u202f%"))
        << less;
    const std::string more = with(0.6, 0.2);
    EXPECT_FALSE(has(more, "long the surface")) << "more is removed along than across: " << more;
    const std::string grown = with(0.2, 1.5);
    EXPECT_TRUE(has(grown, "grows by 50\u202f%")) << grown;
    EXPECT_FALSE(has(grown, "removes less")) << grown;
}

TEST(DenoisingDiscussion, OtherSamplesAreReportedWhereTheyWereTaken) {
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
    EXPECT_TRUE(has(told(grid), "at most 10\u202f%. None crosses")) << told(grid);
    grid.trials[1].further_gains = {3, 1.9};
    EXPECT_TRUE(has(told(grid), "In 1 case the gain crosses 1.1 or 2 with the sample: ball_told at 1.0")) << told(grid);
}

TEST(DenoisingDiscussion, OptimaAtTheEndOfTheGridAreCounted) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto with = [&](int step, double lambda = 0.1) {
        for (NoisyTrial& trial : grid.trials)
            for (const Measure& measure : measures)
                trial.found.*measure.best = {.value = lambda, .step = step, .shape = 1, .rms = 1, .angle = 1};
        return told(grid);
    };
    EXPECT_FALSE(has(with(grid.iterations - 2), "the end of the grid"));
    EXPECT_TRUE(
        has(with(grid.iterations - 1), "Of 6 optima (cases × measures) 0 lie at the end of the grid and 6 one iteration before it"));
    EXPECT_TRUE(has(with(grid.iterations), "Of 6 optima (cases × measures) 6 lie at the end of the grid and 0 one iteration before it"));
    EXPECT_TRUE(has(with(2, grid.lambdas.front()), "6 lie at the smallest λ with iterations to spare"));
    EXPECT_FALSE(has(with(2, grid.lambdas.front()), "the end of the grid"));
    EXPECT_FALSE(has(with(2), "the smallest λ with"));
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
    EXPECT_FALSE(with(0.74, 0.47, 0.9)) << "not near";
    EXPECT_FALSE(with(0.74, 0.47, 0.5)) << "a smaller λ does not bring it back";
    EXPECT_FALSE(with(0.74, 0.74, 0.8)) << "nothing to explain";
}

}   // namespace meshfolio::q7_denoising
