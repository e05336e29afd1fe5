// Our silhouettes against ray casting by another renderer, Embree 3: one ray through each pixel centre.
#include <gtest/gtest.h>

#include "draw_mesh.h"
#include "render/shapes.h"

#ifdef MESHFOLIO_WITH_EMBREE

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "source_dir.h"

namespace {

using render::Image;
using render::View;
using render_tests::Mesh;

constexpr int picture_side = 600;
constexpr double snapping = 1.0 / 512;   // our corners move by at most this along x and along y [pixel]
constexpr int no_triangle = -1;

/// The corners of a mesh as a view sees them: x right and y down in pixels from the corner of the picture, z towards the viewer.
std::vector<glm::dvec3> on_screen(const Mesh& mesh, const View& view, const render::Frame& frame) {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& position : mesh.positions) {
        const glm::dvec3 p = (position - frame.centre) * frame.pixels_per_unit;
        points.push_back(
            {picture_side / 2.0 + glm::dot(p, view.right()), picture_side / 2.0 - glm::dot(p, view.up), glm::dot(p, view.from)});
    }
    return points;
}

/// One triangle number or `no_triangle` a pixel.
using Ids = std::vector<int>;

using Device = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using Scene = std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)>;

Scene scene_of(RTCDevice device, const std::vector<glm::dvec3>& points, const std::vector<glm::ivec3>& triangles) {
    Scene scene(rtcNewScene(device), rtcReleaseScene);
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);   // no ray slips between two triangles
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto fill = [&](RTCBufferType type, RTCFormat format, const auto& rows) {
        auto* target =
            static_cast<std::decay_t<decltype(rows[0])>*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof rows[0], rows.size()));
        std::copy(rows.begin(), rows.end(), target);
    };
    fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, std::vector<glm::vec3>(points.begin(), points.end()));
    fill(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
}

Ids ray_cast(RTCScene scene) {
    Ids ids(picture_side * picture_side, no_triangle);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (int i = 0; i < picture_side * picture_side; ++i) {
        RTCRayHit ray{};
        ray.ray.org_x = static_cast<float>(i % picture_side) + 0.5F;
        ray.ray.org_y = static_cast<float>(i / picture_side) + 0.5F;
        ray.ray.org_z = 2 * picture_side;
        ray.ray.dir_z = -1;
        ray.ray.tfar = 4 * picture_side;
        ray.ray.mask = ~0U;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &ray);
        if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) ids[static_cast<std::size_t>(i)] = static_cast<int>(ray.hit.primID);
    }
    return ids;
}

/// `face_colors_from_id`, undone.
Ids ids_of(const Image& image) {
    Ids ids;
    for (const render::Rgba& p : image.pixels) ids.push_back(p.a == 0 ? no_triangle : (p.r << 16 | p.g << 8 | p.b) - 1);
    return ids;
}

/// Distance of the point (x, y) from the outline of a triangle on the screen.
double distance_from_outline(const std::vector<glm::dvec3>& points, const glm::ivec3& t, double x, double y) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 &a = points[static_cast<std::size_t>(t[k])], &b = points[static_cast<std::size_t>(t[(k + 1) % 3])];
        const double ex = b.x - a.x, ey = b.y - a.y, px = x - a.x, py = y - a.y;
        const double along = std::clamp((px * ex + py * ey) / std::max(ex * ex + ey * ey, 1e-300), 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(px - along * ex, py - along * ey));
    }
    return nearest;
}

/// The plane of a triangle on the screen.
struct Plane {
    double depth;   // over the point it was asked for
    double slope;   // change of depth a pixel
};

Plane plane_at(const std::vector<glm::dvec3>& points, const glm::ivec3& t, double x, double y) {
    const glm::dvec3 &a = points[static_cast<std::size_t>(t.x)], &b = points[static_cast<std::size_t>(t.y)];
    const glm::dvec3 n = glm::cross(b - a, points[static_cast<std::size_t>(t.z)] - a);
    return {a.z - (n.x * (x - a.x) + n.y * (y - a.y)) / n.z, std::hypot(n.x, n.y) / std::abs(n.z)};
}

/// The largest displacement of a point by snapping and by the rounding of rays to float [pixels].
constexpr double tolerated = std::numbers::sqrt2 * snapping + 1e-3;

/// The point lies on the outline of one of two triangles, or they meet there, as far as snapping goes.
bool is_close_call(const std::vector<glm::dvec3>& points, const std::vector<glm::ivec3>& triangles, int id, int other, double x, double y) {
    for (const int i : {id, other})
        if (i != no_triangle && distance_from_outline(points, triangles[static_cast<std::size_t>(i)], x, y) <= tolerated) return true;
    if (id == no_triangle || other == no_triangle) return false;
    const Plane p = plane_at(points, triangles[static_cast<std::size_t>(id)], x, y);
    const Plane q = plane_at(points, triangles[static_cast<std::size_t>(other)], x, y);
    return std::abs(p.depth - q.depth) <= tolerated * (1 + p.slope + q.slope);
}

struct Comparison {
    long both = 0, either = 0;   // pixels covered
    long same_id = 0;            // of those covered in both
    long unexplained = 0;        // different without a close call

    double coverage() const { return either == 0 ? 1 : static_cast<double>(both) / static_cast<double>(either); }
    double agreement() const { return both == 0 ? 1 : static_cast<double>(same_id) / static_cast<double>(both); }
};

Comparison compared(const Ids& ours, const Ids& theirs, const std::vector<glm::dvec3>& points, const std::vector<glm::ivec3>& triangles) {
    Comparison result;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const bool in_ours = ours[i] != no_triangle, in_theirs = theirs[i] != no_triangle;
        result.both += in_ours && in_theirs ? 1 : 0;
        result.either += in_ours || in_theirs ? 1 : 0;
        result.same_id += in_ours && ours[i] == theirs[i] ? 1 : 0;
        const double x = static_cast<double>(i % picture_side) + 0.5, y = static_cast<double>(i / picture_side) + 0.5;
        if (ours[i] != theirs[i] && !is_close_call(points, triangles, ours[i], theirs[i], x, y)) ++result.unexplained;
    }
    return result;
}

/// Reads a mesh of data/, with lines "v x y z" and "f a b c" only.
Mesh bundled(const std::string& name) {
    Mesh mesh;
    std::ifstream file(MESHFOLIO_SOURCE_DIR "/data/" + name + ".obj");
    std::string kind;
    for (double x, y, z; file >> kind >> x >> y >> z;) {
        if (kind == "v") mesh.positions.push_back({x, y, z});
        if (kind == "f") mesh.triangles.push_back(glm::ivec3(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)) - 1);
    }
    return mesh;
}

/// Every which way through each other.
Mesh loose_triangles(int count) {
    Mesh mesh;
    std::mt19937_64 random(5);
    for (int i = 0; i < 3 * count; ++i) {
        const auto coordinate = [&] { return static_cast<double>(render_tests::random_integer(random, -9999, 9999)); };
        const double x = coordinate(), y = coordinate(), z = coordinate();
        mesh.positions.push_back({x, y, z});
        if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
    }
    return mesh;
}

/// Every triangle into four. Midpoints are not shared, but equal.
Mesh subdivided(const Mesh& mesh) {
    Mesh fine;
    for (const glm::ivec3& t : mesh.triangles) {
        const auto at = [&](int k) { return mesh.positions[static_cast<std::size_t>(t[k])]; };
        const auto middle = [&](int i, int j) { return 0.5 * (at(i) + at(j)); };
        const auto first = static_cast<int>(fine.positions.size());
        fine.positions.insert(fine.positions.end(), {at(0), at(1), at(2), middle(1, 2), middle(2, 0), middle(0, 1)});
        for (const glm::ivec3& part : {glm::ivec3{0, 5, 4}, {5, 1, 3}, {4, 3, 2}, {3, 4, 5}}) fine.triangles.push_back(first + part);
    }
    return fine;
}

struct Case {
    const char* name;
    Mesh mesh;
    double least_agreement;
};

/// Triangles are at least 2 pixels wide nearly everywhere; those of the last mesh are half a pixel wide, so that most cover no centre.
std::vector<Case> cases() {
    using render_tests::pebble;
    return {{"pebble", pebble(), 0.99},
            {"loose triangles", loose_triangles(300), 0.99},
            {"creature", bundled("creature"), 0.99},
            {"fandisk_like", bundled("fandisk_like"), 0.99},
            {"lily", bundled("lily"), 0.99},
            {"fine pebble", subdivided(subdivided(subdivided(subdivided(pebble())))), 0.96}};
}

}   // namespace

// We and a ray through the pixel centre disagree only if the centre is near an outline or a common edge, by the distance of snapping. An
// outline of length L therefore affects at most 2 · √2/512 · L pixels: less than 1/1000 of a shape at least 11 pixels wide, and 2 % / s of
// the numbers of triangles with sides of s pixels (edges of length 2√3 / s per pixel).
TEST(Silhouettes, EqualThoseOfRayCasting) {
    const Device device(rtcNewDevice("threads=1"), rtcReleaseDevice);
    for (const auto& [name, mesh, least_agreement] : cases()) {
        ASSERT_FALSE(mesh.triangles.empty()) << name;
        render::DrawOptions options{
            .width = picture_side, .height = picture_side, .background = {0, 0, 0, 0}, .face_colors_from_id = true, .samples = 1};
        options.frame = render::frame_of(render::bounds_of(mesh.positions, mesh.triangles), picture_side, picture_side, options.fill);
        const std::vector<Image> images = render::draw_views(mesh.surface(), render::six_views, options);
        double coverage = 1, agreement = 1;   // least over the views
        for (std::size_t v = 0; v < images.size(); ++v) {
            SCOPED_TRACE(std::string(name) + " from " + std::string(render::six_views[v].name));
            const std::vector<glm::dvec3> points = on_screen(mesh, render::six_views[v], *options.frame);
            const Scene scene = scene_of(device.get(), points, mesh.triangles);
            const Comparison c = compared(ids_of(images[v]), ray_cast(scene.get()), points, mesh.triangles);
            EXPECT_GT(c.both, picture_side);
            EXPECT_GE(c.coverage(), 0.999);
            EXPECT_GE(c.agreement(), least_agreement);
            EXPECT_EQ(c.unexplained, 0);
            coverage = std::min(coverage, c.coverage());
            agreement = std::min(agreement, c.agreement());
        }
        std::printf("%-16s coverage IoU >= %.6f, same triangle >= %.6f\n", name, coverage, agreement);
    }
}

#else

TEST(Silhouettes, EqualThoseOfRayCasting) { GTEST_SKIP() << "built without Embree (libembree-dev)"; }

#endif
