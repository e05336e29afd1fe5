#include "output/draw/robust_range.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meshfolio::output {

namespace {

/// The value below which a share q of the sorted values lies, interpolated between neighbours.
double percentile(const std::vector<double>& sorted, double q) {
    const double at = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// Sorted by counting into equal parts of the range, each of which is then sorted on whatever processor is free. Halves: the width may
/// overflow.
std::vector<double> sorted(const std::vector<double>& values) {
    constexpr std::size_t parts = 4096;
    if (values.size() < 16 * parts) {
        std::vector<double> few = values;
        std::ranges::sort(few);
        return few;
    }
    const auto [low, high] = std::ranges::minmax(values);
    const double half = high / 2 - low / 2, scale = half > 0 ? (parts - 1) / half : 0;
    const auto part_of = [&](double v) { return static_cast<std::size_t>((v / 2 - low / 2) * scale); };
    std::vector<std::size_t> end(parts + 1, 0);
    for (const double v : values) ++end[part_of(v) + 1];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<double> result(values.size());
    for (const double v : values) result[end[part_of(v)]++] = v;
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t p) {
        const auto place = [&](std::size_t i) { return result.begin() + static_cast<std::ptrdiff_t>(i); };
        std::sort(place(p == 0 ? 0 : end[p - 1]), place(end[p]));
    });
    return result;
}

/// At most 8192 of the sorted values, from the middles of as many equal parts: enough for a bin of 96 to be right within 1 %.
std::vector<double> sample_of(const std::vector<double>& sorted) {
    constexpr std::size_t most = 8192;
    if (sorted.size() <= most) return sorted;
    std::vector<double> sample(most);
    for (std::size_t i = 0; i < most; ++i) sample[i] = sorted[(2 * i + 1) * sorted.size() / (2 * most)];
    return sample;
}

}   // namespace

std::vector<double> finite_values(const std::vector<Panel>& panels) {
    std::vector<double> values;
    values.reserve(std::accumulate(panels.begin(), panels.end(), std::size_t{0}, [](std::size_t sum, const Panel& panel) {
        return sum + static_cast<std::size_t>(panel.values.size());
    }));
    for (const Panel& panel : panels) {
        std::copy_if(panel.values.begin(), panel.values.end(), std::back_inserter(values), [](double v) { return std::isfinite(v); });
    }
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

ColorRange robust_range(const std::vector<Panel>& panels, std::string colormap, std::string quantity, std::string unit, double floor,
                        double clip) {
    ColorRange range{std::move(colormap), 0, 0, std::move(quantity), std::move(unit), 0, 0};
    const std::vector<double> values = sorted(finite_values(panels));
    if (!values.empty()) {
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
        const auto below = std::lower_bound(values.begin(), values.end(), range.low) - values.begin();
        const auto above = values.end() - std::upper_bound(values.begin(), values.end(), range.high);
        range.clipped_below = static_cast<double>(below) / static_cast<double>(values.size());
        range.clipped_above = static_cast<double>(above) / static_cast<double>(values.size());
        range.sample = sample_of(values);
    }
    return range;
}

}   // namespace meshfolio::output
