#include "geometry/spectrum/engine/zero_modes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace meshfolio {

ZeroModes::ZeroModes(const SparseMatrix& A, const Vector& M) : components_(components_of(A)) {
    Vector mass = Vector::Zero(components_.count);
    for (Eigen::Index i = 0; i < M.size(); ++i) mass[components_.label[static_cast<std::size_t>(i)]] += M[i];
    y_.resize(M.size());
    for (Eigen::Index i = 0; i < M.size(); ++i) y_[i] = std::sqrt(M[i] / mass[components_.label[static_cast<std::size_t>(i)]]);
}

DenseMatrix ZeroModes::first(int count) const {
    DenseMatrix Z = DenseMatrix::Zero(y_.size(), count);
    for (Eigen::Index i = 0; i < y_.size(); ++i) {
        const int c = components_.label[static_cast<std::size_t>(i)];
        if (c < count) Z(i, c) = y_[i];
    }
    return Z;
}

void ZeroModes::project_out(Eigen::Ref<Vector> y) const {
    Vector part = Vector::Zero(components_.count);
    for (Eigen::Index i = 0; i < y.size(); ++i) part[components_.label[static_cast<std::size_t>(i)]] += y_[i] * y[i];
    for (Eigen::Index i = 0; i < y.size(); ++i) y[i] -= y_[i] * part[components_.label[static_cast<std::size_t>(i)]];
}

void ZeroModes::project_out(EightColumns& Y, bool parallel) const {
    constexpr Eigen::Index chunk = 4096;   // rows; the sums are the same for any number of threads
    const Eigen::Index chunks = (Y.rows() + chunk - 1) / chunk;
    const auto components = static_cast<std::size_t>(components_.count);
    std::vector<Eight> parts(components * static_cast<std::size_t>(chunks), Eight::Zero());
    const auto for_each_row = [&](const auto& visit) {   // (row, its share)
        const auto one = [&](Eigen::Index c) {
            for (Eigen::Index i = c * chunk; i < std::min(Y.rows(), (c + 1) * chunk); ++i)
                visit(i, parts[components * static_cast<std::size_t>(c) +
                               static_cast<std::size_t>(components_.label[static_cast<std::size_t>(i)])]);
        };
        if (parallel)
            tbb::parallel_for(Eigen::Index{0}, chunks, one);
        else
            for (Eigen::Index c = 0; c < chunks; ++c) one(c);
    };
    for_each_row([&](Eigen::Index i, Eight& part) { part += y_[i] * ConstEightRow(Y.row(i)); });
    for (std::size_t i = components; i < parts.size(); ++i) parts[i % components] += parts[i];
    for (std::size_t i = components; i < parts.size(); ++i) parts[i] = parts[i % components];
    for_each_row([&](Eigen::Index i, const Eight& part) { EightRow(Y.row(i)) -= y_[i] * part; });
}

ZeroModes ZeroModes::reordered(const std::vector<int>& order) const {
    ZeroModes other = *this;
    for (std::size_t i = 0; i < order.size(); ++i) other.components_.label[i] = components_.label[static_cast<std::size_t>(order[i])];
    other.y_ = y_(order);
    return other;
}

}   // namespace meshfolio
