// The steps to a picture:
//   scene          centres, scales and rounds the vertices to the sample grid, once for all views;
//   projection     lets opposite views, which see mirrored pictures, share all work up to the triangle that each sample sees;
//   tile_lists     sorts the triangles into tiles of 64 × 64 pixels, for all projections in one pass;
//   rasterizer     finds the highest and the lowest triangle at every sample of a tile;
//   fragments      lists each triangle that a pixel sees once;
//   shading        colours the fragments;
//   view_picture   averages them over pixels in linear light and, with occlusion, darkens the hollows.
// Tiles are independent and triangles keep their order, so that any number of threads gives the same bytes.
#include "draw_mesh.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "raster/rasterizer.h"
#include "raster/tile_lists.h"
#include "rounding.h"
#include "scene/camera.h"
#include "scene/outline.h"
#include "scene/scene.h"
#include "scene/view_picture.h"
#include "shading/shading_style.h"
#include "sheet/strokes.h"

namespace render {

namespace {

/// Returns the options with those completed that depend on others. @throws std::invalid_argument as draw_views()
DrawOptions completed(const Surface& surface, DrawOptions options) {
    if (options.width < 1 || options.height < 1 || options.width > 16384 || options.height > 16384)
        throw std::invalid_argument("draw_views: a picture has 1 to 16384 pixels on a side, not " + std::to_string(options.width) + "x" +
                                    std::to_string(options.height));
    const std::array possible{0, 1, 4, 16};
    if (std::ranges::find(possible, options.samples) == possible.end())
        throw std::invalid_argument("draw_views: samples must be 1, 4 or 16 (or 0, to choose), not " + std::to_string(options.samples));
    if (!surface.values.empty() && surface.values.size() != surface.positions.size())
        throw std::invalid_argument("draw_views: " + std::to_string(surface.values.size()) + " values for " +
                                    std::to_string(surface.positions.size()) + " vertices; give one a vertex");
    if (options.range.colormap == nullptr) options.range.colormap = &colormap_named("viridis");
    if (options.face_colors_from_id) options.samples = 1, options.shading = false;   // numbers cannot be averaged
    options.occlusion = options.occlusion && options.shading;
    return options;
}

/// The buffers in which a thread draws tiles.
struct Workplace {
    Workplace(const SamplePattern& pattern, WideBudget& budget) : tile(pattern, &budget) {}

    SampleTile tile;
    std::vector<std::int32_t> triangles;
    Fragments fragments;
};

/// Draws the views of one projection.
class ProjectionPainter {
public:
    ProjectionPainter(const ProjectedScene& scene, std::span<const BoundaryEdge> boundary, const DrawOptions& options,
                      const Palette& palette, std::span<const std::unique_ptr<ViewPicture>> pictures)
        : scene_(scene), pictures_(pictures) {
        const double width = std::max(1.5, std::min(options.width, options.height) / 320.0);   // visible even if the picture is shrunk
        ribbons_ = edge_on_ribbons(scene, boundary, width);
        for (const auto& picture : pictures) styles_.emplace_back(scene.scene, options, palette, picture->placement());
    }

    void paint(const TileLists& lists, std::size_t projection, int tile, Workplace& place) const {
        lists.collect(projection, tile, place.triangles);
        const int left = tile % lists.columns() * tile_side, top = tile / lists.columns() * tile_side;
        if (place.triangles.empty() && ribbons_.empty()) {
            for (const auto& picture : pictures_) picture->leave_empty(left, top, tile_side);
            return;
        }
        place.tile.start(left, top);
        rasterize(scene_, place.triangles, place.tile);
        for (std::size_t i = 0; i < ribbons_.size(); ++i)
            rasterize_wide(ribbons_[i].screen, scene_.scene.triangle_count() + static_cast<std::int32_t>(i), place.tile);
        for (std::size_t v = 0; v < pictures_.size(); ++v)
            for (int row = 0; row < place.tile.blocks_on_side(); ++row) {
                collect_fragments(place.tile, row, scene_.scene.width, scene_.scene.height, pictures_[v]->placement().from_below,
                                  place.fragments);
                if (place.fragments.count == 0) {
                    const int rows = tile_side / place.tile.blocks_on_side();
                    pictures_[v]->leave_empty(left, top + row * rows, rows);
                    continue;
                }
                shade(scene_, ribbons_, styles_[v], place.fragments);
                pictures_[v]->add(place.tile, row, place.fragments);
            }
    }

private:
    const ProjectedScene& scene_;
    std::vector<Ribbon> ribbons_;
    std::vector<ShadingStyle> styles_;
    std::span<const std::unique_ptr<ViewPicture>> pictures_;
};

/// Returns empty pictures for the views of a projection. If they need buffers, they reuse those of the projection drawn before.
std::vector<std::unique_ptr<ViewPicture>> empty_pictures(const Projection& projection, const DrawOptions& options, bool has_values,
                                                         std::vector<std::unique_ptr<ViewBuffers>>& buffers) {
    const bool with_buffers = options.occlusion || !options.marked_vertices.empty();
    std::vector<std::unique_ptr<ViewPicture>> pictures(projection.placements.size());
    buffers.resize(std::max(buffers.size(), pictures.size()));
    for (auto& some : buffers)   // by this thread, which can reuse the memory that it frees
        if (with_buffers && !some) some = std::make_unique<ViewBuffers>(options);
    tbb::parallel_for(std::size_t{0}, pictures.size(), [&](std::size_t i) {
        pictures[i] = std::make_unique<ViewPicture>(options, projection.placements[i], has_values, buffers[i].get());
    });
    return pictures;
}

/// Draws a ring around each of the vertices that the view sees; ignores numbers out of range. `picture` must have heights if there are any.
void draw_marks(const ProjectedScene& projected, std::span<const int> vertices, ViewPicture& picture) {
    constexpr Rgba black{0, 0, 0, 255}, white{255, 255, 255, 255};   // no colour map has black
    Image& image = picture.image();
    const Placement& placement = picture.placement();
    const double radius = std::max(5.0, std::min(image.width, image.height) / 36.0), width = std::max(1.5, radius / 3);
    for (const int v : vertices) {
        if (v < 0 || index(v) >= projected.scene.vertices.size() || projected.scene.vertices[index(v)].at[0] <= GridVertex::far_off)
            continue;
        const ScreenPoint corner = projected.exact_corner(v);
        glm::dvec2 at(static_cast<double>(corner.x) / subpixels, static_cast<double>(corner.y) / subpixels);   // pixels
        if (placement.mirrored_x) at.x = image.width - at.x;
        if (placement.mirrored_y) at.y = image.height - at.y;
        const int column = static_cast<int>(std::floor(at.x)), row = static_cast<int>(std::floor(at.y));
        if (!(at.x >= 0 && at.y >= 0) || column >= image.width || row >= image.height) continue;
        float lowest = std::numeric_limits<float>::infinity();   // of the surfaces seen around the vertex
        for (int y = row - 1; y <= row + 1; ++y)
            for (int x = column - 1; x <= column + 1; ++x)
                if (const float height = picture.heights().at(x, y); height > HeightField::nothing) lowest = std::min(lowest, height);
        const bool is_hidden = !((placement.from_below ? -corner.depth : corner.depth) / subpixels >= double(lowest) - 1);
        if (is_hidden) continue;
        draw_ring(image, at, radius, 2.2 * width, white);
        draw_ring(image, at, radius, width, black);
    }
}

/// Returns a picture of each view, all on one frame. @param default_samples  per pixel, if options.samples is 0
std::vector<Image> draw_framed(const Surface& surface, std::span<const View> views, const Frame& frame, DrawOptions options,
                               int default_samples) {
    if (options.samples == 0) options.samples = default_samples;
    if (surface.positions.empty() || surface.triangles.empty())
        return std::vector<Image>(views.size(), Image(options.width, options.height, options.background));
    const Scene scene(surface, frame, options);
    const std::vector<BoundaryEdge> boundary = options.shading ? boundary_edges(surface) : std::vector<BoundaryEdge>{};
    const Palette palette(options);
    const std::vector<Projection> projections = projections_of(views);
    std::vector<ProjectedScene> scenes;
    for (const Projection& projection : projections) scenes.emplace_back(scene, projection.axes);
    const SamplePattern& pattern = pattern_of(options.samples);
    WideBudget budget(std::int64_t{options.width} * options.height / (std::int64_t{pattern.block_side} * pattern.block_side));
    const TileLists lists(scenes, pattern, budget);

    tbb::enumerable_thread_specific<Workplace> places([&] { return Workplace(pattern, budget); });
    const int room_width = options.occlusion ? options.width : 0, room_height = options.occlusion ? options.height : 0;
    FinishingRoom room{HeightField(room_width, room_height), ByteField(room_width, room_height), ByteField(room_width, room_height)};
    std::vector<std::unique_ptr<ViewBuffers>> buffers;
    std::vector<Image> images(views.size());
    for (std::size_t p = 0; p < projections.size(); ++p) {   // in succession, because views with heights need much memory
        const auto pictures = empty_pictures(projections[p], options, !surface.values.empty(), buffers);
        const ProjectionPainter painter(scenes[p], boundary, options, palette, pictures);
        tbb::parallel_for(0, lists.columns() * lists.rows(), [&](int tile) { painter.paint(lists, p, tile, places.local()); });
        for (const auto& picture : pictures) {
            picture->finish(room);
            draw_marks(scenes[p], options.marked_vertices, *picture);
            images[picture->placement().view] = std::move(picture->image());
        }
    }
    return images;
}

}   // namespace

double ValueRange::position(double value) const {
    if (logarithmic) return std::log(std::max(value, low) / low) / std::log(high / low);
    return (0.5 * value - 0.5 * low) / (0.5 * high - 0.5 * low);   // halves: the width may overflow
}

Frame frame_of(const Surface& surface, const View& view, const DrawOptions& options) {
    if (options.frame) return *options.frame;
    if (view.is_along_axis()) return frame_of(bounds_of(surface.positions, surface.triangles), options.width, options.height, options.fill);
    return frame_of(surface.positions, surface.triangles, view, options.width, options.height, options.fill);
}

std::vector<Image> draw_views(const Surface& surface, std::span<const View> views, const DrawOptions& wanted) {
    const DrawOptions options = completed(surface, wanted);
    std::vector<View> along_axes;
    for (const View& view : views)
        if (view.is_along_axis()) along_axes.push_back(view);
    std::vector<Image> images;
    if (!along_axes.empty()) images = draw_framed(surface, along_axes, frame_of(surface, along_axes.front(), options), options, 4);
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (views[i].is_along_axis()) continue;
        const Frame own = frame_of(surface, views[i], options);
        images.insert(images.begin() + static_cast<std::ptrdiff_t>(i), draw_framed(surface, views.subspan(i, 1), own, options, 16).front());
    }
    return images;
}

}   // namespace render
