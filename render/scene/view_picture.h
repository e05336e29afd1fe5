/// @file
/// One view while it is being drawn: fragments come in, tile by tile; a picture goes out.
#pragma once

#include <span>
#include <vector>

#include "draw_mesh.h"
#include "raster/fragments.h"
#include "raster/resolve.h"
#include "scene/camera.h"
#include "scene/occlusion.h"

namespace render {

/// What a view needs besides its picture, with occlusion or marks: large, so the next view takes it over.
struct ViewBuffers {
    HeightField heights;
    LargeArray<Layer> layers;   // one a pixel, with occlusion, where `shown` says so
    std::vector<char> shown;    // row by row, of each tile that the row crosses

    ViewBuffers(const DrawOptions& options);
};

/// What views have room in to be finished, one after the other; whatever it holds counts for nothing.
struct FinishingRoom {
    HeightField openness;
    ByteField coverage, creases;
};

class ViewPicture {
public:
    /// @param buffers  nullptr where neither occlusion nor heights are wanted
    ViewPicture(const DrawOptions& options, const Placement& placement, bool has_values, ViewBuffers* buffers);

    /// Averages the shaded fragments of a row of blocks over their pixels. Tiles are independent: threads may add them at once.
    void add(const SampleTile& tile, int block_row, const Fragments& fragments);

    /// Rows of a tile show nothing. Every row of every tile is either added or left empty: what the buffers hold of another view goes.
    void leave_empty(int left, int top, int rows);

    /// Darkens what is occluded and draws silhouettes and creases, where that is wanted.
    void finish(FinishingRoom& room);

    const Placement& placement() const { return placement_; }
    const HeightField& heights() const { return buffers_->heights; }
    Image& image() { return image_; }

private:
    int row(int y) const { return placement_.mirrored_y ? image_.height - 1 - y : y; }
    /// Column of the picture where `count` columns from x on begin.
    int column(int x, int count) const { return placement_.mirrored_x ? image_.width - x - count : x; }
    std::span<Layer> layers(int x, int y, int count) {
        return std::span(buffers_->layers)
            .subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x),
                     static_cast<std::size_t>(count));
    }
    /// Of a row of the picture that crosses the tile at x.
    char& shown(int x, int y) {
        return buffers_->shown[static_cast<std::size_t>(y * ((image_.width - 1) / tile_side + 1) + x / tile_side)];
    }
    /// Calls visit(x, y, layers) for stretches of rows that show something, in parallel.
    template <class Visit>
    void for_each_stretch(const Visit& visit);
    template <class T>
    void mirror(std::span<T> row_of_tile) const;
    void set_heights(const SampleTile& tile, int block_row);

    bool with_occlusion_;
    float occlusion_strength_;
    Placement placement_;
    Rgba background_;
    Image image_;
    ViewBuffers* buffers_;
};

}   // namespace render
