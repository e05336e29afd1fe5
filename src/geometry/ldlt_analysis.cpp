#include "geometry/ldlt_analysis.h"

#include "geometry/factor_implementation.h"

namespace meshfolio {

namespace {

using Implementation = SparseFactor::Implementation;

SparseMatrix shifted(SparseMatrix A, double sigma) {
    for (int j = 0; j < A.cols(); ++j) A.coeffRef(j, j) -= sigma;
    return A;
}

/// Does column j + 1 of L have the pattern of column j without its first row?
bool continues(const FactorColumn& column, const FactorColumn& next, int j) {
    return column.count == next.count + 1 && column.rows[0] == j + 1;
}

/// Where the panel that begins with `first` ends.
int end_of_panel(const Implementation& L, int first, int size) {
    int end = first + 1;
    while (end < size && end - first < LdltPanels::widest && continues(L.column(end - 1), L.column(end), end - 1)) ++end;
    return end;
}

/// Columns first … end − 1 row by row, the panel's own triangle first.
void append_panel(const Implementation& L, int first, int end, LdltPanels& panels) {
    const int w = end - first;
    const FactorColumn last = L.column(end - 1);
    const auto own = static_cast<std::size_t>(w * w), below = static_cast<std::size_t>(last.count);
    double* value = panels.values.data() + panels.value_start.back();
    for (int c = 0; c < w; ++c) {
        const FactorColumn column = L.column(first + c);
        for (int r = c + 1; r < w; ++r) value[w * r + c] = column.values[r - c - 1];
        const double* const under = column.values + (w - 1 - c);
        for (std::size_t r = 0; r < below; ++r) value[own + static_cast<std::size_t>(w) * r + static_cast<std::size_t>(c)] = under[r];
    }
    panels.rows.insert(panels.rows.end(), last.rows, last.rows + last.count);
    panels.first.push_back(end);
    panels.row_start.push_back(panels.rows.size());
    panels.value_start.push_back(panels.value_start.back() + own + static_cast<std::size_t>(w) * below);
}

/// Room for every panel: the numbers take most of the memory, so they are not grown by doubling.
void reserve(const Implementation& L, int size, LdltPanels& panels) {
    std::size_t values = 0, rows = 0;
    for (int first = 0, end = 0; first < size; first = end) {
        end = end_of_panel(L, first, size);
        const auto w = static_cast<std::size_t>(end - first), below = static_cast<std::size_t>(L.column(end - 1).count);
        values += w * (w + below);
        rows += below;
    }
    panels.values.assign(values, 0.0);
    panels.rows.reserve(rows);
}

}   // namespace

LdltAnalysis::LdltAnalysis(const SparseMatrix& A, FactorLibrary library)
    : A_(A), symbolic_(analysed(A, FactorKind::ldlt, library)), order_(symbolic_->order()) {}
LdltAnalysis::~LdltAnalysis() = default;

long long LdltAnalysis::nonzeros() const { return symbolic_->nonzeros(); }

std::unique_ptr<Implementation> LdltAnalysis::factored(double sigma) const {
    auto factor = symbolic_->analysed_copy(A_);
    factorize_checked(*factor, shifted(A_, sigma));
    return factor;
}

LdltPanels LdltAnalysis::factor(double sigma) const {
    const auto L = factored(sigma);
    LdltPanels panels;
    panels.size = static_cast<int>(A_.rows());
    panels.order = order_;
    panels.first = {0};
    panels.row_start = {0};
    panels.value_start = {0};
    reserve(*L, panels.size, panels);
    for (int first = 0; first < panels.size; first = panels.first.back())
        append_panel(*L, first, end_of_panel(*L, first, panels.size), panels);
    const Vector pivots = L->pivots();
    panels.pivots = pivots(order_);
    panels.growth = (pivots.array() / (A_.diagonal().array() - sigma)).abs().maxCoeff();
    return panels;
}

int LdltAnalysis::count_below(double sigma) const { return factored(sigma)->negative; }

}   // namespace meshfolio
