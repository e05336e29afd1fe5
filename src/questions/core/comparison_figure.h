/// @file
/// Figures of one mesh before and after, which readers of the page slide over each other and turn.
#pragma once

#include <string>

#include "questions/core/six_view_figure.h"

namespace meshfolio {

struct ComparisonFigure {
    std::string id;                // "q5_cube_before_after"
    std::string title, subtitle;   // set in the picture
    std::string caption;           // says what to see, with what was measured
    output::Panel before, after;   // plain surfaces: what is to be seen is the shape
    double diagonal = 1;           // of the box that displacements are told in [length]
    std::string colormap;
    int frame_panel = 0;   // 0: framed on the first; −1: on both
};

/// How far every vertex is from where it was, in % of the diagonal. NaN where either place is not finite.
Vector displacement_percent(const Positions& before, const Positions& after, double diagonal);

/// Appends the figure, with the displacement as a third panel in colours of its own, and an alternative text made from the data.
void add_comparison(Answer& answer, ComparisonFigure figure);

}   // namespace meshfolio
