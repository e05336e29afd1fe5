#include "geometry/spectrum/engine/zero_modes.h"

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

void ZeroModes::project_out(EightColumns& Y) const {
    std::vector<Eight> part(static_cast<std::size_t>(components_.count), Eight::Zero());
    for (Eigen::Index i = 0; i < Y.rows(); ++i)
        part[static_cast<std::size_t>(components_.label[static_cast<std::size_t>(i)])] += y_[i] * ConstEightRow(Y.row(i));
    for (Eigen::Index i = 0; i < Y.rows(); ++i)
        EightRow(Y.row(i)) -= y_[i] * part[static_cast<std::size_t>(components_.label[static_cast<std::size_t>(i)])];
}

ZeroModes ZeroModes::reordered(const std::vector<int>& order) const {
    ZeroModes other = *this;
    for (std::size_t i = 0; i < order.size(); ++i) other.components_.label[i] = components_.label[static_cast<std::size_t>(order[i])];
    other.y_ = y_(order);
    return other;
}

}   // namespace meshfolio
