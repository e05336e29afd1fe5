#include "mesh/repeated_points.h"

#include <atomic>
#include <bit>
#include <vector>

#include "base/parallel.h"
#include "mesh/point_table.h"

namespace meshfolio {

namespace {

/// A set of small numbers to which several threads add.
class BitSet {
public:
    explicit BitSet(std::size_t size) : words_((size + 63) / 64) {}

    /// False when `bit` was there before.
    bool add(std::size_t bit) { return (words_[bit / 64].fetch_or(mask(bit), std::memory_order_relaxed) & mask(bit)) == 0; }
    bool has(std::size_t bit) const { return (words_[bit / 64].load(std::memory_order_relaxed) & mask(bit)) != 0; }

private:
    static std::uint64_t mask(std::size_t bit) { return std::uint64_t{1} << (bit % 64); }

    std::vector<std::atomic<std::uint64_t>> words_;
};

}   // namespace

/// Most points are alone. So first each marks one of sixteen times as many bits, chosen by its hash; only the few that share
/// theirs with another are compared.
int count_repeated_points(const TriangleMesh& mesh, const Incidence& vertex_faces) {
    const std::size_t bits = std::bit_ceil(16 * static_cast<std::size_t>(mesh.vertex_count()) + 64);
    BitSet taken(bits), shared(bits);
    const auto in_use = [&](int v) { return vertex_faces.size(v) > 0; };
    const auto point = [&](int v) { return std::array{mesh.X(v, 0) + 0.0, mesh.X(v, 1) + 0.0, mesh.X(v, 2) + 0.0}; };   // −0 becomes 0
    const auto bit_of = [&](int v) { return PointTable::hash(point(v)) & (bits - 1); };
    for_each_index(mesh.vertex_count(), [&](int v) {
        if (in_use(v) && !taken.add(bit_of(v))) shared.add(bit_of(v));
    });
    const auto blocks = of_blocks(mesh.vertex_count(), [&](int begin, int end) {
        std::vector<int> doubtful;
        for (int v = begin; v < end; ++v) {
            if (in_use(v) && shared.has(bit_of(v))) doubtful.push_back(v);
        }
        return doubtful;
    });
    std::size_t count = 0;
    for (const auto& block : blocks) count += block.value.size();
    PointTable points(count);
    for (const auto& block : blocks) {
        for (const int v : block.value) points.number_of(point(v));
    }
    return static_cast<int>(count - points.points().size());
}

}   // namespace meshfolio
