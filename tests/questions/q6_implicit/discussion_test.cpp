// The discussion follows its numbers: each test changes a number of a study and expects other words.
#include <gtest/gtest.h>

#include "mesh/samples/sample_shapes.h"
#include "mesh/vertex_noise.h"
#include "questions/core/study_laws.h"
#include "questions/q6_implicit/parts.h"
#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {
using namespace testing_tools;

namespace {

std::string message(const Studies& studies) {
    report::Section section;
    const report::Facts facts = discussion_facts(studies);
    for (const char* key : {"method", "results", "discussion"}) add_words(section, words, key, facts);
    return prose_of(section);
}
std::string message(const ImplicitStudy& study) { return message(Studies{study}); }
std::string answered(const Studies& studies) { return report::plain(words.say("answer", answer_facts(studies))); }

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

const auto cube = library_mesh(cube_mesh(10), "cube_told6");

/// Returns a study with prices so low that every λ beyond the limit pays.
ImplicitStudy with_prices() {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    study.prices = {.explicit_step = 1, .implicit_step = 4, .factorisation = 8};
    return study;
}

/// Returns the study with this share of the size left after every step.
ImplicitStudy leaving(double size, ImplicitStudy study = with_prices()) {
    for (SmoothingRun& run : study.implicit_runs) std::fill(run.size.begin() + 1, run.size.end(), size);
    return study;
}

/// Returns the first state of the smallest λ with an explicit run that blew up.
SmoothingCell& first_too_large(ImplicitStudy& study) { return study.grid.at(*study.first_blown() * study.iterations.size()); }

}   // namespace

// Paying with 60 % of the size left is strong smoothing, with 40 % it is too far.
TEST(ImplicitDiscussion, TheSizeLeftDecidesIfPayingIsGentleStrongOrTooFar) {
    ASSERT_TRUE(with_prices().break_even());
    const std::string gentle = message(leaving(0.97)), strong = message(leaving(0.6)), gone = message(leaving(0.4));
    EXPECT_TRUE(has(gentle, "Implicit steps pay on cube_told6 while 95\u202f% of the size is still left")) << gentle;
    EXPECT_TRUE(has(strong, "Implicit steps pay only beyond the amount we recommend")) << strong;
    EXPECT_TRUE(has(strong, "60\u202f% of the size is left")) << strong;
    EXPECT_TRUE(has(gone, "Implicit steps pay on cube_told6 only where smoothing goes too far")) << gone;
    for (const std::string& text : {gentle, strong}) EXPECT_FALSE(has(text, "too far")) << text;
    EXPECT_FALSE(has(gone, "pay only beyond")) << gone;
    const std::string some = message(Studies{leaving(0.97), leaving(0.6)});
    EXPECT_TRUE(has(some, "They pay only for stronger smoothing on cube_told6")) << some;
    EXPECT_FALSE(has(some, "Implicit steps pay only beyond")) << some;
}

TEST(ImplicitDiscussion, TheAnswerIsOneSentence) {
    ImplicitStudy never = with_prices(), uncounted = with_prices();
    never.prices.implicit_step = 1e9;
    uncounted.prices.implicit_step = 0;
    const std::string always = answered({leaving(0.97)}), strong = answered({leaving(0.6)}), some = answered({leaving(0.97), leaving(0.6)});
    EXPECT_TRUE(has(always, "(50 λ_crit tried), and keeping 95\u202f% of the size it can be cheaper.")) << always;
    EXPECT_TRUE(has(strong, "only beyond the amount we recommend.")) << strong;
    EXPECT_TRUE(has(some, "on 1 of 2 meshes")) << some;
    EXPECT_TRUE(has(answered({never}), "costs more than explicit smoothing at every amount tried.")) << answered({never});
    EXPECT_TRUE(answered({uncounted}).ends_with("(50 λ_crit tried).")) << answered({uncounted});
    for (const std::string& answer : {always, strong, some, answered({never})}) EXPECT_LE(std::ranges::count(answer, ' '), 25) << answer;
    EXPECT_FALSE(has(message(uncounted), "pay.")) << message(uncounted);
    EXPECT_TRUE(has(message(never), "On cube_told6 they pay at no amount tried")) << message(never);
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
        return message(study);
    };
    const std::string fades = set_gaps(0.3, 0.04), stays = set_gaps(0.3, 0.2), little = set_gaps(0.04, 0.03);
    EXPECT_TRUE(has(fades, "differ by up to 30\u202f% of the distance moved. From t = 10 on it is at most 5\u202f%")) << fades;
    EXPECT_TRUE(has(stays, "the schemes differ, too")) << stays;
    EXPECT_FALSE(has(stays, "From t =")) << stays;
    EXPECT_TRUE(has(little, "never differ by more than 4.0\u202f% of the distance moved")) << little;
}

TEST(ImplicitDiscussion, NamesTheMeshesWhoseBoundaryOrEdgesShrink) {
    EXPECT_TRUE(has(message(implicit_study(cube, quick_settings())), "The sharp edges of cube_told6 are rounded first"));
    ImplicitStudy study = implicit_study(library_mesh(grid_mesh(12, 12, 1, 1), "sheet_told6"), quick_settings());
    ASSERT_TRUE(study.recommended);
    EXPECT_TRUE(has(message(study), "The open boundary of sheet_told6 shrinks before the inside does")) << message(study);
    study.recommended->implicit_X = study.subject.mesh().X.rowwise() + Eigen::RowVector3d(0.1, 0, 0);   // all alike
    EXPECT_FALSE(has(message(study), "shrinks before")) << message(study);
}

TEST(ImplicitDiscussion, TheEffectOfATooLargeStepIsMeasured) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    EXPECT_TRUE(has(message(study), "sharp edges of cube_told6 are pulled in")) << message(study);
    SmoothingCell& first = first_too_large(study);
    first.explicit_X = study.subject.mesh().X;   // the edges are where they were
    first.explicit_energy = 3;
    EXPECT_FALSE(has(message(study), "pulled in")) << message(study);
    EXPECT_TRUE(has(message(study), "The energy of cube_told6 is higher there than that of the input")) << message(study);
    first.explicit_energy = 0.5;
    EXPECT_FALSE(has(message(study), "announce")) << "nothing to see as yet: " << message(study);

    TriangleMesh noisy = cube_mesh(10);
    noisy.X = with_gaussian_noise(noisy.X, Vector3::Constant(0.02), 1);
    ImplicitStudy rough = implicit_study(library_mesh(noisy, "noisy_told6"), quick_settings());
    ASSERT_TRUE(rough.first_blown());
    SmoothingCell& step = first_too_large(rough);
    step.explicit_energy = 0.5;
    step.implicit_X = noisy.X, step.explicit_X = rough.cell(1, 1).implicit_X;
    EXPECT_TRUE(has(message(rough), "Yet noisy_told6 at t = 1 looks smoother")) << message(rough);
}

TEST(ImplicitDiscussion, SmoothnessIsComparedOnlyOnRoughMeshes) {
    ImplicitStudy study = implicit_study(cube, quick_settings());
    const auto compared = [&](double by_implicit, double by_explicit) {
        study.cost->roughness = by_implicit, study.cost->explicit_roughness = by_explicit, study.cost->explicit_steps = 9;
        return message(study);
    };
    EXPECT_FALSE(has(compared(2, 2), "smooth at the same energy")) << "faces of a cube are flat";
    study.roughness = 20;
    EXPECT_TRUE(has(compared(2.019, 2.037), "Both schemes leave cube_told6 equally smooth"));
    EXPECT_TRUE(has(compared(3, 2), "explicit steps leave cube_told6 smoother"));
    EXPECT_TRUE(has(compared(2, 3), "implicit steps leave cube_told6 smoother"));
}

TEST(ImplicitDiscussion, AMeshAloneIsNotCalledTheLargest) {
    const ImplicitStudy study = implicit_study(cube, quick_settings());
    EXPECT_FALSE(has(message(study), "at most, on")) << message(study);
    EXPECT_TRUE(has(message(Studies{study, study}), "of the motion (rms) at most, on cube_told6")) << message(Studies{study, study});
}

}   // namespace meshfolio::q6_implicit
