/// @file
/// The models of a report: meshes that readers can turn in the page.
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

/// Limits that keep a page small: triangles of one model, and bytes of all GLB files together, which lengthen the page by six tenths of
/// that. A figure beyond a limit has only pictures.
inline constexpr int most_model_triangles = 60'000;
inline constexpr std::size_t most_model_bytes = 2'000'000;

/// Writes models/<panel>.glb below `folder` for the turnable figures, in their order: first up to two models of every figure, then the
/// other models of a figure if there is room for all of them.
/// @return the models of each figure, by its id
/// @throws OutputError if a file cannot be written
std::map<std::string, std::vector<report::DrawnModel>> write_models(std::span<const FigureRequest> requests,
                                                                    const std::filesystem::path& folder);

}   // namespace meshfolio::output
