#include "color/colormap.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "color/srgb.h"

namespace render {

namespace {

/// A map given by a few equally spaced colours, with a Catmull–Rom spline in CIELAB between them.
struct Definition {
    const char *name, *kind, *description;
    std::vector<std::uint32_t> colors;   // 0xRRGGBB; a cyclic map does not repeat the first colour
    bool is_straight = false;            // straight lines in sRGB instead of the spline
};

/// viridis, magma, inferno, plasma: colours of the maps of van der Walt and Smith (2015, CC0); cividis: of Nuñez, Anderton and Renslow
/// (2018). batlow, vik: of Crameri (Scientific colour maps, 2018, MIT); twilight: of Bechtold (2017, CC0); turbo: of Mikhailov (2019,
/// Apache-2.0); RdBu: of Brewer (2002, Apache-2.0); coolwarm: of Moreland (2009, free for any use). jet, hot: the formulas of MATLAB;
/// rainbow, seismic: those of matplotlib. Others come within 3 of CIEDE2000 of their originals.
/// parula-like and grey: own, with equal steps of lightness in CIELAB. pale and diverging: likewise, then moved along their curves to equal
/// steps of CAM02-UCS (tests/render/color/equal_steps.py), so that colours can be read as numbers; report's map_scale.cpp repeats them.
/// cyclic: a closed curve in CIELAB (three harmonics), optimised for equal steps of CIEDE2000, equal lightness of t and 1 − t, and the
/// largest distance between any two places in normal and in each kind of colour-blind sight.
const std::vector<Definition>& definitions() {
    static const std::vector<Definition> table{
        {"viridis",
         "sequential",
         "dark violet, green, yellow; safe for colour-blind readers",
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
         "black, purple, orange, cream",
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
        {"inferno",
         "sequential",
         "black, purple, orange, pale yellow",
         {0x000004, 0x140b35, 0x3a0963, 0x60136e, 0x85216b, 0xa92e5e, 0xcb4149, 0xe65d2f, 0xf78311, 0xfcad12, 0xf5db4b, 0xfcffa4},
         true},
        {"plasma", "sequential", "blue, purple, orange, yellow", {0x0d0887, 0x6a00a8, 0xb12a90, 0xe16462, 0xfca636, 0xf0f921}},
        {"batlow", "sequential", "navy, green, orange, pink", {0x011959, 0x185562, 0x577647, 0xb38e2f, 0xfba689, 0xfaccfa}},
        {"vik", "diverging", "blue, white, brown", {0x001261, 0x06558c, 0x71a8c4, 0xebe6e2, 0xd39774, 0xaa4713, 0x590008}},
        {"coolwarm", "diverging", "blue, grey, red", {0x3b4cc0, 0x7092f3, 0xaac7fd, 0xdddddd, 0xf7b89c, 0xe7755b, 0xb40426}},
        {"RdBu",
         "diverging",
         "red, white, blue",
         {0x67001f, 0xb2182b, 0xd6604d, 0xf4a582, 0xfddbc7, 0xf7f7f7, 0xd1e5f0, 0x92c5de, 0x4393c3, 0x2166ac, 0x053061},
         true},
        {"seismic", "diverging", "dark blue, white, dark red", {0x00004d, 0x0000ff, 0xffffff, 0xff0000, 0x800000}, true},
        {"twilight",
         "cyclic",
         "pale grey, blue, dark violet, red and back",
         {0xe2d9e2, 0xa6bfcb, 0x6d90c0, 0x5f58b0, 0x541e7d, 0x2f1437, 0x63194b, 0x9e3b50, 0xc0745d, 0xd0b29d}},
        {"turbo",
         "sequential",
         "dark blue, green, dark red",
         {0x30123b, 0x455acd, 0x3e9bfe, 0x19d6cc, 0x46f884, 0xa3fd3c, 0xe1dd37, 0xfea531, 0xf05b12, 0xc42503, 0x7a0403}},
        {"jet",
         "sequential",
         "dark blue, cyan, yellow, dark red",
         {0x000080, 0x0000ff, 0x0080ff, 0x00ffff, 0x80ff80, 0xffff00, 0xff8000, 0xff0000, 0x800000},
         true},
        {"rainbow",
         "sequential",
         "violet, green, red",
         {0x8000ff, 0x4062fa, 0x00b4ec, 0x40ecd4, 0x80ffb4, 0xbfec8e, 0xffb462, 0xff6232, 0xff0000},
         true},
        {"hot",
         "sequential",
         "black, red, yellow, white",
         {0x000000, 0x550000, 0xaa0000, 0xff0000, 0xff5500, 0xffaa00, 0xffff00, 0xffff80, 0xffffff},
         true},
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
    std::vector<Rgba> stops;
    if (d.is_straight) {
        for (const std::uint32_t c : d.colors) stops.push_back(unpacked(c));
        return stops;
    }
    std::vector<glm::dvec3> lab(1);
    for (const std::uint32_t c : d.colors) lab.push_back(lab_of(unpacked(c)));
    // One more point at either end: the neighbours round the circle, or straight on.
    if (is_cyclic) lab.push_back(lab[1]);
    lab[0] = is_cyclic ? lab[d.colors.size()] : 2.0 * lab[1] - lab[2];
    lab.push_back(is_cyclic ? lab[2] : 2.0 * lab.back() - lab[lab.size() - 2]);
    for (std::size_t i = 1; i + 2 < lab.size(); ++i)
        for (int s = 0; s < steps; ++s) stops.push_back(rgba_of_lab(spline(lab[i - 1], lab[i], lab[i + 1], lab[i + 2], double(s) / steps)));
    stops.push_back(unpacked(is_cyclic ? d.colors.front() : d.colors.back()));
    return stops;
}

bool same_but_for_case(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, [](unsigned char c, unsigned char d) { return std::tolower(c) == std::tolower(d); });
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

const Colormap* find_colormap(std::string_view name) {
    for (const auto& [alias, usual] : {std::pair{"gray", "grey"}, std::pair{"parula", "parula-like"}})
        if (same_but_for_case(name, alias)) return find_colormap(usual);
    for (const Colormap& map : colormap_list())
        if (same_but_for_case(name, map.name)) return &map;
    return nullptr;
}

const Colormap& colormap_named(const std::string& name) {
    if (const Colormap* map = find_colormap(name)) return *map;
    std::string known;
    for (const Colormap& map : colormap_list()) known += (known.empty() ? "" : ", ") + map.name;
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
