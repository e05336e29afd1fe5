// The samples that are smooth unions of bodies: the bumpy cube and the creature.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/at.h"
#include "mesh/samples/implicit_surface.h"
#include "mesh/samples/sample_parts.h"
#include "mesh/samples/signed_distance.h"

namespace meshfolio {

namespace {

// A rounded cube with the pips of a die as smooth bumps: 1 on +z, 2 on +x, 3 on +y, opposite sides adding up to seven, so that each of the
// six views is known by its number.

using Pips = std::vector<std::pair<double, double>>;   // places on a side, in units of the distance between rows

Pips pips_of(int number) {
    static const std::array<Pips, 3> pairs{{{{-1, -1}, {1, 1}}, {{-1, 1}, {1, -1}}, {{-1, 0}, {1, 0}}}};
    Pips pips;
    if (number % 2 == 1) pips.emplace_back(0, 0);
    for (int i = 0; i < number / 2; ++i) pips.insert(pips.end(), pairs[at(i)].begin(), pairs[at(i)].end());
    return pips;
}

std::vector<Ball> bumps() {
    constexpr double half = 0.8, row = 0.42, height = 0.16;   // of each bump above the side
    std::vector<Ball> balls;
    for (int axis = 0; axis < 3; ++axis) {
        const int number = std::array{2, 3, 1}[at(axis)];
        for (const int side : {1, -1}) {
            const int pips = side > 0 ? number : 7 - number;
            const double radius = 0.36 - 0.023 * pips;   // the fewer, the larger
            for (const auto& [u, v] : pips_of(pips)) {
                Vector3 centre;
                centre[axis] = side * (half + height - radius);
                centre[(axis + 1) % 3] = row * u;
                centre[(axis + 2) % 3] = row * v;
                balls.push_back({centre, radius});
            }
        }
    }
    return balls;
}

double bumpy_cube(const Vector3& p) {
    static const RoundBox box{{0.8, 0.8, 0.8}, 0.3};
    static const std::vector<Ball> balls = bumps();
    double d = signed_distance(box, p);
    for (const Ball& ball : balls) d = smooth_union(d, signed_distance(ball, p), 0.16);
    return d;
}

// A small creature: body, head with snout, eyes and ears, a waving arm, feet with toes, a tail, spines along the back. It looks towards +z
// and stands on y = −1. Nothing in it is symmetric, so that no two eigenvalues of its Laplacian coincide.

/// Returns a chain of round cones along the cubic Bézier curve of four points, with radii linear in the parameter.
std::vector<RoundCone> tapered_tube(const std::array<Vector3, 4>& p, double radius_from, double radius_to) {
    constexpr int pieces = 10;
    const auto point = [&](double t) {
        const double s = 1 - t;
        return Vector3(s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3]);
    };
    const auto radius = [&](double t) { return radius_from + t * (radius_to - radius_from); };
    std::vector<RoundCone> tube;
    for (int i = 0; i < pieces; ++i) {
        const double t = static_cast<double>(i) / pieces, next = static_cast<double>(i + 1) / pieces;
        tube.push_back({point(t), point(next), radius(t), radius(next)});
    }
    return tube;
}

template <class Shape> double nearest(const std::vector<Shape>& shapes, const Vector3& p) {
    double d = signed_distance(shapes.front(), p);
    for (std::size_t i = 1; i < shapes.size(); ++i) d = std::min(d, signed_distance(shapes[i], p));
    return d;
}

double trunk(const Vector3& p) {
    static const EllipsoidBody belly{{0, -0.42, 0.03}, {0.39, 0.41, 0.36}};
    static const EllipsoidBody chest{{0.01, 0.02, 0}, {0.29, 0.33, 0.26}};
    static const RoundCone neck{{0.01, 0.12, 0}, {0.03, 0.45, 0.04}, 0.2, 0.18};
    const double d = smooth_union(signed_distance(belly, p), signed_distance(chest, p), 0.2);
    return smooth_union(d, signed_distance(neck, p), 0.12);
}

double head(const Vector3& p) {
    static const EllipsoidBody skull{{0.04, 0.63, 0.06}, {0.38, 0.31, 0.31}};
    static const RoundCone snout{{0.05, 0.54, 0.22}, {0.08, 0.5, 0.47}, 0.19, 0.135};
    static const std::vector<Ball> cheeks{{{-0.14, 0.5, 0.22}, 0.15}, {{0.24, 0.5, 0.2}, 0.15}};
    static const Ball nose{{0.085, 0.58, 0.575}, 0.07};
    static const std::vector<Ball> eyes{{{-0.11, 0.72, 0.3}, 0.1}, {{0.205, 0.72, 0.29}, 0.1}};
    double d = smooth_union(signed_distance(skull, p), signed_distance(snout, p), 0.14);
    d = smooth_union(d, nearest(cheeks, p), 0.14);
    d = smooth_union(d, signed_distance(nose, p), 0.05);
    return smooth_union(d, nearest(eyes, p), 0.05);
}

/// An ellipsoid with a hollow towards the front; the ear stands along `up` from its middle.
struct Ear {
    EllipsoidBody outer, hollow;
    Ear(const Vector3& middle, const Vector3& up, const Vector3& front)
        : outer{middle, {0.36, 0.12, 0.185}, frame_along(up, front)},
          hollow{middle + 0.03 * up + 0.155 * front.normalized(), {0.25, 0.12, 0.11}, frame_along(up, front)} {}
};

double signed_distance(const Ear& ear, const Vector3& p) {
    return smooth_difference(signed_distance(ear.outer, p), signed_distance(ear.hollow, p), 0.1);
}

double ears(const Vector3& p) {
    static const std::vector<Ear> both{{{0.33, 1.01, 0}, {0.34, 0.8, -0.08}, {0.3, 0, 1}},
                                       {{-0.33, 0.95, 0}, {-0.5, 0.62, -0.05}, {-0.1, 0.3, 1}}};
    return nearest(both, p);
}

double hand(const std::vector<RoundCone>& arm, const Ball& palm, const std::vector<RoundCone>& fingers, const Vector3& p) {
    const double d = smooth_union(nearest(arm, p), signed_distance(palm, p), 0.05);
    return smooth_union(d, nearest(fingers, p), 0.07);
}

double right_arm(const Vector3& p) {   // waves
    static const auto arm = tapered_tube({{{-0.2, 0.1, 0}, {-0.5, 0.0, 0.0}, {-0.68, 0.1, 0.1}, {-0.72, 0.42, 0.14}}}, 0.135, 0.09);
    static const Ball palm{{-0.725, 0.46, 0.15}, 0.12};
    static const std::vector<RoundCone> fingers{{{-0.77, 0.5, 0.15}, {-0.905, 0.6, 0.16}, 0.065, 0.055},
                                                {{-0.725, 0.52, 0.16}, {-0.725, 0.69, 0.19}, 0.065, 0.055},
                                                {{-0.68, 0.49, 0.16}, {-0.55, 0.57, 0.21}, 0.065, 0.055}};
    return hand(arm, palm, fingers, p);
}

double left_arm(const Vector3& p) {   // hangs clear of the belly
    static const auto arm = tapered_tube({{{0.2, 0.1, 0}, {0.5, 0.1, 0}, {0.62, -0.08, 0.1}, {0.62, -0.24, 0.28}}}, 0.135, 0.09);
    static const Ball palm{{0.62, -0.27, 0.31}, 0.12};
    static const std::vector<RoundCone> fingers{{{0.66, -0.3, 0.34}, {0.77, -0.39, 0.43}, 0.065, 0.055},
                                                {{0.62, -0.32, 0.35}, {0.61, -0.46, 0.43}, 0.065, 0.055},
                                                {{0.57, -0.27, 0.36}, {0.47, -0.28, 0.48}, 0.065, 0.055}};
    return hand(arm, palm, fingers, p);
}

double legs(const Vector3& p) {
    static const std::vector<RoundCone> shanks{{{0.2, -0.6, 0.04}, {0.26, -0.86, 0.04}, 0.2, 0.14},
                                               {{-0.19, -0.6, 0.06}, {-0.25, -0.86, 0.1}, 0.2, 0.14}};
    static const std::vector<RoundCone> soles{{{0.26, -0.9, 0.02}, {0.31, -0.92, 0.27}, 0.12, 0.14},
                                              {{-0.25, -0.9, 0.08}, {-0.34, -0.92, 0.32}, 0.12, 0.14}};
    static const std::vector<Ball> toes{{{0.2, -0.92, 0.38}, 0.085},   {{0.325, -0.92, 0.44}, 0.09}, {{0.45, -0.92, 0.37}, 0.085},
                                        {{-0.24, -0.92, 0.45}, 0.085}, {{-0.37, -0.92, 0.49}, 0.09}, {{-0.49, -0.92, 0.4}, 0.085}};
    return smooth_union(nearest(shanks, p), smooth_union(nearest(soles, p), nearest(toes, p), 0.08), 0.1);
}

double tail(const Vector3& p) {
    static const auto root =
        tapered_tube({{{0.02, -0.55, -0.2}, {0.05, -0.85, -0.5}, {0.15, -0.95, -0.85}, {0.5, -0.72, -0.95}}}, 0.22, 0.12);
    static const auto tip =
        tapered_tube({{{0.5, -0.72, -0.95}, {0.75, -0.55, -1.02}, {0.85, -0.25, -0.92}, {0.66, -0.1, -0.8}}}, 0.12, 0.07);
    static const Ball end{{0.64, -0.08, -0.79}, 0.115};
    return smooth_union(std::min(nearest(root, p), nearest(tip, p)), signed_distance(end, p), 0.05);
}

double spines(const Vector3& p) {
    static const std::vector<RoundCone> cones{{{0.04, 0.78, -0.15}, {0.04, 0.92, -0.3}, 0.11, 0.06},
                                              {{0.03, 0.5, -0.15}, {0.03, 0.57, -0.34}, 0.11, 0.06},
                                              {{0.01, 0.2, -0.17}, {0.01, 0.25, -0.38}, 0.12, 0.065},
                                              {{0.01, -0.1, -0.22}, {0.01, -0.07, -0.45}, 0.12, 0.065},
                                              {{0.01, -0.38, -0.27}, {0.01, -0.38, -0.51}, 0.12, 0.065}};
    return nearest(cones, p);
}

struct BodyPart {
    double (*distance)(const Vector3& p);
    double blend;   // how softly it grows out of the parts before it
    Ball around;    // the part need not be computed at points nearer to other parts than to this ball
};

double creature(const Vector3& p) {
    static const std::vector<BodyPart> parts{
        {legs, 0.1, {{0, -0.78, 0.2}, 0.75}},         {head, 0.14, {{0.05, 0.62, 0.2}, 0.6}},       {ears, 0.09, {{0, 1, 0}, 0.8}},
        {right_arm, 0.07, {{-0.55, 0.3, 0.1}, 0.62}}, {left_arm, 0.07, {{0.48, -0.12, 0.2}, 0.62}}, {tail, 0.1, {{0.4, -0.55, -0.6}, 0.85}},
        {spines, 0.09, {{0.02, 0.25, -0.3}, 0.95}}};
    double d = trunk(p);
    for (const BodyPart& part : parts)
        if (signed_distance(part.around, p) < d + part.blend) d = smooth_union(d, part.distance(p), part.blend);
    return smooth_difference(d, p.y() + 1, 0.05);   // flat soles on the ground
}

}   // namespace

TriangleMesh bumpy_cube_sample(int subdivide) {
    // The box is not symmetric about the cube, so that no node of the grid lies on a plane of symmetry.
    const Box box{{-1.083, -1.072, -1.061}, {1.1, 1.1, 1.1}};
    const TriangleMesh mesh = relaxed_on(bumpy_cube, surface_net(bumpy_cube, box, 0.0631), 20);
    return subdivided_onto(mesh, subdivide, [](const Vector3& p) { return projected(bumpy_cube, p, 4); });
}

TriangleMesh creature_sample(int subdivide) {
    const Box box{{-1.1, -1.1, -1.25}, {1.1, 1.6, 0.8}};
    const TriangleMesh mesh = relaxed_on(creature, surface_net(creature, box, 0.0465), 20);
    return subdivided_onto(mesh, subdivide, [](const Vector3& p) { return projected(creature, p, 4); });
}

}   // namespace meshfolio
