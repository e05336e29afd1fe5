#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/linear/panel_kernels.cpp"
#include <hwy/foreach_target.h>

#include "geometry/linear/panel_kernels.h"

#include <hwy/highway.h>
#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace meshfolio::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, EightColumns::width>;
using Numbers = hn::Vec<Lanes>;
constexpr int width = EightColumns::width;

/// Eight sums at once, of the products of one lane group with each of the eight columns of V.
HWY_INLINE void AddProductsOfBlock(const double* V, const double* W, Eigen::Index rows, double* G) {
    const Lanes d;
    for (int c = 0; c < width; c += static_cast<int>(hn::Lanes(d))) {
        Numbers g[width];
        HWY_UNROLL(8)
        for (int i = 0; i < width; ++i) g[i] = hn::Load(d, G + width * i + c);
        const double *v = V, *w = W + c;
        for (Eigen::Index r = 0; r < rows; ++r, v += width, w += width) {
            const Numbers x = hn::Load(d, w);
            HWY_UNROLL(8)
            for (int i = 0; i < width; ++i) g[i] = hn::MulAdd(hn::Set(d, v[i]), x, g[i]);
        }
        HWY_UNROLL(8)
        for (int i = 0; i < width; ++i) hn::Store(g[i], d, G + width * i + c);
    }
}

HWY_INLINE void SubtractBlock(const double* V, const double* G, Eigen::Index rows, double* W) {
    const Lanes d;
    for (int c = 0; c < width; c += static_cast<int>(hn::Lanes(d))) {
        Numbers g[width];
        HWY_UNROLL(8)
        for (int i = 0; i < width; ++i) g[i] = hn::Load(d, G + width * i + c);
        const double* v = V;
        double* w = W + c;
        for (Eigen::Index r = 0; r < rows; ++r, v += width, w += width) {   // two chains of four, so that neither waits long
            Numbers x = hn::Load(d, w), y = hn::Mul(hn::Set(d, v[4]), g[4]);
            HWY_UNROLL(4)
            for (int i = 0; i < 4; ++i) {
                x = hn::NegMulAdd(hn::Set(d, v[i]), g[i], x);
                if (i > 0) y = hn::MulAdd(hn::Set(d, v[4 + i]), g[4 + i], y);
            }
            hn::Store(hn::Sub(x, y), d, w);
        }
    }
}

void AddProducts(Blocks V, const double* W, Eigen::Index first, Eigen::Index last, double* G) {
    for (Eigen::Index r = first; r < last; r += panel_rows) {
        const Eigen::Index rows = std::min(panel_rows, last - r);
        for (std::size_t j = 0; j < V.size(); ++j) AddProductsOfBlock(V[j] + width * r, W + width * r, rows, G + 64 * j);
    }
}

void SubtractCombination(Blocks V, const double* G, Eigen::Index first, Eigen::Index last, double* W) {
    for (Eigen::Index r = first; r < last; r += panel_rows) {
        const Eigen::Index rows = std::min(panel_rows, last - r);
        for (std::size_t j = 0; j < V.size(); ++j) SubtractBlock(V[j] + width * r, G + 64 * j, rows, W + width * r);
    }
}

// Offsets within a panel: 8 rows of 8 numbers at most.
// NOLINTBEGIN(bugprone-implicit-widening-of-multiplication-result)

void MultiplyRows(const double* T, Eigen::Index first, Eigen::Index last, double* W) {
    const Lanes d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (double* w = W + width * first; w < W + width * last; w += width) {
        alignas(64) double v[width];   // the row before any lane of it is written
        for (int c = 0; c < width; c += lanes) hn::Store(hn::Load(d, w + c), d, v + c);
        for (int c = 0; c < width; c += lanes) {
            Numbers x = hn::Mul(hn::Set(d, v[0]), hn::Load(d, T + c));
            Numbers y = hn::Mul(hn::Set(d, v[4]), hn::Load(d, T + 4 * width + c));
            HWY_UNROLL(3)
            for (int i = 1; i < 4; ++i) {
                x = hn::MulAdd(hn::Set(d, v[i]), hn::Load(d, T + width * i + c), x);
                y = hn::MulAdd(hn::Set(d, v[4 + i]), hn::Load(d, T + width * (4 + i) + c), y);
            }
            hn::Store(hn::Add(x, y), d, w + c);
        }
    }
}

/// One number, multiplied and added as lanes are.
using One = hn::CappedTag<double, 1>;
HWY_INLINE double MinusProduct(double from, double a, double b) {
    const One d;
    return hn::GetLane(hn::NegMulAdd(hn::Set(d, a), hn::Set(d, b), hn::Set(d, from)));
}

/// y_c = w_c − Σ y_a l_ca, a < c; of the first eight rows y_c is l_rc d_c too.
void EliminateBlock(double* W, Eigen::Index rows, double* pivots) {
    const Lanes d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    alignas(64) double columns[width * width] = {};   // column a of L from its row a + 1 on, zeros above
    for (int r = 0; r < width; ++r) {
        double* const w = W + width * r;
        for (int a = 0; a < r; ++a) {
            for (int c = a + 1; c < r; ++c) w[c] = MinusProduct(w[c], w[a], columns[width * a + c]);
            columns[width * a + r] = w[a] / pivots[a];
            w[r] = MinusProduct(w[r], w[a], columns[width * a + r]);
        }
        pivots[r] = w[r];
        for (int c = 0; c < width; ++c) w[c] = c < r ? columns[width * c + r] : 0;
    }
    for (double* w = W + width * width; w < W + width * rows; w += width) {
        for (int a = 0; a + 1 < width; ++a) {
            const Numbers y = hn::Set(d, w[a]);
            for (int c = a / lanes * lanes; c < width; c += lanes)
                hn::Store(hn::NegMulAdd(y, hn::Load(d, columns + width * a + c), hn::Load(d, w + c)), d, w + c);
        }
        for (int c = 0; c < width; c += lanes) hn::Store(hn::Div(hn::Load(d, w + c), hn::LoadU(d, pivots + c)), d, w + c);
    }
}

/// X := L⁻¹ X within one panel of w columns and in the rows [0, inside) below it; what the others lose is subtracted from Y.
template <int w, int columns>
HWY_INLINE void ForwardPanel(const double* values, const int* rows, Eigen::Index inside, Eigen::Index row_count, double* X, double* Y,
                             double* top) {
    const hn::CappedTag<double, columns> d;
    using Row = hn::Vec<hn::CappedTag<double, columns>>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int c = 0; c < columns; c += lanes) {
        Row x[w];
        HWY_UNROLL(8)
        for (int i = 0; i < w; ++i) {
            x[i] = hn::Load(d, top + columns * i + c);
            for (int j = 0; j < i; ++j) x[i] = hn::NegMulAdd(hn::Set(d, values[w * i + j]), x[j], x[i]);
            hn::Store(x[i], d, top + columns * i + c);
        }
        const double* l = values + w * w;
        const auto subtract = [&](Eigen::Index begin, Eigen::Index end, double* from) HWY_ATTR {
            for (Eigen::Index r = begin; r < end; ++r, l += w) {
                double* const at = from + static_cast<std::ptrdiff_t>(columns) * rows[r] + c;
                Row y = hn::Load(d, at);
                HWY_UNROLL(8)
                for (int i = 0; i < w; ++i) y = hn::NegMulAdd(hn::Set(d, l[i]), x[i], y);
                hn::Store(y, d, at);
            }
        };
        subtract(0, inside, X);
        subtract(inside, row_count, Y);
    }
}

/// X := L⁻ᵀ D⁻¹ X within one panel, what lies below it being solved already.
template <int w, int columns>
HWY_INLINE void BackwardPanel(const double* values, const int* rows, Eigen::Index row_count, const double* pivots, const double* X,
                              double* top) {
    const hn::CappedTag<double, columns> d;
    using Row = hn::Vec<hn::CappedTag<double, columns>>;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int c = 0; c < columns; c += lanes) {
        Row x[w];
        HWY_UNROLL(8)
        for (int i = 0; i < w; ++i) x[i] = hn::Div(hn::Load(d, top + columns * i + c), hn::Set(d, pivots[i]));
        const double* l = values + w * w;
        for (Eigen::Index r = 0; r < row_count; ++r, l += w) {
            const Row y = hn::Load(d, X + static_cast<std::ptrdiff_t>(columns) * rows[r] + c);
            HWY_UNROLL(8)
            for (int i = 0; i < w; ++i) x[i] = hn::NegMulAdd(hn::Set(d, l[i]), y, x[i]);
        }
        HWY_UNROLL(8)
        for (int i = w - 1; i >= 0; --i) {
            for (int j = i + 1; j < w; ++j) x[i] = hn::NegMulAdd(hn::Set(d, values[w * j + i]), x[j], x[i]);
            hn::Store(x[i], d, top + columns * i + c);
        }
    }
}

// NOLINTEND(bugprone-implicit-widening-of-multiplication-result)

/// visit(std::integral_constant<int, w>()), w from 1 to 8.
template <int most = LdltPanels::widest, class Visit>
HWY_INLINE void WithWidth(int w, const Visit& visit) {
    if constexpr (most > 1) {
        if (w < most) return WithWidth<most - 1>(w, visit);
    }
    visit(std::integral_constant<int, most>());
}

template <int columns>
HWY_INLINE void SolveForward(const LdltPanels& factor, int first, int end, const OutsideRows* outside, double* X) {
    for (int p = first; p < end; ++p) {
        const auto panel = static_cast<std::size_t>(p);
        const int column = factor.first[panel];
        const int* const rows = (outside ? outside->rows : factor.rows).data() + factor.row_start[panel];
        const auto count = static_cast<Eigen::Index>(factor.row_start[panel + 1] - factor.row_start[panel]);
        WithWidth(factor.first[panel + 1] - column, [&](auto w) HWY_ATTR {
            ForwardPanel<w(), columns>(factor.values.data() + factor.value_start[panel], rows, outside ? outside->inside[panel] : count,
                                       count, X, outside ? outside->sums : nullptr, X + static_cast<std::ptrdiff_t>(columns) * column);
        });
    }
}

template <int columns>
HWY_INLINE void SolveBackward(const LdltPanels& factor, int first, int end, double* X) {
    for (int p = end - 1; p >= first; --p) {
        const auto panel = static_cast<std::size_t>(p);
        const int column = factor.first[panel];
        const auto count = static_cast<Eigen::Index>(factor.row_start[panel + 1] - factor.row_start[panel]);
        WithWidth(factor.first[panel + 1] - column, [&](auto w) HWY_ATTR {
            BackwardPanel<w(), columns>(factor.values.data() + factor.value_start[panel], factor.rows.data() + factor.row_start[panel],
                                        count, factor.pivots.data() + column, X, X + static_cast<std::ptrdiff_t>(columns) * column);
        });
    }
}

void SolveEightForward(const LdltPanels& factor, int first, int end, const OutsideRows* outside, double* X) {
    SolveForward<EightColumns::width>(factor, first, end, outside, X);
}
void SolveEightBackward(const LdltPanels& factor, int first, int end, double* X) {
    SolveBackward<EightColumns::width>(factor, first, end, X);
}
void SolveFour(const LdltPanels& factor, double* X) {
    SolveForward<FourColumns::width>(factor, 0, factor.panels(), nullptr, X);
    SolveBackward<FourColumns::width>(factor, 0, factor.panels(), X);
}

}   // namespace meshfolio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meshfolio {

HWY_EXPORT(AddProducts);
HWY_EXPORT(SubtractCombination);
HWY_EXPORT(MultiplyRows);
HWY_EXPORT(EliminateBlock);
HWY_EXPORT(SolveEightForward);
HWY_EXPORT(SolveEightBackward);
HWY_EXPORT(SolveFour);

void add_products(Blocks V, const double* W, Eigen::Index first, Eigen::Index last, double* G) {
    HWY_DYNAMIC_DISPATCH(AddProducts)(V, W, first, last, G);
}

void subtract_combination(Blocks V, const double* G, Eigen::Index first, Eigen::Index last, double* W) {
    HWY_DYNAMIC_DISPATCH(SubtractCombination)(V, G, first, last, W);
}

void multiply_rows(const double* T, Eigen::Index first, Eigen::Index last, double* W) {
    HWY_DYNAMIC_DISPATCH(MultiplyRows)(T, first, last, W);
}

void eliminate_block(double* W, Eigen::Index rows, double* pivots) { HWY_DYNAMIC_DISPATCH(EliminateBlock)(W, rows, pivots); }

void solve_forward(const LdltPanels& factor, int first, int end, const OutsideRows* outside, double* X) {
    HWY_DYNAMIC_DISPATCH(SolveEightForward)(factor, first, end, outside, X);
}

void solve_backward(const LdltPanels& factor, int first, int end, double* X) {
    HWY_DYNAMIC_DISPATCH(SolveEightBackward)(factor, first, end, X);
}

void solve_in_place(const LdltPanels& factor, double* X) {
    solve_forward(factor, 0, factor.panels(), nullptr, X);
    solve_backward(factor, 0, factor.panels(), X);
}

void solve_in_place(const LdltPanels& factor, FourColumns& X) { HWY_DYNAMIC_DISPATCH(SolveFour)(factor, X.data()); }

}   // namespace meshfolio
#endif
