#include "geometry/linear/subtree_solves.h"

#include <algorithm>
#include <numeric>

#include "base/parallel_tasks.h"

namespace meshfolio {

SubtreeSolves::SubtreeSolves(const LdltPanels& factor) : factor_(factor), rows_(factor.rows), inside_(std::size_t(factor.panels())) {
    constexpr double parts = 8;
    const std::size_t panels = inside_.size();
    // Panels one after another with the same rows below them are one front: what any of them takes in, the first one does, so that a
    // subtree is in one piece.
    std::vector<std::size_t> front_of(static_cast<std::size_t>(factor.size)), parent(panels, panels), first(panels);
    std::iota(first.begin(), first.end(), std::size_t{0});
    const auto rows_below = [&](std::size_t p) { return factor.row_start[p + 1] - factor.row_start[p]; };
    const auto columns = [&](std::size_t p) { return static_cast<std::size_t>(factor.first[p + 1] - factor.first[p]); };
    const auto first_below = [&](std::size_t p) { return factor.rows[factor.row_start[p]]; };
    std::size_t front = 0;
    for (std::size_t p = 0; p < panels; ++p) {
        if (p > 0 && (rows_below(p - 1) != columns(p) + rows_below(p) || first_below(p - 1) != factor.first[p])) front = p;
        std::fill(front_of.begin() + factor.first[p], front_of.begin() + factor.first[p + 1], front);
    }
    std::vector<double> work(panels + 1, 0.0);   // of the subtree; of all
    for (std::size_t p = 0; p < panels; ++p) {
        if (rows_below(p) > 0) parent[p] = std::max(p + 1, front_of[std::size_t(first_below(p))]);
        work[p] += static_cast<double>((columns(p) + 2) * (columns(p) + rows_below(p)));
        work[parent[p]] += work[p];
        if (parent[p] < panels) first[parent[p]] = std::min(first[parent[p]], first[p]);
    }
    const auto small = [&](std::size_t p) { return p < panels && work[p] <= work[panels] / parts; };
    for (std::size_t root = 0; root < panels; ++root) {
        if (!small(root) || small(parent[root])) continue;
        const auto begin = factor.rows.begin() + std::ptrdiff_t(factor.row_start[root]);
        const std::vector<int> outside(begin, factor.rows.begin() + std::ptrdiff_t(factor.row_start[root + 1]));
        for (std::size_t p = first[root]; p <= root; ++p) {
            const auto own = rows_.begin() + std::ptrdiff_t(factor.row_start[p]),
                       end = rows_.begin() + std::ptrdiff_t(factor.row_start[p + 1]);
            const auto out = std::lower_bound(own, end, factor.first[root + 1]);
            inside_[p] = static_cast<int>(out - own);
            std::transform(out, end, out,
                           [&](int row) { return int(std::lower_bound(outside.begin(), outside.end(), row) - outside.begin()); });
        }
        subtrees_.push_back({static_cast<int>(first[root]), static_cast<int>(root) + 1, outside});
    }
}

void SubtreeSolves::solve_in_place(double* X) const {
    std::vector<EightColumns> sums(subtrees_.size());
    for_each_task(subtrees_.size(), [&](std::size_t s) {
        const Subtree& subtree = subtrees_[s];
        sums[s] = EightColumns(static_cast<Eigen::Index>(subtree.outside.size()));
        std::fill_n(sums[s].data(), EightColumns::width * sums[s].rows(), 0.0);
        const OutsideRows outside{rows_, inside_, sums[s].data()};
        solve_forward(factor_, subtree.first, subtree.end, &outside, X);
    });
    for (std::size_t s = 0; s < sums.size(); ++s)
        for (std::size_t i = 0; i < subtrees_[s].outside.size(); ++i)
            EightRow(X + std::ptrdiff_t(EightColumns::width) * subtrees_[s].outside[i]) += ConstEightRow(sums[s].row(Eigen::Index(i)));
    std::vector<std::pair<int, int>> between;   // panels that belong to no subtree
    int next = 0;
    for (const Subtree& subtree : subtrees_) {
        between.emplace_back(next, subtree.first);
        next = subtree.end;
    }
    between.emplace_back(next, factor_.panels());
    for (const auto& [first, end] : between) solve_forward(factor_, first, end, nullptr, X);
    std::reverse(between.begin(), between.end());
    for (const auto& [first, end] : between) solve_backward(factor_, first, end, X);
    for_each_task(subtrees_.size(), [&](std::size_t s) { solve_backward(factor_, subtrees_[s].first, subtrees_[s].end, X); });
}

}   // namespace meshfolio
