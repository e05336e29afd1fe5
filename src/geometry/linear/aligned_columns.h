/// @file
/// n × 4 numbers, each row in one half of a cache line. Private to the layer.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>

#include "base/linux_only.h"
#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// An n × 4 matrix by rows: three coordinates and a zero.
class FourColumns {
public:
    static constexpr int width = 4;

    FourColumns() = default;
    /// Allocates the numbers without setting them.
    explicit FourColumns(Eigen::Index rows)
        : rows_(rows), numbers_(static_cast<double*>(std::aligned_alloc(alignment_for(rows), bytes_of(rows)))) {
        if (rows > 0 && numbers_ == nullptr) throw std::bad_alloc();
        prefer_large_pages(data(), numbers_bytes(rows));   // the padding after them stays untouched
    }

    Eigen::Index rows() const { return rows_; }
    double* data() { return numbers_.get(); }
    const double* data() const { return numbers_.get(); }
    double* row(Eigen::Index i) { return numbers_.get() + width * i; }
    const double* row(Eigen::Index i) const { return numbers_.get() + width * i; }

private:
    static constexpr std::size_t line = 64, large_page = std::size_t{2} << 20;   // bytes
    static std::size_t numbers_bytes(Eigen::Index rows) { return sizeof(double) * width * static_cast<std::size_t>(rows); }
    static std::size_t alignment_for(Eigen::Index rows) { return numbers_bytes(rows) < large_page ? line : large_page; }
    static std::size_t bytes_of(Eigen::Index rows) {
        const std::size_t unit = alignment_for(rows);
        return (numbers_bytes(rows) + unit - 1) / unit * unit;
    }
    struct Free {
        void operator()(double* p) const { std::free(p); }
    };
    Eigen::Index rows_ = 0;
    std::unique_ptr<double[], Free> numbers_;
};

using Four = Eigen::Array4d;   // a row
using FourRow = Eigen::Map<Four, Eigen::Aligned32>;
using ConstFourRow = Eigen::Map<const Four, Eigen::Aligned32>;
inline FourRow row_of(FourColumns& X, Eigen::Index i) { return FourRow(X.row(i)); }
inline ConstFourRow row_of(const FourColumns& X, Eigen::Index i) { return ConstFourRow(X.row(i)); }

}   // namespace meshfolio
