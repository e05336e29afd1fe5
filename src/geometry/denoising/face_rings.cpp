#include "geometry/denoising/face_rings.h"

#include <algorithm>

namespace meshfolio {

namespace {

void end_row(Incidence& rings) { rings.start.push_back(static_cast<int>(rings.item.size())); }

int shared_vertices(const Faces& F, int s, int t) {
    int shared = 0;
    for (const int v : F.row(s)) shared += v == F(t, 0) || v == F(t, 1) || v == F(t, 2);
    return shared;
}

}   // namespace

FaceRings face_rings(const TriangleMesh& mesh) {
    const Incidence around = triangles_around(mesh);
    FaceRings rings;
    rings.by_vertex.start = rings.by_edge.start = {0};
    std::vector<int> ring;
    for (int t = 0; t < mesh.face_count(); ++t) {
        ring.clear();
        for (const int v : mesh.F.row(t)) ring.insert(ring.end(), around.begin(v), around.end(v));
        std::sort(ring.begin(), ring.end());
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        for (const int s : ring) {
            rings.by_vertex.item.push_back(s);
            if (s != t && shared_vertices(mesh.F, s, t) >= 2) rings.by_edge.item.push_back(s);
        }
        end_row(rings.by_vertex);
        end_row(rings.by_edge);
    }
    return rings;
}

Positions face_centroids(const TriangleMesh& mesh) {
    Positions centroids(mesh.face_count(), 3);
    for (int t = 0; t < mesh.face_count(); ++t) {
        centroids.row(t) = (mesh.X.row(mesh.F(t, 0)) + mesh.X.row(mesh.F(t, 1)) + mesh.X.row(mesh.F(t, 2))) / 3;
    }
    return centroids;
}

}   // namespace meshfolio
