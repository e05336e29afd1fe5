#include "geometry/spectrum/engine/slice_overlaps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "geometry/linear/panel_kernels.h"

namespace meshfolio {

namespace {

using Small = EightColumns::Small;

/// Overlaps smaller than this are left: the sum of k rounding errors.
constexpr double negligible = 1e-13;

/// XᵢᵀX_g − I for all i ≤ g.
std::vector<Small> overlaps(const std::vector<EightColumns>& X, int g, int k) {
    std::vector<const double*> blocks;
    for (int i = 0; i <= g; ++i) blocks.push_back(X[static_cast<std::size_t>(i)].data());
    EightColumns products(static_cast<Eigen::Index>(lanes * blocks.size()));
    std::fill_n(products.data(), 64 * blocks.size(), 0.0);
    add_products(blocks, X[static_cast<std::size_t>(g)].data(), 0, X[0].rows(), products.data());
    std::vector<Small> E;
    for (std::size_t i = 0; i < blocks.size(); ++i) E.push_back(Eigen::Map<const Small>(products.data() + 64 * i));
    for (int c = 0; c < std::min(lanes, k - lanes * g); ++c) E.back()(c, c) -= 1;
    return E;
}

}   // namespace

double make_orthonormal(std::vector<EightColumns>& X, int k) {
    if (X.empty()) return 0;
    const int groups = static_cast<int>(X.size());
    std::vector<std::vector<Small>> E(X.size());
    tbb::parallel_for(0, groups, [&](int i) {
        const int g = i % 2 == 0 ? groups - 1 - i / 2 : i / 2;   // long and short ones alternate
        E[static_cast<std::size_t>(g)] = overlaps(X, g, k);
    });
    double largest = 0;
    for (const auto& column : E) {
        for (const Small& block : column) largest = std::max(largest, block.cwiseAbs().maxCoeff());
    }
    // Rows are independent: a panel of all columns is corrected from its own old values.
    tbb::parallel_for(Eigen::Index{0}, (X[0].rows() + panel_rows - 1) / panel_rows, [&](Eigen::Index p) {
        const Eigen::Index first = p * panel_rows, rows = std::min(panel_rows, X[0].rows() - first);
        std::vector<EightColumns> old;
        std::vector<const double*> none;
        for (const EightColumns& group : X) {
            old.emplace_back(rows);
            std::copy_n(group.row(first), lanes * rows, old.back().data());
        }
        for (int g = 0; g < groups; ++g) {
            for (int i = 0; i <= g; ++i) {
                const Small& overlap = E[static_cast<std::size_t>(g)][static_cast<std::size_t>(i)];
                if (overlap.cwiseAbs().maxCoeff() <= negligible) continue;
                alignas(64) double part[64];
                Eigen::Map<Small> correction(part);
                correction = overlap;
                if (i == g) {
                    correction.triangularView<Eigen::StrictlyLower>().setZero();
                    correction.diagonal() *= 0.5;
                }
                const double* const source = old[static_cast<std::size_t>(i)].data();
                subtract_combination({&source, 1}, part, 0, rows, X[static_cast<std::size_t>(g)].row(first));
            }
        }
    });
    return largest;
}

}   // namespace meshfolio
