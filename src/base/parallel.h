/// @file
/// Loops over 0 … n − 1 on all processors. Blocks have a fixed length and results keep their order, so that they do not depend on the
/// number of processors.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace meshfolio {

inline constexpr int block_length = 1 << 14;

/// Returns the number of blocks of `block_length` in a range of n indices; the last may be shorter. 0 for n ≤ 0.
inline int block_count(int n) { return n > 0 ? (n - 1) / block_length + 1 : 0; }

/// Calls body(block, begin, end) for each block of [0, n); a single block runs on the calling thread.
template <class Body> void for_blocks(int n, Body body) {
    const int blocks = block_count(n);
    const auto run = [&](int block) { body(block, block * block_length, block + 1 == blocks ? n : (block + 1) * block_length); };
    if (blocks == 1) return run(0);
    tbb::parallel_for(0, blocks, run);
}

/// Returns the results of body(begin, end) for the blocks of [0, n), in order, each as the member `value`.
template <class Body> auto per_block(int n, Body body) {
    struct Slot {   // several threads must not write to one std::vector<bool>
        decltype(body(0, 0)) value{};
    };
    std::vector<Slot> results(static_cast<std::size_t>(block_count(n)));
    for_blocks(n, [&](int block, int begin, int end) { results[static_cast<std::size_t>(block)].value = body(begin, end); });
    return results;
}

/// Calls body(i) for each i in [0, n).
template <class Body> void for_each_index(int n, Body body) {
    for_blocks(n, [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i) body(i);
    });
}

/// True if condition(i) holds for every i in [0, n).
template <class Condition> bool all_of_range(int n, Condition condition) {
    const auto blocks = per_block(n, [&](int begin, int end) {
        bool all = true;
        for (int i = begin; i < end; ++i) all &= condition(i);
        return all;
    });
    return std::all_of(blocks.begin(), blocks.end(), [](const auto& block) { return block.value; });
}

/// Computes value(i) in parallel and calls take(0, value(0)), take(1, value(1)), … in this order: sums round as on one processor.
template <class Value, class Take> void in_order(int n, Value value, Take take) {
    constexpr int slab = 16 * block_length;
    std::vector<decltype(value(0))> values(static_cast<std::size_t>(std::min(n, slab)));
    for (int begin = 0; begin < n;) {
        const int size = std::min(n - begin, slab);
        for_each_index(size, [&](int i) { values[static_cast<std::size_t>(i)] = value(begin + i); });
        for (int i = 0; i < size; ++i) take(begin + i, values[static_cast<std::size_t>(i)]);
        begin += size;
    }
}

/// Returns value(0) + … + value(n − 1), added in this order.
template <class Value> double ordered_sum(int n, Value value) {
    double sum = 0;
    in_order(n, value, [&](int, double x) { sum += x; });
    return sum;
}

}   // namespace meshfolio
