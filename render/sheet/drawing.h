/// @file
/// Figures before they become pixels or vectors: a list of items, painted in their order.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "color/colormap.h"
#include "scene/image.h"
#include "sheet/text.h"

namespace render {

/// A figure, with lengths in pixels and y down from its upper left corner.
struct Drawing {
    struct Picture {
        std::shared_ptr<const Image> image;
        int left = 0, top = 0;
    };
    struct Text {
        glm::dvec2 at{0};   // the baseline, at the place that style.align says
        std::string text;
        TextStyle style;
    };
    /// Straight lines from point to point, with round ends and corners.
    struct Path {
        std::vector<glm::dvec2> points;
        double width = 1;
        Rgba color;
    };
    struct Ring {
        glm::dvec2 centre{0};
        double radius = 1, width = 1;
        Rgba color;
    };
    struct Area {
        std::vector<glm::dvec2> corners;
        Rgba color;
    };
    /// A box with the colours of a map from left to right.
    struct Ramp {
        const Colormap* colormap;
        int left, top, right, bottom;
    };
    using Item = std::variant<Picture, Text, Path, Ring, Area, Ramp>;

    int width = 0, height = 0;
    Rgba background{255, 255, 255, 255};
    std::vector<Item> items = {};

    /// Adds a text, or nothing for an empty one.
    void add_text(double x, double y, const std::string& text, const TextStyle& style);
    void add_line(glm::dvec2 from, glm::dvec2 to, double thickness, Rgba color) { items.emplace_back(Path{{from, to}, thickness, color}); }
    /// Adds the area x0 ≤ x < x1, y0 ≤ y < y1.
    void add_rectangle(int x0, int y0, int x1, int y1, Rgba color);
    /// Adds the items of another drawing, moved to the right and down.
    void add(const Drawing& other, int right, int down);
};

/// Paints the items onto an image.
void paint(Image& image, const Drawing& drawing);
/// Returns the drawing as a picture.
Image painted(const Drawing& drawing);

}   // namespace render
