// The discussions of questions 5 to 7 follow their numbers: each test changes a number of a study and expects other words.
#include <gtest/gtest.h>

#include <cctype>

#include "base/number_text.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/vertex_noise.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_laws.h"
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
    for (const char* key : {"limit", "step", "beyond", "stop", "units"})
        add_words(section, q5_explicit::words, key, q5_explicit::facts_of(studies));
}
std::string answered(const std::vector<ExplicitStudy>& studies) {
    return report::plain(q5_explicit::words.say("answer", q5_explicit::facts_of(studies)));
}
std::string told(const ExplicitStudy& study) { return told(add_explicit, std::vector{study}); }

void discuss(report::Section& section, const q6_implicit::Studies& studies) {
    add_paragraphs(section, {q6_implicit::rule_of(studies)});
    for (const ImplicitStudy& study : studies) add_paragraphs(section, {q6_implicit::reading_of(study)});
    for (const auto of : {q6_implicit::comparison_of, q6_implicit::larger_steps_of, q6_implicit::quality_of, q6_implicit::price_of,
                          q6_implicit::verdict_of})
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
        const report::Facts facts = q7_denoising::facts_of(grids, q7_denoising::reasons_of(grids));
        for (const char* key : {"discussion.when", "discussion.further"}) add_words(section, q7_denoising::words, key, facts);
    });
}

TEST(ExplicitDiscussion, BlamesASpotARegionOrTheWhole) {
    ExplicitStudy study = explicit_study(ball, quick_settings());
    study.subject.top.support = 1.5;
    EXPECT_TRUE(has(told(study), "a few vertices set the limit")) << told(study);
    EXPECT_TRUE(has(told(study), "at the ringed vert")) << told(study);
    study.recommended.reset();   // no figure, no ring
    EXPECT_FALSE(has(told(study), "ringed")) << told(study);
    study.subject.top.support = 100;
    EXPECT_TRUE(has(told(study), "spreads over the triangulation")) << told(study);
    EXPECT_FALSE(has(told(study), "a few vertices")) << told(study);
}

TEST(ExplicitDiscussion, RecommendsOnlyWhatIsStable) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    EXPECT_TRUE(has(told(study), "Up to half the limit no wave flips")) << told(study);
    EXPECT_TRUE(answered({study}).starts_with("A good step is λ = 1/μ_max, half the limit;")) << answered({study});
    study.recommended->stopped.lambda *= 0.1;
    EXPECT_TRUE(has(told(study), "we take a smaller one")) << told(study);
    study.recommended->stopped.lambda = 0.95 * study.subject.critical;
    EXPECT_TRUE(has(told(study), "we take the largest stable one")) << told(study);
    study.recommended.reset();
    EXPECT_FALSE(has(told(study), "A good step")) << told(study);
    EXPECT_TRUE(has(told(study), "no step tried can be recommended")) << told(study);
    EXPECT_FALSE(has(told(study), "We stop")) << told(study);
}

TEST(ExplicitDiscussion, TheLargestStepIsFurtherAlongOnlyWhereItIs) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    const std::size_t larger = study.first_beyond() - 1, half = study.recommended->run;
    ASSERT_GT(larger, half);
    EXPECT_TRUE(has(told(study), "also shrunk more, on cube_told")) << told(study);
    study.runs[larger].energy.back() = 1.01 * study.runs[half].energy.back();
    EXPECT_FALSE(has(told(study), "shrunk more")) << told(study);
    EXPECT_TRUE(has(told(study), "20 steps of 0.95 λ_crit leave 12")) << told(study);
}

TEST(ExplicitDiscussion, SaysOfTheResultOnlyWhatItsFigureShows) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    EXPECT_TRUE(has(told(study), "Sharp edges and corners give way first, on cube_told")) << told(study);
    EXPECT_TRUE(has(told(study), "cube_told had no noise to lose, only shape")) << told(study);
    study.recommended->on_features = 1;
    study.recommended->on_boundary = 2;
    EXPECT_FALSE(has(told(study), "Sharp edges and corners")) << told(study);
    EXPECT_TRUE(has(told(study), "The free boundary shrinks first")) << told(study);
    study.recommended->roughness_before = 30;
    EXPECT_FALSE(has(told(study), "no noise to lose")) << told(study);
    study.recommended->roughness_after = 16;
    EXPECT_FALSE(has(told(study), "median face angle falls")) << told(study);
    study.recommended->roughness_after = 14;
    EXPECT_TRUE(has(told(study), "The median face angle falls") || has(told(study), "the median face angle falls at least 2.1-fold"))
        << told(study);
}

TEST(ExplicitDiscussion, FacesTurnedOverAreFoldsUndoneOrMade) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    study.recommended->stopped.moved.inverted_faces = 90;
    study.recommended->folded_before = 60, study.recommended->folded_after = 0;
    EXPECT_TRUE(has(told(study), "Folds of cube_told were undone")) << told(study);
    study.recommended->folded_before = 10, study.recommended->folded_after = 30;
    EXPECT_FALSE(has(told(study), "were undone")) << told(study);
    EXPECT_TRUE(has(told(study), "New folds on cube_told")) << told(study);
}

TEST(ExplicitDiscussion, TheLimitsOfMeshesAreComparedInTheirOwnEdges) {
    TriangleMesh large = icosphere(2);
    large.X *= 10;
    const std::vector studies{explicit_study(ball, quick_settings()),
                              explicit_study(library_mesh(std::move(large), "large_told"), quick_settings())};
    const std::string both = told(add_explicit, studies);
    EXPECT_FALSE(has(both, "times smaller")) << "one triangulation, two sizes: " << both;
    EXPECT_TRUE(has(both, " on ball_told and λ = ")) << both;
}

TEST(ExplicitDiscussion, ReportsWhatTheEnergyHidesOnlyWhereItHidesIt) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    const std::size_t beyond = study.first_beyond();
    ASSERT_LT(beyond, study.runs.size());
    study.runs[beyond].energy.back() = 0.5 * study.runs[beyond].energy.front();
    EXPECT_TRUE(has(told(study), "it is no warning")) << told(study);
    study.runs[beyond].energy.back() = 2 * study.runs[beyond].energy.front();
    EXPECT_FALSE(has(told(study), "it is no warning")) << told(study);
    study.runs.resize(beyond);   // nothing beyond the limit was tried
    study.amplification.resize(beyond);
    study.near.reset(), study.far.reset();
    EXPECT_TRUE(has(told(study), "No step tried on cube_told exceeds the limit")) << told(study);
    EXPECT_FALSE(has(told(study), "Too large a step")) << told(study);
}

// Two vertices that nearly meet diverge by the top mode; a cube's symmetry leaves none of it in the input, and other modes
// grow.
TEST(ExplicitDiscussion, BlamesTheTopModeOnlyIfItIsMostOfTheMotion) {
    const ExplicitStudy symmetric = explicit_study(cube, quick_settings());
    ASSERT_TRUE(symmetric.runs.back().result.blew_up);
    EXPECT_LT(share_of_top_mode(symmetric.subject, symmetric.runs.back().result.X), 1e-6);
    ExplicitStudy blamed = symmetric;
    blamed.peaks = {blamed.runs.back().result.blow_up_vertex};   // where it broke, although the mode is not what grew
    EXPECT_FALSE(has(told(blamed), "most of the motion at the end is the top mode")) << told(blamed);

    TriangleMesh pinched = icosphere(3);
    pinched.X.row(100) += 0.95 * (pinched.X.row(topology_of(pinched).neighbours.begin(100)[0]) - pinched.X.row(100));
    ExplicitStudy study = explicit_study(library_mesh(pinched, "pinched_told"), quick_settings());
    ASSERT_TRUE(study.runs.back().result.blew_up);
    ASSERT_GT(share_of_top_mode(study.subject, study.runs.back().result.X), 0.5);
    study.peaks = {study.runs.back().result.blow_up_vertex};
    EXPECT_TRUE(has(told(study), "On pinched_told most of the motion at the end is the top mode")) << told(study);
    study.peaks = {study.runs.back().result.blow_up_vertex + 1};
    EXPECT_FALSE(has(told(study), "most of the motion")) << told(study);
}

TEST(ExplicitDiscussion, ABlowUpIsAFindingOnlyWhereItWasSeen) {
    ExplicitStudy study = explicit_study(cube, quick_settings());
    EXPECT_TRUE(has(answered({study}), "at 2 λ_crit the mesh blew up within")) << "every run does";
    study.runs.back().result.blew_up = false;
    EXPECT_FALSE(has(answered({study}), "blew up"));
}

// The extent of the top mode says nothing about how many vertices have spikes.
TEST(ExplicitDiscussion, SpikesAreWhereVerticesAreRougherNotWhereTheModeIs) {
    TriangleMesh sheet = grid_mesh(20, 20, 1, 1);
    for (Eigen::Index v = 0; v < sheet.X.rows(); ++v) sheet.X(v, 2) += 0.01 * std::sin(3.0 * static_cast<double>(v * v));
    ExplicitStudy study = explicit_study(library_mesh(sheet, "sheet_told"), quick_settings());
    ASSERT_TRUE(study.far && study.far->at(5));
    study.subject.top.support = 1.5;   // a spot, if one inferred it
    const Positions X = study.subject.mesh().X;
    EXPECT_EQ(q5_explicit::share_rougher(study.subject, X), 0);
    study.far->frames[4] = X;
    EXPECT_FALSE(has(told(study), "Spikes rise everywhere")) << told(study);
    study.far->frames[4].col(2) *= 8;   // all bumps eight times as high
    EXPECT_GT(q5_explicit::share_rougher(study.subject, study.far->frames[4]), 0.9);
    EXPECT_TRUE(has(told(study), "Spikes rise everywhere: by t = 5 ")) << told(study);
    ASSERT_TRUE(study.near);
    study.near->frames.back() = X;
    study.near->frames.back()(210, 2) += 0.3;   // one spike
    EXPECT_TRUE(has(told(study), "ripples are in few places")) << told(study);
}

TEST(ImplicitDiscussion, CallsTooMuchOnlyWhatLosesItsSize) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    for (SmoothingCell& cell : study.grid) cell.kept = 0.99;
    EXPECT_FALSE(has(told(study), "goes too far")) << told(study);
    study.grid[2].kept = 0.6;
    study.grid[3].kept = 0.7;
    EXPECT_TRUE(has(told(study), ": 60\u202f% of the size is left")) << told(study);
    study.grid[2].kept = 1e-5;   // nothing to look at
    EXPECT_TRUE(has(told(study), ": 70\u202f% of the size is left")) << told(study);
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
    EXPECT_TRUE(has(fades, "up to 30\u202f% of the distance moved (t = 1 on cube_told). From t = 10 on it is at most 5\u202f%")) << fades;
    EXPECT_TRUE(has(stays, "differ even within the explicit limit")) << stays;
    EXPECT_FALSE(has(stays, "From t =")) << stays;
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
    EXPECT_TRUE(has(told(study), "Spikes grow by t = 10, where the energy is 5.0 times the input's")) << told(study);
    later.explicit_X *= 3;   // too large to be drawn
    EXPECT_FALSE(has(told(study), "Spikes grow")) << told(study);
}

TEST(ImplicitDiscussion, WhatAStepTooLargeDoesIsMeasured) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    EXPECT_TRUE(has(told(study), "pulled the sharp edges inside the faces")) << told(study);
    SmoothingCell& first = first_too_large(study);
    first.explicit_X = study.subject.mesh().X;   // the edges are where they were
    first.explicit_energy = 3;
    EXPECT_TRUE(has(told(study), "have raised the energy to 300\u202f% of the input")) << told(study);
    first.explicit_energy = 0.5;
    EXPECT_FALSE(has(told(study), "Explicit steps of 5")) << "no smoother than the implicit one: nothing to say: " << told(study);

    TriangleMesh noisy = cube_mesh(10);
    noisy.X = with_gaussian_noise(noisy.X, Vector3::Constant(0.02), 1);
    ImplicitStudy rough = implicit_study(library_mesh(noisy, "noisy_told"), quick_settings());
    ASSERT_TRUE(rough.first_blown());
    SmoothingCell& step = first_too_large(rough);
    step.explicit_energy = 0.5;
    step.implicit_X = noisy.X, step.explicit_X = rough.cell(1, 1).implicit_X;
    EXPECT_TRUE(has(told(rough), "look best at first: at t = 1 the median face angle is")) << told(rough);
}

TEST(ImplicitDiscussion, SmoothnessIsComparedOnlyOnRoughMeshes) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    EXPECT_EQ(q6_implicit::smoothness_key(study), "") << "faces of a cube are flat";
    EXPECT_TRUE(has(told(study), "measures how round it has become: from 0° it rises to")) << told(study);
    study.roughness = 20;
    const auto key = [&](double by_implicit, double by_explicit) {
        study.cost->roughness = by_implicit, study.cost->explicit_roughness = by_explicit, study.cost->explicit_steps = 9;
        return q6_implicit::smoothness_key(study);
    };
    EXPECT_EQ(key(2, 2), "alike");
    EXPECT_EQ(key(2.019, 2.037), "alike");
    EXPECT_TRUE(has(told(study), "On cube_told the two tie at 2.0°")) << told(study);
    EXPECT_EQ(key(3, 2), "smoother");
    EXPECT_TRUE(has(told(study), "Explicit steps leave cube_told smoother: 2.0° against 3.0°")) << told(study);
    EXPECT_EQ(key(2, 3), "rougher");
    EXPECT_TRUE(has(told(study), "Implicit steps leave cube_told smoother: 2.0° against 3.0°")) << told(study);
}

TEST(ImplicitDiscussion, TheAnswerSaysFromWhereOnImplicitStepsPay) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    ASSERT_TRUE(study.cost);
    study.prices = {.explicit_step = 1, .implicit_step = 4, .factorisation = 8};
    const auto even = study.break_even();
    ASSERT_TRUE(even);
    const auto answered_at = [&](double ratio) {
        study.cost->ratio = ratio;
        return answered(study);
    };
    const double h = study.subject.mean_edge;
    EXPECT_TRUE(has(answered_at(0.5),
                    "explicit smoothing is cheaper (0.50 times the arithmetic). Implicit steps are cheaper only if they are large: "
                    "on cube_told from λt = " +
                        readable(even->time() / (h * h), 2) + " h̄² with 5 λ_crit. There"))
        << answered(study);
    EXPECT_TRUE(has(answered_at(4), "implicit smoothing is cheaper: explicit steps need 4.0 times the arithmetic")) << answered(study);
    EXPECT_TRUE(has(answered_at(1), "both cost about the same")) << answered(study);
    EXPECT_FALSE(has(answered(study), "depends on the mesh")) << "there is one mesh";
    EXPECT_TRUE(has(told(study), "either will do: explicit steps of 0.5 λ_crit need 1.0 times the work")) << told(study);
    study.cost->ratio = 4;
    EXPECT_TRUE(has(told(study), "take implicit steps. Explicit ones of 0.5 λ_crit need 4.0 times the work")) << told(study);
    EXPECT_FALSE(has(told(study), "Implicit steps are for more smoothing")) << "they are for this much already";
    study.cost->ratio = 0.1;
    EXPECT_TRUE(has(told(study), "take explicit steps of 0.5 λ_crit: the same or a smoother surface for 0.10 times the work"))
        << told(study);
    EXPECT_TRUE(has(told(study), "Implicit steps are for more smoothing than that")) << told(study);
    study.prices.implicit_step = 1e9;
    EXPECT_TRUE(has(answered(study), "On cube_told implicit steps pay at no amount tried.")) << answered(study);
    study.prices.implicit_step = 0;
    study.cost->ratio = NAN;
    EXPECT_FALSE(has(answered(study), "pay")) << "not counted: " << answered(study);
    EXPECT_FALSE(has(told(study), "factorisation costs")) << told(study);
}
