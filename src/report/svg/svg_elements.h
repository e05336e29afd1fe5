/// @file
/// The SVG elements plots and maps are made of.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/document.h"
#include "report/svg/plot_axis.h"
#include "report/svg/plot_labels.h"

namespace meshfolio::report {

inline constexpr const char* firm = "stroke=\"currentColor\" stroke-width=\"1\"";
inline constexpr double drawing_width = 640, line_height = 17;   // of plots and maps, pixels

/// A coordinate to a tenth of a pixel.
std::string px(double x);

/// Text of any kind, made safe; of mathematics, such as λ_crit, letters are italic and indices lowered. `anchor`: start, middle or end.
std::string text_element(Point at, const std::string& anchor, const std::string& text, const std::string& more = "");
std::string text_element(Point at, const std::string& anchor, const Text& text, const std::string& more = "");

inline constexpr double title_width = drawing_width - 8;
/// A title from `at` on, in lines of at most that width; `at` moves below them.
std::string title_element(Point& at, const std::string& anchor, const std::string& words, double width = title_width);
double title_lines(const std::string& words, double width = title_width);

std::string line_element(Point a, Point b, const std::string& attributes);
std::string rectangle_element(const Box& box, const std::string& attributes);

/// How a series is drawn. No two of a plot's first 42 look the same, in whatever styles: they repeat the colours after six and the
/// patterns, each a kind of dashes and a shape of points, after seven.
struct Look {
    std::string color;    // a variable of the page, with a default that reads on white
    std::string dashes;   // empty: a continuous line
    int pattern;          // shape of its points
    bool has_line, has_points;
};

Look look_of(const Series& series, std::size_t place);

/// Disc, square, triangle, diamond, cross, plus or triangle on its tip, for pattern 0 to 6.
std::string point_shape(Point p, int pattern, const std::string& color, double size = 1);

/// Names in rows above a drawing, each once and behind a sample.
class NameRows {
public:
    static constexpr double sample_width = 28;
    explicit NameRows(double width = drawing_width) : width_(width) {}
    /// @param sample  draws it, SVG from a point on
    void add(const std::string& name, const std::function<std::string(Point)>& sample);
    const std::string& svg() const { return svg_; }
    double bottom() const { return bottom_; }   // 0 without names

private:
    std::vector<std::string> known_;
    std::string svg_;
    double width_, x_ = 4, y_ = 14, bottom_ = 0;
};

/// Ticks and labels under a frame; labels that would touch the one before are left out.
std::string ticks_below(const Axis& axis, const Box& frame);
/// Ticks and labels beside a frame, at its left or its right.
std::string ticks_beside(const Axis& axis, const Box& frame, bool at_right = false);
constexpr double tick_length = 5;
double widest_label(const Axis& axis);

/// The opening of a picture: its size, what it is and what is to be seen, for those who do not see it.
std::string svg_head(const std::string& id, const std::string& subject, const std::string& alt, double width, double height);

}   // namespace meshfolio::report
