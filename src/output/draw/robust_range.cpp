#include "output/draw/robust_range.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <numeric>

#include "base/large_pages.h"

namespace meshfolio::output {

namespace {

/// The value below which a share q of the sorted values lies, interpolated between neighbours.
double percentile(const std::vector<double>& sorted, double q) {
    const double at = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// At most 8192 places, in the middles of as many equal parts: enough for a bin of 96 to be right within 1 %.
std::vector<std::size_t> sample_places(std::size_t size) {
    std::vector<std::size_t> places(std::min<std::size_t>(size, 8192));
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = (2 * i + 1) * size / (2 * places.size());
    return places;
}

/// `values` as if they were sorted, at `places` (ascending) and where the percentiles lie: they are counted into equal parts of their
/// range, of which those that hold such a place are sorted. Halves: the width may overflow.
std::vector<double> sorted_at(std::vector<std::size_t> places, const std::vector<double>& values,
                              std::initializer_list<double> percentiles) {
    const std::size_t parts = std::min<std::size_t>(values.size() / 16 + 1, 65536);
    const auto [low, high] = std::ranges::minmax(values);
    const double half = high / 2 - low / 2, scale = half > 1e-290 ? static_cast<double>(parts - 1) / half : 0;
    const auto part_of = [&, least = low](double v) { return static_cast<std::size_t>((v / 2 - least / 2) * scale); };
    std::vector<std::size_t> end(parts + 1, 0);
    for (const double v : values) ++end[part_of(v) + 1];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<double> result = large_vector<double>(values.size());
    for (const double v : values) result[end[part_of(v)]++] = v;

    for (const double q : percentiles) {
        const auto below = static_cast<std::size_t>(q * static_cast<double>(values.size() - 1));
        places.insert(places.end(), {below, below + 1});
    }
    std::ranges::sort(places);
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t p) {
        const std::size_t begin = p == 0 ? 0 : end[p - 1];
        const auto place = std::ranges::lower_bound(places, begin);
        if (place != places.end() && *place < end[p])
            std::sort(result.begin() + static_cast<std::ptrdiff_t>(begin), result.begin() + static_cast<std::ptrdiff_t>(end[p]));
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
    std::vector<double> values = finite_values(panels);
    const std::vector<std::size_t> sample = sample_places(values.size());
    if (!values.empty()) {
        values = sorted_at(sample, values, {clip, 0.5, 1 - clip});
        range.low = percentile(values, clip);
        range.high = percentile(values, 1 - clip);
    }
    const bool diverging = range.colormap == "diverging";
    const bool from_zero = range.colormap == "pale" && range.low >= 0;
    if (from_zero) range.low = 0;
    if (diverging) {
        const double median = values.empty() ? 0 : percentile(values, 0.5);
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
        std::ranges::transform(sample, std::back_inserter(range.sample), [&](std::size_t place) { return values[place]; });
    }
    return range;
}

}   // namespace meshfolio::output
