/// @file
/// Figures in a terminal.
#pragma once

#include <string>
#include <vector>

#include "run/one_mesh/figure.h"
#include "run/one_mesh/terminal_picture.h"

namespace meshfolio::run {

/// Returns the text that shows a figure as wide as the terminal. Where pictures are too coarse for words, these follow as lines.
std::string terminal_figure(std::vector<FigureMesh> meshes, FigureStyle style, const TerminalRoom& room);

}   // namespace meshfolio::run
