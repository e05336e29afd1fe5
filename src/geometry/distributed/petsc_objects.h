/// @file
/// PETSc's objects as values, and rows of a matrix to send; only for builds with PETSc and SLEPc. Private to the layer.
#pragma once

#include <slepceps.h>

#include <string>
#include <vector>

#include "geometry/linear/sparse_types.h"

namespace meshfolio {

/// An error handler for PetscPushErrorHandler(): stores the first message in a std::string and prints nothing.
inline PetscErrorCode keep_message(MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType kind, const char* message,
                                   void* kept) {
    if (kind == PETSC_ERROR_INITIAL && message != nullptr) *static_cast<std::string*>(kept) = message;
    return code;
}

/// Owner of a PETSc object.
template <class Object, PetscErrorCode (*destroy)(Object*)> class Owned {
public:
    Owned() = default;
    ~Owned() { static_cast<void>(destroy(&object_)); }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    operator Object() const { return object_; }
    /// Destroys the object and returns the place for a new one.
    Object* fresh() {
        static_cast<void>(destroy(&object_));
        return &object_;
    }
    /// Leaves the object to the end of the process, if the other processes do not answer.
    void abandon() { object_ = nullptr; }

private:
    Object object_ = nullptr;
};
using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedEps = Owned<EPS, EPSDestroy>;

/// Rows of a matrix to send: the start of each, columns and numbers.
struct Rows {
    std::vector<PetscInt> start, column;
    std::vector<double> value;
};

/// Returns the rows [first, last). @param S  symmetric: its columns are its rows
inline Rows rows_of(const SparseMatrix& S, PetscInt first, PetscInt last) {
    Rows rows;
    const auto from = S.outerIndexPtr()[first], to = S.outerIndexPtr()[last];
    for (PetscInt i = first; i <= last; ++i) rows.start.push_back(S.outerIndexPtr()[i] - from);
    rows.column.assign(S.innerIndexPtr() + from, S.innerIndexPtr() + to);
    rows.value.assign(S.valuePtr() + from, S.valuePtr() + to);
    return rows;
}

}   // namespace meshfolio
