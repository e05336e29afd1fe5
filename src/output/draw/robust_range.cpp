#include "output/draw/figure_request.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace meshfolio::output {

namespace {

/// At most 8192 places, in the middles of as many equal parts: enough for a bin of 96 to be right within 1 %.
std::vector<std::size_t> sample_places(std::size_t size) {
    std::vector<std::size_t> places(std::min<std::size_t>(size, 8192));
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = (2 * i + 1) * size / (2 * places.size());
    return places;
}

std::size_t place_below(double q, std::size_t size) { return size > 0 ? static_cast<std::size_t>(q * static_cast<double>(size - 1)) : 0; }

/// What would stand at `places` (ascending) if `values` were sorted: they are counted into equal parts of their range, and only the parts
/// that hold such a place are gathered and sorted. Halves: the width may overflow.
std::vector<double> sorted_at(const std::vector<std::size_t>& places, const std::vector<double>& values) {
    const std::size_t parts = std::min<std::size_t>(values.size() / 16 + 1, 65536);
    const auto [low, high] = std::ranges::minmax(values);
    const double half = high / 2 - low / 2, scale = half > 1e-290 ? static_cast<double>(parts - 1) / half : 0;
    constexpr std::size_t shares = 2, nowhere = std::numeric_limits<std::size_t>::max();
    // Of each part, in each share of the values: how many values there are, then where the next one goes.
    std::array<std::vector<std::size_t>, shares> next;
    next.fill(std::vector<std::size_t>(parts, 0));
    const auto for_each_value = [&, least = low](const auto& visit) {
        tbb::parallel_for(std::size_t{0}, shares, [&](std::size_t s) {
            for (std::size_t i = s * values.size() / shares; i < (s + 1) * values.size() / shares; ++i)
                visit(next[s][static_cast<std::size_t>((values[i] / 2 - least / 2) * scale)], values[i]);
        });
    };
    for_each_value([](std::size_t& count, double) { ++count; });

    struct Gathered {
        std::size_t begin, size, rank;   // rank: place of its first value
    };
    std::vector<Gathered> gathered;
    std::size_t rank = 0, end = 0;
    for (std::size_t p = 0; p < parts; ++p) {
        const std::size_t size = next[0][p] + next[1][p];
        const auto place = std::ranges::lower_bound(places, rank);
        const bool wanted = place != places.end() && *place < rank + size;
        next[1][p] = wanted ? end + next[0][p] : nowhere;
        next[0][p] = wanted ? end : nowhere;
        if (wanted) gathered.push_back({std::exchange(end, end + size), size, rank});
        rank += size;
    }
    std::vector<double> sorted(end), result(places.size());
    for_each_value([&](std::size_t& to, double v) {
        if (to != nowhere) sorted[to++] = v;
    });
    tbb::parallel_for(std::size_t{0}, gathered.size(), [&](std::size_t g) {
        const Gathered& part = gathered[g];
        const auto begin = sorted.begin() + static_cast<std::ptrdiff_t>(part.begin);
        std::sort(begin, begin + static_cast<std::ptrdiff_t>(part.size));
        for (auto place = std::ranges::lower_bound(places, part.rank); place != places.end() && *place < part.rank + part.size; ++place)
            result[static_cast<std::size_t>(place - places.begin())] = sorted[part.begin + *place - part.rank];
    });
    return result;
}

}   // namespace

std::vector<double> finite_values(const std::vector<Panel>& panels) {
    std::vector<double> values;
    values.reserve(std::accumulate(panels.begin(), panels.end(), std::size_t{0}, [](std::size_t sum, const Panel& panel) {
        return sum + static_cast<std::size_t>(panel.values.size());
    }));
    for (const Panel& panel : panels)
        std::copy_if(panel.values.begin(), panel.values.end(), std::back_inserter(values), [](double v) { return std::isfinite(v); });
    return values;
}

std::vector<double> histogram(std::span<const double> values, double low, double high) {
    std::size_t bins = 96;
    while (bins > 24 && values.size() < 32 * bins) bins /= 2;
    const double half = high / 2 - low / 2;   // finite even where high − low is not
    if (values.empty() || !(half > 0)) return {};
    std::vector<double> shares(bins, 0);
    for (const double v : values) {
        if (v < low || v > high) continue;
        const auto bin = static_cast<std::size_t>(static_cast<double>(bins) * ((v / 2 - low / 2) / half));
        shares[std::min(bin, bins - 1)] += 1;
    }
    for (double& share : shares) share /= static_cast<double>(values.size());
    return shares;
}

void enter_clipped(ColorRange& range, const std::vector<double>& values) {
    const auto share = [&](auto outside) {
        return values.empty() ? 0 : static_cast<double>(std::ranges::count_if(values, outside)) / static_cast<double>(values.size());
    };
    range.clipped_below = share([&](double v) { return v < range.low; });
    range.clipped_above = share([&](double v) { return v > range.high; });
}

ColorRange robust_range(const std::vector<Panel>& panels, std::string colormap, std::string quantity, std::string unit, double floor,
                        double clip) {
    ColorRange range{std::move(colormap), 0, 0, std::move(quantity), std::move(unit), 0, 0};
    const std::vector<double> values = finite_values(panels);
    const std::vector<std::size_t> sample = sample_places(values.size());
    std::vector<std::size_t> places = sample;
    for (const double q : {clip, 0.5, 1 - clip})
        places.insert(places.end(), {place_below(q, values.size()), place_below(q, values.size()) + 1});
    std::ranges::sort(places);
    const std::vector<double> sorted = values.empty() ? values : sorted_at(places, values);
    const auto value_at = [&](std::size_t place) {
        return sorted[static_cast<std::size_t>(std::ranges::lower_bound(places, place) - places.begin())];
    };
    // The value below which a share q lies, interpolated between neighbours.
    const auto percentile = [&](double q) {
        const std::size_t below = place_below(q, values.size());
        const double from = value_at(below), to = value_at(std::min(below + 1, values.size() - 1));
        return from + (q * static_cast<double>(values.size() - 1) - static_cast<double>(below)) * (to - from);
    };
    if (!values.empty()) range.low = percentile(clip), range.high = percentile(1 - clip);
    const bool diverging = range.colormap == "diverging";
    const bool from_zero = range.colormap == "pale" && range.low >= 0;
    if (from_zero) range.low = 0;
    if (diverging) {
        const double median = values.empty() ? 0 : percentile(0.5);
        range.high = std::max({std::abs(range.low), std::abs(range.high), 1.25 * std::abs(median)});
        range.low = -range.high;
    }
    if (range.high - range.low < floor) {
        const double middle = diverging ? 0 : from_zero ? 0.5 * floor : 0.5 * (range.low + range.high);
        range.low = middle - 0.5 * floor;
        range.high = middle + 0.5 * floor;
    }
    if (!values.empty()) {
        enter_clipped(range, values);
        std::ranges::transform(sample, std::back_inserter(range.sample), value_at);
    }
    return range;
}

}   // namespace meshfolio::output
