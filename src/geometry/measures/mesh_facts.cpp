#include "geometry/measures/mesh_facts.h"

#include <charconv>
#include <numeric>

#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/measures/mesh_laws.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

/// The shortest decimal equal to a double: its significant digits, and the exponent of the first.
struct Decimal {
    int digits = 0, exponent = 0;

    int decimals() const { return std::max(0, digits - 1 - exponent); }
};
Decimal decimal_of(double x) {
    if (x == 0) return {};
    char text[32];
    const char* const end = std::to_chars(text, text + sizeof text, std::abs(x), std::chars_format::scientific).ptr;   // 1.25e-03
    const char* const e = std::find(static_cast<const char*>(text), end, 'e');
    Decimal decimal{static_cast<int>(e - text) - (e - text > 1 ? 1 : 0)};
    std::from_chars(e + (e[1] == '+' ? 2 : 1), end, decimal.exponent);
    return decimal;
}

/// Returns the distance from x to the next larger number of this type.
template <class Number> double spacing_at(double x) {
    const auto number = static_cast<Number>(x);
    return static_cast<double>(std::nextafter(number, std::numeric_limits<Number>::infinity()) - number);
}

/// Returns the largest common step of the coordinates of each axis, the shortest of the three, in units of 1/per_unit; 1 where nothing
/// differs.
/// @param per_unit  coordinates are whole multiples of its inverse
double grid_step(const Positions& X, double per_unit) {
    long long least = 0;
    for (const auto& axis : X.colwise()) {
        long long step = 0;
        for (Eigen::Index i = 1; i < axis.size() && step != 1; ++i)
            step = std::gcd(step, std::llround(axis[i] * per_unit) - std::llround(axis[0] * per_unit));
        if (step > 0) least = least > 0 ? std::min(least, step) : step;
    }
    return least > 0 ? static_cast<double>(least) : 1;
}

/// Returns the largest |a·unit − b| over the largest |b|, among entries that are numbers.
double relative_change(const Vector& a, double unit, const Vector& b) {
    double change = 0, size = 0;
    for (Eigen::Index i = 0; i < b.size(); ++i) {
        if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
        change = std::max(change, std::abs(a[i] * unit - b[i]));
        size = std::max(size, std::abs(b[i]));
    }
    return size > 0 ? change / size : 0;
}

}   // namespace

MeshFacts mesh_facts(const PreparedMesh& prepared) {
    const TriangleMesh& mesh = prepared.mesh;
    MeshFacts facts;
    facts.counts = prepared.preflight;
    facts.unreferenced_vertices = facts.counts.vertices - facts.counts.vertices_in_use;
    const CornerValues edges = edge_lengths(mesh);
    facts.shortest_edge = edges.minCoeff();
    facts.longest_edge = edges.maxCoeff();
    facts.smallest_angle = smallest_angle(mesh);
    const Box box{facts.counts.box_low, facts.counts.box_high};
    facts.diagonal = box.diagonal();
    facts.offset = box.centre().norm() / facts.diagonal;
    const Vector deficits = angle_deficit(mesh, prepared.topology);
    facts.total_deficit = total_deficit(deficits);
    facts.gauss_bonnet_residual = gauss_bonnet_error(deficits, facts.counts.euler_characteristic);
    if (facts.shortest_edge > 0) {
        facts.coordinate_rounding = coordinate_spacing(mesh) / facts.shortest_edge;
        const bool whole = (mesh.X.array() == mesh.X.array().round()).all();
        if (!whole) facts.written_steps = written_spacing(mesh.X) / facts.shortest_edge;
    }
    return facts;
}

double written_spacing(const Positions& X) {
    constexpr int longest = 15;   // digits that every double has
    const double farthest = X.size() > 0 ? X.cwiseAbs().maxCoeff() : 0, finest = spacing_at<double>(farthest);
    int digits = 0, decimals = 0;
    bool single = farthest <= std::numeric_limits<float>::max();
    for (const double x : X.reshaped()) {
        const Decimal decimal = decimal_of(x);
        digits = std::max(digits, decimal.digits);
        decimals = std::max(decimals, decimal.decimals());
        single = single && static_cast<double>(static_cast<float>(x)) == x;
    }
    const double of_decimals = std::pow(10.0, -decimals);
    if (of_decimals > 8 * finest) return grid_step(X, std::pow(10.0, decimals)) * of_decimals;
    if (single) return spacing_at<float>(farthest);
    return digits <= longest ? std::pow(10.0, decimal_of(farthest).exponent + 1 - digits) : finest;
}

double coordinate_spacing(const TriangleMesh& mesh) {
    const Box box = bounding_box(mesh);
    const double farthest = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    return spacing_at<double>(farthest);
}

double change_when_moved(const PreparedMesh& prepared, double scale) {
    const TriangleMesh& mesh = prepared.mesh;
    const Box box{prepared.preflight.box_low, prepared.preflight.box_high};
    const double unit = std::ldexp(1.0, std::ilogb(box.diagonal()) + 1);   // a power of two above the diagonal
    const double away = std::ldexp(unit, 20);
    const Positions near = (mesh.X.rowwise() - box.centre().transpose()) / unit;   // within [−1, 1]
    const Positions far = near.array() * scale * unit + away * scale;              // rounded here
    const Positions back = far.array() / scale - away;                             // not here
    const TriangleMesh there = moved_to(mesh, far), here = moved_to(mesh, back);
    const LaplaceBeltrami a = laplace_beltrami(there), b = laplace_beltrami(here);
    const Vector H = cotangent_mean_curvature(here, prepared.topology, b), K = gaussian_curvature(here, prepared.topology, b.M);
    return std::max({relative_change(a.C.coeffs(), 1, b.C.coeffs()), relative_change(a.M, 1 / (scale * scale), b.M),
                     relative_change(cotangent_mean_curvature(there, prepared.topology, a), scale, H),
                     relative_change(gaussian_curvature(there, prepared.topology, a.M), scale * scale, K)});
}

}   // namespace meshfolio
