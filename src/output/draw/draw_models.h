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

/// Limits that keep a page small: triangles of a model, bytes of all GLB files together (the page grows by six tenths of that). Beyond them
/// there are only pictures.
inline constexpr int most_model_triangles = 60'000;
inline constexpr std::size_t most_model_bytes = 2'000'000;

/// Writes models/<panel>.glb below `folder` for the turnable figures, in their order: first up to two models of each figure, then its
/// further ones, all or none. Models that would exceed most_model_bytes in all are left out.
/// @return the models of each figure, by its id
/// @throws OutputError if a file cannot be written
std::map<std::string, std::vector<report::DrawnModel>> write_models(std::span<const FigureRequest> requests,
                                                                    const std::filesystem::path& folder);

}   // namespace meshfolio::output
