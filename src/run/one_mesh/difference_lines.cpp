#include "run/one_mesh/difference_lines.h"

#include <numbers>

#include "geometry/measures/mesh_error.h"

namespace meshfolio::run {

std::vector<DifferenceLine> difference_lines(const TriangleMesh& a, const TriangleMesh& b) {
    const MeshDifference d = compare_meshes(a, b);
    const double degrees = 180 / std::numbers::pi;
    return {{"rms", d.rms, "sqrt(sum d^2 / n) over vertices"},
            {"max", d.max, "largest vertex distance"},
            {"hausdorff", hausdorff_distance(a, b), "two-sided, vertices to surface"},
            {"mean_normal_angle_deg", degrees * d.mean_normal_angle, "between corresponding faces"},
            {"volume_ratio", d.volume_ratio, "B over A"},
            {"area_ratio", d.area_ratio, "B over A"},
            {"area_weighted_rms", d.area_weighted_rms, "with the vertex areas of A"},
            {"mean_squared_normal_angle_deg2", degrees * degrees * d.mean_squared_normal_angle, ""},
            {"box_diagonal", d.box_diagonal, "of A"},
            {"inverted_faces", static_cast<double>(d.inverted_faces), "normal turned by more than 90 degrees"}};
}

}   // namespace meshfolio::run
