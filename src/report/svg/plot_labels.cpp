#include "report/svg/plot_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace meshfolio::report {

namespace {

constexpr double clearance = 3;

/// Returns the common area of two boxes.
double overlap(const Box& a, const Box& b) {
    const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
    const double height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
    return width > 0 && height > 0 ? width * height : 0;
}

constexpr double name_line = 14.5, between_names = 1.5, clear_of_leader = 3;

/// Returns the ascending values nearest to these, by least squares: neighbours that descend become their mean.
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

double LabelPlacer::cost(const Box& box) const {
    const double area = (box.right - box.left) * (box.bottom - box.top);
    double sum = 20 * (area - overlap(box, frame_));
    for (const Box& other : taken_) sum += 10 * overlap(box, other);
    for (const Point& p : data_) {
        const bool covered =
            p.x > box.left - clearance && p.x < box.right + clearance && p.y > box.top - clearance && p.y < box.bottom + clearance;
        if (covered) sum += 40;
    }
    return sum;
}

Box LabelPlacer::place(const std::vector<Box>& candidates) {
    Box best;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        Box box = candidates[i];   // moved into the frame as far as it fits
        const double right = std::max(frame_.left - box.left, std::min(frame_.right - box.right, 0.0)),
                     down = std::max(frame_.top - box.top, std::min(frame_.bottom - box.bottom, 0.0));
        box = {box.left + right, box.top + down, box.right + right, box.bottom + down};
        const double c = cost(box) + 2 * static_cast<double>(i);
        if (c < smallest) {
            smallest = c;
            best = box;
        }
    }
    taken_.push_back(best);
    return best;
}

std::vector<Box> around(Point point, double width, double height) {
    std::vector<Box> boxes;
    for (const double distance : {8.0, 22.0, 40.0, 62.0}) {
        for (const double up : {1.0, -1.0}) {
            const double y = up > 0 ? point.y - 0.7 * distance - height : point.y + 0.7 * distance;
            for (const double left : {point.x + distance * 0.6, point.x - distance * 0.6 - width, point.x - width / 2})
                boxes.push_back({left, y, left + width, y + height});
        }
        const double middle = point.y - height / 2;
        boxes.push_back({point.x + distance + 2, middle, point.x + distance + 2 + width, middle + height});
        boxes.push_back({point.x - distance - 2 - width, middle, point.x - distance - 2, middle + height});
    }
    return boxes;
}

std::vector<double> spread_apart(const std::vector<double>& wanted, const std::vector<double>& heights, double low, double high) {
    std::vector<std::size_t> order(wanted.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
    std::vector<double> offsets, lowered;   // of the middles in a stack, from the first; the wanted middles minus these
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
