// PETSc and MUMPS factor (Amestoy et al. 2001), SLEPc's Krylov–Schur finds eigenpairs (Hernandez, Roman & Vidal 2005). The first process
// broadcasts each task, and all do it. It sends rows of matrices and vectors in blocks.
#include "geometry/distributed/ranks.h"

#include "base/errors.h"

#ifdef MESHFOLIO_WITH_SLEPC

#include "geometry/distributed/petsc_objects.h"

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace meshfolio {

namespace {

enum class Task : int { leave, factor, pivots, solve, eigenpairs };
struct Call {
    Task task;
    int n = 0, other = 0;   // rows, columns or pairs; 1 if definite, or the number of known pairs
};

class RanksOfMpi final : public Ranks {
public:
    RanksOfMpi() {
        PetscOptionsSetValue(nullptr, "-no_signal_handler", "1");   // the program has its own
        PetscOptionsSetValue(nullptr, "-skip_petscrc", "1");
        if (SlepcInitializeNoArguments() != 0) throw EngineError("MPI, PETSc or SLEPc does not start", "run it by mpirun");
        PetscPushErrorHandler(keep_message, &message_);
        MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
        MPI_Comm_size(PETSC_COMM_WORLD, &size_);
        MPI_Comm_dup(PETSC_COMM_WORLD, &calls_);
    }
    /// If a process ends without the others, with an exit code other than 0, mpirun ends them all.
    ~RanksOfMpi() override {
        if (is_first()) broadcast({Task::leave});
        MPI_Request all = MPI_REQUEST_NULL;
        if (!failed_alone_) MPI_Ibarrier(calls_, &all);
        if (failed_alone_ || !ends_within(all, patience)) {
            factor_.abandon();
            return;
        }
        factor_.fresh();
        MPI_Comm_free(&calls_);
        SlepcFinalize();
    }
    RanksOfMpi(const RanksOfMpi&) = delete;
    RanksOfMpi& operator=(const RanksOfMpi&) = delete;

    bool is_first() const override { return rank_ == 0; }

    void serve() override {
        std::optional<SolverError>
            failure;   // of all ranks, or of this one alone: then the first waits in the failed task, and calls no more
        for (;;) {
            const Call call = next_call(failure);
            if (call.task == Task::leave) return;
            failure.reset();
            try {
                take_part(call);
            } catch (const SolverError& error) {
                failure = error;
            }
        }
    }

    void factor(const SparseMatrix& S, bool definite) override {
        broadcast({Task::factor, static_cast<int>(S.rows()), definite ? 1 : 0});
        factor_here(&S, static_cast<PetscInt>(S.rows()), definite);
    }
    int negative_pivots() override {
        broadcast({Task::pivots});
        return pivots_here();
    }
    long long nonzeros() override {
        PetscInt entries = 0;
        check(MatMumpsGetInfog(factor_, 29, &entries));
        return entries < 0 ? -1'000'000LL * entries : entries;   // MUMPS: then in millions
    }
    DenseMatrix solve(const DenseMatrix& B) override {
        broadcast({Task::solve, static_cast<int>(B.cols())});
        DenseMatrix X = B;
        solve_here(static_cast<int>(B.cols()), &X);
        return X;
    }
    InversePairs largest_of_inverse(int count, const DenseMatrix& known) override {
        broadcast({Task::eigenpairs, count, static_cast<int>(known.cols())});
        InversePairs pairs{Vector(count), DenseMatrix(known.rows(), count)};
        eigenpairs_here(count, static_cast<int>(known.cols()), &known, &pairs);
        return pairs;
    }

private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds patience{60};   // for the other ranks

    void check(PetscErrorCode code) const {
        if (code == 0) return;
        if (code == PETSC_ERR_MEM)
            throw SolverError("rank " + std::to_string(rank_) + ": out of memory",
                              "start more ranks (mpirun -n N), or use machines with more memory");
        throw SolverError("PETSc failed on rank " + std::to_string(rank_) + ": " + message_, "take more ranks, or run without mpirun");
    }

    /// Waits without using the processor, since the first may work alone for long; returns false at the limit.
    static bool ends_within(MPI_Request& request, std::optional<std::chrono::seconds> limit) {
        const auto begin = Clock::now();
        for (int done = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE), done == 0;) {
            if (limit && Clock::now() - begin > *limit) return false;
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        return true;
    }
    void broadcast(Call call) const {
        MPI_Request sent = MPI_REQUEST_NULL;
        MPI_Ibcast(&call, sizeof call, MPI_BYTE, 0, calls_, &sent);
        ends_within(sent, patience);
    }
    Call next_call(const std::optional<SolverError>& failure) {
        Call call{Task::leave};
        MPI_Request received = MPI_REQUEST_NULL;
        MPI_Ibcast(&call, sizeof call, MPI_BYTE, 0, calls_, &received);
        failed_alone_ = !ends_within(received, failure ? std::optional(patience) : std::nullopt);
        if (failed_alone_) throw SolverError(*failure);
        return call;
    }
    void take_part(const Call& call) {
        if (call.task == Task::factor) factor_here(nullptr, call.n, call.other != 0);
        if (call.task == Task::pivots) pivots_here();
        if (call.task == Task::solve) solve_here(call.n, nullptr);
        if (call.task == Task::eigenpairs) eigenpairs_here(call.n, call.other, nullptr, nullptr);
    }

    // The tasks, done by all ranks; data of the first rank is null in the others.

    Rows own_rows(const SparseMatrix* S) const {
        if (S != nullptr) {
            for (int r = 1; r < size_; ++r) {
                const Rows rows = rows_of(*S, begin_[at(r)], begin_[at(r + 1)]);
                MPI_Send(rows.start.data(), static_cast<int>(rows.start.size()), MPIU_INT, r, 0, calls_);
                MPI_Send(rows.column.data(), static_cast<int>(rows.column.size()), MPIU_INT, r, 1, calls_);
                MPI_Send(rows.value.data(), static_cast<int>(rows.value.size()), MPI_DOUBLE, r, 2, calls_);
            }
            return rows_of(*S, 0, begin_[1]);
        }
        Rows rows;
        rows.start.resize(static_cast<std::size_t>(own_count() + 1));
        MPI_Recv(rows.start.data(), own_count() + 1, MPIU_INT, 0, 0, calls_, MPI_STATUS_IGNORE);
        rows.column.resize(static_cast<std::size_t>(rows.start.back()));
        rows.value.resize(rows.column.size());
        MPI_Recv(rows.column.data(), rows.start.back(), MPIU_INT, 0, 1, calls_, MPI_STATUS_IGNORE);
        MPI_Recv(rows.value.data(), rows.start.back(), MPI_DOUBLE, 0, 2, calls_, MPI_STATUS_IGNORE);
        return rows;
    }

    void factor_here(const SparseMatrix* S, PetscInt n, bool definite) {
        begin_.clear();
        for (int r = 0; r <= size_; ++r) begin_.push_back(static_cast<int>(static_cast<long long>(n) * r / size_));
        counts_.clear();
        for (int r = 0; r < size_; ++r) counts_.push_back(begin_[at(r + 1)] - begin_[at(r)]);
        factor_.fresh();   // frees its memory before the next factor
        OwnedMat A;
        {
            const Rows rows = own_rows(S);
            check(MatCreateMPIAIJWithArrays(PETSC_COMM_WORLD, own_count(), own_count(), n, n, rows.start.data(), rows.column.data(),
                                            rows.value.data(), A.fresh()));
        }
        check(MatSetOption(A, definite ? MAT_SPD : MAT_SYMMETRIC, PETSC_TRUE));
        check(MatGetFactor(A, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor_.fresh()));
        if (!definite) {
            check(MatMumpsSetIcntl(factor_, 13, 1));    // else the pivots of the last front are not counted
            check(MatMumpsSetIcntl(factor_, 14, 60));   // per cent of room for delayed pivots
        }
        MatFactorInfo info;
        check(MatFactorInfoInitialize(&info));
        check(MatCholeskyFactorSymbolic(factor_, A, nullptr, &info));
        check(MatCholeskyFactorNumeric(factor_, A, &info));
        MatFactorError error = MAT_FACTOR_NOERROR;
        check(MatFactorGetError(factor_, &error));
        if (error == MAT_FACTOR_OUTMEMORY)
            throw SolverError("the factor needs more memory than a rank has",
                              "start more ranks (mpirun -n N), or use machines with more memory");
        PetscInt negative = 0;
        if (definite) check(MatMumpsGetInfog(factor_, 12, &negative));   // MUMPS goes on after a negative pivot
        if (error == MAT_FACTOR_NOERROR && negative == 0) return;
        throw SolverError(definite ? "the matrix is not positive definite"
                                   : "the matrix is too close to singular to factor (a pivot was lost in rounding)");
    }

    int pivots_here() {
        PetscInt negative = 0;
        check(MatGetInertia(factor_, &negative, nullptr, nullptr));   // a pivot of 0 has no factor
        return negative;
    }

    void make_vector(OwnedVec& x) const { check(VecCreateMPI(PETSC_COMM_WORLD, own_count(), begin_.back(), x.fresh())); }
    /// Distributes a column of the first process's matrix to all; gather() collects it.
    void scatter(const double* column, Vec x) const {
        double* own = nullptr;
        check(VecGetArrayWrite(x, &own));
        MPI_Scatterv(column, counts_.data(), begin_.data(), MPI_DOUBLE, own, own_count(), MPI_DOUBLE, 0, calls_);
        check(VecRestoreArrayWrite(x, &own));
    }
    void gather(Vec x, double* column) const {
        const double* own = nullptr;
        check(VecGetArrayRead(x, &own));
        MPI_Gatherv(own, own_count(), MPI_DOUBLE, column, counts_.data(), begin_.data(), MPI_DOUBLE, 0, calls_);
        check(VecRestoreArrayRead(x, &own));
    }

    void solve_here(int columns, DenseMatrix* X) {
        OwnedVec b, x;
        make_vector(b);
        make_vector(x);
        for (int j = 0; j < columns; ++j) {
            double* const column = X != nullptr ? X->col(j).data() : nullptr;
            scatter(column, b);
            check(MatSolve(factor_, b, x));
            gather(x, column);
        }
    }

    static PetscErrorCode apply_inverse(Mat shell, Vec x, Vec y) {
        RanksOfMpi* self = nullptr;
        const PetscErrorCode code = MatShellGetContext(shell, &self);
        return code != 0 ? code : MatSolve(self->factor_, x, y);
    }

    void eigenpairs_here(int count, int known_count, const DenseMatrix* known, InversePairs* pairs) {
        OwnedMat inverse;
        check(MatCreateShell(PETSC_COMM_WORLD, own_count(), own_count(), begin_.back(), begin_.back(), this, inverse.fresh()));
        check(MatShellSetOperation(inverse, MATOP_MULT, reinterpret_cast<void (*)()>(apply_inverse)));
        std::vector<OwnedVec> owned(static_cast<std::size_t>(known_count));
        std::vector<Vec> deflated;
        for (OwnedVec& vector : owned) {
            make_vector(vector);
            scatter(known != nullptr ? known->col(static_cast<Eigen::Index>(deflated.size())).data() : nullptr, vector);
            deflated.push_back(vector);
        }
        OwnedEps solver;
        check(EPSCreate(PETSC_COMM_WORLD, solver.fresh()));
        check(EPSSetOperators(solver, inverse, nullptr));
        check(EPSSetProblemType(solver, EPS_HEP));
        check(EPSSetWhichEigenpairs(solver, EPS_LARGEST_REAL));
        check(EPSSetDimensions(solver, count, PETSC_DEFAULT, PETSC_DEFAULT));
        check(EPSSetTolerances(solver, 1e-12, 1000));
        check(EPSSetDeflationSpace(solver, known_count, deflated.data()));
        check(EPSSolve(solver));
        PetscInt converged = 0;
        check(EPSGetConverged(solver, &converged));
        if (converged < count)
            throw SolverError("Krylov-Schur found " + std::to_string(converged) + " of " + std::to_string(count) + " eigenpairs",
                              "ask for fewer");
        OwnedVec y;
        make_vector(y);
        for (int j = 0; j < count; ++j) {
            PetscScalar theta = 0;
            check(EPSGetEigenpair(solver, j, &theta, nullptr, y, nullptr));
            gather(y, pairs != nullptr ? pairs->Y.col(j).data() : nullptr);
            if (pairs != nullptr) pairs->theta[j] = theta;
        }
    }

    static std::size_t at(int r) { return static_cast<std::size_t>(r); }
    PetscInt own_count() const { return counts_[at(rank_)]; }

    std::string message_;   // of PETSc's last error
    MPI_Comm calls_ = MPI_COMM_NULL;
    int rank_ = 0, size_ = 1;
    bool failed_alone_ = false;
    std::vector<int> begin_, counts_;   // rows of each rank: the first row (and the end), and the number
    OwnedMat factor_;
};

}   // namespace

std::unique_ptr<Ranks> ranks_of_mpi() { return std::make_unique<RanksOfMpi>(); }

}   // namespace meshfolio

#else

std::unique_ptr<meshfolio::Ranks> meshfolio::ranks_of_mpi() {
    throw EngineError("this program was built without the backend slepc",
                      "leave --backend out, or configure with -DMESHFOLIO_SLEPC=ON (Debian: apt install slepc-dev petsc-dev)");
}

#endif
