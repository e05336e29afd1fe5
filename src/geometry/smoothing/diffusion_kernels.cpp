#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/smoothing/diffusion_kernels.cpp"
#include <hwy/foreach_target.h>

#include "geometry/smoothing/diffusion_kernels.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace meshfolio::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, FourColumns::width>;
using Numbers = hn::Vec<Lanes>;
constexpr std::ptrdiff_t width = FourColumns::width;

bool ExplicitRows(const DifferenceRows& L, double lambda, const double* HWY_RESTRICT x, int first, int last, double bound,
                  double* HWY_RESTRICT y) {
    const Lanes d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const Numbers step = hn::Set(d, lambda), most = hn::Set(d, bound), one = hn::Set(d, 1.0);
    const std::int32_t* const column = L.column.data();
    const double* const weight = L.weight.data();
    bool near = true;
    for (int c = 0; c < width; c += lanes) {
        Numbers outside = hn::Zero(d);   // how many
        for (int i = first; i < last; ++i) {
            const Numbers xi = hn::Load(d, x + width * i + c);
            Numbers sum = hn::Zero(d);
            const std::uint32_t end = L.start[static_cast<std::size_t>(i) + 1];
            for (std::uint32_t k = L.start[static_cast<std::size_t>(i)]; k < end; ++k) {
                const Numbers xj = hn::Load(d, x + width * column[k] + c);
                sum = hn::Add(sum, hn::Mul(hn::Set(d, weight[k]), hn::Sub(xj, xi)));
            }
            const Numbers yi = hn::Add(xi, hn::Mul(step, sum));
            hn::Store(yi, d, y + width * i + c);
            outside = hn::Add(outside, hn::IfThenElseZero(hn::Not(hn::Le(hn::Abs(yi), most)), one));
        }
        near = near && hn::AllTrue(d, hn::Eq(outside, hn::Zero(d)));
    }
    return near;
}

void IncompleteSolve(const IncompleteCholesky& factor, const double* HWY_RESTRICT r, int first, int last, double* HWY_RESTRICT z) {
    const Lanes d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const std::uint32_t* const start = factor.start.data();
    for (int c = 0; c < width; c += lanes) {
        for (int i = first; i < last; ++i) {
            Numbers zi = hn::Load(d, r + width * i + c);
            for (std::uint32_t k = start[i]; k < start[i + 1]; ++k) {
                zi = hn::Sub(zi, hn::Mul(hn::Set(d, factor.value[k]), hn::Load(d, z + width * factor.column[k] + c)));
            }
            hn::Store(zi, d, z + width * i + c);
        }
        for (int i = first; i < last; ++i) {
            hn::Store(hn::Div(hn::Load(d, z + width * i + c), hn::Set(d, factor.pivots[i])), d, z + width * i + c);
        }
        for (int i = last - 1; i >= first; --i) {
            const Numbers zi = hn::Load(d, z + width * i + c);
            for (std::uint32_t k = start[i]; k < start[i + 1]; ++k) {
                double* const zj = z + width * factor.column[k] + c;
                hn::Store(hn::Sub(hn::Load(d, zj), hn::Mul(hn::Set(d, factor.value[k]), zi)), d, zj);
            }
        }
    }
}

}   // namespace meshfolio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meshfolio {

HWY_EXPORT(ExplicitRows);
HWY_EXPORT(IncompleteSolve);

bool explicit_rows(const DifferenceRows& L, double lambda, const double* x, int first, int last, double bound, double* y) {
    return HWY_DYNAMIC_DISPATCH(ExplicitRows)(L, lambda, x, first, last, bound, y);
}

void incomplete_solve(const IncompleteCholesky& factor, const double* r, int first, int last, double* z) {
    HWY_DYNAMIC_DISPATCH(IncompleteSolve)(factor, r, first, last, z);
}

}   // namespace meshfolio
#endif
