/// @file
/// n × 4 numbers, the four of a row side by side in one half of a cache line: three coordinates and a zero. Private to the layer.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "geometry/sparse_types.h"

namespace meshfolio {

class FourColumns {
public:
    static constexpr int width = 4;

    FourColumns() = default;
    /// Not initialised.
    explicit FourColumns(Eigen::Index rows)
        : rows_(rows),
          numbers_(
              static_cast<double*>(std::aligned_alloc(64, 64 * ((sizeof(double) * width * static_cast<std::size_t>(rows) + 63) / 64)))) {
        if (rows > 0 && numbers_ == nullptr) throw std::bad_alloc();
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

/// Row i is row vertex[i] of X, and back: the other rows of X stay.
FourColumns gathered(const Positions& X, const std::vector<int>& vertex);
void scatter(const FourColumns& rows, const std::vector<int>& vertex, Positions& X);

}   // namespace meshfolio
