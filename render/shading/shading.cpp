// Shading has two steps over vectors of fragments (Highway: compiled once for each instruction set, with the same bits from all):
//   1. interpolate: fetch the corners of the triangle, compute barycentric coordinates, then the normal and the place in the colour map;
//   2. light: multiply the colour from the map by the light on the normal.
// Fragments of ribbons, and of triangles with corners that do not fit the grid, take step 1 one at a time (exact_shading.cpp).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shading/shading.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "color/srgb.h"
#include "raster/vectors-inl.h"
#include "rounding.h"
#include "shading/shading_style.h"

HWY_BEFORE_NAMESPACE();
namespace render::HWY_NAMESPACE {

using FloatMask = hn::Mask<Floats>;

HWY_INLINE FloatVector set(float x) { return hn::Set(Floats(), x); }
HWY_INLINE FloatVector clamped(FloatVector x) { return hn::Min(hn::Max(x, set(0)), set(1)); }

struct Vector3 {
    FloatVector x, y, z;
};
HWY_INLINE FloatVector dot(const Vector3& a, const Vector3& b) {
    return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}
HWY_INLINE Vector3 scaled(FloatVector s, const Vector3& a) { return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)}; }
HWY_INLINE Vector3 sum(const Vector3& a, const Vector3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
HWY_INLINE Vector3 difference(const Vector3& a, const Vector3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE FloatVector cross(FloatVector ax, FloatVector ay, FloatVector bx, FloatVector by) {
    return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
}

/// One corner of each triangle of a vector.
struct Corner {
    Vector3 at, normal;   // along the axes of the projection
    FloatVector sharpness, map_position;
};

class CornerFetcher {
public:
    CornerFetcher(const ProjectedScene& projected)
        : vertices_(projected.vertices),
          triangles_(&projected.scene.surface.triangles[0].x),
          map_positions_(projected.scene.map_positions.empty() ? nullptr : projected.scene.map_positions.data()),
          component_(projected.component) {}

    Corner corner(IntVector id, int k) const {
        const Ints d;
        const IntVector v = hn::GatherIndex(d, triangles_, hn::Add(hn::Add(id, hn::ShiftLeft<1>(id)), hn::Set(d, k)));
        const GridVectors vertex = grid_vectors(vertices_, v);
        const auto at = [&](int axis) HWY_ATTR { return hn::ConvertTo(Floats(), vertex.at[index(component_[index(axis)])]); };
        const IntVector packed = vertex.normal;
        const FloatMask has_normal = hn::RebindMask(Floats(), hn::Ne(packed, hn::Zero(d)));
        const auto normal = [&](int axis) HWY_ATTR {
            const IntVector bits = hn::And(hn::ShiftRightSame(packed, 10 * component_[index(axis)]), hn::Set(d, 1023));
            return hn::IfThenElseZero(has_normal, hn::Sub(hn::Mul(hn::ConvertTo(Floats(), bits), set(1.0F / 511)), set(1)));
        };
        const IntVector thirds = hn::And(hn::ShiftRight<30>(packed), hn::Set(d, 3));
        const FloatVector sharpness = hn::Mul(hn::ConvertTo(Floats(), thirds), set(1.0F / 3));
        return {{at(0), at(1), at(2)},
                {normal(0), normal(1), normal(2)},
                hn::IfThenElse(has_normal, sharpness, set(1)),
                map_positions_ != nullptr ? hn::GatherIndex(Floats(), map_positions_, v) : set(0)};
    }

private:
    const GridVertex* vertices_;
    const std::int32_t* triangles_;
    const float* map_positions_;
    std::array<int, 3> component_;
};

/// Returns the normal at a corner: of the vertex or, at a crease, of the triangle as far as it can be trusted.
HWY_INLINE Vector3 corner_normal(const Corner& corner, const Vector3& face_normal, FloatVector trust) {
    const FloatVector sharp = hn::Mul(trust, corner.sharpness);
    return sum(scaled(sharp, face_normal), scaled(hn::Sub(set(1), sharp), corner.normal));
}

/// Returns the value at barycentric coordinates. Near a corner without a value it is NaN; elsewhere such corners do not count.
HWY_INLINE FloatVector interpolated_value(FloatVector ta, FloatVector tb, FloatVector tc, FloatVector wa, FloatVector wb, FloatVector wc) {
    FloatVector total = set(0), weight = set(0);
    const auto add = [&](FloatVector t, FloatVector w) HWY_ATTR {
        const FloatMask known = hn::Not(hn::IsNaN(t));
        total = hn::Add(total, hn::IfThenElseZero(known, hn::Mul(w, t)));
        weight = hn::Add(weight, hn::IfThenElseZero(known, w));
    };
    add(ta, wa), add(tb, wb), add(tc, wc);
    const FloatMask b_nearer = hn::Gt(wb, wa);
    const FloatVector ab = hn::IfThenElse(b_nearer, tb, ta), w_ab = hn::IfThenElse(b_nearer, wb, wa);
    const FloatVector nearest = hn::IfThenElse(hn::Gt(wc, w_ab), tc, ab);
    const FloatMask use_nearest = hn::Or(hn::IsNaN(nearest), hn::Not(hn::Gt(weight, set(0))));
    return hn::IfThenElse(use_nearest, nearest, hn::Div(total, hn::IfThenElse(use_nearest, set(1), weight)));
}

/// Returns the ink at a distance from a line [pixels]: 1 on the line, 0 a pixel away.
HWY_INLINE FloatVector line_ink(FloatVector distance) { return clamped(hn::Sub(set(line_half_width + 0.5F), distance)); }

/// Returns the ink of the edges of a triangle with sides ab and ac [grid steps] and twice the area `area`.
HWY_INLINE FloatVector edge_ink(const Vector3& ab, const Vector3& ac, FloatVector area, FloatVector wa, FloatVector wb, FloatVector wc) {
    const auto height = [&](FloatVector x, FloatVector y) HWY_ATTR {
        return hn::Div(hn::Abs(area), hn::Mul(set(subpixels), hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)))));
    };
    const FloatVector over_a = height(hn::Sub(ac.x, ab.x), hn::Sub(ac.y, ab.y)), over_b = height(ac.x, ac.y), over_c = height(ab.x, ab.y);
    const FloatVector nearest = hn::Min(hn::Mul(wa, over_a), hn::Min(hn::Mul(wb, over_b), hn::Mul(wc, over_c)));
    const FloatVector smallest = hn::Min(over_a, hn::Min(over_b, over_c));
    return hn::Mul(hn::Mul(set(edge_strength), line_ink(nearest)), clamped(hn::Mul(smallest, set(1 / smallest_meshed))));
}

/// Returns the ink of isolines, which run where map position · scale + offset is an integer. The gradient gives the distance in pixels, so
/// that lines are equally wide everywhere. @param tb_ta, tc_ta  differences of the map positions of the corners
HWY_INLINE FloatVector isoline_ink(const ShadingStyle& style, const Vector3& ab, const Vector3& ac, FloatVector area, FloatVector tb_ta,
                                   FloatVector tc_ta, FloatVector at) {
    const FloatVector gx = hn::Div(cross(tb_ta, tc_ta, ab.y, ac.y), area), gy = hn::Div(cross(tc_ta, tb_ta, ac.x, ab.x), area);
    const FloatVector slope =   // of the map position, per pixel
        hn::Mul(set(subpixels), hn::Sqrt(hn::Add(hn::Mul(gx, gx), hn::Mul(gy, gy))));
    const FloatVector gradient = hn::Mul(set(std::abs(style.isoline_scale)), slope);
    const FloatVector u = hn::Add(hn::Mul(at, set(style.isoline_scale)), set(style.isoline_offset));
    const FloatVector to_line = hn::Abs(hn::Sub(u, hn::Round(u)));
    const FloatMask is_steep = hn::Gt(slope, set(flattest_isolines));   // false also for NaN
    const FloatVector spacing = hn::Div(set(1), hn::IfThenElse(is_steep, gradient, set(1)));
    const FloatVector fading = clamped(hn::Sub(hn::Mul(spacing, set(2 / closest_isolines)), set(1)));
    return hn::IfThenElseZero(is_steep, hn::Mul(fading, line_ink(hn::Mul(to_line, spacing))));
}

/// Sets normal, map position, back and ink of a vector of fragments from i on (step 1).
HWY_INLINE void interpolate(const CornerFetcher& fetch, float handedness, const ShadingStyle& style, Fragments& fragments, std::size_t i) {
    const Floats f;
    const IntVector id = hn::Load(Ints(), fragments.triangle.data() + i);
    const Corner a = fetch.corner(id, 0), b = fetch.corner(id, 1), c = fetch.corner(id, 2);
    const Vector3 ab = difference(b.at, a.at), ac = difference(c.at, a.at);
    const FloatVector area = cross(ab.x, ab.y, ac.x, ac.y);
    const FloatVector px = hn::Sub(hn::Load(f, fragments.x.data() + i), a.at.x), py = hn::Sub(hn::Load(f, fragments.y.data() + i), a.at.y);
    const FloatVector one_over_area = hn::Div(set(1), hn::IfThenElse(hn::Eq(area, set(0)), set(1), area));
    // Limits, because rounding may carry points of slivers out.
    const FloatVector wb = clamped(hn::Mul(cross(px, py, ac.x, ac.y), one_over_area));
    const FloatVector wc = hn::Min(clamped(hn::Mul(cross(ab.x, ab.y, px, py), one_over_area)), hn::Sub(set(1), wb));
    const FloatVector wa = hn::Sub(hn::Sub(set(1), wb), wc);

    const FloatMask faces_away = hn::Lt(hn::Mul(area, set(handedness * style.towards_viewer)), set(0));
    const FloatVector sign = hn::IfThenElse(faces_away, set(-1), set(1));
    Vector3 na = a.normal, nb = b.normal, nc = c.normal;
    if (!hn::AllTrue(f, hn::Eq(hn::Max(a.sharpness, hn::Max(b.sharpness, c.sharpness)), set(0)))) {
        const Vector3 face{cross(ab.y, ab.z, ac.y, ac.z), cross(ab.z, ab.x, ac.z, ac.x), area};
        const FloatVector length = hn::Sqrt(dot(face, face));
        const Vector3 face_normal = scaled(hn::Div(set(handedness), hn::Max(length, set(1e-30F))), face);
        const FloatVector trust = hn::Min(set(1), hn::Mul(length, set(1 / trusted_area)));
        na = corner_normal(a, face_normal, trust), nb = corner_normal(b, face_normal, trust), nc = corner_normal(c, face_normal, trust);
    }
    const auto part = [&](FloatVector w, const Vector3& n) HWY_ATTR { return scaled(hn::Mul(sign, w), n); };
    const Vector3 normal = sum(part(wa, na), sum(part(wb, nb), part(wc, nc)));
    hn::Store(normal.x, f, fragments.normal_x.data() + i);
    hn::Store(normal.y, f, fragments.normal_y.data() + i);
    hn::Store(normal.z, f, fragments.normal_z.data() + i);
    hn::Store(hn::IfThenElseZero(faces_away, set(1)), f, fragments.back.data() + i);
    hn::Store(set(0), f, fragments.fixed_light.data() + i);
    FloatVector ink = set(0);
    if (style.has_values) {
        const FloatVector at = interpolated_value(a.map_position, b.map_position, c.map_position, wa, wb, wc);
        hn::Store(at, f, fragments.map_position.data() + i);
        if (style.isoline_scale != 0)
            ink = isoline_ink(style, ab, ac, area, hn::Sub(b.map_position, a.map_position), hn::Sub(c.map_position, a.map_position), at);
    }
    if (style.options.edges) ink = hn::Max(ink, edge_ink(ab, ac, area, wa, wb, wc));
    hn::Store(ink, f, fragments.ink.data() + i);
}

/// Returns the neutral light on the fragments from i on, 0 to 1.
HWY_INLINE FloatVector light_on(const ShadingStyle& style, const Fragments& fragments, std::size_t i) {
    const Floats f;
    Vector3 n{hn::Load(f, fragments.normal_x.data() + i), hn::Load(f, fragments.normal_y.data() + i),
              hn::Load(f, fragments.normal_z.data() + i)};
    const FloatVector length = hn::Sqrt(dot(n, n));
    const FloatMask has_normal = hn::Gt(length, set(0));
    n = scaled(hn::Div(set(1), hn::IfThenElse(has_normal, length, set(1))), n);
    n.z = hn::IfThenElse(has_normal, n.z, set(style.towards_viewer));
    FloatVector total = set(ambient);
    for (std::size_t l = 0; l < light_strength.size(); ++l) {
        const glm::vec3& towards = style.lights[l];
        const FloatVector facing = hn::Add(dot(n, {set(towards.x), set(towards.y), set(towards.z)}), set(wrap));
        total = hn::Add(total, hn::Mul(set(light_strength[l] / (1 + wrap)), hn::Max(set(0), facing)));
    }
    const FloatVector light = hn::Min(style.has_values ? hn::Mul(set(exposure_of_values), total) : total, set(1));
    const FloatVector shown = style.has_values ? hn::Sub(set(1), hn::Mul(set(light_on_values), hn::Sub(set(1), light))) : light;
    const FloatVector fixed = hn::Load(f, fragments.fixed_light.data() + i);
    return hn::IfThenElse(hn::Gt(fixed, set(0)), fixed, shown);
}

/// Returns the colours of the values, or of the plain surface, without light.
HWY_INLINE Vector3 base_color(const ShadingStyle& style, const Fragments& fragments, std::size_t i) {
    const Floats f;
    const Palette& palette = style.palette;
    if (!style.has_values) return {set(palette.plain.r), set(palette.plain.g), set(palette.plain.b)};
    const FloatVector at = hn::Load(f, fragments.map_position.data() + i);
    const FloatMask known = hn::Not(hn::IsNaN(at));
    const IntVector step = hn::NearestInt(hn::Mul(hn::IfThenElseZero(known, clamped(at)), set(Palette::steps)));
    return {hn::IfThenElse(known, hn::GatherIndex(f, palette.red.data(), step), set(palette.undefined.r)),
            hn::IfThenElse(known, hn::GatherIndex(f, palette.green.data(), step), set(palette.undefined.g)),
            hn::IfThenElse(known, hn::GatherIndex(f, palette.blue.data(), step), set(palette.undefined.b))};
}

/// Returns the ink of hatches: thin slanting lines over undefined values and, in the other direction, over backs.
HWY_INLINE FloatVector hatch_ink(const ShadingStyle& style, const Fragments& fragments, std::size_t i) {
    const Floats f;
    const FloatMask undefined = hn::IsNaN(hn::Load(f, fragments.map_position.data() + i));
    const FloatMask is_back = hn::Gt(hn::Load(f, fragments.back.data() + i), set(0));
    if (hn::AllFalse(f, hn::Or(undefined, is_back))) return set(0);
    const FloatVector x = hn::Mul(set(style.slant), hn::Load(f, fragments.x.data() + i)), y = hn::Load(f, fragments.y.data() + i);
    const auto lines = [&](FloatVector across) HWY_ATTR {
        constexpr float spacing = hatch_spacing * subpixels * 1.41421356F;
        const FloatVector u = hn::Mul(across, set(1 / spacing));
        return line_ink(hn::Mul(hn::Abs(hn::Sub(u, hn::Round(u))), set(hatch_spacing)));
    };
    const FloatVector over_undefined = hn::IfThenElseZero(undefined, hn::Mul(set(undefined_hatch), lines(hn::Sub(x, y))));
    return hn::IfThenElse(is_back, hn::Max(over_undefined, hn::Mul(set(back_hatch), lines(hn::Add(x, y)))), over_undefined);
}

/// Sets red, green and blue of a vector of fragments from i on (step 2).
HWY_INLINE void light(const ShadingStyle& style, Fragments& fragments, std::size_t i) {
    const Floats f;
    Vector3 color = base_color(style, fragments, i);
    if (style.options.shading) {
        const FloatVector strength = light_on(style, fragments, i), back = hn::Load(f, fragments.back.data() + i);
        const glm::vec3 darkening = style.options.backface_tint && !style.has_values ? back_tint : glm::vec3(1);
        const auto tinted = [&](FloatVector channel, float tint)
                                HWY_ATTR { return hn::Mul(hn::Mul(channel, strength), hn::Sub(set(1), hn::Mul(back, set(1 - tint)))); };
        color = {tinted(color.x, darkening.r), tinted(color.y, darkening.g), tinted(color.z, darkening.b)};
        if (style.has_values && style.options.backface_tint) {   // dark on light colours and light on dark ones
            const FloatVector ink = hatch_ink(style, fragments, i), dark = hn::IfThenElseZero(hn::Lt(color.y, set(0.12F)), set(0.4F));
            color = sum(scaled(hn::Sub(set(1), ink), color), scaled(ink, {dark, dark, dark}));
        }
    }
    const FloatVector ink = hn::Load(f, fragments.ink.data() + i);
    color = sum(scaled(hn::Sub(set(1), ink), color), scaled(ink, {set(ink_color.r), set(ink_color.g), set(ink_color.b)}));
    hn::Store(color.x, f, fragments.red.data() + i);
    hn::Store(color.y, f, fragments.green.data() + i);
    hn::Store(color.z, f, fragments.blue.data() + i);
}

void InterpolateAll(const ProjectedScene& scene, const ShadingStyle& style, Fragments& fragments) {
    const CornerFetcher fetch(scene);
    const auto handedness = static_cast<float>(scene.axes.handedness());
    for (std::size_t i = 0; i < fragments.count; i += hn::Lanes(Floats())) interpolate(fetch, handedness, style, fragments, i);
}

void LightAll(const ShadingStyle& style, Fragments& fragments) {
    for (std::size_t i = 0; i < fragments.count; i += hn::Lanes(Floats())) light(style, fragments, i);
}

}   // namespace render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(InterpolateAll);
HWY_EXPORT(LightAll);

void shade(const ProjectedScene& projected, std::span<const Ribbon> ribbons, const ShadingStyle& style, Fragments& fragments) {
    if (style.options.face_colors_from_id) {
        for (std::size_t i = 0; i < fragments.count; ++i) {
            const auto number = static_cast<std::uint32_t>(fragments.triangle[i]) + 1;
            fragments.red[i] = linear_of(static_cast<std::uint8_t>(number >> 16));
            fragments.green[i] = linear_of(static_cast<std::uint8_t>(number >> 8));
            fragments.blue[i] = linear_of(static_cast<std::uint8_t>(number));
        }
        return;
    }
    const auto is_off_grid = [&](std::int32_t id) {   // also for ribbons
        if (id >= projected.scene.triangle_count()) return true;
        const glm::ivec3& t = projected.scene.surface.triangles[index(id)];
        const auto first = [&](int v) { return projected.vertices[v].at[0]; };
        return std::min({first(t.x), first(t.y), first(t.z)}) <= GridVertex::far_off;
    };
    std::vector<std::pair<std::size_t, std::int32_t>> exact;
    const bool some_exact = projected.has_far_off || !ribbons.empty();
    std::int32_t ordinary = some_exact ? no_triangle : fragments.triangle[0];
    for (std::size_t i = 0; some_exact && i < fragments.count; ++i)
        if (is_off_grid(fragments.triangle[i])) exact.emplace_back(i, fragments.triangle[i]);
        else ordinary = fragments.triangle[i];
    // An ordinary triangle stands in for ribbons, which have no corners to fetch, and fills the last vector.
    for (const auto& [i, id] : exact) fragments.triangle[i] = ordinary;
    for (std::size_t i = fragments.count; i % block_samples != 0; ++i)
        fragments.triangle[i] = ordinary, fragments.x[i] = 0, fragments.y[i] = 0;
    if (ordinary != no_triangle) HWY_DYNAMIC_DISPATCH(InterpolateAll)(projected, style, fragments);
    for (const auto& [i, id] : exact) interpolate_exactly(projected, ribbons, id, style, fragments, i);
    HWY_DYNAMIC_DISPATCH(LightAll)(style, fragments);
}

}   // namespace render
#endif
