// How a picture is made:
//   scene          vertices are centred, scaled and rounded to the sample grid, once for all views;
//   projection     opposite views see the same picture plane, mirrored, one from above and one from below: they share all up to
//                  the triangle that each sample sees;
//   tile_lists     triangles are sorted into tiles of 64 × 64 pixels, for all projections in one pass;
//   rasterizer     in each tile the highest and the lowest triangle of every sample are found;
//   fragments      for every pixel each triangle that it sees, once;
//   shading        gives fragments their colour;
//   view_picture   averages them over pixels in linear light and, with occlusion, darkens the hollows.
// Tiles are independent and triangles keep their order, so any number of threads gives the same bytes.
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
#include "scene/camera.h"
#include "scene/outline.h"
#include "scene/scene.h"
#include "scene/view_picture.h"
#include "shading/shading_style.h"
#include "sheet/strokes.h"

namespace render {

namespace {

void check(const Surface& surface, const DrawOptions& options) {
    if (options.width < 1 || options.height < 1 || options.width > 16384 || options.height > 16384)
        throw std::invalid_argument("draw_views: a picture has 1 to 16384 pixels on a side, not " + std::to_string(options.width) + "x" +
                                    std::to_string(options.height));
    const std::array possible{0, 1, 4, 16};
    if (std::ranges::find(possible, options.samples) == possible.end())
        throw std::invalid_argument("draw_views: samples must be 1, 4 or 16");
    if (!surface.values.empty() && surface.values.size() != surface.positions.size())
        throw std::invalid_argument("draw_views: " + std::to_string(surface.values.size()) + " values for " +
                                    std::to_string(surface.positions.size()) + " vertices");
}

DrawOptions completed(const DrawOptions& wanted) {
    DrawOptions options = wanted;
    if (options.range.colormap == nullptr) options.range.colormap = &colormap_named("viridis");
    if (options.face_colors_from_id) options.samples = 1, options.shading = false;   // numbers cannot be averaged
    options.occlusion = options.occlusion && options.shading;
    return options;
}

DrawOptions sampled(DrawOptions options, int by_itself) {
    if (options.samples == 0) options.samples = by_itself;
    return options;
}

/// Wide enough to stay visible when the picture is shrunk into a sheet.
double ribbon_width(const DrawOptions& options) { return std::max(1.5, std::min(options.width, options.height) / 320.0); }

/// What a thread needs to draw a tile.
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
        : scene_(scene), ribbons_(edge_on_ribbons(scene, boundary, ribbon_width(options))), pictures_(pictures) {
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

std::vector<ProjectedScene> projected(const Scene& scene, std::span<const Projection> projections) {
    std::vector<ProjectedScene> result;
    for (const Projection& p : projections) result.emplace_back(scene, p.axes);
    return result;
}

/// Pictures for the views of one projection after another, which share their buffers.
class PictureMaker {
public:
    PictureMaker(const DrawOptions& options, bool has_values)
        : options_(options),
          has_values_(has_values),
          room_{HeightField(width(), height()), ByteField(width(), height()), ByteField(width(), height())} {}

    FinishingRoom& room() { return room_; }

    std::vector<std::unique_ptr<ViewPicture>> empty_pictures(const Projection& projection) {
        const bool with_buffers = options_.occlusion || !options_.marked_vertices.empty();
        std::vector<std::unique_ptr<ViewPicture>> pictures(projection.placements.size());
        buffers_.resize(std::max(buffers_.size(), pictures.size()));
        for (auto& buffers : buffers_)   // by this thread: what it frees it can use again
            if (with_buffers && !buffers) buffers = std::make_unique<ViewBuffers>(options_);
        tbb::parallel_for(std::size_t{0}, pictures.size(), [&](std::size_t i) {
            pictures[i] = std::make_unique<ViewPicture>(options_, projection.placements[i], has_values_, buffers_[i].get());
        });
        return pictures;
    }

private:
    int width() const { return options_.occlusion ? options_.width : 0; }
    int height() const { return options_.occlusion ? options_.height : 0; }

    const DrawOptions& options_;
    bool has_values_;
    std::vector<std::unique_ptr<ViewBuffers>> buffers_;
    FinishingRoom room_;
};

constexpr Rgba mark_color{0, 0, 0, 255}, mark_rim{255, 255, 255, 255};   // black: no colour map has it

/// Where the vertex lies in the picture, in pixels, and its height towards the viewer.
struct Place {
    glm::dvec2 at;
    double height;
};

Place place_of(const ScreenPoint& corner, const ViewPicture& picture, const Image& image) {
    const Placement& placement = picture.placement();
    const double x = static_cast<double>(corner.x) / subpixels, y = static_cast<double>(corner.y) / subpixels;
    return {{placement.mirrored_x ? image.width - x : x, placement.mirrored_y ? image.height - y : y},
            (placement.from_below ? -corner.depth : corner.depth) / subpixels};
}

/// Nothing stands over the vertex: it is no lower, up to a pixel, than the lowest surface seen round it.
bool is_seen(const Place& place, const HeightField& heights) {
    const int x = static_cast<int>(std::floor(place.at.x)), y = static_cast<int>(std::floor(place.at.y));
    if (!(place.at.x >= 0 && place.at.y >= 0) || x >= heights.width() || y >= heights.height()) return false;
    float lowest = std::numeric_limits<float>::infinity();
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u)
            if (const float height = heights.at(u, v); height > HeightField::nothing) lowest = std::min(lowest, height);
    return place.height >= double(lowest) - 1;
}

/// Rings those of the vertices that the view sees; numbers out of range are passed over. `picture` must have heights if there are any.
void draw_marks(const ProjectedScene& projected, std::span<const int> vertices, ViewPicture& picture) {
    Image& image = picture.image();
    const double radius = std::max(5.0, std::min(image.width, image.height) / 36.0), width = std::max(1.5, radius / 3);
    for (const int v : vertices) {
        if (v < 0 || static_cast<std::size_t>(v) >= projected.scene.vertices.size()) continue;
        if (projected.scene.vertices[static_cast<std::size_t>(v)].at[0] <= GridVertex::far_off) continue;
        const Place place = place_of(projected.exact_corner(v), picture, image);
        if (!is_seen(place, picture.heights())) continue;
        draw_ring(image, place.at, radius, 2.2 * width, mark_rim);
        draw_ring(image, place.at, radius, width, mark_color);
    }
}

/// All views on one frame.
std::vector<Image> draw_framed(const Surface& surface, std::span<const View> views, const Frame& frame, const DrawOptions& options) {
    if (views.empty()) return {};
    if (surface.positions.empty() || surface.triangles.empty())
        return std::vector<Image>(views.size(), Image(options.width, options.height, options.background));
    const Scene scene(surface, frame, options);
    const std::vector<BoundaryEdge> boundary = options.shading ? boundary_edges(surface) : std::vector<BoundaryEdge>{};
    const Palette palette(options);
    const std::vector<Projection> projections = projections_of(views);
    const std::vector<ProjectedScene> scenes = projected(scene, projections);
    const SamplePattern& pattern = pattern_of(options.samples);
    WideBudget budget(std::int64_t{options.width} * options.height / (std::int64_t{pattern.block_side} * pattern.block_side));
    const TileLists lists(scenes, pattern, budget);

    tbb::enumerable_thread_specific<Workplace> places([&] { return Workplace(pattern, budget); });
    PictureMaker maker(options, !surface.values.empty());
    std::vector<Image> images(views.size());
    for (std::size_t p = 0; p < projections.size(); ++p) {   // one after the other: views with heights need much memory
        const auto pictures = maker.empty_pictures(projections[p]);
        const ProjectionPainter painter(scenes[p], boundary, options, palette, pictures);
        tbb::parallel_for(0, lists.columns() * lists.rows(), [&](int tile) { painter.paint(lists, p, tile, places.local()); });
        for (const auto& picture : pictures) {
            picture->finish(maker.room());
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

std::vector<Image> draw_views(const Surface& surface, std::span<const View> views, const DrawOptions& wanted) {
    check(surface, wanted);
    const DrawOptions options = completed(wanted);
    std::vector<View> along_axes;
    for (const View& view : views)
        if (view.is_along_axis()) along_axes.push_back(view);
    std::vector<Image> images;
    if (!along_axes.empty()) {
        const Frame shared = options.frame
                                 ? *options.frame
                                 : frame_of(bounds_of(surface.positions, surface.triangles), options.width, options.height, options.fill);
        images = draw_framed(surface, along_axes, shared, sampled(options, 4));
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (views[i].is_along_axis()) continue;
        const Frame own = options.frame
                              ? *options.frame
                              : frame_of(surface.positions, surface.triangles, views[i], options.width, options.height, options.fill);
        images.insert(images.begin() + static_cast<std::ptrdiff_t>(i),
                      draw_framed(surface, views.subspan(i, 1), own, sampled(options, 16)).front());
    }
    return images;
}

}   // namespace render
