/// @file
/// Figures of smoothed meshes beside their input.
#pragma once

#include <string>

#include "questions/six_view_figure.h"
#include "questions/smoothing_study.h"

namespace meshfolio {

/// The mesh of the subject on the positions X, coloured by curvature_colours().
output::Panel smoothing_panel(const SmoothingSubject& subject, const Positions& X, std::string name, std::string label);

/// Puts the input, as panel `before`, in front of the panels and adds the figure. The colour range is the input's: an unstable result
/// has curvatures of any size.
void add_smoothing_figure(Answer& answer, const SmoothingSubject& subject, std::string before, SixViewFigure figure);

}   // namespace meshfolio
