#include "geometry/spectrum/engine/slice_overlaps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
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

class Groups {
public:
    Groups(const SpectrumProblem& problem, const Vector& mu)
        : problem_(problem), mu_(mu), rounding_(50 * std::numeric_limits<double>::epsilon() * problem.B.diagonal().maxCoeff()) {}

    /// Of each group the largest ‖By − μy‖/μ, the relative residual in the M⁻¹ norm, over what it should be: 5e-9, or what rounding of the
    /// largest rows leaves. Above 1 where needles raise ‖B‖ so far that the rounding of the basis counts.
    Vector excess(const std::vector<EightColumns>& X) const {
        Vector largest(static_cast<Eigen::Index>(X.size()));
        tbb::parallel_for(std::size_t{0}, X.size(), [&](std::size_t g) {
            const EightColumns R = rest(X[g], g);
            Eight squares = Eight::Zero();
            for (Eigen::Index i = 0; i < R.rows(); ++i) squares += ConstEightRow(R.row(i)).square();
            double worst = 0;
            for (int c = 0; c < columns(g); ++c) {
                const double mu = mu_[first(g) + c];
                worst = std::max(worst, std::sqrt(squares[c]) / mu / std::clamp(rounding_ / mu, 5e-9, 5e-4));
            }
            largest[static_cast<Eigen::Index>(g)] = worst;
        });
        return largest;
    }

    /// @param factor  of B + cI
    std::vector<EightColumns> damped(const LdltPanels& factor, const std::vector<EightColumns>& X, const Vector& excess) const {
        std::vector<EightColumns> better(X.size());
        tbb::parallel_for(std::size_t{0}, X.size(), [&](std::size_t g) {
            EightColumns Y(X[g].rows());
            std::copy_n(X[g].data(), EightColumns::width * Y.rows(), Y.data());
            if (excess[static_cast<Eigen::Index>(g)] > 1) {
                EightColumns R = rest(Y, g);
                solve_in_place(factor, R.data());
                for (Eigen::Index i = 0; i < Y.rows(); ++i) EightRow(Y.row(i)) -= ConstEightRow(R.row(i));
                problem_.zeros_in_order.project_out(Y);
            }
            better[g] = std::move(Y);
        });
        make_orthonormal(better, static_cast<int>(mu_.size()));
        return better;
    }

private:
    static Eigen::Index first(std::size_t g) { return EightColumns::width * static_cast<Eigen::Index>(g); }
    Eigen::Index columns(std::size_t g) const { return std::min<Eigen::Index>(EightColumns::width, mu_.size() - first(g)); }

    /// BY − Yμ
    EightColumns rest(const EightColumns& Y, std::size_t g) const {
        const std::vector<int>&order = problem_.analysis.order(), &place = problem_.analysis.place();
        Eight mu = Eight::Zero();
        mu.head(columns(g)) = mu_.segment(first(g), columns(g));
        EightColumns R(Y.rows());
        for (Eigen::Index i = 0; i < Y.rows(); ++i) {
            Eight r = -mu * ConstEightRow(Y.row(i));
            for (SparseMatrix::InnerIterator entry(problem_.B, order[static_cast<std::size_t>(i)]); entry; ++entry)
                r += entry.value() * ConstEightRow(Y.row(place[static_cast<std::size_t>(entry.row())]));
            EightRow(R.row(i)) = r;
        }
        return R;
    }

    const SpectrumProblem& problem_;
    const Vector& mu_;
    double rounding_;
};

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
    for (const auto& column : E)
        for (const Small& block : column) largest = std::max(largest, block.cwiseAbs().maxCoeff());
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

void damp_noise(const SpectrumProblem& problem, std::vector<EightColumns>& X, const Vector& mu) {
    if (X.empty()) return;
    constexpr int most_steps = 3;
    const Groups groups(problem, mu);
    Vector excess = groups.excess(X);
    for (int step = 0; step < most_steps && excess.maxCoeff() > 1; ++step) {
        try {
            const LdltPanels factor = problem.factor(-mu[mu.size() - 1], true);
            if (factor.negative_pivots() > 0) break;
            std::vector<EightColumns> better = groups.damped(factor, X, excess);
            const Vector after = groups.excess(better);
            if (!(after.maxCoeff() < excess.maxCoeff())) break;
            excess = after;
            X = std::move(better);
        } catch (const SolverError&) {   // a pivot lost in rounding
            break;
        }
    }
}

}   // namespace meshfolio
