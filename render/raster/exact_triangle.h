/// @file
/// Shading of what has no corners on the grid, one fragment at a time: triangles that reach far beyond the picture, and ribbons.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "raster/fragments.h"
#include "scene/outline.h"
#include "shading/shading_style.h"

namespace render {

/// A triangle, or half of a ribbon, in the original coordinates.
class ExactTriangle {
public:
    ExactTriangle(const ProjectedScene& projected, std::span<const Ribbon> ribbons, std::int32_t id);

    /// What is interpolated for fragment i; see Fragments.
    void interpolate(const ShadingStyle& style, Fragments& fragments, std::size_t i) const;

private:
    glm::dvec2 at(std::size_t k) const;   // a corner, from the middle of the picture, y up
    double area() const;                  // twice, signed
    glm::dvec3 barycentric(const Fragments& fragments, std::size_t i) const;

    const Scene& scene_;
    const Axes& axes_;
    bool is_ribbon_;
    Triangle2 screen_;
    glm::ivec3 vertex_{};
};

}   // namespace render
