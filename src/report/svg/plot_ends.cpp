#include "report/svg/plot_ends.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/svg/svg_elements.h"

namespace meshfolio::report {

namespace {

constexpr double name_line = 14.5, between_names = 1.5, clear_of_leader = 3;

/// The ascending values nearest to these: neighbours that descend become their mean.
std::vector<double> nearest_ascending(const std::vector<double>& values) {
    struct Block {
        double mean;
        std::size_t count;
    };
    std::vector<Block> blocks;
    for (const double value : values) {
        blocks.push_back({value, 1});
        while (blocks.size() > 1 && blocks[blocks.size() - 2].mean > blocks.back().mean) {
            const Block last = blocks.back();
            blocks.pop_back();
            Block& joined = blocks.back();
            joined.mean = (joined.mean * double(joined.count) + last.mean * double(last.count)) / double(joined.count + last.count);
            joined.count += last.count;
        }
    }
    std::vector<double> ascending;
    for (const Block& block : blocks) ascending.insert(ascending.end(), block.count, block.mean);
    return ascending;
}

}   // namespace

std::vector<double> spread_apart(const std::vector<double>& wanted, const std::vector<double>& heights, double low, double high) {
    std::vector<std::size_t> order(wanted.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
    std::vector<double> offsets, lowered;   // of the middles from the first where all are stacked; what is left of the wanted ones
    for (std::size_t i = 0; i < order.size(); ++i) {
        offsets.push_back(i == 0 ? 0 : offsets.back() + 0.5 * (heights[order[i - 1]] + heights[order[i]]));
        lowered.push_back(wanted[order[i]] - offsets.back());
    }
    const std::vector<double> shifts = nearest_ascending(lowered);
    std::vector<double> middles(wanted.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const double first = low + 0.5 * heights[order.front()], last = high - 0.5 * heights[order.back()] - offsets.back();
        middles[order[i]] = offsets[i] + std::clamp(shifts[i], first, std::max(first, last));
    }
    return middles;
}

double EndName::height() const { return name_line * static_cast<double>(lines.size()) + between_names; }

std::string drawn_names(const std::vector<EndName>& names, double x, double low, double high) {
    std::vector<double> wanted, heights;
    for (const EndName& name : names) {
        wanted.push_back(name.end.y);
        heights.push_back(name.height());
    }
    const std::vector<double> middles = spread_apart(wanted, heights, low, high);
    std::string svg;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const EndName& name = names[i];
        const Point start{name.end.x + clear_of_leader, name.end.y}, sample{x + end_gap, middles[i]};
        if (sample.x - start.x > 2 * end_gap || std::abs(sample.y - start.y) > 2)
            svg += line_element(start, {sample.x - 2, sample.y}, "stroke=\"var(--plot-line, #6b7280)\" stroke-width=\"0.8\"");
        svg += "<g transform=\"translate(" + px(sample.x) + " " + px(sample.y) + ")\">\n" + name.sample + "</g>\n";
        double y = middles[i] - 0.5 * name_line * (static_cast<double>(name.lines.size()) - 1) + 4.3;
        for (const std::string& line : name.lines) {
            svg += text_element({sample.x + end_sample_width + end_gap - 2, y}, "start", line,
                                " font-size=\"12\" fill=\"" + name.color + "\"");
            y += name_line;
        }
    }
    return svg;
}

}   // namespace meshfolio::report
