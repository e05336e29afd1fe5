/// @file
/// The models of a report: meshes that readers of the page can turn.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "output/draw/figure_request.h"
#include "report/document.h"
#include "report/drawn_figure.h"

namespace meshfolio::output {

/// Limits that keep a page small: triangles of one model, and bytes of all GLB files, of which six tenths are added to the page. A figure
/// beyond has pictures only.
inline constexpr int most_model_triangles = 60'000;
inline constexpr std::size_t most_model_bytes = 2'000'000;

/// Writes models/<panel>.glb below `folder` for the panels of the figures that ask to be turned, in their order: the first two of every
/// figure, then the others of a figure while there is room for all of them.
/// @return by the id of the figure
/// @throws OutputError
std::map<std::string, std::vector<report::DrawnModel>> write_models(std::span<const FigureRequest> requests,
                                                                    const std::filesystem::path& folder);

}   // namespace meshfolio::output
