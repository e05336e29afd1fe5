#include "sheet/drawing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rounding.h"
#include "sheet/strokes.h"

namespace render {

namespace {

/// Returns the x of the points where a row meets the sides of an area, ascending.
std::vector<double> crossings(const std::vector<glm::dvec2>& corners, double y) {
    std::vector<double> found;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
        if ((a.y <= y) != (b.y <= y)) found.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    std::ranges::sort(found);
    return found;
}

/// Fills an area: 16 lines a row of pixels, each with its exact length in a pixel.
void fill_area(Image& image, const Drawing::Area& area) {
    constexpr int lines = 16;
    if (area.corners.empty()) return;
    const auto [top, bottom] = std::ranges::minmax(area.corners, {}, &glm::dvec2::y);
    std::vector<double> coverage(index(image.width));
    for (int y = std::max(0, int(std::floor(top.y))); y < std::min(image.height, int(std::ceil(bottom.y))); ++y) {
        std::ranges::fill(coverage, 0);
        for (int line = 0; line < lines; ++line) {
            const std::vector<double> ends = crossings(area.corners, y + (line + 0.5) / lines);
            for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
                for (int x = std::max(0, int(std::floor(ends[i]))); x < std::min(image.width, int(std::ceil(ends[i + 1]))); ++x)
                    coverage[index(x)] += (std::min(ends[i + 1], x + 1.0) - std::max(ends[i], double(x))) / lines;
        }
        for (int x = 0; x < image.width; ++x)
            if (coverage[index(x)] > 0) image.at(x, y) = inked(image.at(x, y), area.color, static_cast<float>(coverage[index(x)]));
    }
}

struct Painter {
    Image& image;

    void operator()(const Drawing::Picture& p) const { paste(image, *p.image, p.left, p.top); }
    void operator()(const Drawing::Text& t) const { draw_text(image, t.at.x, t.at.y, t.text, t.style); }
    void operator()(const Drawing::Path& p) const {
        for (std::size_t i = 0; i + 1 < p.points.size(); ++i) draw_line(image, p.points[i], p.points[i + 1], p.width, p.color);
    }
    void operator()(const Drawing::Ring& r) const { draw_ring(image, r.centre, r.radius, r.width, r.color); }
    void operator()(const Drawing::Area& a) const { fill_area(image, a); }
    void operator()(const Drawing::Ramp& r) const {
        for (int x = r.left; x < r.right; ++x)
            fill_rectangle(image, x, r.top, x + 1, r.bottom, color_at(*r.colormap, (x + 0.5 - r.left) / (r.right - r.left)));
    }
};

/// Moves an item.
struct Mover {
    int right, down;
    glm::dvec2 by{right, down};

    void operator()(Drawing::Picture& p) const { p.left += right, p.top += down; }
    void operator()(Drawing::Text& t) const { t.at += by; }
    void operator()(Drawing::Ring& r) const { r.centre += by; }
    void operator()(Drawing::Ramp& r) const { r.left += right, r.right += right, r.top += down, r.bottom += down; }
    void operator()(Drawing::Path& p) const {
        for (glm::dvec2& point : p.points) point += by;
    }
    void operator()(Drawing::Area& a) const {
        for (glm::dvec2& corner : a.corners) corner += by;
    }
};

}   // namespace

void Drawing::add_text(double x, double y, const std::string& text, const TextStyle& style) {
    if (!text.empty()) items.emplace_back(Text{{x, y}, text, style});
}

void Drawing::add_rectangle(int x0, int y0, int x1, int y1, Rgba color) {
    items.emplace_back(Area{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, color});
}

void Drawing::add(const Drawing& other, int right, int down) {
    for (Item item : other.items) {
        std::visit(Mover{right, down}, item);
        items.push_back(std::move(item));
    }
}

void paint(Image& image, const Drawing& drawing) {
    for (const Drawing::Item& item : drawing.items) std::visit(Painter{image}, item);
}

Image painted(const Drawing& drawing) {
    Image image(drawing.width, drawing.height, drawing.background);
    paint(image, drawing);
    return image;
}

}   // namespace render
