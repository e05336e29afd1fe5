/// @file
/// Draws the figures of a report into its folder, in parallel.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "output/draw/figure_request.h"
#include "report/document.h"
#include "report/drawn_figure.h"

namespace meshfolio::output {

struct DrawSettings {
    int width = 800, height = 800;   // of view files [pixels]; below 800, pictures in sheets shrink as well
    bool view_files = false;         // write view files of all figures, not only of those that ask for them
    bool sheets_only = false;        // write no view files; view_files wins
};

/// Draws the figures: writes images/… and, for figures that readers can turn, models/… below `folder`.
/// @param progress  called by any thread with the share of the panels that are drawn
/// @return for each figure, by its id: places and JPEGs of its pictures, its legend and its models
/// @throws OutputError if a file cannot be written
report::DrawnFigures draw_figures(std::span<const FigureRequest> requests, const std::filesystem::path& folder,
                                  const DrawSettings& settings, const std::function<void(double share)>& progress = {});

}   // namespace meshfolio::output
