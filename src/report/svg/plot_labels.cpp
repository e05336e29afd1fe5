#include "report/svg/plot_labels.h"

#include <algorithm>
#include <limits>

#include "report/page/math_markup.h"
#include "sans-regular.h"

namespace meshfolio::report {

namespace {

constexpr double clearance = 3;

double overlap(const Box& a, const Box& b) {
    const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
    const double height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
    return width > 0 && height > 0 ? width * height : 0;
}

/// As far as need be, and as it fits.
Box moved_into(const Box& frame, const Box& box) {
    const double right = std::max(frame.left - box.left, std::min(frame.right - box.right, 0.0)),
                 down = std::max(frame.top - box.top, std::min(frame.bottom - box.bottom, 0.0));
    return {box.left + right, box.top + down, box.right + right, box.bottom + down};
}

double area(const Box& box) { return (box.right - box.left) * (box.bottom - box.top); }

}   // namespace

double text_width(const std::string& text) {
    double width = 0;
    for (std::size_t i = 0, length = 1; i < text.size(); i += length) {
        const auto lead = static_cast<unsigned char>(text[i]);
        length = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
        char32_t c = length == 1 ? lead : lead & (0x7FU >> length);
        for (std::size_t k = i + 1; k < std::min(i + length, text.size()); ++k) c = c << 6 | (static_cast<unsigned char>(text[k]) & 0x3FU);
        const auto* known = std::ranges::lower_bound(sans_regular_widths, c, {}, [](auto& entry) { return entry.character; });
        width +=
            known != std::end(sans_regular_widths) && known->character == c ? known->width : 650;   // in another font: as a large digit
    }
    return 1e-3 * font_size * width;
}

double text_width(const Text& text) {
    double width = 0;
    for (const Run& run : text) {
        if (run.kind != Run::Kind::math) {
            width += text_width(run.content);
            continue;
        }
        for (const MathPart& part : math_parts(run.content)) {
            const bool small = part.kind == MathPart::Kind::subscript || part.kind == MathPart::Kind::superscript;
            width += text_width(part.text) * (small ? script_size / font_size : 1);
        }
    }
    return width;
}

std::vector<std::string> wrapped(const std::string& text, double width) {
    std::vector<std::string> lines(1);
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
        if (!lines.back().empty() && text_width(longer) > width) {
            lines.push_back(word);
        } else {
            lines.back() = longer;
        }
        begin = end + 1;
    }
    return lines;
}

double LabelPlacer::cost(const Box& box) const {
    double sum = 20 * (area(box) - overlap(box, frame_));
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
        const Box box = moved_into(frame_, candidates[i]);
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

}   // namespace meshfolio::report
