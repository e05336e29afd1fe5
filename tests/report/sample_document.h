/// @file
/// Documents for the tests of the writers.
#pragma once

#include "report/document.h"
#include "report/drawn_figure.h"

namespace meshfolio::report {

/// One of everything: each kind of block, run, status, check, input and plot, with values that are undefined, huge and tiny.
Document sample_document();
DrawnFigures sample_figures();
/// Returns the figures in other layouts: one mesh with its views, and a matrix with heads and an empty cell.
DrawnFigures sample_layouts();
/// Returns the figures with one that can be turned, before and after.
DrawnFigures sample_models();

/// Markup, quotes, separators, control characters and bytes that are no UTF-8, in one name.
extern const std::string hostile;

/// The sample with `hostile` in every text a file name, a mesh name or a message could bring in.
Document hostile_document();
DrawnFigures hostile_figures();

}   // namespace meshfolio::report
