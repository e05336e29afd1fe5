/// @file
/// Draws the figures a report asks for into its folder, in parallel.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>

#include "output/draw/figure_request.h"
#include "report/document.h"
#include "report/drawn_figure.h"

namespace meshfolio::output {

struct DrawSettings {
    int width = 800, height = 800;   // of a view in its own file; below 800, pictures in sheets shrink as well
    bool view_files = false;         // of all figures, not only of those that ask for them
    bool sheets_only = false;        // no view files at all
};

/// Called while figures are drawn, by any thread.
struct DrawEvents {
    std::function<void(double share)> progress = {};
    std::set<std::string> early = {};                                     // ids of figures to be drawn before the others;
    std::function<void(report::DrawnFigures figures)> early_drawn = {};   // called with them, once, even if there are none
};

/// Writes images/… and, for figures that can be turned, models/… below `folder` and returns what the writers need.
/// @throws OutputError
report::DrawnFigures draw_figures(std::span<const FigureRequest> requests, const std::filesystem::path& folder,
                                  const DrawSettings& settings, const DrawEvents& events = {});

}   // namespace meshfolio::output
