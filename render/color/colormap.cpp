#include "color/colormap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "color/srgb.h"

namespace render {

namespace {

/// A map given by a few equally spaced colours, with a Catmull–Rom spline in CIELAB between them.
struct Definition {
    const char *name, *kind, *description;
    std::vector<std::uint32_t> colors;   // 0xRRGGBB; a cyclic map does not repeat the first colour
};

/// viridis and magma: ten colours of the maps of van der Walt and Smith (2015, CC0); cividis: of Nuñez, Anderton and Renslow (2018).
/// parula-like and grey: own, with equal steps of lightness in CIELAB. pale and diverging: likewise, then moved along their curves to equal
/// steps of CAM02-UCS (tests/render/color/equal_steps.py), so that colours can be read as numbers; report's map_scale.cpp repeats them.
/// cyclic: a closed curve in CIELAB (three harmonics), optimised for equal steps of CIEDE2000, equal lightness of t and 1 − t, and the
/// largest distance between any two places in normal and in each kind of colour-blind sight.
const std::vector<Definition>& definitions() {
    static const std::vector<Definition> table{
        {"viridis",
         "sequential",
         "dark violet, green, yellow; perceptually uniform, safe for colour-blind readers",
         {0x440154, 0x482878, 0x3e4a89, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725}},
        {"pale",
         "sequential",
         "cream, green, blue, navy; for distances and errors: zero is pale, and the form of what is right stays visible",
         {0xf1eee4, 0xcfd5b3, 0x9cc6a5, 0x6db7a9, 0x42a2ac, 0x1e88ab, 0x066ba1, 0x1c4d88, 0x253261}},
        {"parula-like",
         "sequential",
         "blue, teal, yellow; for comparison with earlier reports",
         {0x253195, 0x004db8, 0x0269c5, 0x1187c3, 0x19a5b8, 0x50bc95, 0xaec86a, 0xf2d14f, 0xf6f138}},
        {"diverging",
         "diverging",
         "blue, white, red, of equal lightness on both sides; for signed values centred on zero",
         {0x004c9e, 0x0b6ac3, 0x4a87d6, 0x79a4e2, 0xa5c0e9, 0xcedaee, 0xeeeeee, 0xeed3c7, 0xe6af9c, 0xdb8a76, 0xca6656, 0xb4413d,
          0x93232b}},
        {"magma",
         "sequential",
         "black, purple, orange, cream; perceptually uniform",
         {0x000004, 0x180f3d, 0x440f76, 0x721f81, 0x9e2f7f, 0xcd4071, 0xf1605d, 0xfd9668, 0xfeca8d, 0xfcfdbf}},
        {"cividis",
         "sequential",
         "blue, grey, yellow; looks the same with red-green blindness",
         {0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173, 0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46}},
        {"cyclic",
         "cyclic",
         "pale green, blue, dusk, orange and back; for angles and phases, safe for colour-blind readers",
         {0xcde5bd, 0xb4e4d5, 0x98d7e5, 0x75bee7, 0x549cd6, 0x477bb6, 0x4f6193, 0x5f5274, 0x71495a, 0x854542, 0x9e4a2b, 0xbe5d1b, 0xde7e22,
          0xf4a447, 0xf5c675, 0xe5db9d}},
        {"grey", "sequential", "dark to light grey; for print without colour", {0x1f1f1f, 0x777777, 0xdadada}},
    };
    return table;
}

Rgba unpacked(std::uint32_t color) {
    return {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8), static_cast<std::uint8_t>(color), 255};
}

/// Returns the point at u in [0, 1] of the Catmull–Rom spline from p1 to p2 with the neighbours p0 and p3.
glm::dvec3 spline(const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& p2, const glm::dvec3& p3, double u) {
    return p1 + 0.5 * u * (p2 - p0 + u * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3 + u * (3.0 * (p1 - p2) + p3 - p0)));
}

std::vector<Rgba> stops_of(const Definition& d) {
    constexpr int steps = 16;   // between two given colours: finer than the eye
    const bool is_cyclic = std::string_view(d.kind) == "cyclic";
    std::vector<glm::dvec3> lab(1);
    for (const std::uint32_t c : d.colors) lab.push_back(lab_of(unpacked(c)));
    // One more point at either end: the neighbours round the circle, or straight on.
    if (is_cyclic) lab.push_back(lab[1]);
    lab[0] = is_cyclic ? lab[d.colors.size()] : 2.0 * lab[1] - lab[2];
    lab.push_back(is_cyclic ? lab[2] : 2.0 * lab.back() - lab[lab.size() - 2]);
    std::vector<Rgba> stops;
    for (std::size_t i = 1; i + 2 < lab.size(); ++i)
        for (int s = 0; s < steps; ++s) stops.push_back(rgba_of_lab(spline(lab[i - 1], lab[i], lab[i + 1], lab[i + 2], double(s) / steps)));
    stops.push_back(unpacked(is_cyclic ? d.colors.front() : d.colors.back()));
    return stops;
}

std::uint8_t mixed(std::uint8_t a, std::uint8_t b, double u) { return static_cast<std::uint8_t>(std::lrint(a + u * (b - a))); }

}   // namespace

std::span<const Colormap> colormap_list() {
    static const std::vector<Colormap> list = [] {
        std::vector<Colormap> maps;
        for (const Definition& d : definitions()) maps.push_back({d.name, d.kind, d.description, stops_of(d)});
        return maps;
    }();
    return list;
}

const Colormap& colormap_named(const std::string& name) {
    std::string known;
    for (const Colormap& map : colormap_list()) {
        if (map.name == name) return map;
        known += (known.empty() ? "" : ", ") + map.name;
    }
    throw std::invalid_argument("unknown colour map '" + name + "'; known are " + known);
}

Rgba color_at(const Colormap& map, double t) {
    const double last = static_cast<double>(map.stops.size() - 1);
    const double at = std::isnan(t) ? 0 : std::clamp(t, 0.0, 1.0) * last;
    const auto i = static_cast<std::size_t>(at);
    if (i + 1 >= map.stops.size()) return map.stops.back();
    const Rgba a = map.stops[i], b = map.stops[i + 1];
    const double u = at - static_cast<double>(i);
    return {mixed(a.r, b.r, u), mixed(a.g, b.g, u), mixed(a.b, b.b, u), mixed(a.a, b.a, u)};
}

}   // namespace render
