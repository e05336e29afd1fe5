/// @file
/// Loops over 0 … n − 1 on all processors. Blocks are of a fixed length and results stand in their order: nothing depends on how many
/// processors there are.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace meshfolio {

inline constexpr int block_length = 1 << 14;

inline int block_count(int n) { return n > 0 ? (n - 1) / block_length + 1 : 0; }

/// body(block, begin, end) for each block of the range. What is short stays on the thread that calls.
template <class Body>
void for_blocks(int n, Body body) {
    const int blocks = block_count(n);
    const auto run = [&](int block) { body(block, block * block_length, block + 1 == blocks ? n : (block + 1) * block_length); };
    if (blocks == 1) return run(0);
    tbb::parallel_for(0, blocks, run);
}

/// What body(begin, end) returns for each block, in order.
template <class Body>
auto of_blocks(int n, Body body) {
    struct Slot {   // a std::vector<bool> could not be written to from several threads
        decltype(body(0, 0)) value{};
    };
    std::vector<Slot> results(static_cast<std::size_t>(block_count(n)));
    for_blocks(n, [&](int block, int begin, int end) { results[static_cast<std::size_t>(block)].value = body(begin, end); });
    return results;
}

/// body(i) for each i.
template <class Body>
void for_each_index(int n, Body body) {
    for_blocks(n, [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i) body(i);
    });
}

/// Whether condition(i) holds for every i.
template <class Condition>
bool all_of_range(int n, Condition condition) {
    const auto blocks = of_blocks(n, [&](int begin, int end) {
        bool all = true;
        for (int i = begin; i < end; ++i) all &= condition(i);
        return all;
    });
    return std::all_of(blocks.begin(), blocks.end(), [](const auto& block) { return block.value; });
}

/// Computes value(i) in parallel and hands them on one by one: take(0, value(0)), take(1, value(1)), … So sums come out as if
/// there were one processor.
template <class Value, class Take>
void in_order(int n, Value value, Take take) {
    constexpr int slab = 16 * block_length;
    std::vector<decltype(value(0))> values(static_cast<std::size_t>(std::min(n, slab)));
    for (int begin = 0; begin < n;) {
        const int size = std::min(n - begin, slab);
        for_each_index(size, [&](int i) { values[static_cast<std::size_t>(i)] = value(begin + i); });
        for (int i = 0; i < size; ++i) take(begin + i, values[static_cast<std::size_t>(i)]);
        begin += size;
    }
}

/// value(0) + value(1) + …, in this order.
template <class Value>
double ordered_sum(int n, Value value) {
    double sum = 0;
    in_order(n, value, [&](int, double x) { sum += x; });
    return sum;
}

}   // namespace meshfolio
