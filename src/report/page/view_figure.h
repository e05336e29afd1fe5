/// @file
/// The pictures of a figure as the templates see them (view_model.h): how they are laid out, on screens and on paper alike.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "report/page/view_blocks.h"

namespace meshfolio::report {

/// Enters what a page needs to show the pictures of a figure.
void enter_pictures(nlohmann::json& view, const Figure& figure, const DrawnFigure& drawn, const ViewContext& context);

/// The picture of the first page.
nlohmann::json cover_view(const Figure& cover, const ViewContext& context);

}   // namespace meshfolio::report
