// The discussion of question 7 follows its numbers: each test changes a number of a study and expects other words.
#include <gtest/gtest.h>

#include <cmath>

#include "base/number_text.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/core/study_laws.h"
#include "questions/q7_denoising/study.h"

namespace meshfolio::q7_denoising {
using namespace testing_tools;

namespace {

report::Facts facts_on(const Grids& grids) { return facts_of(grids, reasons_of(grids)); }

std::string message(const DenoisingGrid& grid) {
    report::Section section;
    const report::Facts facts = facts_on({grid});
    for (const char* key : {"discussion.why", "discussion.when", "discussion.cost", "discussion.further"})
        add_words(section, words, key, facts);
    return prose_of(section);
}
std::string answer_on(const Grids& grids) { return report::plain(words.say("answer", facts_on(grids))); }

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

const auto cube = library_mesh(cube_mesh(10), "cube_told");
const auto ball = library_mesh(icosphere(2), "ball_told");

/// Returns a study of two noise levels with these gains by surface, and no loss of volume.
DenoisingGrid grid_with(double low, double high) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    for (NoisyTrial& trial : grid.trials) {
        SearchResult& found = trial.found;
        const double gain = &trial == grid.trials.data() ? low : high;
        found.by_shape = {
            .value = 0.1, .step = 3, .shape = found.noisy.shape / gain, .rms = found.noisy.rms, .angle = 0.2, .volume = trial.clean_volume};
    }
    return grid;
}

}   // namespace

TEST(DenoisingDiscussion, CountsTheVerdictsOfTheTable) {
    DenoisingGrid grid = grid_with(1.5, 3);
    EXPECT_TRUE(has(message(grid), "works in 1 of 2 cases and helps in 1; it never fails")) << message(grid);
    grid.trials[1].found.by_shape.volume *= 0.8;
    EXPECT_TRUE(has(message(grid), "works in 0 of 2 cases and helps in 1")) << message(grid);
    EXPECT_TRUE(has(message(grid), "1 shrinks too much")) << message(grid);
    EXPECT_TRUE(has(message(grid_with(1.05, 3)), "helps in 0; it fails in 1")) << message(grid_with(1.05, 3));
}

TEST(DenoisingDiscussion, TheCountsFollowFromTheGainsThatArePrinted) {
    EXPECT_EQ(rounded_down(1.0999, 3), 1.09);
    const DenoisingGrid grid = denoising_grid(cube, quick_settings());
    for (const report::Table& table : {result_table({grid}), measure_table({grid})})
        for (const report::Column& column : table.columns)
            if (column.unit == "×") {
                EXPECT_EQ(column.rounding, report::Column::Rounding::down) << column.name;
                EXPECT_EQ(column.digits, 3);
            }
}

TEST(DenoisingDiscussion, TheAnswerIsOneShortSentenceWithTheLeastNoiseThatWorks) {
    const auto answer = [](double low, double high) { return answer_on({grid_with(low, high)}); };
    const std::string level = readable(grid_with(1, 1).edges(grid_with(1, 1).trials[1]), 2);
    EXPECT_TRUE(has(answer(1.5, 3), "from noise of " + level + " mean edges on")) << answer(1.5, 3);
    EXPECT_TRUE(has(answer(3, 1.5), "in 1 of 2 cases")) << "more noise, less gain: no such limit";
    EXPECT_TRUE(has(answer(1.05, 1.05), "Smoothing fails here")) << answer(1.05, 1.05);
    DenoisingGrid shrunk = grid_with(1.5, 3);
    shrunk.trials[1].found.by_shape.volume *= 0.8;
    EXPECT_TRUE(has(answer_on({shrunk}), "but shrinks ball_told")) << answer_on({shrunk});
    for (const std::string& one : {answer(1.5, 3), answer(3, 1.5), answer_on({shrunk})}) {
        EXPECT_LE(std::ranges::count(one, ' '), 24) << one;
        EXPECT_EQ(one.find(". "), one.npos) << one;
    }
}

TEST(DenoisingDiscussion, NoiseLevelDecidesOnlyIfNoCaseContradicts) {
    DenoisingGrid first = grid_with(1.5, 3), second = grid_with(1.5, 3);
    EXPECT_FALSE(has(message(first), "between, some cases"));
    const auto both = [&] {
        report::Section section;
        add_words(section, words, "discussion.when", facts_on({first, second}));
        return prose_of(section);
    };
    EXPECT_FALSE(has(both(), "between, some cases")) << both();
    second.trials[0] = grid_with(2.5, 3).trials[0];
    EXPECT_TRUE(has(both(), "between, some cases")) << "the same noise is halved on one and not on the other: " << both();
    second.mean_edge *= 1 + 1e-15;   // the same level but for rounding
    EXPECT_TRUE(noise_split({first, second}).decides == false);
}

TEST(DenoisingDiscussion, EdgesAreRoundedOnlyIfTheirErrorIsLarger) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    grid.feature_vertices = 10;
    const auto with = [&](double times) {
        for (NoisyTrial& trial : grid.trials) trial.found.by_shape.step = 3, trial.clean_loss.features = {times, 1};
        return message(grid);
    };
    EXPECT_TRUE(has(with(2), "Edges are rounded: on ball_told they are 2.0 times as far off")) << with(2);
    EXPECT_TRUE(has(answer_on({grid}), "rounds sharp edges") || !has(answer_on({grid}), "at least halves"));
    EXPECT_FALSE(has(with(0.5), "Edges are rounded")) << with(0.5);
    grid.feature_vertices = 100;   // of 162
    EXPECT_TRUE(has(message(grid), "we cannot say which edges belong to the shape")) << message(grid);
}

TEST(DenoisingDiscussion, SaysWhereTheDistanceLeftIsLargest) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto spread = [&](SplitRms features, SplitRms curved) {
        for (NoisyTrial& trial : grid.trials) {
            trial.found.by_shape.step = 3;
            trial.residual.features = features;
            trial.residual.curved = curved;
        }
        return message(grid);
    };
    EXPECT_FALSE(has(spread({1.1, 1}, {1.1, 1}), "largest at the sharp edges") || has(spread({1.1, 1}, {1.1, 1}), "bends most"));
    EXPECT_TRUE(has(spread({3, 1}, {2, 1}), "What error stays on ball_told is largest where the surface bends most"))
        << "a ball has no edges";
    grid.feature_vertices = 10;
    EXPECT_TRUE(has(spread({3, 1}, {2, 1}), "largest at the sharp edges of ball_told"));
}

// A rule that gains less than 1.1 counts as failing.
TEST(DenoisingDiscussion, TheRuleWithoutTheCleanMeshFailsBelowTheGainOfVerdicts) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto with = [&](double low, double high) {
        grid.trials[0].stopped = {.step = 1, .gain = low, .best = 2};
        grid.trials[1].stopped = {.step = 1, .gain = high, .best = 2};
        return message(grid);
    };
    EXPECT_TRUE(has(with(2, 1), "reaches 75\u202f% of the best gain")) << with(2, 1);
    EXPECT_TRUE(has(with(2, 1), "It fails, with a gain below 1.1, in 1 of 2 cases.")) << "stopping at once gains nothing: " << with(2, 1);
    EXPECT_TRUE(has(with(1.09, 0.5), "in 2 of 2 cases, and does harm in 1")) << with(1.09, 0.5);
    EXPECT_FALSE(has(with(1.1, 2), "It fails, with")) << with(1.1, 2);
    grid.fitted_to_clean = 0.5 * grid.edges(grid.trials[1]);
    EXPECT_FALSE(has(with(2, 0.5), "shape is taken for noise")) << "the noise is larger than that";
    grid.fitted_to_clean *= 4;
    EXPECT_TRUE(has(with(2, 0.5), "There shape is taken for noise")) << with(2, 0.5);
    EXPECT_FALSE(has(with(NAN, NAN), "Without the clean mesh"));
}

TEST(DenoisingDiscussion, TheRuleStopsNearTheBestOnASmoothSurface) {
    const DenoisingGrid grid = denoising_grid(library_mesh(icosphere(4), "ball_stopped"), quick_settings());
    const NoisyTrial& trial = grid.trials.back();
    ASSERT_GT(trial.stopped.step, 0);
    EXPECT_FALSE(trial.stopped.fails());
    EXPECT_LE(trial.stopped.share(), 1);
    EXPECT_GT(trial.stopped.share(), 0.8) << "of the best of the same run";
}

TEST(DenoisingDiscussion, SaysIfMoreNoiseNeedsMoreSmoothing) {
    DenoisingGrid grid = denoising_grid(cube, quick_settings());
    const auto best_at = [&](NoisyTrial& trial, int step) { trial.found.by_shape.value = 0.1, trial.found.by_shape.step = step; };
    best_at(grid.trials.front(), 1);
    best_at(grid.trials.back(), 5);
    EXPECT_TRUE(has(message(grid), "from λt = 0.10 h̄² at the weakest noise to 0.50 h̄²")) << message(grid);
    best_at(grid.trials.front(), 5);
    EXPECT_FALSE(has(message(grid), "More noise moves")) << message(grid);
}

TEST(DenoisingDiscussion, NoNoiseIsTooStrongIfTheStrongestGainsMost) {
    DenoisingGrid grid = grid_with(2, 3);
    EXPECT_TRUE(has(message(grid), "noise is worth removing: on ball_told")) << message(grid);
    grid.trials.back().found.by_shape.volume *= 0.5;
    EXPECT_FALSE(has(message(grid), "worth removing")) << "the volume went with it";
    EXPECT_FALSE(has(message(grid_with(3, 2)), "worth removing"));
}

TEST(DenoisingDiscussion, DriftIsNamedIfSmoothingRemovesLessAlongTheSurface) {
    DenoisingGrid grid = denoising_grid(ball, quick_settings());
    const auto with = [&](double across, double along) {   // the shares of the squared errors that are left
        for (NoisyTrial& trial : grid.trials) {
            SearchResult& found = trial.found;
            found.noisy.shape = 1, found.noisy.rms = std::sqrt(2);
            found.by_shape = {.step = 1, .shape = std::sqrt(across), .rms = std::sqrt(across + along), .volume = trial.clean_volume};
        }
        return message(grid);
    };
    EXPECT_TRUE(has(with(0.2, 0.6), "removes 40\u202f% of its square, and 80\u202f% of that across")) << with(0.2, 0.6);
    EXPECT_FALSE(has(with(0.6, 0.2), "the error along it")) << "more is removed along than across";
    EXPECT_TRUE(has(with(0.2, 1.5), "smoothing multiplies it by 1.2 ")) << with(0.2, 1.5);
}

TEST(DenoisingDiscussion, ReportsFurtherSamplesIfTheyWereTaken) {
    DenoisingGrid grid = grid_with(3, 3);
    EXPECT_FALSE(has(message(grid), "samples of the noise")) << "a quick run has one alone";
    for (NoisyTrial& trial : grid.trials) trial.further_gains = {3, 3};
    grid.trials[0].further_gains = {3.3, 2.7};   // deviations 0.3 and −0.3 of three: 0.3
    EXPECT_NEAR(grid.trials[0].spread(), 0.3, 1e-12);
    EXPECT_TRUE(has(message(grid), "change the gain by 10\u202f% at most")) << message(grid);
    EXPECT_FALSE(has(message(grid), "the verdict depends")) << message(grid);
    grid.trials[1].further_gains = {3, 1.9};
    EXPECT_TRUE(has(message(grid), "in 1 case the verdict depends on the sample")) << message(grid);
}

TEST(DenoisingDiscussion, OtherNoiseIsComparedWithTheGainAgainstGaussianNoise) {
    DenoisingGrid grid = grid_with(3, 3);
    const auto with = [&](double impulsive, double spread) {
        grid.other_noise = {{.kind = NoiseKind::normal, .same = 2.5, .best = 2.5},
                            {.kind = NoiseKind::impulsive, .same = impulsive, .best = 2 * impulsive, .spread = spread}};
        return message(grid);
    };
    EXPECT_TRUE(has(with(1.2, 0.5), "is harder: it gains 2.4 at the best t of that run, where Gaussian noise gains 3.0")) << with(1.2, 0.5);
    EXPECT_TRUE(has(with(1.2, 0.5), "off by at least 50\u202f% of what"));
    EXPECT_FALSE(has(with(1.2, 0.01), "spreads a spike"));
    EXPECT_FALSE(has(with(3.5, 0.5), "harder")) << with(3.5, 0.5);
}

}   // namespace meshfolio::q7_denoising
