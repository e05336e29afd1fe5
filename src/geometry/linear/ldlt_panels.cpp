#include "geometry/linear/ldlt_panels.h"

#include <algorithm>

#include "geometry/linear/factor_implementation.h"

namespace meshfolio {

namespace {

using Implementation = SparseFactor::Implementation;

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
    const auto own = static_cast<std::size_t>(w) * static_cast<std::size_t>(w), below = static_cast<std::size_t>(last.count);
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

void append_columns(const Implementation& L, LdltPanels& panels) {
    reserve(L, panels.size, panels);
    for (int first = 0; first < panels.size; first = panels.first.back())
        append_panel(L, first, end_of_panel(L, first, panels.size), panels);
}

/// Columns first … first + w − 1 of a block of columns of equal pattern, divided by their diagonals: LLᵀ becomes LDLᵀ.
void append_part(const Supernode& block, int first, int w, LdltPanels& panels) {
    const int skipped = first - block.first, below = block.row_count - skipped - w;
    double* value = panels.values.data() + panels.value_start.back();
    for (int c = 0; c < w; ++c) {
        const double* const column = block.values + std::ptrdiff_t(block.row_count) * (skipped + c) + skipped;
        const double inverse = 1 / column[c];
        for (int r = c + 1; r < w; ++r) value[w * r + c] = column[r] * inverse;
        for (int r = 0; r < below; ++r) value[std::ptrdiff_t(w) * (w + r) + c] = column[w + r] * inverse;
    }
    const int* const rows = block.rows + skipped + w;
    panels.rows.insert(panels.rows.end(), rows, rows + below);
    panels.first.push_back(first + w);
    panels.row_start.push_back(panels.rows.size());
    panels.value_start.push_back(panels.value_start.back() + static_cast<std::size_t>(w) * static_cast<std::size_t>(w + below));
}

/// visit(first, w) for the parts, of at most the panels' width, that a block is cut into.
template <class Visit>
void for_parts(const Supernode& block, Visit visit) {
    for (int done = 0; done < block.columns; done += LdltPanels::widest) {
        visit(block.first + done, std::min(LdltPanels::widest, block.columns - done));
    }
}

void append_supernodes(const Implementation& L, LdltPanels& panels) {
    std::size_t values = 0, rows = 0;
    for (int s = 0; s < L.supernodes(); ++s) {
        const Supernode block = L.supernode(s);
        for_parts(block, [&](int first, int w) {
            const auto below = static_cast<std::size_t>(block.row_count - (first - block.first) - w), wide = static_cast<std::size_t>(w);
            values += wide * (wide + below);
            rows += below;
        });
    }
    panels.values.assign(values, 0.0);
    panels.rows.reserve(rows);
    for (int s = 0; s < L.supernodes(); ++s) {
        const Supernode block = L.supernode(s);
        for_parts(block, [&](int first, int w) { append_part(block, first, w, panels); });
    }
}

}   // namespace

LdltPanels panels_of(const Implementation& L) {
    LdltPanels panels;
    panels.size = static_cast<int>(L.rows);
    panels.order = L.order();
    panels.first = {0};
    panels.row_start = {0};
    panels.value_start = {0};
    L.supernodes() > 0 ? append_supernodes(L, panels) : append_columns(L, panels);
    panels.pivots = L.pivots()(panels.order);
    return panels;
}

}   // namespace meshfolio
