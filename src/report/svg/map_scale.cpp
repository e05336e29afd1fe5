#include "report/svg/map_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace meshfolio::report {

namespace {

using Rgb = std::array<double, 3>;

/// The maps "pale" and "diverging" of render/color/colormap.cpp, which this layer may not include.
constexpr std::array<unsigned, 9> sequential{0xf1eee4, 0xcfd5b3, 0x9cc6a5, 0x6db7a9, 0x42a2ac, 0x1e88ab, 0x066ba1, 0x1c4d88, 0x253261};
constexpr std::array<unsigned, 13> diverging{0x004c9e, 0x0b6ac3, 0x4a87d6, 0x79a4e2, 0xa5c0e9, 0xcedaee, 0xeeeeee,
                                             0xeed3c7, 0xe6af9c, 0xdb8a76, 0xca6656, 0xb4413d, 0x93232b};

Rgb rgb_of(unsigned hex) { return {double(hex >> 16 & 255), double(hex >> 8 & 255), double(hex & 255)}; }

/// Returns the colour at t in [0, 1], interpolated between the colours of a list.
template <std::size_t n> Rgb between(const std::array<unsigned, n>& colours, double t) {
    const double place = t * double(n - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), n - 2);
    const Rgb a = rgb_of(colours[i]), b = rgb_of(colours[i + 1]);
    Rgb mixed;
    for (std::size_t c = 0; c < 3; ++c) mixed[c] = a[c] + (place - double(i)) * (b[c] - a[c]);
    return mixed;
}

}   // namespace

MapScale::MapScale(const Map& map) : logarithmic_(map.log_values), diverging_(map.colours == Map::Colours::diverging) {
    double least = INFINITY, largest = -INFINITY;
    for (const Map::Panel& panel : map.panels) {
        for (const double value : panel.values) {
            if (!std::isfinite(value) || (logarithmic_ && !(value > 0))) continue;
            least = std::min(least, value);
            largest = std::max(largest, value);
        }
    }
    if (map.range) {
        low_ = map.range->low;
        high_ = map.range->high;
    } else if (least <= largest) {
        low_ = least;
        high_ = largest;
        if (diverging_ && logarithmic_) {
            const double factor = std::max(map.middle / least, largest / map.middle);
            low_ = map.middle / factor;
            high_ = map.middle * factor;
        } else if (diverging_) {
            const double reach = std::max(map.middle - least, largest - map.middle);
            low_ = map.middle - reach;
            high_ = map.middle + reach;
        }
    }
    const bool valid = std::isfinite(low_) && std::isfinite(high_) && (!logarithmic_ || low_ > 0) && low_ <= high_;
    if (!valid) low_ = high_ = 1;
    if (!(high_ - low_ > 1e-12 * std::max(std::abs(low_), std::abs(high_)))) {   // a single value is in the middle
        const double margin = low_ != 0 ? 0.5 * std::abs(low_) : 1;
        high_ = low_ + margin;
        low_ -= margin;
    }
    clips_below_ = least < low_;
    clips_above_ = largest > high_;
}

int MapScale::band(double value) const {
    double t = 0;
    if (!logarithmic_) {
        t = (value - low_) / (high_ - low_);
    } else if (value > 0) {
        t = (std::log(value) - std::log(low_)) / (std::log(high_) - std::log(low_));
    }
    return static_cast<int>(std::clamp(std::floor(t * bands), 0.0, double(bands - 1)));
}

std::string MapScale::color(int band) const {
    double t = double(band) / (bands - 1);
    if (diverging_) {   // without the grey in the middle, so that the two sides differ
        constexpr int half = bands / 2;
        constexpr double side = 5.0 / 12;   // of the colours
        t = band < half ? side * band / (half - 1) : 1 - side * (bands - 1 - band) / (half - 1);
    }
    const Rgb rgb = diverging_ ? between(diverging, t) : between(sequential, t);
    std::array<char, 8> text{};
    static_cast<void>(std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(std::lround(rgb[0])),
                                    static_cast<unsigned>(std::lround(rgb[1])), static_cast<unsigned>(std::lround(rgb[2]))));
    return text.data();
}

std::vector<double> cell_edges(const std::vector<double>& centres, bool logarithmic) {
    std::vector<double> u;
    for (const double x : centres) {
        if (!std::isfinite(x) || (logarithmic && !(x > 0))) return {};
        u.push_back(logarithmic ? std::log(x) : x);
        if (u.size() > 1 && !(u.back() > u[u.size() - 2])) return {};
    }
    if (u.empty()) return {};
    const std::size_t n = u.size();
    const double alone = logarithmic ? 0.5 * std::log(2) : std::max(0.5 * std::abs(u.front()), 0.5);
    std::vector<double> edges{u.front() - (n > 1 ? 0.5 * (u[1] - u[0]) : alone)};
    for (std::size_t i = 1; i < n; ++i) edges.push_back(0.5 * (u[i - 1] + u[i]));
    edges.push_back(u.back() + (n > 1 ? 0.5 * (u[n - 1] - u[n - 2]) : alone));
    if (logarithmic)
        for (double& edge : edges) edge = std::exp(edge);
    return edges;
}

}   // namespace meshfolio::report
