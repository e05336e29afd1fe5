#include "geometry/inertia.h"

#include "errors.h"
#include "geometry/sparse_factor.h"

namespace meshfolio {

int inertia_below(const SparseMatrix& A, const Vector& M, double sigma) {
    SparseMatrix diagonal(A.rows(), A.cols());
    diagonal = (-sigma * M).asDiagonal();
    return SparseFactor::ldlt(A + diagonal).negative_pivots();
}

std::optional<Inertia> inertia_between(const SparseMatrix& A, const Vector& M, double low, double high) {
    for (const double share : {0.5, 0.382, 0.618, 0.271, 0.733, 0.189, 0.817}) {
        const double sigma = low + share * (high - low);
        try {
            return Inertia{sigma, inertia_below(A, M, sigma)};
        } catch (const SolverError&) {   // a pivot was lost in rounding
        }
    }
    return {};
}

}   // namespace meshfolio
