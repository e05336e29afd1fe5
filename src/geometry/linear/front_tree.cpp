#include "geometry/linear/front_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/linear/factor_operations.h"

namespace meshfolio {

namespace {

/// The children of each node of a forest one after another, those of the same parent in the order of `nodes`; roots last.
struct Children {
    std::vector<std::size_t> start;
    std::vector<int> child;

    Children(const std::vector<int>& parent, const std::vector<int>& nodes) : start(parent.size() + 2, 0), child(parent.size()) {
        const auto slot = [&](int node) {
            const int p = parent[static_cast<std::size_t>(node)];
            return p < 0 ? parent.size() : static_cast<std::size_t>(p);
        };
        for (const int node : nodes) ++start[slot(node) + 1];
        std::partial_sum(start.begin(), start.end(), start.begin());
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for (const int node : nodes) child[next[slot(node)]++] = node;
    }
    std::span<const int> of(std::size_t node) const { return {child.data() + start[node], child.data() + start[node + 1]}; }
};

/// Old numbers in postorder, the longest column of each family last, next to its parent, so that the two may be joined.
std::vector<int> postorder(const EliminationTree& tree) {
    std::vector<int> by_length(tree.parent.size());
    std::iota(by_length.begin(), by_length.end(), 0);
    std::stable_sort(by_length.begin(), by_length.end(),
                     [&](int a, int b) { return tree.count[std::size_t(a)] < tree.count[std::size_t(b)]; });
    const Children children(tree.parent, by_length);
    std::vector<int> order, stack;
    order.reserve(tree.parent.size());
    const auto push = [&](std::size_t node) {
        const auto family = children.of(node);
        stack.insert(stack.end(), family.begin(), family.end());
    };
    push(tree.parent.size());
    while (!stack.empty()) {   // parents before children, last child first: the reverse is a postorder
        order.push_back(stack.back());
        stack.pop_back();
        push(static_cast<std::size_t>(order.back()));
    }
    std::reverse(order.begin(), order.end());
    return order;
}

/// Columns that are eliminated together.
struct Joined {
    int first = 0, end = 0, below = 0;
    double zeros = 0;   // stored without need

    double columns() const { return end - first; }
    double entries() const { return 0.5 * columns() * (columns() + 1) + columns() * below; }
};

/// A child and its parent as one. The child's columns get the parent's rows.
Joined joined(const Joined& child, const Joined& parent) {
    return {child.first, parent.end, parent.below,
            child.zeros + parent.zeros + child.columns() * (parent.columns() + parent.below - child.below)};
}

/// A few zeros cost less than many small fronts; measured with solves of eight right-hand sides.
bool worth_joining(const Joined& both) {
    const double share = both.zeros / both.entries();
    return both.zeros == 0 || (both.columns() <= 8 && share < 0.5) || (both.columns() <= 32 && share < 0.15) || share < 0.05;
}

/// @param tree  in postorder
std::vector<Joined> joined_columns(const EliminationTree& tree) {
    std::vector<Joined> fronts;
    for (int j = 0; j < static_cast<int>(tree.parent.size()); ++j) {
        fronts.push_back({j, j + 1, tree.count[std::size_t(j)], 0});
        while (fronts.size() > 1) {
            const Joined &child = fronts[fronts.size() - 2], &parent = fronts.back();
            const int above = tree.parent[static_cast<std::size_t>(child.end - 1)];
            const Joined both = joined(child, parent);
            if (above < parent.first || above >= parent.end || !worth_joining(both)) break;
            fronts.pop_back();
            fronts.back() = both;
        }
    }
    return fronts;
}

void append_rows(const SparseMatrix& A, std::span<const int> children, int f, std::vector<int>& seen, FrontTree& tree) {
    const int first = tree.first[std::size_t(f)], end = tree.first[std::size_t(f) + 1];
    const std::size_t start = tree.rows.size();
    const auto add = [&](int row) {
        if (row < end || std::exchange(seen[static_cast<std::size_t>(row)], f) == f) return;
        tree.rows.push_back(row);
    };
    for (int j = first; j < end; ++j)
        for (SparseMatrix::InnerIterator entry(A, tree.order[std::size_t(j)]); entry; ++entry)
            add(tree.place[static_cast<std::size_t>(entry.index())]);
    for (const int child : children)
        for (std::size_t q = tree.row_start[std::size_t(child)]; q < tree.row_start[std::size_t(child) + 1]; ++q) add(tree.rows[q]);
    std::sort(tree.rows.begin() + static_cast<std::ptrdiff_t>(start), tree.rows.end());
    tree.row_start.push_back(tree.rows.size());
}

}   // namespace

long long FrontTree::entries() const {
    long long sum = 0;
    for (int f = 0; f < fronts(); ++f) {
        const long long own = columns(f);
        sum += own * (own + 1) / 2 + own * static_cast<long long>(rows_below(f).size());
    }
    return sum;
}

FrontTree front_tree(const SparseMatrix& A, const std::vector<int>& order) {
    const EliminationTree given = elimination_tree(A, order);
    const std::vector<int> post = postorder(given), place = places_of(post, A.rows());
    FrontTree tree;
    EliminationTree columns;
    for (const int old : post) {
        const int parent = given.parent[std::size_t(old)];
        tree.order.push_back(order[std::size_t(old)]);
        columns.parent.push_back(parent < 0 ? -1 : place[std::size_t(parent)]);
        columns.count.push_back(given.count[std::size_t(old)]);
        tree.nonzeros += given.count[std::size_t(old)] + 1;
    }
    tree.place = places_of(tree.order, A.rows());

    const std::vector<Joined> fronts = joined_columns(columns);
    std::vector<int> front_of(post.size()), ascending(fronts.size());
    std::iota(ascending.begin(), ascending.end(), 0);
    tree.first = {0};
    for (const int f : ascending) {
        const Joined& front = fronts[std::size_t(f)];
        std::fill(front_of.begin() + front.first, front_of.begin() + front.end, f);
        tree.first.push_back(front.end);
    }
    for (const Joined& front : fronts) {
        const int above = columns.parent[static_cast<std::size_t>(front.end - 1)];
        tree.parent.push_back(above < 0 ? -1 : front_of[std::size_t(above)]);
    }
    const Children children(tree.parent, ascending);
    std::vector<int> seen(post.size(), -1);
    tree.row_start = {0};
    for (const int f : ascending) append_rows(A, children.of(std::size_t(f)), f, seen, tree);
    return tree;
}

}   // namespace meshfolio
