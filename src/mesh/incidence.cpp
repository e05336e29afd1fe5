#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#include "base/at.h"
#include "base/large_pages.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

namespace {

/// The range of indices of one of several parts of about equal length.
struct Part {
    std::size_t begin, end;
    Part(std::size_t size, int part, int parts) : begin(size * at(part) / at(parts)), end(size * at(part + 1) / at(parts)) {}
};

}   // namespace

/// Sorting by counting, in parallel: each processor counts the corners of its part of the triangles; the sums of these counts tell
/// where in which row each part begins; then each writes its own. Rows come out ascending however many parts there are.
Incidence triangles_around(const TriangleMesh& mesh) {
    const std::size_t corners = at(mesh.face_count()) * 3;
    const int* corner = mesh.F.data();
    const int parts = corners < 100'000 ? 1 : std::clamp(tbb::this_task_arena::max_concurrency(), 1, 8);
    std::vector<std::vector<int>> place(at(parts));   // of each part: at first how many corners a vertex has, then where the next one goes
    tbb::parallel_for(0, parts, [&](int p) {
        std::vector<int>& count = place[at(p)];
        count = large_vector<int>(at(mesh.vertex_count()));
        const Part part(corners, p, parts);
        for (std::size_t c = part.begin; c < part.end; ++c) ++count[at(corner[c])];
    });
    Incidence around;
    around.start.resize(at(mesh.vertex_count()) + 1);
    int sum = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        around.start[at(v)] = sum;
        for (std::vector<int>& of_part : place) {
            const int count = of_part[at(v)];
            of_part[at(v)] = sum;
            sum += count;
        }
    }
    around.start.back() = sum;
    around.item = large_vector<int>(corners);
    tbb::parallel_for(0, parts, [&](int p) {
        const Part part(corners, p, parts);
        int* const item = around.item.data();
        for (std::size_t c = part.begin; c < part.end; ++c) item[place[at(p)][at(corner[c])]++] = static_cast<int>(c / 3);
    });
    return around;
}

}   // namespace meshfolio
