#include "geometry/spectrum/engine/block_lanczos.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/linear/dense_eigenpairs.h"
#include "geometry/linear/panel_kernels.h"
#include "geometry/linear/random_numbers.h"

namespace meshfolio {

namespace {

using Small = EightColumns::Small;
constexpr int width = EightColumns::width;

/// Sums over the rows are taken in chunks of this many, whether by one thread or by several.
constexpr Eigen::Index chunk_rows = 16 * panel_rows;

template <class Work>   // (chunk, first row, last row)
void for_each_chunk(Eigen::Index rows, bool parallel, const Work& work) {
    const Eigen::Index chunks = (rows + chunk_rows - 1) / chunk_rows;
    const auto one = [&](Eigen::Index c) { work(c, c * chunk_rows, std::min(rows, (c + 1) * chunk_rows)); };
    if (parallel)
        tbb::parallel_for(Eigen::Index{0}, chunks, one);
    else
        for (Eigen::Index c = 0; c < chunks; ++c) one(c);
}

Small small_at(const std::vector<double>& G, std::size_t block) { return Eigen::Map<const Small>(G.data() + 64 * block); }

}   // namespace

SpectrumTimes& SpectrumTimes::operator+=(const SpectrumTimes& other) {
    factor += other.factor;
    solve += other.solve;
    orthogonalise += other.orthogonalise;
    rayleigh_ritz += other.rayleigh_ritz;
    return *this;
}

BlockLanczos::BlockLanczos(const LdltPanels& factor, const ZeroModes& zeros, const std::vector<const EightColumns*>& locked,
                           const Setting& setting)
    : factor_(factor), zeros_(zeros), setting_(setting), n_(factor.size), locked_count_(locked.size()) {
    if (setting.parallel) subtrees_.emplace(factor);
    for (const EightColumns* block : locked) all_.push_back(block->data());
    // Drawn by the matrix's rows, not by the order of elimination.
    EightColumns W(n_);
    std::vector<int> place(static_cast<std::size_t>(n_));
    for (std::size_t i = 0; i < place.size(); ++i) place[static_cast<std::size_t>(factor.order[i])] = static_cast<int>(i);
    std::uint64_t state = 0x9e3779b97f4a7c15ULL * (setting.seed + 1);
    for (const int i : place) std::generate_n(W.row(i), width, [&] { return uniform_number(state); });
    zeros_.project_out(W, setting_.parallel);
    normalise(W, orthogonalise(W), {}, nullptr);
    V_.push_back(std::move(W));
    all_.push_back(V_.back().data());
}

std::vector<double> BlockLanczos::sweep(std::span<double* const> W, Blocks S, const double* G, Blocks P, const Small* T) const {
    const std::size_t size = 64 * P.size() * W.size();
    const auto chunks = static_cast<std::size_t>((n_ + chunk_rows - 1) / chunk_rows);
    EightColumns parts(static_cast<Eigen::Index>(chunks * size / width));   // aligned
    EightColumns coefficients(static_cast<Eigen::Index>(width * S.size() * W.size()));
    std::copy_n(G, 64 * S.size() * W.size(), coefficients.data());
    alignas(64) double transform[64];
    if (T != nullptr) std::copy_n(T->data(), 64, transform);
    for_each_chunk(n_, setting_.parallel, [&](Eigen::Index c, Eigen::Index first, Eigen::Index last) {
        double* const part = parts.data() + static_cast<std::size_t>(c) * size;
        std::fill_n(part, size, 0.0);
        for (Eigen::Index r = first; r < last; r += panel_rows) {   // a panel of S and P serves every W
            const Eigen::Index end = std::min(last, r + panel_rows);
            for (std::size_t t = 0; t < W.size(); ++t) {
                if (!S.empty()) subtract_combination(S, coefficients.data() + 64 * S.size() * t, r, end, W[t]);
                if (T != nullptr) multiply_rows(transform, r, end, W[t]);
                if (!P.empty()) add_products(P, W[t], r, end, part + 64 * P.size() * t);
            }
        }
    });
    std::vector<double> sums(size, 0.0);
    for (std::size_t c = 0; c < chunks; ++c)
        for (std::size_t i = 0; i < size; ++i) sums[i] += parts.data()[c * size + i];
    return sums;
}

Small BlockLanczos::orthogonalise(EightColumns& W) const {
    const std::vector<double> G = sweep(W.data(), {}, nullptr, all_);
    const double* const block = W.data();
    return small_at(sweep(W.data(), all_, G.data(), {&block, 1}), 0);
}

Small BlockLanczos::orthogonalise_with_last(EightColumns& W) {
    const Blocks before = Blocks(all_).first(all_.size() - 1);
    double* const both[] = {V_.back().data(), W.data()};
    const std::vector<double> G = sweep(both, {}, nullptr, before);
    watch_.compare(Eigen::Map<const Vector>(G.data(), Eigen::Index(64 * before.size())).cwiseAbs().maxCoeff());
    const double *const last = V_.back().data(), *const next = W.data();
    const std::vector<double> A = sweep(both, before, G.data(), {&last, 1});
    return small_at(sweep(W.data(), {&last, 1}, A.data() + 64, {&next, 1}), 0);
}

bool BlockLanczos::keep_orthogonal(EightColumns& W, Small& gram) {
    constexpr double allowed = 1e-9;   // as much of the others may an eigenvector have in it; none where it is to be polished
    if (locked_count_ > 0 || setting_.refine_with != nullptr) {
        gram = orthogonalise(W);
        return true;
    }
    const Eigen::SelfAdjointEigenSolver<Small> spectral(gram);
    std::vector<Small> below = below_;
    below.push_back(spectral.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * spectral.eigenvectors().transpose());
    const bool lost = watch_.expect(diagonal_, below) > allowed && V_.size() > 1;
    if (lost) gram = orthogonalise_with_last(W);
    watch_.advance(lost);
    return lost;
}

/// Random columns, orthogonal to everything, where the Krylov space has no more to offer.
void BlockLanczos::fill_up(EightColumns& W, const Eigen::Array<bool, 8, 1>& lost) {
    std::uint64_t state = 0x9e3779b97f4a7c15ULL * (setting_.seed + 1000 + V_.size());
    EightColumns fresh(n_);
    for (Eigen::Index i = 0; i < n_; ++i)
        for (int c = 0; c < width; ++c) fresh.row(i)[c] = lost[c] ? uniform_number(state) : 0;
    zeros_.project_out(fresh);
    orthogonalise(fresh);
    const Small gram = orthogonalise(fresh);
    for (Eigen::Index i = 0; i < n_; ++i) {
        for (int c = 0; c < width; ++c)
            if (lost[c]) W.row(i)[c] = fresh.row(i)[c] / std::sqrt(gram(c, c));
    }
}

/// By the eigenvectors of WᵀW, again until rounding alone is left; directions that are rounding only are replaced.
Small BlockLanczos::normalise(EightColumns& W, Small gram, Blocks S, const double* G) {
    constexpr double lost_below = 1e-14, weak_below = 1e-5, orthonormal = 1e-13;
    Small R = Small::Identity();
    double* const to = W.data();
    for (int pass = 0; pass < 3; ++pass) {
        const Eigen::SelfAdjointEigenSolver<Small> spectral(0.5 * (gram + gram.transpose()));
        const Eigen::Array<double, 8, 1> length = spectral.eigenvalues().array().max(0).sqrt();
        const double floor = pass == 0 ? lost_below * std::max(scale_, length[7]) : 1e-3;
        const Eigen::Array<bool, 8, 1> lost = length <= floor;
        const Eigen::Array<double, 8, 1> inverse = lost.select(0, 1 / length.max(1e-300)), kept = lost.select(0, length);
        const Small& Q = spectral.eigenvectors();
        // The second time nearly the identity: Q Λ^∓½ Qᵀ keeps the columns where they are.
        Small T = Q * inverse.matrix().asDiagonal(), step = kept.matrix().asDiagonal() * Q.transpose();
        if (pass > 0) {
            T = T * Q.transpose();
            step = Q * step;
        }
        const double* const block = W.data();
        gram = small_at(sweep({&to, 1}, pass == 0 ? S : Blocks(), G, {&block, 1}, &T), 0);
        R = (step * R).eval();
        if (pass == 0 && lost.any()) fill_up(W, lost);
        if (pass == 0 && (lost.any() || length[0] < weak_below * std::max(scale_, length[7])))
            gram = orthogonalise(W);   // rounding has been enlarged
        if ((gram - Small::Identity()).cwiseAbs().maxCoeff() < orthonormal) break;
    }
    return R;
}

void BlockLanczos::invert(EightColumns& W) const {
    const auto solve = [&](EightColumns& X) {
        if (subtrees_)
            subtrees_->solve_in_place(X.data());
        else
            solve_in_place(factor_, X.data());
    };
    if (setting_.refine_with == nullptr) {
        solve(W);
        zeros_.project_out(W, setting_.parallel);
        return;
    }
    EightColumns rest(n_);   // W − (B − σI)X, then what is added to X
    std::copy_n(W.data(), width * n_, rest.data());
    solve(W);
    const SparseMatrix& B = *setting_.refine_with;
    tbb::parallel_for(Eigen::Index{0}, n_, [&](Eigen::Index i) {
        EightRow r(rest.row(i));
        r += setting_.sigma * EightRow(W.row(i));
        for (SparseMatrix::InnerIterator entry(B, i); entry; ++entry) r -= entry.value() * EightRow(W.row(entry.row()));
    });
    solve(rest);
    for (Eigen::Index i = 0; i < n_; ++i) EightRow(W.row(i)) += EightRow(rest.row(i));
    zeros_.project_out(W, setting_.parallel);
}

void BlockLanczos::advance() {
    const double start = seconds();
    const std::size_t j = V_.size() - 1;
    EightColumns W(n_);
    for_each_chunk(n_, setting_.parallel, [&](Eigen::Index, Eigen::Index first, Eigen::Index last) {
        std::copy(V_[j].row(first), V_[j].row(last), W.row(first));   // and the first touch of W's memory
    });
    invert(W);
    const double solved = seconds();
    times.solve += solved - start;

    // Against the two blocks that the recurrence names, twice, for what rounding brought back, the second time when W is normalised;
    // against all where it must be.
    const double* const named[] = {V_[j > 0 ? j - 1 : j].data(), V_[j].data(), W.data()};
    const Small before = j > 0 ? Small(below_[j - 1].transpose()) : Small::Zero();
    Small A = small_at(sweep(W.data(), {named, 1}, before.data(), {named + 1, 1}), 0);
    const Blocks local(named + (j > 0 ? 0 : 1), named + 2);
    const std::vector<double> G = sweep(W.data(), {named + 1, 1}, A.data(), {local.data(), local.size() + 1});
    Small gram = small_at(G, local.size());
    for (std::size_t i = 0; i < local.size(); ++i) gram -= small_at(G, i).transpose() * small_at(G, i);
    A += small_at(G, local.size() - 1);
    diagonal_.push_back(0.5 * (A + A.transpose()));
    scale_ = std::max(scale_, A.norm());
    const bool clean = keep_orthogonal(W, gram);
    below_.push_back(normalise(W, gram, clean ? Blocks() : local, G.data()));
    V_.push_back(std::move(W));
    all_.push_back(V_.back().data());
    times.orthogonalise += seconds() - solved;
}

RitzPairs BlockLanczos::ritz_pairs() {
    const double start = seconds();
    const int m = basis_size();
    const auto steps = diagonal_.size();
    DenseMatrix T = DenseMatrix::Zero(m, m);
    for (std::size_t j = 0; j < steps; ++j) {
        const auto at = static_cast<Eigen::Index>(width * j);
        T.block<8, 8>(at, at) = diagonal_[j];
        if (j + 1 < steps) T.block<8, 8>(at + 8, at) = below_[j];   // only the lower triangle is read
    }
    const DenseEigenpairs small = dense_eigenpairs(T);
    std::vector<int> order(static_cast<std::size_t>(m));
    std::iota(order.begin(), order.end(), 0);
    const Vector mu = setting_.sigma + small.values.array().inverse();
    std::sort(order.begin(), order.end(), [&](int a, int b) { return mu[a] < mu[b]; });
    RitzPairs pairs{mu(order), small.values(order), Vector(m), small.vectors(Eigen::all, order)};
    const DenseMatrix beyond = below_.back() * pairs.S.bottomRows<8>();
    const Vector distance = pairs.theta.cwiseInverse();
    pairs.residual = beyond.colwise().norm().transpose().array() * distance.array().square() / pairs.mu.array().abs();
    times.rayleigh_ritz += seconds() - start;
    return pairs;
}

std::vector<EightColumns> BlockLanczos::take_vectors(const RitzPairs& pairs, std::span<const int> chosen) {
    const double start = seconds();
    const auto groups = (chosen.size() + width - 1) / width;
    const auto blocks = V_.size();
    std::vector<EightColumns> G;
    for (std::size_t g = 0; g < groups; ++g) {
        EightColumns& coordinates = G.emplace_back(static_cast<Eigen::Index>(width * blocks));
        std::fill_n(coordinates.data(), 64 * blocks, 0.0);
        for (std::size_t c = 0; c < width && width * g + c < chosen.size(); ++c) {
            const int i = chosen[width * g + c];
            const Eigen::Matrix<double, 8, 1> beyond = below_.back() * pairs.S.col(i).tail<8>() / pairs.theta[i];
            Vector y(static_cast<Eigen::Index>(width * blocks));
            y << pairs.S.col(i), beyond;
            y /= -y.norm();   // the kernel subtracts
            for (Eigen::Index r = 0; r < y.size(); ++r) coordinates.row(r)[c] = y[r];
        }
    }
    for_each_chunk(n_, setting_.parallel, [&](Eigen::Index, Eigen::Index first, Eigen::Index last) {
        std::vector<EightColumns> X;   // one panel of each group
        for (std::size_t g = 0; g < groups; ++g) X.emplace_back(panel_rows);
        std::vector<const double*> basis(blocks);
        for (Eigen::Index r = first; r < last; r += panel_rows) {   // a panel of the whole basis serves all groups
            const Eigen::Index rows = std::min(panel_rows, last - r);
            for (std::size_t b = 0; b < blocks; ++b) basis[b] = V_[b].row(r);
            for (std::size_t g = 0; g < groups; ++g) {
                std::fill_n(X[g].data(), width * rows, 0.0);
                subtract_combination(basis, G[g].data(), 0, rows, X[g].data());
            }
            for (std::size_t g = 0; g < groups; ++g) std::copy_n(X[g].data(), width * rows, V_[g].row(r));
        }
    });
    all_.clear();
    V_.resize(groups);
    times.rayleigh_ritz += seconds() - start;
    return std::move(V_);
}

}   // namespace meshfolio
