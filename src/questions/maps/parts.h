/// @file
/// Parts of the section "maps": what the planes of smoothing show.
#pragma once

#include "questions/maps/study.h"

namespace meshfolio::maps {

inline constexpr report::Words words("maps");

using Studies = std::vector<SmoothingMaps>;

/// The maps of one mesh: error, volume (area where it is open), turned triangles; explicit beside implicit.
std::vector<report::Map> maps_of(const SmoothingMaps& maps);
/// "a: explicit, the last step …. b: …."
std::string words_of(const std::vector<MapPlace>& places);

report::Table blow_up_table(const Studies& studies);
report::Table place_table(const Studies& studies);
report::Table region_table(const Studies& studies);

/// How many runs there are on either side of the explicit limit, how many of them blew up, and how many implicit ones did.
struct BlowUps {
    int within = 0, beyond = 0, within_lost = 0, beyond_lost = 0, implicit_lost = 0;
    double off = 0;   // largest distance of a measured iteration from the best prediction at hand

    int faults() const { return within_lost + implicit_lost; }
    bool sharp() const { return faults() == 0 && beyond > 0 && beyond_lost == beyond; }
};
BlowUps blow_ups_of(const Studies& studies);

/// "none", "12".
std::string none_or(int count);
void add_discussion(report::Section& section, const Studies& studies);

}   // namespace meshfolio::maps
