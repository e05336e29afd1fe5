#include "raster/tile_lists.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "raster/rasterizer.h"
#include "render/shapes.h"

namespace {

using render_tests::Mesh;

/// Triangles of all sizes anywhere in and round the picture, some broken.
Mesh scattered_triangles(int count) {
    std::mt19937_64 random(4);
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const double size = std::pow(10.0, static_cast<double>(render_tests::random_integer(random, -2, 6)));
        const auto coordinate = [&] { return static_cast<double>(render_tests::random_integer(random, -1000, 1000)); };
        const glm::dvec3 middle(0.3 * coordinate(), 0.3 * coordinate(), 0.3 * coordinate());
        for (int k = 0; k < 3; ++k) mesh.positions.push_back(middle + 0.001 * size * glm::dvec3(coordinate(), coordinate(), coordinate()));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    mesh.triangles[5].y = -1, mesh.triangles[6].z = 3 * count;
    mesh.positions[30].x = std::nan("");
    return mesh;
}

TEST(TileLists, HoldEveryTriangleThatCoversASampleAndAreAscending) {
    const Mesh mesh = scattered_triangles(20000);
    const render::Surface surface = mesh.surface();
    const render::DrawOptions options{.width = 300, .height = 170};
    const render::Scene scene(surface, {}, options);
    std::vector<render::ProjectedScene> projected;
    for (const render::Projection& p : render::projections_of(render::six_views)) projected.emplace_back(scene, p.axes);
    for (const int samples : {1, 4, 16}) {
        render::WideBudget budget(0);
        const render::TileLists lists(projected, render::pattern_of(samples), budget);
        ASSERT_EQ(lists.columns(), 5);
        ASSERT_EQ(lists.rows(), 3);
        std::vector<std::int32_t> list, everything, seen;
        for (std::int32_t id = 0; id < scene.triangle_count(); ++id)
            if (id != 5 && id != 6 && id != 10) everything.push_back(id);
        for (std::size_t p = 0; p < projected.size(); ++p)
            for (int t = 0; t < lists.columns() * lists.rows(); ++t) {
                lists.collect(p, t, list);
                ASSERT_TRUE(std::is_sorted(list.begin(), list.end()));
                ASSERT_EQ(std::adjacent_find(list.begin(), list.end()), list.end());
                render::SampleTile from_list(render::pattern_of(samples)), from_all(render::pattern_of(samples));
                for (render::SampleTile* tile : {&from_list, &from_all}) tile->start(t % 5 * 64, t / 5 * 64);
                render::rasterize(projected[p], list, from_list);
                render::rasterize(projected[p], everything, from_all);
                for (int row = 0; row < from_all.blocks_on_side(); ++row)
                    for (int c = 0; c < from_all.blocks_on_side(); ++c) {
                        ASSERT_EQ(from_list.row(row)[c].top, from_all.row(row)[c].top);
                        ASSERT_EQ(from_list.row(row)[c].bottom, from_all.row(row)[c].bottom);
                    }
            }
    }
}

TEST(TileLists, BrokenTrianglesAreInNoList) {
    const Mesh mesh = scattered_triangles(3000);
    const render::Surface surface = mesh.surface();
    const render::Scene scene(surface, {}, {.width = 300, .height = 170});
    const render::ProjectedScene projected(scene, render::projections_of(render::six_views)[2].axes);
    render::WideBudget budget(0);
    const render::TileLists lists({&projected, 1}, render::four_samples, budget);
    std::vector<std::int32_t> list;
    for (int t = 0; t < lists.columns() * lists.rows(); ++t) {
        lists.collect(0, t, list);
        for (const std::int32_t broken : {5, 6, 10}) ASSERT_FALSE(std::binary_search(list.begin(), list.end(), broken));
    }
}

}   // namespace
