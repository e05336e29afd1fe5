#include <algorithm>
#include <cmath>
#include <vector>

#include "output/figure_request.h"

namespace meshfolio::output {

namespace {

/// The value below which a share q of the sorted values lies, interpolated between neighbours.
double percentile(const std::vector<double>& sorted, double q) {
    const double at = q * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}   // namespace

ColorRange robust_range(const std::vector<Panel>& panels, std::string colormap, std::string quantity, std::string unit, double floor,
                        double clip) {
    ColorRange range{std::move(colormap), 0, 0, std::move(quantity), std::move(unit), 0, 0};
    std::vector<double> values;
    for (const Panel& panel : panels) {
        std::copy_if(panel.values.begin(), panel.values.end(), std::back_inserter(values), [](double v) { return std::isfinite(v); });
    }
    if (!values.empty()) {
        std::sort(values.begin(), values.end());
        range.low = percentile(values, clip);
        range.high = percentile(values, 1 - clip);
    }
    const bool diverging = range.colormap == "diverging";
    if (diverging) {
        range.high = std::max(std::abs(range.low), std::abs(range.high));
        range.low = -range.high;
    }
    if (range.high - range.low < floor) {
        const double middle = diverging ? 0 : 0.5 * (range.low + range.high);
        range.low = middle - 0.5 * floor;
        range.high = middle + 0.5 * floor;
    }
    if (!values.empty()) {
        const auto below = std::lower_bound(values.begin(), values.end(), range.low) - values.begin();
        const auto above = values.end() - std::upper_bound(values.begin(), values.end(), range.high);
        range.clipped_below = static_cast<double>(below) / static_cast<double>(values.size());
        range.clipped_above = static_cast<double>(above) / static_cast<double>(values.size());
    }
    return range;
}

}   // namespace meshfolio::output
