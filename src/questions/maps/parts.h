/// @file
/// Parts of the section "maps": what the planes of smoothing show.
#pragma once

#include <string>
#include <vector>

#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"
#include "questions/maps/study.h"

namespace meshfolio::maps {

inline constexpr report::Words words("maps");

using Studies = std::vector<SmoothingMaps>;

/// The maps of one mesh: error, volume (area where it is open), smallest angle, turned triangles; explicit beside implicit.
std::vector<report::Map> maps_of(const SmoothingMaps& maps);
/// "a: explicit, the last step …. b: …."
std::string words_of(const std::vector<MapPlace>& places);

report::Table blow_up_table(const Studies& studies);
report::Table place_table(const Studies& studies);
report::Table region_table(const Studies& studies);

/// "none", "12".
std::string none_or(int count);
void add_discussion(report::Section& section, const Studies& studies);

}   // namespace meshfolio::maps
