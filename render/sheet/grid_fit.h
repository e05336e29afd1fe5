/// @file
/// Hinting of heights. stb_truetype does not hint, so that in small text horizontal edges fall within pixels and look grey. GridFit moves
/// the heights of a glyph by up to half a pixel such that the lines that letters share, and thin horizontal bars, begin and end with a row
/// of pixels. Widths do not change.
#pragma once

#include <span>
#include <vector>

namespace render {

/// The heights that the letters of a font share, above the baseline, in font units.
struct FontLines {
    double descender = 0;   // of p, below 0
    double x_height = 0;
    double capital = 0;
    double ascender = 0;    // of d
    double overshoot = 0;   // of round letters beyond the other heights
};

/// A horizontal edge of an outline: straight, or the extreme of a curve.
struct HorizontalEdge {
    double height;
    bool is_top;   // the ink is below it
};

/// Maps heights in font units to pixels above the baseline, piecewise linearly and monotonically.
class GridFit {
public:
    /// @param scale  pixels per font unit
    GridFit(const FontLines& lines, std::span<const HorizontalEdge> edges, double scale);

    /// Returns the fitted height in pixels above the baseline of a height in font units.
    double operator()(double height) const;

private:
    struct Knot {
        double height, pixels;
    };

    double scale_;
    std::vector<Knot> knots_;   // ascending

    void insert_bar(double bottom, double top);
    void insert(double height, double pixels);
};

}   // namespace render
