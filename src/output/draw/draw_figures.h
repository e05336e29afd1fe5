/// @file
/// Draws the figures a report asks for into its folder, in parallel.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "output/draw/figure_request.h"
#include "report/document.h"

namespace meshfolio::output {

struct DrawSettings {
    int width = 800, height = 800;   // of a view in its own file; below 800, pictures in sheets shrink as well
    bool view_files = false;         // of all figures, not only of those that ask for them
    bool sheets_only = false;        // no view files at all
};

/// Writes images/… and, for figures that can be turned, models/… below `folder` and returns what the writers need.
/// @throws OutputError
report::DrawnFigures draw_figures(std::span<const FigureRequest> requests, const std::filesystem::path& folder,
                                  const DrawSettings& settings, const std::function<void(double)>& progress = {});

}   // namespace meshfolio::output
