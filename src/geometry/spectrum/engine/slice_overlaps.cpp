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

/// E[g][i] = XᵢᵀX_g − I for all i ≤ g, first ≤ g < end. A panel of the Xᵢ is read once for all of these.
void set_overlaps(const std::vector<EightColumns>& X, int first, int end, int k, std::vector<std::vector<Small>>& E) {
    std::vector<const double*> blocks;
    for (int i = 0; i < end; ++i) blocks.push_back(X[static_cast<std::size_t>(i)].data());
    std::vector<EightColumns> products;
    for (int g = first; g < end; ++g) {
        products.emplace_back(static_cast<Eigen::Index>(lanes * (g + 1)));
        std::fill_n(products.back().data(), 64 * (g + 1), 0.0);
    }
    for (Eigen::Index r = 0; r < X[0].rows(); r += panel_rows) {
        for (int g = first; g < end; ++g) {
            add_products(Blocks(blocks).first(static_cast<std::size_t>(g + 1)), blocks[static_cast<std::size_t>(g)], r,
                         std::min(X[0].rows(), r + panel_rows), products[static_cast<std::size_t>(g - first)].data());
        }
    }
    for (int g = first; g < end; ++g) {
        const double* const product = products[static_cast<std::size_t>(g - first)].data();
        std::vector<Small>& column = E[static_cast<std::size_t>(g)];
        for (int i = 0; i <= g; ++i) column.push_back(Eigen::Map<const Small>(product + std::ptrdiff_t(64) * i));
        for (int c = 0; c < std::min(lanes, k - lanes * g); ++c) column.back()(c, c) -= 1;
    }
}

}   // namespace

double make_orthonormal(std::vector<EightColumns>& X, int k) {
    if (X.empty()) return 0;
    const int groups = static_cast<int>(X.size());
    std::vector<std::vector<Small>> E(X.size());
    const int tile = std::clamp(groups / 16, 1, 6), tiles = (groups + tile - 1) / tile;
    const auto set_tile = [&](int i) {
        const int first = tile * (tiles - 1 - i);   // the long ones first
        set_overlaps(X, first, std::min(first + tile, groups), k, E);
    };
    tbb::parallel_for(0, tiles, set_tile, tbb::simple_partitioner());
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
