/// @file
/// PETSc's objects as values, and rows of a matrix to be sent. For who compiles with PETSc and SLEPc. Private to the layer.
#pragma once

#include <slepceps.h>

#include <string>
#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// For PetscPushErrorHandler(): the first message into a std::string, and nothing printed.
inline PetscErrorCode keep_message(MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType kind, const char* message,
                                   void* kept) {
    if (kind == PETSC_ERROR_INITIAL && message != nullptr) *static_cast<std::string*>(kept) = message;
    return code;
}

/// One of PETSc's objects.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
public:
    Owned() = default;
    ~Owned() { static_cast<void>(destroy(&object_)); }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    operator Object() const { return object_; }
    /// For a new one in its place.
    Object* fresh() {
        static_cast<void>(destroy(&object_));
        return &object_;
    }
    /// Left to the end of the process, where the others do not answer.
    void abandon() { object_ = nullptr; }

private:
    Object object_ = nullptr;
};
using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedEps = Owned<EPS, EPSDestroy>;

/// Rows of a matrix as they are sent: where each begins, columns and numbers.
struct Rows {
    std::vector<PetscInt> start, column;
    std::vector<double> value;
};

/// @param S  symmetric: its columns are its rows
inline Rows rows_of(const SparseMatrix& S, PetscInt first, PetscInt last) {
    Rows rows;
    const auto from = S.outerIndexPtr()[first], to = S.outerIndexPtr()[last];
    for (PetscInt i = first; i <= last; ++i) rows.start.push_back(S.outerIndexPtr()[i] - from);
    rows.column.assign(S.innerIndexPtr() + from, S.innerIndexPtr() + to);
    rows.value.assign(S.valuePtr() + from, S.valuePtr() + to);
    return rows;
}

}   // namespace meshfolio
