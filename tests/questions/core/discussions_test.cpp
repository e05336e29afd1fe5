// The discussions of questions 5 and 7 follow their numbers: each test changes a number of a study and expects other words.
#include <gtest/gtest.h>

#include <cctype>

#include "base/number_text.h"
#include "mesh/samples/sample_shapes.h"
#include "mesh/vertex_noise.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_laws.h"
#include "questions/q5_explicit/parts.h"
#include "questions/q5_explicit/study.h"
#include "questions/q7_denoising/study.h"

using namespace meshfolio;
using namespace meshfolio::testing_tools;
using q5_explicit::explicit_study;
using q5_explicit::ExplicitStudy;

namespace {

template <class Study> std::string told(void (*add)(report::Section&, const std::vector<Study>&), const std::vector<Study>& studies) {
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
    EXPECT_TRUE(has(told(study), "also shrunk more, by over 2\u202f% of the input's on cube_told")) << told(study);
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
    EXPECT_TRUE(has(told(study), "Spikes rise everywhere")) << told(study);
    ASSERT_TRUE(study.near);
    study.near->frames.back() = X;
    study.near->frames.back()(210, 2) += 0.3;   // one spike
    EXPECT_TRUE(has(told(study), "ripples are in few places")) << told(study);
}
