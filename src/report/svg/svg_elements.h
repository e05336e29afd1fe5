/// @file
/// The SVG elements of plots, maps, diagrams and legends. Units are pixels, y down.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report/document.h"
#include "report/svg/plot_axis.h"
#include "report/text.h"

namespace meshfolio::report {

constexpr double font_size = 12.5, script_size = 11;   // 7.5 and 6.6 points where a drawing is 136 mm wide
inline constexpr const char* font_family = "'Report Sans', 'Report Math', system-ui, sans-serif";   // as in fonts.css; files stand alone
inline constexpr const char* firm = "stroke=\"currentColor\" stroke-width=\"1\"";
inline constexpr double drawing_width = 640, line_height = 17;   // of plots and maps, pixels

struct Point {
    double x = 0, y = 0;
};

struct Box {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// Consecutive points of a curve without a gap.
using Stretch = std::vector<Point>;

/// Returns the points point_of(0) to point_of(n − 1), optional each, in stretches between empty ones.
template <class PointOf> std::vector<Stretch> stretches(std::size_t n, PointOf point_of) {
    std::vector<Stretch> all(1);
    for (std::size_t i = 0; i < n; ++i) {
        const std::optional<Point> point = point_of(i);
        if (point) all.back().push_back(*point);
        if (!point && !all.back().empty()) all.emplace_back();
    }
    if (all.back().empty()) all.pop_back();
    return all;
}

/// Returns the path data of the line through these points: "M1 2L3 4".
std::string line_data(const Stretch& points);

/// Returns the width [pixels] of a text in the regular sans of the pages.
double text_width(const std::string& text);
/// Returns the width [pixels] of a text in which indices and exponents are smaller.
double text_width(const Text& text);
/// Returns the lines of a text, broken at spaces; no line is wider than `width` [pixels] unless a single word is.
std::vector<std::string> wrapped(const std::string& text, double width);

/// Returns a coordinate, rounded to a tenth of a pixel: "12.3".
std::string px(double x);

/// Returns a <text> element. Any text is made safe; in mathematics, such as λ_crit, letters are italic and indices lowered.
/// @param anchor  start, middle or end
/// @param more    further attributes, each behind a space
std::string text_element(Point at, const std::string& anchor, const std::string& text, const std::string& more = "");
std::string text_element(Point at, const std::string& anchor, const Text& text, const std::string& more = "");

inline constexpr double title_width = drawing_width - 8;
/// Returns a bold title that begins at `at`, in lines no wider than `width`, and moves `at` below them.
std::string title_element(Point& at, const std::string& anchor, const std::string& words, double width = title_width);
/// Returns the number of lines into which title_element() breaks a title.
double title_lines(const std::string& words, double width = title_width);

/// Return a <line> and a <rect> element with further attributes.
std::string line_element(Point a, Point b, const std::string& attributes);
std::string rectangle_element(const Box& box, const std::string& attributes);

/// The look of a series. The first 42 series of a plot look different in any style: colours repeat after six; patterns, which are dashes
/// and a shape of points, after seven.
struct Look {
    std::string color;    // a CSS variable of the page, with a default for white ground
    std::string dashes;   // empty: a continuous line
    int pattern;          // shape of its points
    bool has_line, has_points;
};

/// Returns the look of a series. @param place  its number in the plot, unless it has its own colour or pattern
Look look_of(const Series& series, std::size_t place);

/// Returns SVG of a point shape at p: disc, square, triangle, diamond, cross, plus or inverted triangle for pattern 0 to 6.
/// @param size  factor
std::string point_shape(Point p, int pattern, const std::string& color, double size = 1);

/// Names in rows above a drawing, each once, behind a sample of its curve.
class NameRows {
public:
    static constexpr double sample_width = 28;
    explicit NameRows(double width = drawing_width) : width_(width) {}
    /// Adds a name unless it is empty or known. @param sample  returns the SVG of the sample, given its left end
    void add(const std::string& name, const std::function<std::string(Point)>& sample);
    const std::string& svg() const { return svg_; }
    double bottom() const { return bottom_; }   // 0 without names

private:
    std::vector<std::string> known_;
    std::string svg_;
    double width_, x_ = 4, y_ = 14, bottom_ = 0;
};

/// Returns SVG of the ticks and labels of an axis below a frame. A label that would touch the label before it is left out.
std::string ticks_below(const Axis& axis, const Box& frame);
/// Returns SVG of the ticks and labels of a vertical axis at the left of a frame, or at its right.
std::string ticks_beside(const Axis& axis, const Box& frame, bool at_right = false);
constexpr double tick_length = 5;
/// Returns the width [pixels] of the widest label of an axis; 0 without labels.
double widest_label(const Axis& axis);

/// Returns the opening <svg …> of a picture: its size, its subject as <title> and its alternative text as <desc>.
std::string svg_head(const std::string& id, const std::string& subject, const std::string& alt, double width, double height);

}   // namespace meshfolio::report
