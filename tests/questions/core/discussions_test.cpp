// The discussions of questions 5 to 7 say what the numbers say: a number is changed in a study, and the words change with it.
#include <gtest/gtest.h>

#include <cctype>

#include "mesh/samples/sample_shapes.h"
#include "mesh/vertex_noise.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_laws.h"
#include "questions/core/study_list.h"
#include "questions/q5_explicit/parts.h"
#include "questions/q6_implicit/parts.h"
#include "questions/q7_denoising/parts.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;
using q5_explicit::explicit_study;
using q5_explicit::ExplicitStudy;
using q6_implicit::implicit_study;
using q6_implicit::ImplicitStudy;
using q6_implicit::SmoothingCell;

namespace {

template <class Study>
std::string told(void (*add)(report::Section&, const std::vector<Study>&), const std::vector<Study>& studies) {
    report::Section section;
    add(section, studies);
    return prose_of(section);
}
void add_explicit(report::Section& section, const std::vector<ExplicitStudy>& studies) {
    using namespace q5_explicit;
    add_paragraphs(section, {how_large(studies), which_step(studies), when_to_stop(studies), too_large(studies), units_of_lambda(studies)});
}
std::string told(const ExplicitStudy& study) { return told(add_explicit, std::vector{study}); }

void discuss(report::Section& section, const q6_implicit::Studies& studies) {
    add_paragraphs(section, {q6_implicit::rule_of(studies)});
    for (const ImplicitStudy& study : studies) add_paragraphs(section, {q6_implicit::reading_of(study)});
    for (const auto of :
         {q6_implicit::views_of, q6_implicit::comparison_of, q6_implicit::larger_steps_of, q6_implicit::quality_of, q6_implicit::price_of})
        add_paragraphs(section, {of(studies)});
}
std::string told(const ImplicitStudy& study) { return told(discuss, std::vector{study}); }
std::string answered(const ImplicitStudy& study) { return report::plain(q6_implicit::answer_of({study})); }

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

const auto cube = library_mesh(cube_mesh(10), "cube_told");
const auto ball = library_mesh(icosphere(2), "ball_told");

void expect_a_number_in_every_paragraph(void (*discuss)(report::Section&)) {
    report::Section section;
    discuss(section);
    for (const report::Block& block : section.blocks) {
        const auto* paragraph = std::get_if<report::Paragraph>(&block);
        if (paragraph == nullptr) continue;
        const std::string words = report::plain(paragraph->text);
        EXPECT_TRUE(std::any_of(words.begin(), words.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) << words;
        EXPECT_FALSE(has(words, "  ")) << words;
        EXPECT_TRUE(words.ends_with(".")) << words;
    }
}

}   // namespace

TEST(Discussions, NoParagraphIsWithoutItsNumber) {
    expect_a_number_in_every_paragraph([](report::Section& section) {
        add_explicit(section, {explicit_study(cube, quick_settings()), explicit_study(ball, quick_settings())});
        discuss(section, {implicit_study(cube, quick_settings()), implicit_study(ball, quick_settings())});
        const q7_denoising::Grids grids{q7_denoising::denoising_grid(cube, quick_settings()),
                                        q7_denoising::denoising_grid(ball, quick_settings())};
        for (const auto of : {q7_denoising::explanation_of, q7_denoising::reading_of, q7_denoising::strength_of, q7_denoising::amount_of,
                              q7_denoising::limits_of})
            add_paragraphs(section, {of(grids)});
    });
}

TEST(ListedObserved, TellsACommonConditionOnce) {
    EXPECT_EQ(listed_observed({{"a", "x"}, {"b", "x"}, {"c", "x"}}), "a, b and c, each time x");
    EXPECT_EQ(listed_observed({{"a", "x"}, {"b", "y"}}), "a (x) and b (y)");
    EXPECT_EQ(listed_observed({{"a", "x"}}), "a (x)");
    EXPECT_EQ(listed_observed({}), "");
}

TEST(ExplicitDiscussion, BlamesASpotARegionOrTheWhole) {
    ExplicitStudy study = explicit_study(ball, quick_settings());
    study.subject.top.support = 1.5;
    EXPECT_TRUE(has(told(study), "a few vertices set the limit")) << told(study);
    study.subject.top.support = 100;
    EXPECT_TRUE(has(told(study), "spreads over the triangulation")) << told(study);
    EXPECT_FALSE(has(told(study), "a few vertices")) << told(study);
}

TEST(ExplicitDiscussion, RecommendsOnlyWhatIsStable) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    EXPECT_TRUE(has(told(study), "A good step is half the limit")) << told(study);
    study.recommended->run = 0;
    EXPECT_TRUE(has(told(study), "so we take a smaller one")) << told(study);
    study.recommended->run = 2;
    EXPECT_TRUE(has(told(study), "we take the largest stable one")) << told(study);
    study.recommended.reset();
    EXPECT_FALSE(has(told(study), "half the limit")) << told(study);
    EXPECT_TRUE(has(told(study), "no step tried can be recommended")) << told(study);
    EXPECT_FALSE(has(told(study), "So we stop")) << told(study);
}

TEST(ExplicitDiscussion, TheLargestStepIsFurtherAlongOnlyWhereItIs) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    const std::size_t larger = study.first_beyond() - 1, half = study.recommended->run;
    ASSERT_GT(larger, half);
    EXPECT_TRUE(has(told(study), "leave less energy")) << told(study);
    study.runs[larger].energy.back() = 1.01 * study.runs[half].energy.back();
    EXPECT_FALSE(has(told(study), "leave less energy")) << told(study);
    EXPECT_TRUE(has(told(study), "20 steps of 0.95 λ_crit leave 12")) << told(study);
}

TEST(ExplicitDiscussion, SaysOfTheResultOnlyWhatItsFigureShows) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    EXPECT_TRUE(has(told(study), "sharp edges and corners of cube_told round off first")) << told(study);
    study.recommended->on_features = 1;
    study.recommended->on_boundary = 2;
    EXPECT_FALSE(has(told(study), "round off first")) << told(study);
    EXPECT_TRUE(has(told(study), "it moved 2.0 times as far as the inside")) << told(study);
    study.recommended->roughness_before = 30;
    study.recommended->roughness_after = 16;
    EXPECT_FALSE(has(told(study), "more than halved")) << told(study);
    study.recommended->roughness_after = 14;
    EXPECT_TRUE(has(told(study), "more than halved by then on cube_told")) << told(study);
}

TEST(ExplicitDiscussion, TellsWhatTheEnergyHidesOnlyWhereItDoes) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    const std::size_t beyond = study.first_beyond();
    ASSERT_LT(beyond, study.runs.size());
    study.runs[beyond].energy.back() = 0.5 * study.runs[beyond].energy.front();
    EXPECT_TRUE(has(told(study), "The energy is no warning")) << told(study);
    study.runs[beyond].energy.back() = 2 * study.runs[beyond].energy.front();
    EXPECT_FALSE(has(told(study), "The energy is no warning")) << told(study);
    study.runs.resize(beyond);   // nothing beyond the limit was tried
    study.amplification.resize(beyond);
    EXPECT_TRUE(has(told(study), "No step tried on cube_told exceeds the limit")) << told(study);
}

TEST(ExplicitDiscussion, NamesTheIterationThatBreaksAndKnowsItsMode) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    SmoothingRun& last = study.runs.back();
    last.result.blew_up = true;
    last.result.blow_up_iteration = 12;
    last.result.blow_up_vertex = study.peaks.back();
    EXPECT_TRUE(has(told(study), "cube_told blew up in iteration 12")) << told(study);
    EXPECT_TRUE(has(told(study), "is one where the top mode is largest")) << told(study);
    study.peaks = {last.result.blow_up_vertex + 1};
    EXPECT_FALSE(has(told(study), "top mode is largest")) << told(study);
}

TEST(ExplicitDiscussion, ABlowUpIsAFindingOnlyWhereItWasSeen) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    EXPECT_TRUE(has(told(study), "within the 20 steps tried it only grew")) << told(study);
    EXPECT_TRUE(has(report::plain(q5_explicit::answer_in_short({study})), "at 2 λ_crit the mesh blew up within")) << "every run does";
    study.runs[study.first_beyond()].result.blew_up = true;
    EXPECT_FALSE(has(told(study), "it only grew")) << told(study);
    study.runs.back().result.blew_up = false;
    EXPECT_FALSE(has(report::plain(q5_explicit::answer_in_short({study})), "blew up"));
}

TEST(ExplicitDiscussion, FacesTurnedOverAreThoseOfTheLastFrameUpToFive) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    q5_explicit::Strip& strip = study.strips.back();
    ASSERT_GE(strip.frames.size(), 3u);
    ASSERT_EQ(study.frame_times[2], 5);
    strip.frames[2] = strip.frames[0];
    EXPECT_FALSE(has(told(study), "By t = 5")) << told(study);
    strip.frames[2].col(0) *= -1;   // a mirror image: its four other sides face inwards
    EXPECT_TRUE(has(told(study), "By t = 5 800 of the 1200 faces of cube_told have turned over")) << told(study);
}

TEST(ImplicitDiscussion, CallsTooMuchOnlyWhatLosesItsSize) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    for (SmoothingCell& cell : study.grid) cell.kept = 0.99;
    EXPECT_FALSE(has(told(study), "shows too much")) << told(study);
    study.grid[2].kept = 0.6;
    study.grid[3].kept = 0.7;
    EXPECT_TRUE(has(told(study), "only 60\u202f% of the size is left")) << told(study);
    study.grid[2].kept = 1e-5;   // nothing to look at
    EXPECT_TRUE(has(told(study), "only 70\u202f% of the size is left")) << told(study);
}

TEST(ImplicitDiscussion, TheGapIsTheLargestOfAllCellsWithinTheLimit) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    const Positions& X = study.subject.mesh().X;
    const Positions step = Positions::Ones(X.rows(), 3);
    const auto set_gaps = [&](double first, double last) {   // of the distance moved
        for (SmoothingCell& cell : study.grid) cell.implicit_X = X + step, cell.explicit_X = X + step;
        study.grid[0].explicit_X = X + (1 + first) * step;
        study.grid[1].explicit_X = X + (1 + last) * step;
        study.grid.back().explicit_X = X + 9 * step;   // beyond the limit
        return told(study);
    };
    const std::string fades = set_gaps(0.3, 0.04), stays = set_gaps(0.3, 0.2), little = set_gaps(0.04, 0.03);
    EXPECT_TRUE(has(fades, "up to 30\u202f% of the distance moved (t = 1 on cube_told), but below 5\u202f% from t = 10 on")) << fades;
    EXPECT_TRUE(has(stays, "Even within the explicit limit")) << stays;
    EXPECT_FALSE(has(stays, "below 5")) << stays;
    EXPECT_TRUE(has(little, "at most 4.0\u202f% of the distance moved")) << little;
}

TEST(ImplicitDiscussion, SharpEdgesOfAClosedMeshGiveWay) {
    EXPECT_TRUE(has(told(implicit_study(cube, quick_settings())), "The sharp edges are rounded first"));
}

TEST(ImplicitDiscussion, SaysWhereTheShapeGivesWay) {
    ImplicitStudy study = implicit_study(library_mesh(grid_mesh(12, 12, 1, 1), "sheet_told"), quick_settings());
    ASSERT_TRUE(study.recommended);
    EXPECT_TRUE(has(told(study), "The open boundary shrinks first")) << told(study);
    Positions& X = study.recommended->implicit_X;
    X = study.subject.mesh().X.rowwise() + Eigen::RowVector3d(0.1, 0, 0);   // all alike
    EXPECT_FALSE(has(told(study), "shrinks first")) << told(study);
}

/// The first step of the smallest λ whose explicit run blew up.
SmoothingCell& first_too_large(ImplicitStudy& study, std::size_t t = 0) {
    return study.grid.at(*study.first_blown() * study.iterations.size() + t);
}

TEST(ImplicitDiscussion, SpikesAreSeenOnlyWhereTheyAreDrawn) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    ASSERT_TRUE(study.first_blown());
    SmoothingCell& later = first_too_large(study, 1);
    later.explicit_energy = 5;
    later.explicit_X = study.subject.mesh().X;
    EXPECT_TRUE(has(told(study), "Then spikes grow: at λ = 5 λ_crit, t = 10")) << told(study);
    later.explicit_X *= 3;   // too large to be drawn
    EXPECT_FALSE(has(told(study), "spikes grow")) << told(study);
}

TEST(ImplicitDiscussion, WhatAStepTooLargeDoesIsMeasured) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    EXPECT_TRUE(has(told(study), "pulls the sharp edges inside the faces")) << told(study);
    SmoothingCell& first = first_too_large(study);
    first.explicit_X = study.subject.mesh().X;   // the edges are where they were
    first.explicit_energy = 3;
    EXPECT_TRUE(has(told(study), "the energy rises to 300\u202f% of the input")) << told(study);
    first.explicit_energy = 0.5;
    EXPECT_FALSE(has(told(study), "explicit step too large")) << "no smoother than the implicit one: nothing to say: " << told(study);

    TriangleMesh noisy = cube_mesh(10);
    noisy.X = with_gaussian_noise(noisy.X, Vector3::Constant(0.02), 1);
    ImplicitStudy rough = implicit_study(library_mesh(noisy, "noisy_told"), quick_settings());
    ASSERT_TRUE(rough.first_blown());
    SmoothingCell& step = first_too_large(rough);
    step.explicit_energy = 0.5;
    step.implicit_X = noisy.X, step.explicit_X = rough.cell(1, 1).implicit_X;
    EXPECT_TRUE(has(told(rough), "looks best at first: its median face angle is")) << told(rough);
}

TEST(ImplicitDiscussion, SmoothnessIsComparedOnlyOnRoughMeshes) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    EXPECT_EQ(q6_implicit::smoothness_key({study}), "") << "faces of a cube are flat";
    EXPECT_TRUE(has(told(study), "measures how round it has become: from 0° it rises to")) << told(study);
    study.roughness = 20;
    const auto key = [&](double by_implicit, double by_explicit) {
        study.costs[0].roughness = by_implicit, study.costs[0].explicit_roughness = by_explicit, study.costs[0].explicit_steps = 9;
        return q6_implicit::smoothness_key({study});
    };
    EXPECT_EQ(key(2, 2), "alike");
    EXPECT_EQ(key(3, 2), "smoother");
    EXPECT_TRUE(has(answered(study), "and leaves the surface as smooth or smoother") || q6_implicit::prices({study}, true).empty());
    EXPECT_EQ(key(2, 3), "rougher");
}

TEST(ImplicitDiscussion, TheAnswerWeighsBothPrices) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    ASSERT_EQ(study.costs.size(), 2u);
    for (q6_implicit::SmoothingCost& cost : study.costs) {
        cost.explicit_steps = 100;
        cost.explicit_operations = 4 * cost.implicit_operations;
        cost.cell.kept = 0.3;
    }
    EXPECT_TRUE(has(answered(study), "It is also cheaper: for as much smoothing as we recommend explicit steps need 4.0 times"));
    EXPECT_FALSE(has(answered(study), "pays only")) << answered(study);
    study.costs[0].explicit_operations = study.costs[0].implicit_operations / 2;
    EXPECT_TRUE(has(answered(study), "explicit smoothing is cheaper (0.50 times the arithmetic)")) << answered(study);
    EXPECT_TRUE(has(answered(study),
                    "Implicit smoothing pays only for much heavier smoothing, where explicit steps need 4.0 times the "
                    "arithmetic, but only 30\u202f% of the size is left."))
        << answered(study);
    study.costs[1].cell.kept = 0.99;
    EXPECT_FALSE(has(answered(study), "of the size is left")) << answered(study);
    study.costs[0].explicit_operations = study.costs[0].implicit_operations;
    EXPECT_TRUE(has(answered(study), "both cost about the same")) << answered(study);
    EXPECT_FALSE(has(answered(study), "depends on the mesh")) << "there is one mesh";
    study.costs[1].explicit_steps = 0;
    EXPECT_FALSE(has(answered(study), "heavier")) << answered(study);
    EXPECT_TRUE(has(told(study), "Only the implicit method reaches so much smoothing within 3000 steps on cube_told")) << told(study);
}
