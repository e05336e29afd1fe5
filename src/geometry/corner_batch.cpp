#include "geometry/corner_batch.h"

#include <cmath>

// Nobody reads floating-point exceptions here, which would keep the loops from becoming vector instructions. These are also compiled for
// wider vectors, chosen at run time: only +, −, ×, ÷, √ and comparisons, never contracted, so the numbers are the same.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-trapping-math")
#define MESHFOLIO_WIDER_VECTORS __attribute__((target_clones("avx512f", "avx2", "default")))
#define MESHFOLIO_INDEPENDENT _Pragma("GCC ivdep")
#else
#define MESHFOLIO_WIDER_VECTORS
#define MESHFOLIO_INDEPENDENT
#endif

#include "geometry/arctangent.h"

namespace meshfolio {
namespace {

struct Arrow {
    double x, y, z;
};
Arrow operator*(double s, const Arrow& a) { return {s * a.x, s * a.y, s * a.z}; }
Arrow operator-(const Arrow& a, const Arrow& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(const Arrow& a, const Arrow& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Arrow cross(const Arrow& a, const Arrow& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

double larger(double a, double b) { return a > b ? a : b; }
double either(bool first, double a, double b) { return first ? a : b; }
Arrow either(bool first, const Arrow& a, const Arrow& b) {
    return {either(first, a.x, b.x), either(first, a.y, b.y), either(first, a.z, b.z)};
}

/// What loops over a batch read and write.
struct Three {
    double *x, *y, *z;
    explicit Three(CornerBatch::Points& p) : x(p.x.data()), y(p.y.data()), z(p.z.data()) {}
    Arrow operator[](int i) const { return {x[i], y[i], z[i]}; }
    void set(int i, const Arrow& a) const {
        x[i] = a.x;
        y[i] = a.y;
        z[i] = a.z;
    }
};

MESHFOLIO_WIDER_VECTORS void find_dots_and_normals(CornerBatch& b, double scale) {
    const Three at_here(b.at_here), at_next(b.at_next), at_previous(b.at_previous), normal(b.normal);
    const double* const place = b.place.data();
    double *const dot_here = b.dot_here.data(), *const dot_next = b.dot_next.data(), *const dot_previous = b.dot_previous.data();
    double *const squared_here = b.squared_here.data(), *const squared_next = b.squared_next.data();
    double *const squared_previous = b.squared_previous.data(), *const squared_cross = b.cross.data();
    const int size = b.size;
    MESHFOLIO_INDEPENDENT
    for (int i = 0; i < size; ++i) {
        const Arrow here = scale * (at_previous[i] - at_next[i]), next = scale * (at_here[i] - at_previous[i]);   // edges opposite
        const Arrow previous = scale * (at_next[i] - at_here[i]);
        const double l = dot(here, here), m = dot(next, next), n = dot(previous, previous);
        // The longest edge; of equal ones the first in the order in which the triangle is stored: here comes before next unless it is
        // corner 2, before previous if it is corner 0, next before previous unless here is corner 1.
        const bool over_next = (l > m) | ((l == m) & (place[i] != 2)), over_previous = (l > n) | ((l == n) & (place[i] == 0));
        const bool next_over = (m > n) | ((m == n) & (place[i] != 1)), longest = over_next & over_previous;
        const Arrow u = either(longest, next, either(next_over, previous, here));
        const Arrow v = either(longest, previous, either(next_over, here, next));
        const Arrow uv = cross(u, v);
        dot_here[i] = -dot(next, previous);
        dot_next[i] = -dot(previous, here);
        dot_previous[i] = -dot(here, next);
        squared_here[i] = l;
        squared_next[i] = m;
        squared_previous[i] = n;
        normal.set(i, uv);
        squared_cross[i] = dot(uv, uv);
    }
}

/// |u × v|, below which it is rounding noise.
double cross_floor(double squared_here, double squared_next, double squared_previous) {
    return 1e-12 * larger(squared_here, larger(squared_next, squared_previous));
}

}   // namespace

void CornerBatch::resize(int corners) {
    size = corners;
    if (corners <= room_) return;
    room_ = corners;
    for (Points* points : {&at_here, &at_next, &at_previous, &normal}) {
        for (Numbers* numbers : {&points->x, &points->y, &points->z}) numbers->resize(static_cast<std::size_t>(room_ + spare));
    }
    for (Numbers* numbers : {&place, &dot_here, &dot_next, &dot_previous, &squared_here, &squared_next, &squared_previous, &cross,
                             &cotangent_next, &cotangent_previous, &barycentric, &voronoi, &mixed, &angle}) {
        numbers->resize(static_cast<std::size_t>(room_ + spare));
    }
    for (Vertices* vertices : {&next, &previous}) vertices->resize(static_cast<std::size_t>(room_ + spare));
}

void find_shapes(CornerBatch& batch, double scale) {
    find_dots_and_normals(batch, scale);
    for (int i = 0; i < batch.size; ++i) batch.cross[static_cast<std::size_t>(i)] = std::sqrt(batch.cross[static_cast<std::size_t>(i)]);
}

MESHFOLIO_WIDER_VECTORS void find_cotangents(CornerBatch& b) {
    const double *const l = b.squared_here.data(), *const m = b.squared_next.data(), *const n = b.squared_previous.data();
    const double *const cross = b.cross.data(), *const dot_next = b.dot_next.data(), *const dot_previous = b.dot_previous.data();
    double *const cotangent_next = b.cotangent_next.data(), *const cotangent_previous = b.cotangent_previous.data();
    const int size = b.size;
    MESHFOLIO_INDEPENDENT
    for (int i = 0; i < size; ++i) {
        const double denominator = larger(cross[i], cross_floor(l[i], m[i], n[i]));
        const double divisor = denominator > 0 ? denominator : 1;   // all corners coincide: 0/1
        cotangent_next[i] = dot_next[i] / divisor;
        cotangent_previous[i] = dot_previous[i] / divisor;
    }
}

MESHFOLIO_WIDER_VECTORS void find_area_shares(CornerBatch& b) {
    const double *const l = b.squared_here.data(), *const m = b.squared_next.data(), *const n = b.squared_previous.data();
    const double *const cross = b.cross.data(), *const cotangent_next = b.cotangent_next.data();
    const double *const cotangent_previous = b.cotangent_previous.data(), *const dot_here = b.dot_here.data();
    const double *const dot_next = b.dot_next.data(), *const dot_previous = b.dot_previous.data();
    double *const barycentric = b.barycentric.data(), *const voronoi = b.voronoi.data(), *const mixed = b.mixed.data();
    const int size = b.size;
    MESHFOLIO_INDEPENDENT
    for (int i = 0; i < size; ++i) {
        const double area = 0.5 * cross[i], of_edges = cotangent_next[i] * m[i] / 8 + cotangent_previous[i] * n[i] / 8;
        const double cell = cross[i] > cross_floor(l[i], m[i], n[i]) ? of_edges : 0;
        const bool obtuse_elsewhere = (dot_next[i] < 0) | (dot_previous[i] < 0);
        barycentric[i] = area / 3;
        voronoi[i] = cell;
        mixed[i] = dot_here[i] < 0 ? area / 2 : obtuse_elsewhere ? area / 4 : cell;
    }
}

MESHFOLIO_WIDER_VECTORS void find_angles(CornerBatch& b) {
    const double *const cross = b.cross.data(), *const dot_here = b.dot_here.data();
    double* const angle = b.angle.data();
    const int size = b.size;
    MESHFOLIO_INDEPENDENT
    for (int i = 0; i < size; ++i) angle[i] = angle_of(cross[i], dot_here[i]);
}

}   // namespace meshfolio
