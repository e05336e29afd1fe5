#include "run/one_mesh/difference_lines.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "geometry/measures/mesh_error.h"
#include "mesh/orientation.h"
#include "mesh/triangle_measures.h"

namespace meshfolio::run {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

std::vector<DifferenceLine> lines_of_same_triangles(const TriangleMesh& a, const TriangleMesh& b) {
    const MeshDifference d = compare_meshes(a, b);
    return {{"rms", d.rms, "sqrt(sum d^2 / n) over vertices"},
            {"max", d.max, "largest vertex distance"},
            {"hausdorff", hausdorff_distance(a, b), "two-sided, vertices to surface"},
            {"mean_normal_angle_deg", degrees * d.mean_normal_angle, "between corresponding faces"},
            {"volume_ratio", d.volume_ratio, "B over A, where both enclose a volume"},
            {"area_ratio", d.area_ratio, "B over A"},
            {"area_weighted_rms", d.area_weighted_rms, "with the vertex areas of A"},
            {"mean_squared_normal_angle_deg2", degrees * degrees * d.mean_squared_normal_angle, ""},
            {"box_diagonal", d.box_diagonal, "of A"},
            {"inverted_faces", static_cast<double>(d.inverted_faces), "normal turned by more than 90 degrees", true}};
}

std::vector<DifferenceLine> lines_of_surfaces(const TriangleMesh& a, const TriangleMesh& b, const SurfaceDistances& d) {
    const DistancesTo &to_b = d.a_to_b, &to_a = d.b_to_a;
    const auto larger = [&](double DistancesTo::*value) { return std::fmax(to_b.*value, to_a.*value); };
    return {
        {"rms", larger(&DistancesTo::rms), "distance to the other surface, the larger of both ways"},
        {"max", d.hausdorff(), "the same"},
        {"hausdorff", d.hausdorff(), "two-sided, surface to surface"},
        {"mean_normal_angle_deg", degrees * larger(&DistancesTo::mean_normal_angle), "to the nearest triangle, the larger of both ways"},
        {"volume_ratio", enclosed_volume(b) / enclosed_volume(a), "B over A, where both enclose a volume"},
        {"area_ratio", surface_area(b) / surface_area(a), "B over A"},
        {"box_diagonal", bounding_box(a).diagonal(), "of A"},
        {"rms_a_to_b", to_b.rms, "from the area of A to the surface of B"},
        {"rms_b_to_a", to_a.rms, "and back"},
        {"mean_a_to_b", to_b.mean, "over the area of A"},
        {"mean_b_to_a", to_a.mean, "over the area of B"},
        {"max_a_to_b", to_b.max, "of vertices and inner points"},
        {"max_b_to_a", to_a.max, "and back"},
        {"normal_angle_a_to_b_deg", degrees * to_b.mean_normal_angle, "to the nearest triangle, mean over the area"},
        {"normal_angle_b_to_a_deg", degrees * to_a.mean_normal_angle, "and back"}};
}

}   // namespace

bool have_same_triangles(const TriangleMesh& a, const TriangleMesh& b) {
    return a.vertex_count() == b.vertex_count() && a.face_count() == b.face_count() && a.F == b.F;
}

Difference difference_of(const TriangleMesh& a, const TriangleMesh& b, bool as_surfaces) {
    Difference difference;
    difference.same_triangles = have_same_triangles(a, b);
    if (!difference.same_triangles || as_surfaces) difference.distances = surface_distances(a, b);
    difference.lines = difference.distances ? lines_of_surfaces(a, b, *difference.distances) : lines_of_same_triangles(a, b);
    return difference;
}

Field distance_field(const DistancesTo& distances, double diagonal) {
    return {.values = distances.of_vertices, .quantity = "distance", .unit = "length", .floor = 1e-9 * diagonal};
}

std::string difference_json(const Difference& difference) {
    nlohmann::ordered_json json;
    for (const DifferenceLine& line : difference.lines) {
        json[line.key] = std::isfinite(line.value) ? nlohmann::ordered_json(line.value) : nlohmann::ordered_json();
        if (line.is_count) json[line.key] = static_cast<int>(line.value);
    }
    json["same_triangles"] = difference.same_triangles;
    if (const auto& distances = difference.distances) {
        const double high = distances->hausdorff();
        json["histogram"] = {{"high", high},
                             {"a_to_b", area_histogram(distances->a_to_b, high, distance_bins)},
                             {"b_to_a", area_histogram(distances->b_to_a, high, distance_bins)}};
    }
    return json.dump(2) + "\n";
}

}   // namespace meshfolio::run
