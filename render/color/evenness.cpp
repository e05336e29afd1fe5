#include "color/evenness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "color/srgb.h"

namespace render {

namespace {

double lightness(const Colormap& map, double t) { return lab_of(color_at(map, t)).x; }

/// True if the lightness from one place to another only rises or only falls, but for the rounding of 8-bit colours.
bool is_monotone(const Colormap& map, double from, double to) {
    constexpr int steps = 64;
    constexpr double rounding = 0.5;
    const double way = lightness(map, to) > lightness(map, from) ? 1 : -1;
    double farthest = way * lightness(map, from);
    for (int i = 1; i <= steps; ++i) {
        const double here = way * lightness(map, from + (to - from) * i / steps);
        if (here < farthest - rounding) return false;
        farthest = std::max(farthest, here);
    }
    return true;
}

/// Returns the distance of two colours in CIELAB by CIE94 (graphic arts), with the geometric mean of both chromas, so that it is symmetric.
double visible_distance(const glm::dvec3& a, const glm::dvec3& b) {
    const double chroma_a = std::hypot(a.y, a.z), chroma_b = std::hypot(b.y, b.z), chroma = std::sqrt(chroma_a * chroma_b);
    const double along = chroma_a - chroma_b, across = std::hypot(a.y - b.y, a.z - b.z);
    const double hue = std::sqrt(std::max(0.0, across * across - along * along));
    return std::hypot(a.x - b.x, along / (1 + 0.045 * chroma), hue / (1 + 0.015 * chroma));
}

}   // namespace

std::string unevenness_of(const Colormap& map) {
    constexpr int steps = 16;
    constexpr double most_uneven = 3;   // the known uniform maps reach 2.4 (magma), seismic 5.8
    if (map.kind == "cyclic" && !(map.stops.front() == map.stops.back())) return "its ends have different colours";
    if (map.kind == "sequential" && !is_monotone(map, 0, 1)) return "its lightness goes up and down";
    if (map.kind == "diverging" && !(is_monotone(map, 0, 0.5) && is_monotone(map, 0.5, 1)))
        return "its lightness goes up and down on one side of the middle";
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int i = 0; i < steps; ++i) {
        const double step = visible_distance(lab_of(color_at(map, double(i) / steps)), lab_of(color_at(map, double(i + 1) / steps)));
        least = std::min(least, step), most = std::max(most, step);
    }
    if (least == 0) return "it shows different values in one colour";
    if (most <= most_uneven * least) return "";
    return "equal steps look up to " + std::to_string(std::lround(most / least)) + " times as large at one place as at another";
}

std::string kind_of(const std::vector<Rgba>& stops) {
    constexpr double nearly_grey = 15;   // chroma
    if (stops.front() == stops.back()) return "cyclic";
    const Colormap map{"", "", "", stops};
    const glm::dvec3 middle = lab_of(color_at(map, 0.5));
    const bool turns = (middle.x - lightness(map, 0)) * (middle.x - lightness(map, 1)) > 0;
    return turns && std::hypot(middle.y, middle.z) < nearly_grey && is_monotone(map, 0, 0.5) && is_monotone(map, 0.5, 1) ? "diverging"
                                                                                                                         : "sequential";
}

}   // namespace render
