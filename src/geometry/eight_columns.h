/// @file
/// n × 8 numbers, the eight of a row side by side: what one step of a block method works on. Private to the layer.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>

#include "geometry/sparse_types.h"

namespace meshfolio {

class EightColumns {
public:
    static constexpr int width = 8;
    using Small = Eigen::Matrix<double, width, width, Eigen::RowMajor>;

    EightColumns() = default;
    /// Not initialised.
    explicit EightColumns(Eigen::Index rows)
        : rows_(rows), numbers_(static_cast<double*>(std::aligned_alloc(64, sizeof(double) * width * static_cast<std::size_t>(rows)))) {
        if (numbers_ == nullptr) throw std::bad_alloc();
    }

    Eigen::Index rows() const { return rows_; }
    double* data() { return numbers_.get(); }
    const double* data() const { return numbers_.get(); }
    double* row(Eigen::Index i) { return numbers_.get() + width * i; }
    const double* row(Eigen::Index i) const { return numbers_.get() + width * i; }

private:
    struct Free {
        void operator()(double* p) const { std::free(p); }
    };
    Eigen::Index rows_ = 0;
    std::unique_ptr<double[], Free> numbers_;
};

}   // namespace meshfolio
