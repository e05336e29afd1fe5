/// @file
/// Letters on whole pixels. stb_truetype runs no hinting programs, so that at the size of small text every horizontal edge falls
/// somewhere within a pixel and all of them look grey. Here the heights of a glyph are moved, by a third of a pixel or so, until the
/// lines that letters share and their thin horizontal bars begin and end with a row. Widths stay as they are.
#pragma once

#include <span>
#include <vector>

namespace render {

/// The heights that the letters of a font share, from the baseline up, in font units.
struct FontLines {
    double descender = 0;   // of p, below 0
    double x_height = 0;
    double capital = 0;
    double ascender = 0;    // of d
    double overshoot = 0;   // by which round letters go beyond all of these
};

/// A horizontal edge of an outline, straight or the extreme of a curve.
struct HorizontalEdge {
    double height;
    bool is_top;   // the ink is below it
};

/// Maps heights in font units to rows of pixels: piecewise linear and never falling.
class GridFit {
public:
    /// @param scale  pixels per font unit
    GridFit(const FontLines& lines, std::span<const HorizontalEdge> edges, double scale);

    /// Pixels above the baseline.
    double operator()(double height) const;

private:
    struct Knot {
        double height, pixels;
    };

    double scale_;
    std::vector<Knot> knots_;   // ascending

    void insert_bar(double bottom, double top);
    bool insert(double height, double pixels);
};

}   // namespace render
