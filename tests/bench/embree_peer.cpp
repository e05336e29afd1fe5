// The same six pictures by ray casting with Embree 3: 2 × 2 rays a pixel in packets of 16, interpolated normals, colours by
// value. The hierarchy is built anew in each run; vertex normals and colours are made before.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "bench/bench_meshes.h"

namespace {

using render::View;

struct Prepared {
    std::vector<glm::vec3> positions;   // in pixels round the middle; one more than there are: Embree reads 16 bytes a vertex
    std::vector<glm::vec3> normals;
    std::vector<float> values;   // 0 to 255
    std::vector<glm::ivec3> triangles;
    std::array<glm::vec3, 256> ramp;
};

Prepared prepared(const bench::BenchMesh& mesh) {
    const render::Frame frame = render::frame_of(render::bounds_of(mesh.positions, mesh.triangles), bench::side, bench::side, 0.92);
    Prepared result{{}, {}, {}, mesh.triangles, {}};
    for (const glm::dvec3& p : mesh.positions) result.positions.push_back(glm::vec3((p - frame.centre) * frame.pixels_per_unit));
    result.positions.emplace_back(0);
    result.normals.assign(mesh.positions.size(), glm::vec3(0));
    for (const glm::ivec3& t : mesh.triangles) {
        const auto at = [&](int k) { return result.positions[static_cast<std::size_t>(t[k])]; };
        for (int k = 0; k < 3; ++k) result.normals[static_cast<std::size_t>(t[k])] += glm::cross(at(1) - at(0), at(2) - at(0));
    }
    for (const double v : mesh.values) result.values.push_back(static_cast<float>(255 * (v - mesh.low) / (mesh.high - mesh.low)));
    for (std::size_t i = 0; i < 256; ++i) {
        const render::Rgba c = render::color_at(render::colormap_named("viridis"), static_cast<double>(i) / 255);
        result.ramp[i] = {c.r, c.g, c.b};
    }
    return result;
}

using Device = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using Scene = std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)>;

Scene built(RTCDevice device, const Prepared& mesh, RTCBuildQuality quality) {
    Scene scene(rtcNewScene(device), rtcReleaseScene);
    rtcSetSceneBuildQuality(scene.get(), quality);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0, sizeof(glm::vec3),
                               mesh.normals.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0, sizeof(glm::ivec3),
                               mesh.triangles.size());
    rtcSetGeometryBuildQuality(geometry, quality);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
}

/// Rays of 4 × 4 samples, which are 2 × 2 pixels from (x, y) on, towards the mesh.
void aim(RTCRayHit16& packet, const View& view, int x, int y) {
    constexpr float far = 4 * bench::side;
    const glm::vec3 right(view.right()), up(view.up), from(view.from);
    for (int i = 0; i < 16; ++i) {
        const float across = static_cast<float>(x - bench::side / 2) + 0.25F + 0.5F * static_cast<float>(i % 4);
        const float down = static_cast<float>(y - bench::side / 2) + 0.25F + 0.5F * static_cast<float>(i / 4);
        const glm::vec3 origin = far * from + across * right - down * up;
        packet.ray.org_x[i] = origin.x, packet.ray.org_y[i] = origin.y, packet.ray.org_z[i] = origin.z;
        packet.ray.dir_x[i] = -from.x, packet.ray.dir_y[i] = -from.y, packet.ray.dir_z[i] = -from.z;
        packet.ray.tnear[i] = 0, packet.ray.tfar[i] = 2 * far, packet.ray.time[i] = 0;
        packet.ray.mask[i] = ~0U, packet.ray.flags[i] = 0;
        packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
}

glm::vec3 color_of_hit(const Prepared& mesh, const View& view, const RTCHit16& hit, int i) {
    if (hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) return glm::vec3(255);
    const glm::ivec3& t = mesh.triangles[hit.primID[i]];
    const auto a = static_cast<std::size_t>(t.x), b = static_cast<std::size_t>(t.y), c = static_cast<std::size_t>(t.z);
    const float v = hit.u[i], w = hit.v[i], u = 1 - v - w;
    const glm::vec3 normal = u * mesh.normals[a] + v * mesh.normals[b] + w * mesh.normals[c];
    const float facing = std::abs(glm::dot(normal, glm::vec3(view.from))) / (glm::length(normal) + 1e-30F);
    const float value = u * mesh.values[a] + v * mesh.values[b] + w * mesh.values[c];
    return (0.25F + 0.75F * facing) * mesh.ramp[static_cast<std::size_t>(std::min(255.0F, std::max(0.0F, value)))];
}

void draw_packet(RTCScene scene, RTCIntersectContext& context, const Prepared& mesh, const View& view, int x, int y, render::Image& image) {
    alignas(64) RTCRayHit16 packet;
    alignas(64) std::array<int, 16> valid;
    valid.fill(-1);
    aim(packet, view, x, y);
    rtcIntersect16(valid.data(), scene, &context, &packet);
    std::array<glm::vec3, 4> sum{};
    for (int i = 0; i < 16; ++i) sum[static_cast<std::size_t>(i / 8 * 2 + i % 4 / 2)] += color_of_hit(mesh, view, packet.hit, i);
    for (int p = 0; p < 4; ++p) {
        const glm::vec3 mean = 0.25F * sum[static_cast<std::size_t>(p)] + 0.5F;
        image.at(x + p % 2, y + p / 2) = {static_cast<std::uint8_t>(mean.x), static_cast<std::uint8_t>(mean.y),
                                          static_cast<std::uint8_t>(mean.z), 255};
    }
}

render::Image drawn(RTCScene scene, const Prepared& mesh, const View& view) {
    constexpr int tile = 32;
    render::Image image(bench::side, bench::side);
    tbb::parallel_for(tbb::blocked_range2d<int>(0, bench::side / tile, 0, bench::side / tile), [&](const auto& tiles) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        for (int y = tiles.rows().begin() * tile; y < tiles.rows().end() * tile; y += 2)
            for (int x = tiles.cols().begin() * tile; x < tiles.cols().end() * tile; x += 2)
                draw_packet(scene, context, mesh, view, x, y, image);
    });
    return image;
}

void embree(benchmark::State& state, RTCBuildQuality quality) {
    using Clock = std::chrono::steady_clock;
    const Prepared mesh = prepared(bench::mesh_at_level(static_cast<int>(state.range(0))));
    const Device device(rtcNewDevice("threads=2"), rtcReleaseDevice);
    std::chrono::duration<double, std::milli> build{0};
    for (auto _ : state) {
        const auto start = Clock::now();
        const Scene scene = built(device.get(), mesh, quality);
        build += Clock::now() - start;
        for (const View& view : render::six_views) benchmark::DoNotOptimize(drawn(scene.get(), mesh, view));
    }
    state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
    state.counters["build_ms"] = benchmark::Counter(build.count(), benchmark::Counter::kAvgIterations);
}

void embree_low(benchmark::State& state) { embree(state, RTC_BUILD_QUALITY_LOW); }
void embree_medium(benchmark::State& state) { embree(state, RTC_BUILD_QUALITY_MEDIUM); }

}   // namespace

BENCHMARK(embree_low)->DenseRange(0, bench::levels - 1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(embree_medium)->DenseRange(0, bench::levels - 1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
