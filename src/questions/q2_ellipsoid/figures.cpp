#include "geometry/curvature/analytic_surfaces.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/q2_ellipsoid/parts.h"

namespace meshfolio::q2_ellipsoid {

void add_ellipsoid_figure(Answer& answer, const Ellipsoid& ellipsoid, bool quick, const std::string& colormap) {
    const auto curvature = [axes = axes_of(ellipsoid)](const Vector3& p) { return ellipsoid_curvature(axes, p).H; };
    TriangleMesh mesh = ellipsoid_mesh(quick ? 4 : 5, axes_of(ellipsoid));
    Vector H(mesh.vertex_count());
    for (int i = 0; i < mesh.vertex_count(); ++i) H[i] = curvature(mesh.X.row(i));
    output::FigureRequest figure{.id = "q2_ellipsoid_h",
                                 .title = words.line("ellipsoid.title"),
                                 .subtitle = axes_text(ellipsoid),
                                 .panels = {panel_of(std::move(mesh), "q2_ellipsoid_h", "H", H)}};
    figure.range = output::robust_range(figure.panels, colormap, "mean curvature H", "1/length", 0.01, 0);
    add_figure(answer, std::move(figure),
               words.line("ellipsoid.caption", "axes"_a = axes_text(ellipsoid), "tip"_a = readable(curvature({ellipsoid.a, 0, 0})),
                          "pole"_a = readable(curvature({0, 0, ellipsoid.c}))));
}

}   // namespace meshfolio::q2_ellipsoid
