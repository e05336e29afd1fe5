#include "run/one_mesh/difference_lines.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "base/number_text.h"
#include "geometry/measures/mesh_error.h"
#include "mesh/orientation.h"
#include "mesh/triangle_measures.h"

namespace meshfolio::run {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

constexpr const char *hausdorff_meaning = "two-sided, surface to surface, of all points: at least this",
                     *bound_meaning = "and no more than this";

std::vector<DifferenceLine> lines_of_same_triangles(const TriangleMesh& a, const TriangleMesh& b, const HausdorffDistance& hausdorff) {
    const MeshDifference d = compare_meshes(a, b);
    return {{"rms", "rms distance", d.rms, "sqrt(sum d² / n) over vertices"},
            {"max", "largest distance", d.max, "largest vertex distance"},
            {"hausdorff", "Hausdorff distance, at least", hausdorff.distance, hausdorff_meaning},
            {"hausdorff_bound", "Hausdorff distance, at most", hausdorff.bound, bound_meaning},
            {"mean_normal_angle_deg", "mean angle of normals [°]", degrees * d.mean_normal_angle, "between corresponding faces"},
            {"volume_ratio", "volume ratio", d.volume_ratio, "B over A, where both enclose a volume"},
            {"area_ratio", "area ratio", d.area_ratio, "B over A"},
            {"area_weighted_rms", "rms distance by area", d.area_weighted_rms, "with the vertex areas of A"},
            {"mean_squared_normal_angle_deg2", "mean squared angle of normals [°²]", degrees * degrees * d.mean_squared_normal_angle, ""},
            {"box_diagonal", "diagonal of the box", d.box_diagonal, "of A"},
            {"inverted_faces", "turned triangles", static_cast<double>(d.inverted_faces), "normal turned by more than 90 degrees", true}};
}

std::vector<DifferenceLine> lines_of_surfaces(const TriangleMesh& a, const TriangleMesh& b, const SurfaceDistances& d) {
    const DistancesTo &to_b = d.a_to_b, &to_a = d.b_to_a;
    const auto larger = [&](double DistancesTo::*value) { return std::fmax(to_b.*value, to_a.*value); };
    return {{"rms", "rms distance", larger(&DistancesTo::rms), "distance to the other surface, the larger of both ways"},
            {"max", "largest distance", d.hausdorff.distance, "the largest that was measured"},
            {"hausdorff", "Hausdorff distance, at least", d.hausdorff.distance, hausdorff_meaning},
            {"hausdorff_bound", "Hausdorff distance, at most", d.hausdorff.bound, bound_meaning},
            {"mean_normal_angle_deg", "mean angle of normals [°]", degrees * larger(&DistancesTo::mean_normal_angle),
             "to the nearest triangle, the larger of both ways"},
            {"volume_ratio", "volume ratio", enclosed_volume(b) / enclosed_volume(a), "B over A, where both enclose a volume"},
            {"area_ratio", "area ratio", surface_area(b) / surface_area(a), "B over A"},
            {"box_diagonal", "diagonal of the box", bounding_box(a).diagonal(), "of A"},
            {"rms_a_to_b", "rms, A to B", to_b.rms, "from the area of A to the surface of B"},
            {"rms_b_to_a", "rms, B to A", to_a.rms, "and back"},
            {"mean_a_to_b", "mean, A to B", to_b.mean, "over the area of A"},
            {"mean_b_to_a", "mean, B to A", to_a.mean, "over the area of B"},
            {"max_a_to_b", "largest, A to B", to_b.max, "the largest that was measured"},
            {"max_b_to_a", "largest, B to A", to_a.max, "and back"},
            {"normal_angle_a_to_b_deg", "angle of normals [°], A to B", degrees * to_b.mean_normal_angle,
             "to the nearest triangle, mean over the area"},
            {"normal_angle_b_to_a_deg", "angle of normals [°], B to A", degrees * to_a.mean_normal_angle, "and back"},
            {"rms_error", "error of the rms", larger(&DistancesTo::rms_error), "what rms cannot be off by"},
            {"mean_error_a_to_b", "error of the mean, A to B", to_b.mean_error, "what the mean cannot be off by"},
            {"mean_error_b_to_a", "error of the mean, B to A", to_a.mean_error, "and back"},
            {"rms_error_a_to_b", "error of the rms, A to B", to_b.rms_error, "what the rms cannot be off by"},
            {"rms_error_b_to_a", "error of the rms, B to A", to_a.rms_error, "and back"}};
}

}   // namespace

bool have_same_triangles(const TriangleMesh& a, const TriangleMesh& b) {
    return a.vertex_count() == b.vertex_count() && a.face_count() == b.face_count() && a.F == b.F;
}

Difference difference_of(const TriangleMesh& a, const TriangleMesh& b, bool as_surfaces, double accuracy) {
    Difference difference;
    difference.same_triangles = have_same_triangles(a, b);
    if (!difference.same_triangles || as_surfaces) difference.distances = surface_distances(a, b, accuracy);
    const HausdorffDistance hausdorff = difference.distances ? difference.distances->hausdorff : hausdorff_distance(a, b, accuracy);
    difference.lines = difference.distances ? lines_of_surfaces(a, b, *difference.distances) : lines_of_same_triangles(a, b, hausdorff);
    if (!hausdorff.reached)
        difference.warnings.push_back("the search for the Hausdorff distance reached its limit: it lies between " +
                                      readable(hausdorff.distance) + " and " + readable(hausdorff.bound));
    if (difference.distances && !difference.distances->exact())
        difference.warnings.emplace_back("some points are equally far from very many triangles: their distances are upper bounds");
    return difference;
}

Field distance_field(Vector of_vertices, double diagonal) {
    return {.values = std::move(of_vertices), .quantity = "distance", .unit = "length", .colormap = "pale", .floor = 1e-9 * diagonal};
}

std::string difference_json(const Difference& difference) {
    nlohmann::ordered_json json;
    for (const DifferenceLine& line : difference.lines) {
        json[line.key] = std::isfinite(line.value) ? nlohmann::ordered_json(line.value) : nlohmann::ordered_json();
        if (line.is_count) json[line.key] = static_cast<int>(line.value);
    }
    json["same_triangles"] = difference.same_triangles;
    if (const auto& distances = difference.distances) {
        const double high = distances->hausdorff.distance;
        json["histogram"] = {{"high", high},
                             {"a_to_b", area_histogram(distances->a_to_b, high, distance_bins)},
                             {"b_to_a", area_histogram(distances->b_to_a, high, distance_bins)}};
    }
    return json.dump(2) + "\n";
}

}   // namespace meshfolio::run
