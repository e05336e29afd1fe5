// The inner loop of explicit smoothing for the vectors of this processor, chosen at run time (Highway). A coordinate is a lane, sums over a
// row go in the order of its entries and products are rounded before they are added: the same bytes on every processor. In vectors because
// `smooth armadillo.obj --iterations 1000` takes 1.4 times as long with Eigen's arrays (0.73 s of processor time instead of 0.54 s).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/smoothing/diffusion_kernels.cpp"
#include <hwy/foreach_target.h>

#include "geometry/smoothing/diffusion_step.h"

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

}   // namespace meshfolio::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meshfolio {

HWY_EXPORT(ExplicitRows);

bool explicit_rows(const DifferenceRows& L, double lambda, const FourColumns& X, int first, int last, double bound, FourColumns& Y) {
    return HWY_DYNAMIC_DISPATCH(ExplicitRows)(L, lambda, X.data(), first, last, bound, Y.data());
}

}   // namespace meshfolio
#endif
