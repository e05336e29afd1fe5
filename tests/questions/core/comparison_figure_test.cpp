#include "questions/core/comparison_figure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/samples/sample_shapes.h"

using namespace meshfolio;

namespace {

/// A ball of diagonal `diagonal` whose vertices all moved by `shift` along x.
ComparisonFigure moved_ball(double shift, double diagonal) {
    const TriangleMesh ball = icosphere(1);
    TriangleMesh moved = ball;
    moved.X.col(0).array() += shift;
    ComparisonFigure figure;
    figure.id = "q5_ball_before_after";
    figure.title = "ball before and after";
    figure.caption = "The ball.";
    figure.before = panel_of(ball, "ball_before", "before");
    figure.after = panel_of(moved, "ball_after", "after");
    figure.diagonal = diagonal;
    figure.colormap = "viridis";
    return figure;
}

}   // namespace

TEST(ComparisonFigure, MeasuresHowFarEveryVertexMoved) {
    const TriangleMesh ball = icosphere(1);
    const Vector moved = displacement_percent(ball.X, moved_ball(0.5, 1).after.mesh->X, 25);
    EXPECT_LT((moved.array() - 2).abs().maxCoeff(), 1e-12);
    Positions gone = ball.X;
    gone(3, 1) = INFINITY;
    EXPECT_TRUE(std::isnan(displacement_percent(ball.X, gone, 25)[3])) << "what has left has no distance";
    EXPECT_EQ(displacement_percent(ball.X, gone, 25)[4], 0);
}

TEST(ComparisonFigure, AsksForThreePicturesOfWhichOnlyTheDifferenceIsColoured) {
    Answer answer;
    add_comparison(answer, moved_ball(0.5, 25));
    ASSERT_EQ(answer.figures.size(), 1u);
    const output::FigureRequest& request = answer.figures.front();
    EXPECT_TRUE(request.layout == output::Layout::comparison && request.turnable);
    ASSERT_EQ(request.panels.size(), 3u);
    EXPECT_EQ(request.panels[0].values.size(), 0);
    EXPECT_EQ(request.panels[1].values.size(), 0);
    EXPECT_EQ(request.panels[2].values.size(), request.panels[2].mesh->vertex_count());
    EXPECT_EQ(request.panels[2].mesh, request.panels[1].mesh) << "the difference is shown where the vertices went";
    EXPECT_EQ(request.range->low, 0);
}

TEST(ComparisonFigure, ItsWordsChangeWithTheData) {
    Answer two, four;
    add_comparison(two, moved_ball(0.5, 25));
    add_comparison(four, moved_ball(1, 25));
    const auto& small = std::get<report::Figure>(two.section.blocks.front());
    const auto& large = std::get<report::Figure>(four.section.blocks.front());
    for (const std::string& words : {small.caption, small.alt}) EXPECT_NE(words.find("moved by 2.00\u202f%"), std::string::npos) << words;
    for (const std::string& words : {large.caption, large.alt}) EXPECT_NE(words.find("moved by 4.00\u202f%"), std::string::npos) << words;
}
