/// @file
/// The models of a report: meshes that readers of the page can turn.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "output/draw/figure_request.h"
#include "report/document.h"

namespace meshfolio::output {

/// Limits that keep a page small: triangles of one model, and bytes of the GLB files that one call writes (at most 8 MB of base64 in its
/// page). A figure beyond has pictures only.
inline constexpr int most_model_triangles = 60'000;
inline constexpr std::size_t most_model_bytes = 6'000'000;

/// Writes models/<panel>.glb below `folder` for the figures that ask to be turned, in their order, and names them in `figures`.
/// @throws OutputError
void add_models(std::span<const FigureRequest> requests, const std::filesystem::path& folder, report::DrawnFigures& figures);

}   // namespace meshfolio::output
