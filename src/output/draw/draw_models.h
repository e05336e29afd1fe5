/// @file
/// The models of a report: meshes that readers of the page can turn.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "output/draw/figure_request.h"
#include "report/document.h"

namespace meshfolio::output {

/// Limits of what is turned, so that the page stays light: triangles of a mesh, and bytes of GLB of all models together, which are at most
/// 8 MB of base64 in the page. A figure beyond keeps its pictures.
inline constexpr int most_model_triangles = 60'000;
inline constexpr std::size_t most_model_bytes = 6'000'000;

/// Writes models/<panel>.glb below `folder` for the figures that ask to be turned, in their order, and names them in `figures`.
/// @throws OutputError
void add_models(std::span<const FigureRequest> requests, const std::filesystem::path& folder, report::DrawnFigures& figures);

}   // namespace meshfolio::output
