/// @file
/// Frames and sizes of the pictures of a figure: all at one scale, without empty margins.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "output/draw/figure_request.h"
#include "scene/camera.h"

namespace meshfolio::output {

struct PictureFrame {
    render::Frame frame;
    int width = 0, height = 0;   // [pixels]
    render::View view = render::three_quarter_view();
};

/// The direction of a panel from three quarters: that of the first mesh of its states, of its row of a matrix, or of the figure, so that
/// what is compared is seen from one side; of its own mesh in a gallery.
render::View hero_of(const FigureRequest& request, std::size_t panel);

/// From three quarters, a frame a panel, all of one size: each mesh in the middle of its own (Layout::multiples), or all in one. What is
/// framed takes `side` pixels in width or in height; other meshes are cut off at that square.
std::vector<PictureFrame> three_quarter_frames(const FigureRequest& request, int side);

/// The six directions: one frame for all panels, or for those that show one mesh, and the sizes of the pictures along x, y and z.
struct SixFrames {
    render::Frame frame;
    std::array<PictureFrame, 3> along;
    PictureFrame covering_all() const;
    const PictureFrame& of(const render::View& view) const { return along[view.from.x != 0 ? 0 : view.from.y != 0 ? 1 : 2]; }
};
SixFrames six_frames(const FigureRequest& request, std::size_t panel, int side);

/// The view along an axis that shows the front of a flat mesh, which is a line in the others; nothing if the mesh is not flat.
std::optional<render::View> view_of_flat(const TriangleMesh& mesh);

/// Positions that fit into the three-quarter picture of `mesh`: unchanged, or scaled down about the middle if they would be cut off.
struct FittedPositions {
    Positions X;
    double scale = 1;
};
FittedPositions fitted_into_frame(const TriangleMesh& mesh, const Positions& X);

/// The frame of a view file in full size: as in the other pictures, but not cropped. @param hero  the view from three quarters; null: along
/// axes
render::Frame full_frame(const FigureRequest& request, std::size_t panel, const render::View* hero, int width, int height);

}   // namespace meshfolio::output
