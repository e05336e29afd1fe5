#include "output/draw/figure_request.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "output/draw/surface_of.h"

namespace meshfolio::output {

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
        return static_cast<double>(std::ranges::count_if(values, outside)) / std::max(1.0, static_cast<double>(values.size()));
    };
    range.clipped_below = share([&](double v) { return v < range.low; });
    range.clipped_above = share([&](double v) { return v > range.high; });
}

ColorRange robust_range(const std::vector<Panel>& panels, std::string colormap, std::string quantity, std::string unit, double floor,
                        double clip, std::shared_ptr<const render::Colormap> own_map) {
    ColorRange range{.colormap = std::move(colormap), .high = 0, .quantity = std::move(quantity), .unit = std::move(unit)};
    range.own_map = std::move(own_map);
    std::vector<double> values = finite_values(panels);
    tbb::parallel_sort(values);
    // Interpolates between the neighbours of the value below which a share q lies.
    const auto percentile = [&](double q) {
        const double place = q * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const double from = values[below], to = values[std::min(below + 1, values.size() - 1)];
        return from + (place - static_cast<double>(below)) * (to - from);
    };
    if (!values.empty()) range.low = percentile(clip), range.high = percentile(1 - clip);
    const bool diverging = colormap_of(range).kind == "diverging";
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
        // The middles of at most 8192 equal parts: enough for each of 96 bins to be right within 1 %.
        range.sample.resize(std::min<std::size_t>(values.size(), 8192));
        for (std::size_t i = 0; i < range.sample.size(); ++i)
            range.sample[i] = values[(2 * i + 1) * values.size() / (2 * range.sample.size())];
    }
    return range;
}

}   // namespace meshfolio::output
