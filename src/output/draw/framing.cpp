#include "output/draw/framing.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "mesh/triangle_measures.h"
#include "output/draw/arrangement.h"
#include "output/draw/surface_of.h"
#include "scene/hero.h"

namespace meshfolio::output {

namespace {

constexpr double share_framed = 0.94;        // of the side of a picture; the rest is margin
constexpr double narrowest_picture = 0.12;   // of the side, for surfaces seen from their edge

std::size_t first_of_group(const FigureRequest& request, std::size_t panel) {
    return panel - panel % static_cast<std::size_t>(request.states);
}

/// True if the picture of panel `of` must show all of this panel's mesh.
bool is_framed(const FigureRequest& request, std::size_t panel, std::size_t of = 0) {
    if (request.states > 1) return panel == first_of_group(request, of);
    return request.frame_panel < 0 || panel == static_cast<std::size_t>(request.frame_panel);
}

render::Bounds united(const std::optional<render::Bounds>& a, const render::Bounds& b) {
    return a ? render::Bounds{glm::min(a->low, b.low), glm::max(a->high, b.high)} : b;
}

/// Returns the box of the meshes of the panels for which is_wanted(panel) holds.
template <class Wanted> render::Bounds joined_box(const FigureRequest& request, const Wanted& is_wanted) {
    std::optional<render::Bounds> box;
    for (std::size_t p = 0; p < request.panels.size(); ++p)
        if (request.panels[p].mesh && is_wanted(p)) box = united(box, bounds_of(*request.panels[p].mesh));
    return box.value_or(render::Bounds{});
}

render::Bounds seen(const TriangleMesh& mesh, const render::View& view, const render::Frame& frame) {
    const render::Surface surface = surface_of(mesh);
    return render::bounds_in_picture(surface.positions, surface.triangles, view, frame);
}

render::Bounds within_square(const render::Bounds& box, int side) {
    const glm::dvec3 half(0.5 * side);
    return {glm::clamp(box.low, -half, half), glm::clamp(box.high, -half, half)};
}

/// Returns the length of a picture with its margin [pixels] for `extent` out of a square of `side`.
int picture_length(double extent, int side) {
    const double length = extent + (1 - share_framed) * side;
    return static_cast<int>(std::lround(std::clamp(length, std::max(1.0, narrowest_picture * side), double(side))));
}

/// Returns the frame in which the framed panels together fill the picture.
render::Frame common_frame(const FigureRequest& request, const render::View& view, int width, int height, double fill) {
    std::vector<glm::dvec3> positions;
    std::vector<glm::ivec3> triangles;
    for (std::size_t p = 0; p < request.panels.size(); ++p) {
        if (!request.panels[p].mesh || !is_framed(request, p)) continue;
        const render::Surface surface = surface_of(*request.panels[p].mesh);
        const int offset = static_cast<int>(positions.size());
        positions.insert(positions.end(), surface.positions.begin(), surface.positions.end());
        for (const glm::ivec3& t : surface.triangles) triangles.push_back(t + offset);
    }
    return render::frame_of(positions, triangles, view, width, height, fill);
}

render::Frame own_frame(const TriangleMesh& mesh, const render::View& view, int width, int height, double fill) {
    const render::Surface surface = surface_of(mesh);
    return render::frame_of(surface.positions, surface.triangles, view, width, height, fill);
}

bool has_own_frames(const FigureRequest& request) { return request.layout == Layout::multiples || request.states > 1; }

/// Gives views of one mesh, or of all meshes in one frame, the smallest of their scales, if panels have views of their own.
void share_scales(const FigureRequest& request, std::vector<PictureFrame>& frames) {
    const auto has_view = [](const Panel& panel) { return !panel.view.empty(); };
    if (std::ranges::none_of(request.panels, has_view)) return;
    std::map<const TriangleMesh*, double> scales;
    const auto scale_of = [&](std::size_t p) -> double& {
        return scales.try_emplace(has_own_frames(request) ? request.panels[p].mesh.get() : nullptr, frames[p].frame.pixels_per_unit)
            .first->second;
    };
    for (std::size_t p = 0; p < frames.size(); ++p) scale_of(p) = std::min(scale_of(p), frames[p].frame.pixels_per_unit);
    for (std::size_t p = 0; p < frames.size(); ++p) frames[p].frame.pixels_per_unit = scale_of(p);
}

/// Returns the mesh that frames a panel: the first of its group.
const TriangleMesh& first_state(const FigureRequest& request, std::size_t panel) {
    return *request.panels[first_of_group(request, panel)].mesh;
}

}   // namespace

render::View hero_of(const FigureRequest& request, std::size_t panel) {
    const render::Sight& sight = request.sight;
    const std::string& name = request.panels[panel].view;
    if (sight.camera && (name.empty() || name == "camera")) return render::view_of(sight, {});
    if (!name.empty() && name != "hero") return render::view_named(name, sight.up.value_or(render::Up::y));
    const bool own = has_own_frames(request), is_matrix = !request.columns.empty() || !request.rows.empty();
    std::size_t group = request.panels.size();
    if (own && request.states > 1) group = static_cast<std::size_t>(request.states);
    else if (own && (is_matrix || is_gallery(request))) group = is_matrix ? static_cast<std::size_t>(panels_in_a_line(request)) : 1;
    const std::size_t first = panel - panel % group;
    for (std::size_t p = first; p < std::min(first + group, request.panels.size()); ++p)
        if (request.panels[p].mesh && (own || is_framed(request, p)))
            return render::hero_view(surface_of(*request.panels[p].mesh), sight.up);
    return render::view_named("hero", sight.up.value_or(render::Up::y));
}

std::vector<PictureFrame> three_quarter_frames(const FigureRequest& request, int side) {
    const bool own = has_own_frames(request);
    const double fill = share_framed * request.sight.zoom;
    std::vector<PictureFrame> frames(request.panels.size());
    for (std::size_t p = 0; p < frames.size(); ++p) {
        if (!request.panels[p].mesh) continue;
        PictureFrame& frame = frames[p];
        frame.view = own || p == 0 || !request.panels[p].view.empty() ? hero_of(request, p) : frames[0].view;
        frame.frame = own                                     ? own_frame(first_state(request, p), frame.view, side, side, fill)
                      : p > 0 && frame.view == frames[0].view ? frames[0].frame
                                                              : common_frame(request, frame.view, side, side, fill);
    }
    share_scales(request, frames);
    std::optional<render::Bounds> box;
    for (std::size_t p = 0; p < frames.size(); ++p)
        if (request.panels[p].mesh) box = united(box, within_square(seen(*request.panels[p].mesh, frames[p].view, frames[p].frame), side));
    const render::Bounds shown = box.value_or(render::Bounds{});
    const glm::dvec3 extent = shown.high - shown.low, middle = 0.5 * (shown.low + shown.high);
    for (PictureFrame& frame : frames) {
        frame.frame.centre += (middle.x * frame.view.right() + middle.y * frame.view.up) / frame.frame.pixels_per_unit;
        frame.width = picture_length(extent.x / std::min(1.0, request.sight.zoom), side);
        frame.height = picture_length(extent.y / std::min(1.0, request.sight.zoom), side);
    }
    return frames;
}

std::optional<render::View> view_of_flat(const TriangleMesh& mesh, const render::Sight& sight) {
    constexpr double thin = 0.05;   // of the largest extent: more than noise
    const render::Bounds box = bounds_of(mesh);
    const glm::dvec3 extent = box.high - box.low;
    const double most = std::max({extent.x, extent.y, extent.z});
    const auto is_thin = [&](int axis) { return extent[axis] <= thin * most; };
    if (is_thin(0) + is_thin(1) + is_thin(2) != 1) return {};
    const int axis = is_thin(0) ? 0 : is_thin(1) ? 1 : 2;
    const bool faces_back = face_normals(mesh).col(axis).sum() < 0;
    const render::View& front = render::six_views[static_cast<std::size_t>(2 * axis + (faces_back ? 1 : 0))];
    return render::view_named(std::string(front.name), sight.up.value_or(render::Up::y));
}

FittedPositions fitted_into_frame(const TriangleMesh& mesh, const Positions& X) {
    const render::View view = render::hero_view(surface_of(mesh));
    const render::Frame frame = own_frame(mesh, view, 1, 1, share_framed);   // a picture one pixel wide
    const render::Bounds box = seen(moved_to(mesh, X), view, frame);
    const glm::dvec3 reach = glm::max(glm::abs(box.low), glm::abs(box.high));
    const double farthest = std::max(reach.x, reach.y);
    if (farthest <= 0.5) return {X, 1};
    const double scale = 0.5 * share_framed / farthest;
    const Eigen::RowVector3d middle(frame.centre.x, frame.centre.y, frame.centre.z);
    return {(scale * (X.rowwise() - middle)).rowwise() + middle, scale};
}

PictureFrame SixFrames::covering_all() const {
    PictureFrame all{frame, 0, 0};
    for (const PictureFrame& one : sizes) {
        all.width = std::max(all.width, one.width);
        all.height = std::max(all.height, one.height);
    }
    return all;
}

SixFrames six_frames(const FigureRequest& request, std::size_t panel, int side) {
    SixFrames six;
    six.frame = render::frame_of(joined_box(request, [&](std::size_t p) { return is_framed(request, p, panel); }), side, side,
                                 share_framed * request.sight.zoom);
    const render::Bounds all = joined_box(
        request, [&](std::size_t p) { return request.states == 1 || first_of_group(request, p) == first_of_group(request, panel); });
    const double scale = six.frame.pixels_per_unit;
    const render::Bounds shown = within_square({(all.low - six.frame.centre) * scale, (all.high - six.frame.centre) * scale}, side);
    six.frame.centre += 0.5 * (shown.low + shown.high) / scale;
    const glm::dvec3 extent = (shown.high - shown.low) / std::min(1.0, request.sight.zoom);
    for (const render::View& view : views_in_reading_order(request.sight)) {
        const glm::dvec3 right = glm::abs(view.right()), up = glm::abs(view.up);
        six.sizes.push_back({six.frame, picture_length(glm::dot(extent, right), side), picture_length(glm::dot(extent, up), side), view});
    }
    return six;
}

render::Frame full_frame(const FigureRequest& request, std::size_t panel, const render::View* hero, int width, int height) {
    const double fill = render::DrawOptions{}.fill * request.sight.zoom;
    if (hero == nullptr)
        return render::frame_of(joined_box(request, [&](std::size_t p) { return is_framed(request, p, panel); }), width, height, fill);
    if (has_own_frames(request)) return own_frame(first_state(request, panel), *hero, width, height, fill);
    return common_frame(request, *hero, width, height, fill);
}

}   // namespace meshfolio::output
