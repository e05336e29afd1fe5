// Factorisations by CHOLMOD (Chen, Davis, Hager & Rajamanickam 2008) with AMD ordering: simplicial LDLᵀ, whose pivots give the
// inertia, and LLᵀ, supernodal for large matrices.
#ifdef MESHFOLIO_WITH_CHOLMOD

#include <cholmod.h>

#include <new>

#include "base/errors.h"
#include "geometry/linear/blas_turn.h"
#include "geometry/linear/factor_implementation.h"

namespace meshfolio {

namespace {

/// CHOLMOD's workspace and settings. It never prints.
class Common {
public:
    Common() {
        cholmod_start(&common_);
        common_.print = 0;
        common_.nmethods = 1;
        common_.method[0].ordering = CHOLMOD_AMD;
        common_.postorder = 1;
        common_.quick_return_if_not_posdef = 1;
    }
    ~Common() { cholmod_finish(&common_); }
    Common(const Common&) = delete;
    Common& operator=(const Common&) = delete;
    cholmod_common* operator->() { return &common_; }
    const cholmod_common* operator->() const { return &common_; }
    cholmod_common* get() { return &common_; }

    /// @throws std::bad_alloc; SolverError if CHOLMOD met sizes beyond its integers or was used wrongly
    void check(const char* what) const {
        if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
        if (common_.status < CHOLMOD_OK) throw SolverError(std::string(what) + ": CHOLMOD status " + std::to_string(common_.status));
    }

private:
    cholmod_common common_;
};

/// CHOLMOD's view of the lower triangle; nothing is copied, and CHOLMOD does not write to it.
cholmod_sparse lower_triangle(const SparseMatrix& A) {
    cholmod_sparse view = {};
    view.nrow = static_cast<std::size_t>(A.rows());
    view.ncol = static_cast<std::size_t>(A.cols());
    view.nzmax = static_cast<std::size_t>(A.nonZeros());
    view.p = const_cast<int*>(A.outerIndexPtr());
    view.i = const_cast<int*>(A.innerIndexPtr());
    view.x = const_cast<double*>(A.valuePtr());
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
}

cholmod_dense dense_view(const DenseMatrix& B) {
    cholmod_dense view = {};
    view.nrow = static_cast<std::size_t>(B.rows());
    view.ncol = static_cast<std::size_t>(B.cols());
    view.nzmax = static_cast<std::size_t>(B.size());
    view.d = view.nrow;
    view.x = const_cast<double*>(B.data());
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    return view;
}

class CholmodFactor final : public SparseFactor::Implementation {
public:
    explicit CholmodFactor(FactorKind factor_kind) { kind = factor_kind; }
    ~CholmodFactor() override { cholmod_free_factor(&L_, common_.get()); }
    CholmodFactor(const CholmodFactor&) = delete;
    CholmodFactor& operator=(const CholmodFactor&) = delete;

    void analyze(const SparseMatrix& A) override {
        common_->supernodal = supernodal ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
        common_->final_ll = kind == FactorKind::cholesky;
        cholmod_sparse view = lower_triangle(A);
        L_ = cholmod_analyze(&view, common_.get());
        common_.check("symbolic analysis");
    }

    bool factorize(const SparseMatrix& A) override {
        cholmod_sparse view = lower_triangle(A);
        const auto turn = turn_for_blas();
        cholmod_factorize(&view, L_, common_.get());
        common_.check("factorisation");
        return common_->status == CHOLMOD_OK && L_->minor == L_->n;
    }

    DenseMatrix solve(const DenseMatrix& B) const override {
        Common workspace;   // of this call alone, so that solves may run at the same time
        cholmod_dense view = dense_view(B);
        const auto turn = turn_for_blas();
        cholmod_dense* X = cholmod_solve(CHOLMOD_A, L_, &view, workspace.get());
        workspace.check("solve");
        DenseMatrix result = Eigen::Map<const DenseMatrix>(static_cast<const double*>(X->x), B.rows(), B.cols());
        cholmod_free_dense(&X, workspace.get());
        return result;
    }

    Vector pivots() const override {
        Vector d(static_cast<Eigen::Index>(L_->n));
        const int* permutation = static_cast<const int*>(L_->Perm);
        const auto put = [&](int column, double diagonal) { d[permutation[column]] = L_->is_ll ? diagonal * diagonal : diagonal; };
        L_->is_super ? visit_supernodal(put) : visit_simplicial(put);
        return d;
    }

    std::unique_ptr<Implementation> analysed_copy(const SparseMatrix&) const override {
        auto copy = std::make_unique<CholmodFactor>(kind);
        copy->rows = rows;
        copy->supernodal = supernodal;
        copy->common_->supernodal = common_->supernodal;
        copy->common_->final_ll = common_->final_ll;
        copy->L_ = cholmod_copy_factor(L_, copy->common_.get());
        copy->common_.check("copy of the symbolic analysis");
        return copy;
    }

    std::vector<int> order() const override {
        const int* permutation = static_cast<const int*>(L_->Perm);
        return {permutation, permutation + L_->n};
    }

    FactorColumn column(int j) const override {
        const int start = static_cast<const int*>(L_->p)[j] + 1;
        return {static_cast<const int*>(L_->nz)[j] - 1, static_cast<const int*>(L_->i) + start, static_cast<const double*>(L_->x) + start};
    }

    int supernodes() const override { return L_->is_super ? static_cast<int>(L_->nsuper) : 0; }
    Supernode supernode(int s) const override {
        const int *super = static_cast<const int*>(L_->super), *rows_start = static_cast<const int*>(L_->pi);
        return {super[s], super[s + 1] - super[s], rows_start[s + 1] - rows_start[s], static_cast<const int*>(L_->s) + rows_start[s],
                static_cast<const double*>(L_->x) + static_cast<const int*>(L_->px)[s]};
    }

    long long nonzeros() const override {
        if (L_->is_super) return static_cast<long long>(L_->xsize);
        const int* count = static_cast<const int*>(L_->xtype == CHOLMOD_PATTERN ? L_->ColCount : L_->nz);
        long long sum = 0;
        for (std::size_t j = 0; j < L_->n; ++j) sum += count[j];
        return sum;
    }

private:
    /// Column by column nothing reaches BLAS.
    std::unique_lock<std::mutex> turn_for_blas() const { return L_->is_super ? blas_turn() : std::unique_lock<std::mutex>(); }

    /// The diagonal comes first in each column.
    template <class Visit>
    void visit_simplicial(Visit visit) const {
        const int* start = static_cast<const int*>(L_->p);
        const double* value = static_cast<const double*>(L_->x);
        for (int j = 0; j < static_cast<int>(L_->n); ++j) visit(j, value[start[j]]);
    }

    /// Supernode s is a dense column-major block: columns super[s] … super[s+1] − 1, as many rows as pi[s+1] − pi[s].
    template <class Visit>
    void visit_supernodal(Visit visit) const {
        const int* super = static_cast<const int*>(L_->super);
        const int* rows_start = static_cast<const int*>(L_->pi);
        const int* value_start = static_cast<const int*>(L_->px);
        const double* value = static_cast<const double*>(L_->x);
        for (std::size_t s = 0; s < L_->nsuper; ++s) {
            const int block_rows = rows_start[s + 1] - rows_start[s];
            for (int j = super[s]; j < super[s + 1]; ++j) visit(j, value[value_start[s] + (j - super[s]) * (block_rows + 1)]);
        }
    }

    Common common_;
    cholmod_factor* L_ = nullptr;
};

}   // namespace

std::unique_ptr<SparseFactor::Implementation> factor_by_cholmod(FactorKind kind) { return std::make_unique<CholmodFactor>(kind); }

}   // namespace meshfolio

#endif
