#include "report/svg_elements.h"

#include <cmath>

#include "number_text.h"
#include "report/escape.h"
#include "report/math_markup.h"

namespace meshfolio::report {

namespace {

/// Escaped text with the indices of its symbols lowered: λ_crit.
std::string with_indices(const std::string& words) {
    std::string marked, shift;   // `shift` takes the next part back to the base line
    for (const Run& run : prose(words)) {
        for (const MathPart& part :
             run.kind == Run::Kind::math ? math_parts(run.content) : std::vector<MathPart>{{MathPart::Kind::upright, run.content}}) {
            const bool lowered = part.kind == MathPart::Kind::subscript;
            const std::string text = xml_escape(safe_text(part.text));
            marked += lowered         ? "<tspan dy=\"3.5\" font-size=\"9.5\">" + text + "</tspan>"
                      : shift.empty() ? text
                                      : "<tspan" + shift + ">" + text + "</tspan>";
            shift = lowered ? " dy=\"-3.5\"" : "";
        }
    }
    return marked;
}

}   // namespace

std::string px(double x) { return plain_text(std::round(10 * x) / 10, 6); }

std::string text_element(Point at, const std::string& anchor, const std::string& text, const std::string& more) {
    return "<text x=\"" + px(at.x) + "\" y=\"" + px(at.y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" + with_indices(text) +
           "</text>\n";
}

std::string line_element(Point a, Point b, const std::string& attributes) {
    return "<line x1=\"" + px(a.x) + "\" y1=\"" + px(a.y) + "\" x2=\"" + px(b.x) + "\" y2=\"" + px(b.y) + "\" " + attributes + "/>\n";
}

std::string point_shape(Point p, int shape, const std::string& color) {
    const auto at = [&](double dx, double dy) { return px(p.x + dx) + " " + px(p.y + dy); };
    const std::string filled = "\" fill=\"" + color + "\"/>\n",
                      drawn = "\" fill=\"none\" stroke=\"" + color + "\" stroke-width=\"1.8\"/>\n";
    switch (shape) {
        case 1:
            return "<path d=\"M" + at(-3.3, -3.3) + "H" + px(p.x + 3.3) + "V" + px(p.y + 3.3) + "H" + px(p.x - 3.3) + "Z" + filled;
        case 2:
            return "<path d=\"M" + at(0, -4.4) + "L" + at(4.2, 3.2) + "L" + at(-4.2, 3.2) + "Z" + filled;
        case 3:
            return "<path d=\"M" + at(0, -4.6) + "L" + at(4.6, 0) + "L" + at(0, 4.6) + "L" + at(-4.6, 0) + "Z" + filled;
        case 4:
            return "<path d=\"M" + at(-3.4, -3.4) + "L" + at(3.4, 3.4) + "M" + at(-3.4, 3.4) + "L" + at(3.4, -3.4) + drawn;
        case 5:
            return "<path d=\"M" + at(-4.2, 0) + "L" + at(4.2, 0) + "M" + at(0, -4.2) + "L" + at(0, 4.2) + drawn;
        default:
            return "<circle cx=\"" + px(p.x) + "\" cy=\"" + px(p.y) + "\" r=\"3.6" + filled;
    }
}

}   // namespace meshfolio::report
