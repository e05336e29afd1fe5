// How a picture is made: the corners are projected and snapped once a view; the picture is cut into bands of rows; in each band
// first the nearest triangle of every sample is found (rasterizer), then every visible triangle is shaded once a pixel (shading),
// at the middle of the samples it has there, which by convexity lies in it. Bands are independent, so any number of threads
// gives the same bytes.
#include "draw_mesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "outline.h"
#include "rasterizer.h"
#include "scene.h"
#include "shading.h"

namespace render {

namespace {

constexpr int band_rows = 32;

void check(const Surface& surface, const DrawOptions& options) {
    if (options.width < 1 || options.height < 1 || options.width > 16384 || options.height > 16384)
        throw std::invalid_argument("draw_views: a picture has 1 to 16384 pixels on a side, not " + std::to_string(options.width) + "x" +
                                    std::to_string(options.height));
    if (options.samples != 1 && options.samples != 4) throw std::invalid_argument("draw_views: samples must be 1 or 4");
    if (!surface.values.empty() && surface.values.size() != surface.positions.size())
        throw std::invalid_argument("draw_views: " + std::to_string(surface.values.size()) + " values for " +
                                    std::to_string(surface.positions.size()) + " vertices");
}

/// For each band of rows the triangles that may cover a sample in it, ascending.
struct Bands {
    std::vector<std::size_t> start;
    std::vector<std::int32_t> triangles;

    std::span<const std::int32_t> of(int band) const {
        const auto b = static_cast<std::size_t>(band);
        return std::span(triangles).subspan(start[b], start[b + 1] - start[b]);
    }
};

/// First and last band; none when first > last.
struct BandRange {
    std::int16_t first = 1, last = 0;
};

/// The bands that the bounding box of `t` meets; none when it lies beside the picture or a corner is too far off to be drawn.
BandRange bands_of(const Triangle2& t, int width, int height) {
    const ScreenPoint &a = t.corner[0], &b = t.corner[1], &c = t.corner[2];
    const std::int64_t x0 = std::min(a.x, std::min(b.x, c.x)), x1 = std::max(a.x, std::max(b.x, c.x));
    const std::int64_t y0 = std::min(a.y, std::min(b.y, c.y)), y1 = std::max(a.y, std::max(b.y, c.y));
    if (x1 < 0 || y1 < 0 || x0 > width * subpixels || y0 > height * subpixels || std::max(x1, y1) > largest_coordinate) return {};
    const std::int64_t last = (height - 1) / band_rows, step = band_rows * subpixels;
    return {static_cast<std::int16_t>(std::max<std::int64_t>(0, y0) / step), static_cast<std::int16_t>(std::min(last, y1 / step))};
}

bool has_known_corners(const glm::ivec3& t, std::size_t vertices) {
    return t.x >= 0 && t.y >= 0 && t.z >= 0 && static_cast<std::size_t>(std::max(t.x, std::max(t.y, t.z))) < vertices;
}

std::vector<BandRange> band_ranges(const Picture& picture) {
    std::vector<BandRange> ranges(static_cast<std::size_t>(picture.triangle_count()) + picture.ribbons.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const auto id = static_cast<std::int32_t>(i);
        if (picture.is_ribbon(id) || has_known_corners(picture.scene.triangle(id), picture.points.size()))
            ranges[i] = bands_of(picture.on_screen(id), picture.options.width, picture.options.height);
    }
    return ranges;
}

/// Counting sort by band.
Bands sorted_into_bands(const Picture& picture) {
    const std::vector<BandRange> ranges = band_ranges(picture);
    Bands bands;
    bands.start.assign(static_cast<std::size_t>((picture.options.height - 1) / band_rows) + 3, 0);
    for (const BandRange& r : ranges)
        for (int b = r.first; b <= r.last; ++b) ++bands.start[static_cast<std::size_t>(b) + 2];
    for (std::size_t b = 2; b < bands.start.size(); ++b) bands.start[b] += bands.start[b - 1];
    bands.triangles.resize(bands.start.back());
    for (std::size_t i = 0; i < ranges.size(); ++i)
        for (int b = ranges[i].first; b <= ranges[i].last; ++b)
            bands.triangles[bands.start[static_cast<std::size_t>(b) + 1]++] = static_cast<std::int32_t>(i);
    return bands;
}

/// All samples see the same triangle, or all of them nothing.
bool sees_one(std::span<const Visible> seen) {
    return std::all_of(seen.begin() + 1, seen.end(), [&](const Visible& v) { return v.triangle == seen[0].triangle; });
}

/// The mean over the samples of pixel (x, y), in linear light.
LinearColor resolved(std::span<const Visible> seen, std::span<const SampleOffset> offsets, glm::dvec2 pixel, Shader& shader,
                     const LinearColor& background) {
    const glm::dvec2 corner = double(subpixels) * pixel;
    if (sees_one(seen)) return shader.color(seen[0].triangle, corner + 0.5 * double(subpixels));
    LinearColor sum;
    std::uint32_t done = 0;
    for (std::size_t s = 0; s < seen.size(); ++s) {
        if ((done >> s & 1) != 0) continue;
        const std::int32_t id = seen[s].triangle;
        int count = 0;
        glm::dvec2 middle(0);
        for (std::size_t other = s; other < seen.size(); ++other) {
            if (seen[other].triangle != id) continue;
            done |= 1U << other;
            ++count;
            middle += glm::dvec2(offsets[other].x, offsets[other].y);
        }
        const glm::dvec2 at = corner + middle / double(count);
        sum += static_cast<float>(count) * (id == Visible::nothing ? background : shader.color(id, at));
    }
    return (1 / static_cast<float>(seen.size())) * sum;
}

void draw_band(const Picture& picture, std::span<const std::int32_t> triangles, int first_row, Image& image) {
    if (triangles.empty()) return;
    SampleBand band(image.width, first_row, std::min(band_rows, image.height - first_row), picture.options.samples);
    for (const std::int32_t id : triangles) rasterize(picture.on_screen(id), id, band);
    Shader shader(picture);
    const LinearColor background = linear_of(picture.options.background);
    for (int y = first_row; y < first_row + band.rows(); ++y)
        for (int x = 0; x < image.width; ++x)
            if (const auto seen = band.at(x, y); seen[0].triangle != Visible::nothing || !sees_one(seen))
                image.at(x, y) = srgb_of(resolved(seen, band.offsets(), {x, y}, shader, background));
}

/// Wide enough to stay visible when the picture is shrunk into a sheet.
double ribbon_width(const DrawOptions& options) { return std::max(1.5, std::min(options.width, options.height) / 320.0); }

Image draw_view(const Scene& scene, const Palette& palette, std::span<const BoundaryEdge> boundary, const View& view,
                const DrawOptions& options) {
    Picture picture{scene, view, options, palette, project(scene, view, options.width, options.height), {}};
    picture.ribbons = edge_on_ribbons(scene, boundary, view, picture.points, ribbon_width(options));
    const Bands bands = sorted_into_bands(picture);
    Image image(options.width, options.height, options.background);
    tbb::parallel_for(0, (options.height - 1) / band_rows + 1,
                      [&](int band) { draw_band(picture, bands.of(band), band * band_rows, image); });
    return image;
}

}   // namespace

std::vector<Image> draw_views(const Surface& surface, std::span<const View> views, const DrawOptions& wanted) {
    check(surface, wanted);
    DrawOptions options = wanted;
    if (options.range.colormap == nullptr) options.range.colormap = &colormap_named("viridis");
    if (options.face_colors_from_id) options.samples = 1;   // numbers cannot be averaged
    const Frame frame =
        options.frame.value_or(frame_of(bounds_of(surface.positions, surface.triangles), options.width, options.height, options.fill));
    const Scene scene = prepare(surface, frame, options.range);
    const Palette palette(options);
    const bool outlined = options.shading && !options.face_colors_from_id;
    const std::vector<BoundaryEdge> boundary = outlined ? boundary_edges(surface) : std::vector<BoundaryEdge>{};
    std::vector<Image> images(views.size());
    tbb::parallel_for(std::size_t{0}, views.size(),
                      [&](std::size_t i) { images[i] = draw_view(scene, palette, boundary, views[i], options); });
    return images;
}

}   // namespace render
