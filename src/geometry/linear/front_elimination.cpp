#include "geometry/linear/front_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "base/large_pages.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/aligned_columns.h"
#include "geometry/linear/panel_kernels.h"

namespace meshfolio {

namespace {

constexpr int width = EightColumns::width;
using Index = Eigen::Index;

Index blocks_for(Index columns) { return (columns + width - 1) / width; }

/// The lower part of a dense matrix, eight columns side by side: block J has the rows from 8J on.
class LowerBlocks {
public:
    LowerBlocks() = default;
    LowerBlocks(Index rows, Index columns) { reset(rows, columns); }
    /// All 0, in the memory at hand where that is enough.
    void reset(Index rows, Index columns) {
        rows_ = rows, blocks_ = blocks_for(columns);
        if (rows_before(blocks_) > numbers_.rows()) numbers_ = EightColumns(rows_before(blocks_));
        std::fill_n(numbers_.data(), width * rows_before(blocks_), 0.0);
    }
    Index rows() const { return rows_; }
    Index blocks() const { return blocks_; }
    double* block(Index J) { return numbers_.row(rows_before(J)); }
    const double* block(Index J) const { return numbers_.row(rows_before(J)); }
    double* row(Index J, Index i) { return block(J) + width * (i - width * J); }
    const double* row(Index J, Index i) const { return block(J) + width * (i - width * J); }

private:
    Index rows_before(Index J) const { return J * rows_ - width * J * (J - 1) / 2; }
    Index rows_ = 0, blocks_ = 0;
    EightColumns numbers_;
};

/// Rows: the front's own columns, rows of the identity that fill up the last eight, then the rows below. One front after the other is
/// eliminated in the memory of the first.
struct Front {
    Index columns = 0, padded = 0;
    LowerBlocks own, rest;
    std::vector<double> pivots;
    std::vector<Index> at;   // of each row that a child has left

    void begin(Index own_columns, Index rows_below) {
        columns = own_columns, padded = width * blocks_for(own_columns);
        own.reset(padded + rows_below, own_columns);
        rest = LowerBlocks(rows_below, rows_below);
        pivots.assign(static_cast<std::size_t>(padded), 0.0);
        for (Index c = columns; c < padded; ++c) own.row(own.blocks() - 1, c)[c % width] = 1;
    }
};

/// visit(i) for 0 … count − 1.
template <class Visit>
void for_each_of(Index count, bool parallel, const Visit& visit) {
    if (parallel)
        tbb::parallel_for(Index{0}, count, visit);
    else
        for (Index i = 0; i < count; ++i) visit(i);
}

class Elimination {
public:
    Elimination(const SparseMatrix& A, double sigma, const FrontTree& tree, LdltPanels& L)
        : A_(A), sigma_(sigma), tree_(tree), L_(L), rest_(static_cast<std::size_t>(tree.fronts())) {
        lay_out();
        children_.resize(rest_.size());
        for (int f = 0; f < tree.fronts(); ++f)
            if (tree.parent[std::size_t(f)] >= 0) children_[std::size_t(tree.parent[std::size_t(f)])].push_back(f);
    }

    void run(bool parallel) {
        if (!parallel) {
            Front front;
            for (int f = 0; f < tree_.fronts(); ++f) eliminate(f, front, false);
            return;
        }
        constexpr double tasks = 32;
        std::vector<double> work(rest_.size(), 0.0);   // of the subtree
        std::vector<int> first(rest_.size());          // front of the subtree
        for (int f = 0; f < tree_.fronts(); ++f) {
            const auto at = static_cast<std::size_t>(f);
            const double columns = tree_.columns(f), rows = columns + double(tree_.rows_below(f).size());
            work[at] += columns * rows * rows;
            first[at] = children_[at].empty() ? f : first[std::size_t(children_[at].front())];
            if (tree_.parent[at] >= 0) work[std::size_t(tree_.parent[at])] += work[at];
        }
        double all = 0;
        for (std::size_t f = 0; f < work.size(); ++f) all += tree_.parent[f] < 0 ? work[f] : 0;
        const auto small = [&](int f) { return work[std::size_t(f)] <= all / tasks; };
        std::vector<int> subtrees;
        for (int f = 0; f < tree_.fronts(); ++f) {
            const int parent = tree_.parent[std::size_t(f)];
            if (small(f) && (parent < 0 || !small(parent))) subtrees.push_back(f);
        }
        for_each_task(subtrees.size(), [&](std::size_t i) {
            Front front;
            for (int f = first[std::size_t(subtrees[i])]; f <= subtrees[i]; ++f) eliminate(f, front, false);
        });
        Front front;
        for (int f = 0; f < tree_.fronts(); ++f)
            if (!small(f)) eliminate(f, front, true);
    }

private:
    /// Panels and their rows, numbers still 0.
    void lay_out() {
        L_.size = static_cast<int>(A_.rows());
        L_.order = tree_.order;
        L_.first = {0};
        L_.row_start = L_.value_start = {0};
        L_.pivots.resize(A_.rows());
        std::size_t values = 0;
        for (int f = 0; f < tree_.fronts(); ++f) {
            first_panel_.push_back(L_.panels());
            const int end = tree_.first[std::size_t(f) + 1];
            const auto below = tree_.rows_below(f);
            for (int column = tree_.first[std::size_t(f)]; column < end; column = L_.first.back()) {
                const int next = std::min(column + width, end);
                for (int row = next; row < end; ++row) L_.rows.push_back(row);
                L_.rows.insert(L_.rows.end(), below.begin(), below.end());
                const auto w = static_cast<std::size_t>(next - column);
                values += w * (w + L_.rows.size() - L_.row_start.back());
                L_.first.push_back(next);
                L_.row_start.push_back(L_.rows.size());
                L_.value_start.push_back(values);
            }
        }
        L_.values = large_vector<double>(values);
    }

    void eliminate(int f, Front& front, bool parallel) {
        front.begin(tree_.columns(f), static_cast<Index>(tree_.rows_below(f).size()));
        add_entries(f, front);
        for (const int child : children_[std::size_t(f)]) {
            add_rest(child, f, front, parallel);
            rest_[std::size_t(child)] = {};
        }
        for (Index J = 0; J < front.own.blocks(); ++J) {
            constexpr Index chunk = panel_rows;
            const Index first = width * J, rows = front.own.rows() - first;
            for_each_of((rows + chunk - 1) / chunk, parallel && rows > 2 * chunk, [&](Index c) {
                const Index from = first + c * chunk;
                subtract_products(front, J, first, std::min<Index>(width, front.own.rows() - first), from,
                                  std::min(chunk, front.own.rows() - from), front.own.row(J, from));
            });
            eliminate_block(front.own.block(J), rows, front.pivots.data() + first);
            keep(f, J, front);
        }
        for_each_of(front.rest.blocks(), parallel, [&](Index T) {
            const Index first = front.padded + width * T, rows = front.own.rows() - first;
            subtract_products(front, front.own.blocks(), first, std::min<Index>(width, rows), first, rows, front.rest.block(T));
        });
        rest_[std::size_t(f)] = std::move(front.rest);
    }

    /// Entries of A − σI in the front's own columns.
    void add_entries(int f, Front& front) const {
        const int first = tree_.first[std::size_t(f)];
        const auto below = tree_.rows_below(f);
        for (Index c = 0; c < front.columns; ++c) {
            const int column = first + static_cast<int>(c);
            double* const block = front.own.block(c / width);
            for (SparseMatrix::InnerIterator entry(A_, tree_.order[std::size_t(column)]); entry; ++entry) {
                const int row = tree_.place[static_cast<std::size_t>(entry.index())];
                if (row < column) continue;
                const Index i = row < first + front.columns
                                    ? row - first
                                    : front.padded + (std::lower_bound(below.begin(), below.end(), row) - below.begin());
                block[width * (i - width * (c / width)) + c % width] = entry.value() - (row == column ? sigma_ : 0);
            }
        }
    }

    /// What the child has left, to the front's own columns and to what the front will leave.
    void add_rest(int child, int f, Front& front, bool parallel) const {
        const LowerBlocks& left = rest_[std::size_t(child)];
        find_rows(child, f, front);
        const std::vector<Index>& at = front.at;
        for_each_of(left.blocks(), parallel, [&](Index J) {
            const Index begin = width * J, columns = std::min<Index>(width, left.rows() - begin);
            double* target[width];   // diagonal entries of the columns
            for (Index c = 0; c < columns; ++c) {
                const Index column = at[std::size_t(begin + c)], inner = column - front.padded;
                target[c] = inner < 0 ? front.own.row(column / width, column) + column % width
                                      : front.rest.row(inner / width, inner) + inner % width;
            }
            const double* from = left.block(J);
            for (Index i = begin; i < left.rows(); ++i, from += width)
                for (Index c = 0; c < std::min(columns, i - begin + 1); ++c)
                    target[c][width * (at[std::size_t(i)] - at[std::size_t(begin + c)])] += from[c];
        });
    }

    /// The front's row for each row that the child has left.
    void find_rows(int child, int f, Front& front) const {
        const int first = tree_.first[std::size_t(f)];
        const auto below = tree_.rows_below(f);
        front.at.clear();
        Index q = 0;
        for (const int row : tree_.rows_below(child)) {
            if (row < first + front.columns) {
                front.at.push_back(row - first);
                continue;
            }
            while (below[std::size_t(q)] != row) ++q;
            front.at.push_back(front.padded + q);
        }
    }

    /// W −= L D L̂ᵀ: the rows from `row` on against the eight of the columns that begin with `column`, both numbered as the front's rows.
    /// @param blocks   of the front's own columns, eliminated already
    /// @param columns  that are there
    static void subtract_products(const Front& front, Index blocks, Index column, Index columns, Index row, Index rows, double* W) {
        if (blocks == 0) return;
        static thread_local std::vector<const double*> V;   // kept from call to call: most are too short to pay for their memory
        static thread_local EightColumns G;
        V.resize(static_cast<std::size_t>(blocks));
        if (G.rows() < width * blocks) G = EightColumns(width * blocks);
        for (Index K = 0; K < blocks; ++K) {
            V[std::size_t(K)] = front.own.row(K, row);
            const double *const l = front.own.row(K, column), *const d = front.pivots.data() + width * K;
            for (Index a = 0; a < width; ++a)
                for (Index c = 0; c < width; ++c) G.row(width * K + a)[c] = c < columns ? d[a] * l[width * c + a] : 0;
        }
        subtract_combination(V, G.data(), 0, rows, W);
    }

    /// Block J of the front becomes a panel.
    void keep(int f, Index J, const Front& front) {
        const auto panel = static_cast<std::size_t>(first_panel_[std::size_t(f)]) + static_cast<std::size_t>(J);
        const Index w = std::min<Index>(width, front.columns - width * J), first = width * J;
        double* value = L_.values.data() + L_.value_start[panel];
        const auto copy = [&](Index from, Index to) {
            for (Index i = from; i < to; ++i, value += w) std::copy_n(front.own.row(J, i), w, value);
        };
        copy(first, front.columns);
        copy(front.padded, front.own.rows());
        std::copy_n(front.pivots.data() + first, w, L_.pivots.data() + L_.first[panel]);
    }

    const SparseMatrix& A_;
    double sigma_;
    const FrontTree& tree_;
    LdltPanels& L_;
    std::vector<int> first_panel_;
    std::vector<LowerBlocks> rest_;   // of each front, until its parent has taken it
    std::vector<std::vector<int>> children_;
};

}   // namespace

LdltPanels factor_by_fronts(const SparseMatrix& A, double sigma, const FrontTree& tree, bool parallel) {
    LdltPanels panels;
    Elimination(A, sigma, tree, panels).run(parallel);
    return panels;
}

}   // namespace meshfolio
