#include "scene/view_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "rounding.h"

namespace render {

ViewBuffers::ViewBuffers(const DrawOptions& options) : heights(options.width, options.height) {
    if (!options.occlusion) return;
    layers.resize(index(options.width) * index(options.height));
    shown.resize(index(((options.width - 1) / tile_side + 1) * options.height));
}

ViewPicture::ViewPicture(const DrawOptions& options, const Placement& placement, bool has_values, ViewBuffers* buffers)
    : with_occlusion_(options.occlusion),
      occlusion_strength_(has_values ? 0.035F : 0.9F),   // little on values, whose colours must match the colour bar
      placement_(placement),
      background_(options.background),
      image_(options.width, options.height, options.background),
      buffers_(buffers) {}

void ViewPicture::add(const SampleTile& tile, int block_row, const Fragments& fragments) {
    const int rows = tile.pattern().block_side, top = tile.y() + block_row * rows;
    std::array<LinearColor, std::size_t{tile_side} * 4> colors{};
    for (std::size_t i = 0; i < fragments.count; ++i) {
        const float w = fragments.weight[i];
        colors[index(fragments.pixel[i])] += {w * fragments.red[i], w * fragments.green[i], w * fragments.blue[i], w};
    }
    std::array<float, std::size_t{tile_side} * 4> heights;
    if (buffers_ != nullptr) collect_heights(tile, block_row, placement_.from_below, heights);
    const int last_row = std::min(rows, image_.height - top), columns = std::min(tile_side, image_.width - tile.x());
    const int left = column(tile.x(), columns);
    for (int y = 0; y < last_row; ++y) {
        const auto in_picture = [&](auto& values) {
            const std::span in_row = std::span(values).subspan(index(y * tile_side), index(columns));
            if (placement_.mirrored_x) std::ranges::reverse(in_row);
            return in_row;
        };
        const std::span row_colors = in_picture(colors);
        if (with_occlusion_) shown(tile.x(), row(top + y)) = 1, pack(row_colors, layers(left, row(top + y), columns));
        else resolve(row_colors, background_, {&image_.at(left, row(top + y)), row_colors.size()});
        if (buffers_ != nullptr) buffers_->heights.set(left, row(top + y), in_picture(heights));
    }
}

void ViewPicture::leave_empty(int left, int top, int rows) {
    if (buffers_ == nullptr) return;
    const int columns = std::min(tile_side, image_.width - left);
    for (int y = top; y < std::min(top + rows, image_.height); ++y) {
        if (with_occlusion_) shown(left, row(y)) = 0;
        buffers_->heights.clear(column(left, columns), row(y), columns);
    }
}

void ViewPicture::finish(FinishingRoom& room) {
    if (!with_occlusion_) return;
    const Sky sky(buffers_->heights);
    room.coverage.clear(), room.creases.clear();
    for_each_stretch([&](int x, int y, std::span<const Layer> row_layers) {
        std::array<float, tile_side> open;
        const std::span row_open = std::span(open).first(row_layers.size());
        sky.openness(x, y, row_open);
        room.openness.set(x, y, row_open);
        find_creases(buffers_->heights, x, y, {room.creases.place(x, y), row_open.size()});
        std::transform(row_layers.begin(), row_layers.end(), room.coverage.place(x, y),
                       [](const Layer& layer) { return static_cast<std::uint8_t>(layer.coverage >> 8); });
    });
    for_each_stretch([&](int x, int y, std::span<const Layer> row_layers) {
        std::array<float, tile_side> light, lines;
        std::array<LinearColor, tile_side> colors;
        const std::span row_light = std::span(light).first(row_layers.size()), row_lines = std::span(lines).first(row_layers.size());
        const std::span row_colors = std::span(colors).first(row_layers.size());
        smooth(buffers_->heights, room.openness, x, y, row_light);
        draw_lines(room.coverage, room.creases, x, y, row_lines);
        for (std::size_t i = 0; i < row_light.size(); ++i) light[i] = (1 - occlusion_strength_ * (1 - light[i])) * (1 - lines[i]);
        unpack(row_layers, row_light, row_colors);
        resolve(row_colors, background_, {&image_.at(x, y), row_colors.size()});
    });
}

template <class Visit> void ViewPicture::for_each_stretch(const Visit& visit) {
    tbb::parallel_for(0, image_.height, [&](int y) {
        for (int x = 0; x < image_.width; x += tile_side) {
            const int count = std::min(tile_side, image_.width - x), left = column(x, count);
            if (shown(x, y) != 0) visit(left, y, layers(left, y, count));
        }
    });
}

}   // namespace render
