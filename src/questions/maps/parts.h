/// @file
/// Parts of the section "maps": what the planes of smoothing show.
#pragma once

#include <vector>

#include "questions/maps/study.h"
#include "report/document.h"

namespace meshfolio::maps {

/// The maps of one mesh: error, volume (area where it is open), smallest angle, turned triangles; explicit beside implicit.
std::vector<report::Map> maps_of(const SmoothingMaps& maps);
/// " a: explicit, the last step …. b: …."
std::string words_of(const std::vector<MapPlace>& places);

report::Table blow_up_table(const std::vector<SmoothingMaps>& studies);
report::Table place_table(const std::vector<SmoothingMaps>& studies);
report::Table region_table(const std::vector<SmoothingMaps>& studies);
std::vector<report::Check> map_checks(const std::vector<SmoothingMaps>& studies);

/// Two cells of one scheme with the same diffusion time λt, reached in many small steps and in few large ones.
struct EqualTime {
    std::size_t many = 0, few = 0;   // cells
    double difference = 0;           // of the rms motion, many over few, less 1
};
/// Of all such pairs whose iteration counts differ tenfold the one that differs most, where neither had blown up; `few` = `many`: none.
EqualTime largest_difference_at_equal_time(const SmoothingMaps& maps, const SchemeMap& map);

void add_discussion(report::Section& section, const std::vector<SmoothingMaps>& studies);

}   // namespace meshfolio::maps
