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

namespace meshfolio::output {

struct DrawSettings {
    int width = 800, height = 800;   // of one view
    int sheet_cell = 400;            // of one view inside a 2 × 3 sheet
    int strip_cell = 240;            // of one view inside a strip of several panels
    int preview_width = 1200;        // of the JPEG inside the page
    int panel_width = 640;           // of the JPEG of one picture of a comparison
    int jpeg_quality = 82;
    std::set<std::string> on_paper = {};   // figures that also need their whole sheet as a JPEG
    int print_quality = 92;                // of the JPEG for paper: with the colours of every pixel
    int threads = 0;                       // 0: all
};

/// Writes images/… and, for figures that can be turned, models/… below `folder` and returns what the writers need.
/// @throws OutputError
report::DrawnFigures draw_figures(std::span<const FigureRequest> requests, const std::filesystem::path& folder,
                                  const DrawSettings& settings, const std::function<void(double)>& progress = {});

}   // namespace meshfolio::output
