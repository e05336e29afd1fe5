#include "geometry/spectrum/engine/noise_damping.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.h"
#include "geometry/spectrum/engine/slice_overlaps.h"

namespace meshfolio {

namespace {

using Eight = Eigen::Array<double, EightColumns::width, 1>;
using EightRow = Eigen::Map<Eight>;
using ConstEightRow = Eigen::Map<const Eight>;

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
