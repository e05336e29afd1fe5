#include "sheet/view_label.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/camera.h"

namespace {

using render::Image;
using render::View;

constexpr double em = 100;
constexpr std::array<glm::dvec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

Image label_of(const View& view) {
    render::Drawing drawing{.width = 800, .height = 500};
    render::add_view_label(drawing, 400, 250, view.name, em, {0, 0, 0, 255});
    return render::painted(drawing);
}

/// Pixels of one axis: x is red, y green, z blue.
std::vector<glm::dvec2> inked(const Image& image, int axis) {
    std::vector<glm::dvec2> found;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const render::Rgba pixel = image.at(x, y);
            std::array<int, 3> c{pixel.r, pixel.g, pixel.b};
            std::rotate(c.begin(), c.begin() + axis, c.end());
            if (c[0] > std::max(c[1], c[2]) + 60) found.emplace_back(x + 0.5, y + 0.5);
        }
    }
    return found;
}

/// The direction of an axis in the picture, right and down; (0, 0) along the line of sight.
glm::dvec2 on_screen(const View& view, int axis) {
    const glm::dvec3& e = axes[static_cast<std::size_t>(axis)];
    return {glm::dot(e, view.right()), -glm::dot(e, view.up)};
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
    return values[values.size() / 2];
}

/// The point where the shafts of the two visible arrows meet.
glm::dvec2 origin_of(const Image& image, const View& view) {
    glm::dvec2 origin(0);
    for (int axis = 0; axis < 3; ++axis) {
        const int across = std::abs(on_screen(view, axis).x) > 0.5 ? 1 : 0;   // the coordinate that a shaft keeps
        if (glm::length(on_screen(view, axis)) < 0.5) continue;
        std::vector<double> places;
        for (const glm::dvec2& p : inked(image, axis)) places.push_back(p[across]);
        origin[across] = median(places);
    }
    return origin;
}

/// The share of the points with an image under `map` that is more than 2.5 pixels from all points.
template <class Map> double asymmetry(const std::vector<glm::dvec2>& points, const Map& map) {
    const auto has = [&](const glm::dvec2& p) {
        return std::any_of(points.begin(), points.end(), [&](const glm::dvec2& q) { return glm::length(p - q) < 2.5; });
    };
    const auto lost = std::count_if(points.begin(), points.end(), [&](const glm::dvec2& p) { return !has(map(p)); });
    return double(lost) / double(points.size());
}

}   // namespace

TEST(ViewLabel, ArrowsPointWhereTheAxesAreSeen) {
    for (const View& view : render::six_views) {
        const Image image = label_of(view);
        const glm::dvec2 origin = origin_of(image, view);
        for (int axis = 0; axis < 3; ++axis) {
            const glm::dvec2 direction = on_screen(view, axis), across(-direction.y, direction.x);
            if (glm::length(direction) < 0.5) continue;
            double nearest = 1e9, furthest = -1e9, widest = 0;
            std::vector<glm::dvec2> arrow;   // without its letter
            for (const glm::dvec2& p : inked(image, axis)) {
                const double along = glm::dot(p - origin, direction), aside = glm::dot(p - origin, across);
                nearest = std::min(nearest, along);
                furthest = std::max(furthest, along);
                widest = std::max(widest, std::abs(aside));
                if (along < 1.3 * em) arrow.emplace_back(along, aside);
            }
            EXPECT_GT(nearest, 0) << view.name << ", axis " << axis;
            EXPECT_GT(furthest, 4 * widest) << view.name << ", axis " << axis;
            EXPECT_LT(asymmetry(arrow, [](glm::dvec2 p) { return glm::dvec2(p.x, -p.y); }), 0.01) << view.name << ", axis " << axis;
        }
    }
}

// A dot is the tip of an approaching arrow, a cross the feathers of a departing one.
TEST(ViewLabel, AnAxisAlongTheLineOfSightIsARingedDotOrCross) {
    for (const View& view : render::six_views) {
        const Image image = label_of(view);
        const glm::dvec2 origin = origin_of(image, view);
        for (int axis = 0; axis < 3; ++axis) {
            const double depth = glm::dot(axes[static_cast<std::size_t>(axis)], view.from);
            if (std::abs(depth) < 0.5) continue;
            std::vector<glm::dvec2> mark;
            double radius = 0;
            for (const glm::dvec2& p : inked(image, axis)) {
                if (glm::length(p - origin) > 0.28 * em) continue;   // the letter
                mark.push_back(p - origin);
                radius = std::max(radius, glm::length(p - origin));
            }
            EXPECT_GT(radius, 0.2 * em) << view.name;
            EXPECT_LT(asymmetry(mark, [](glm::dvec2 p) { return glm::dvec2(p.y, -p.x); }), 0.05) << view.name << ": a quarter turn";
            EXPECT_LT(asymmetry(mark, [](glm::dvec2 p) { return glm::dvec2(-p.x, p.y); }), 0.05) << view.name << ": a mirror";
            const auto inked_at = [&](glm::dvec2 p) {
                return std::any_of(mark.begin(), mark.end(), [&](const glm::dvec2& q) { return glm::length(p - q) < 1; });
            };
            EXPECT_TRUE(inked_at({0, 0})) << view.name;
            EXPECT_FALSE(inked_at({0.62 * radius, 0})) << view.name << ": beside the middle";
            EXPECT_EQ(inked_at({0.44 * radius, 0.44 * radius}), depth < 0) << view.name << ": between the middle and the ring";
        }
    }
}

TEST(ViewLabel, OtherNamesGetNoTripod) {
    const Image image = label_of({"front", {}, {}});
    for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(inked(image, axis).empty());
    EXPECT_GT(render::view_label_width("+x", em), render::view_label_width("front", em)) << "though the name is shorter";
}

// The arrow of the axis that is up points up, so that the label differs from that of the same view with y up.
TEST(ViewLabel, ShowsTheAxisThatIsUp) {
    const auto arrow_of_z = [](render::Up up) {
        render::Drawing drawing{.width = 200, .height = 100};
        render::add_view_label(drawing, 100, 50, "+x", 20, {0, 0, 0, 255}, up);
        for (const render::Drawing::Item& item : drawing.items)
            if (const auto* path = std::get_if<render::Drawing::Path>(&item);
                path != nullptr && path->color == render::Rgba{40, 85, 190, 255})
                return path->points[1] - path->points[0];
        return glm::dvec2(0);
    };
    EXPECT_LT(arrow_of_z(render::Up::y).x, 0) << "from +x, z points to the left";
    EXPECT_LT(arrow_of_z(render::Up::z).y, 0) << "y is down: z points up";
    EXPECT_NEAR(arrow_of_z(render::Up::z).x, 0, 1e-12);
}
