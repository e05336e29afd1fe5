/// @file
/// A view while it is drawn: it takes fragments, tile by tile, and gives a picture.
#pragma once

#include <span>
#include <vector>

#include "draw_mesh.h"
#include "raster/fragments.h"
#include "raster/resolve.h"
#include "rounding.h"
#include "scene/camera.h"
#include "scene/occlusion.h"

namespace render {

/// Large buffers of a view with occlusion or marks, which the next view takes over.
struct ViewBuffers {
    HeightField heights;
    LargeArray<Layer> layers;   // with occlusion, one a pixel, valid where `shown` says so
    std::vector<char> shown;    // row by row, for each tile that the row crosses

    ViewBuffers(const DrawOptions& options);
};

/// Working space in which views are finished one after the other; its contents before do not matter.
struct FinishingRoom {
    HeightField openness;
    ByteField coverage, creases;
};

class ViewPicture {
public:
    /// @param buffers  null if neither occlusion nor heights are wanted
    ViewPicture(const DrawOptions& options, const Placement& placement, bool has_values, ViewBuffers* buffers);

    /// Averages the shaded fragments of a row of blocks over their pixels. Several threads may add different tiles at once.
    void add(const SampleTile& tile, int block_row, const Fragments& fragments);

    /// Notes that rows of a tile show nothing. Each row of each tile must be added or left empty, because the buffers hold an earlier view.
    void leave_empty(int left, int top, int rows);

    /// Darkens occluded parts and draws silhouettes and creases, if the options ask for occlusion.
    void finish(FinishingRoom& room);

    const Placement& placement() const { return placement_; }
    const HeightField& heights() const { return buffers_->heights; }
    Image& image() { return image_; }

private:
    int row(int y) const { return placement_.mirrored_y ? image_.height - 1 - y : y; }
    /// Returns the first column in the picture of `count` columns of the projection from x on.
    int column(int x, int count) const { return placement_.mirrored_x ? image_.width - x - count : x; }
    std::span<Layer> layers(int x, int y, int count) {
        return std::span(buffers_->layers).subspan(index(y) * index(image_.width) + index(x), index(count));
    }
    /// Returns the flag of row y of the picture in the tile at column x of the projection: 1 if it shows something.
    char& shown(int x, int y) { return buffers_->shown[index(y * ((image_.width - 1) / tile_side + 1) + x / tile_side)]; }
    /// Calls visit(x, y, layers) in parallel for the stretches of rows that show something.
    template <class Visit> void for_each_stretch(const Visit& visit);

    bool with_occlusion_;
    float occlusion_strength_;
    Placement placement_;
    Rgba background_;
    Image image_;
    ViewBuffers* buffers_;
};

}   // namespace render
