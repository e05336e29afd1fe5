/// @file
/// Frames and sizes of the pictures of a figure: at one scale, without empty margins.
#pragma once

#include <algorithm>
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

/// Returns the view of a panel that has its own, else from the camera of the figure, else from three quarters: render::hero_view() of the
/// first mesh in its group of states, in its row of a matrix of multiples, or in the figure (with one frame the first framed mesh), so that
/// compared meshes are seen from one side; in a gallery that of its own mesh.
render::View hero_of(const FigureRequest& request, std::size_t panel);

/// Returns a frame for each panel from three quarters, all of one size: centred on its own mesh (Layout::multiples) or the first of its
/// group of states, else shared by all. Meshes that are not framed are cut off at the square of `side` pixels that the framed ones fill.
std::vector<PictureFrame> three_quarter_frames(const FigureRequest& request, int side);

/// Frames of the six views along the axes: one frame for all panels or a group of states, and the sizes of the pictures.
struct SixFrames {
    render::Frame frame;
    std::vector<PictureFrame> sizes;   // in reading order
    /// Returns the frame with the smallest size that holds the pictures of all six views.
    PictureFrame covering_all() const;
    /// Returns the frame and size for one of the views.
    const PictureFrame& of(const render::View& view) const { return *std::ranges::find(sizes, view, &PictureFrame::view); }
};

/// Returns the frames of a panel; `side` is the length of the longest side of the pictures [pixels].
SixFrames six_frames(const FigureRequest& request, std::size_t panel, int side);

/// Returns the view along an axis that shows the front of a flat mesh, which is a line in other views; nothing if the mesh is not flat.
std::optional<render::View> view_of_flat(const TriangleMesh& mesh, const render::Sight& sight);

struct FittedPositions {
    Positions X;
    double scale = 1;
};
/// Returns other positions X of the mesh so that they fit into its own three-quarter picture: unchanged with scale 1, or scaled down about
/// the middle of the picture.
FittedPositions fitted_into_frame(const TriangleMesh& mesh, const Positions& X);

/// Returns the frame of a panel's view files of width × height pixels: that of all framed panels together, or the panel's own if it has
/// one.
/// @param hero  the three-quarter view; null: the views along the axes
render::Frame full_frame(const FigureRequest& request, std::size_t panel, const render::View* hero, int width, int height);

}   // namespace meshfolio::output
