#include "geometry/block_lanczos.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <numeric>

#include "geometry/panel_kernels.h"

namespace meshfolio {

namespace {

using Small = EightColumns::Small;
constexpr int width = EightColumns::width;

/// Sums over the rows are taken in chunks of this many, whether by one thread or by several.
constexpr Eigen::Index chunk_rows = 64 * panel_rows;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

template <class Work>   // (chunk, first row, last row)
void for_each_chunk(Eigen::Index rows, bool parallel, const Work& work) {
    const Eigen::Index chunks = (rows + chunk_rows - 1) / chunk_rows;
    const auto one = [&](Eigen::Index c) { work(c, c * chunk_rows, std::min(rows, (c + 1) * chunk_rows)); };
    if (parallel) {
        tbb::parallel_for(Eigen::Index{0}, chunks, one);
    } else {
        for (Eigen::Index c = 0; c < chunks; ++c) one(c);
    }
}

/// Uniform in (−½, ½), the same on every machine (splitmix64, Steele et al. 2014).
double random_number(std::uint64_t& state) {
    state += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53 - 0.5;
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

BlockLanczos::BlockLanczos(const LdltPanels& factor, const ZeroModes& zeros, std::vector<const EightColumns*> locked,
                           const Setting& setting)
    : factor_(factor), zeros_(zeros), setting_(setting), n_(factor.size), locked_count_(locked.size()) {
    for (const EightColumns* block : locked) all_.push_back(block->data());
    // Drawn by the matrix's rows, not by the order of elimination.
    EightColumns W(n_);
    std::vector<int> place(static_cast<std::size_t>(n_));
    for (std::size_t i = 0; i < place.size(); ++i) place[static_cast<std::size_t>(factor.order[i])] = static_cast<int>(i);
    std::uint64_t state = 0x9e3779b97f4a7c15ULL * (setting.seed + 1);
    for (const int i : place) std::generate_n(W.row(i), width, [&] { return random_number(state); });
    zeros_.project_out(W);
    std::vector<double> G;
    orthogonalise(W, G);
    normalise(W);
    V_.push_back(std::move(W));
    all_.push_back(V_.back().data());
}

std::vector<double> BlockLanczos::products(const std::vector<const double*>& V, const EightColumns& W) const {
    const std::size_t size = 64 * V.size();
    const auto chunks = static_cast<std::size_t>((n_ + chunk_rows - 1) / chunk_rows);
    std::vector<double, std::allocator<double>> sums(size, 0.0);
    EightColumns parts(static_cast<Eigen::Index>(chunks * size / width));   // aligned
    for_each_chunk(n_, setting_.parallel, [&](Eigen::Index c, Eigen::Index first, Eigen::Index last) {
        double* const part = parts.data() + static_cast<std::size_t>(c) * size;
        std::fill_n(part, size, 0.0);
        add_products(V, W.data(), first, last, part);
    });
    for (std::size_t c = 0; c < chunks; ++c) {
        for (std::size_t i = 0; i < size; ++i) sums[i] += parts.data()[c * size + i];
    }
    return sums;
}

void BlockLanczos::subtract(const std::vector<const double*>& V, const double* G, EightColumns& W) const {
    EightColumns aligned(static_cast<Eigen::Index>(width * V.size()));
    std::copy_n(G, 64 * V.size(), aligned.data());
    for_each_chunk(n_, setting_.parallel, [&](Eigen::Index, Eigen::Index first, Eigen::Index last) {
        subtract_combination(V, aligned.data(), first, last, W.data());
    });
}

void BlockLanczos::orthogonalise(EightColumns& W, std::vector<double>& G) const {
    G = products(all_, W);
    subtract(all_, G.data(), W);
}

/// Random columns, orthogonal to everything, where the Krylov space has no more to offer.
void BlockLanczos::fill_up(EightColumns& W, const Eigen::Array<bool, 8, 1>& lost) {
    std::uint64_t state = 0x9e3779b97f4a7c15ULL * (setting_.seed + 1000 + V_.size());
    EightColumns fresh(n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
        for (int c = 0; c < width; ++c) fresh.row(i)[c] = lost[c] ? random_number(state) : 0;
    }
    zeros_.project_out(fresh);
    std::vector<double> G;
    for (int pass = 0; pass < 2; ++pass) orthogonalise(fresh, G);
    const Small gram = Eigen::Map<const Small>(products({fresh.data()}, fresh).data());
    for (Eigen::Index i = 0; i < n_; ++i) {
        for (int c = 0; c < width; ++c) {
            if (lost[c]) W.row(i)[c] = fresh.row(i)[c] / std::sqrt(gram(c, c));
        }
    }
}

/// Twice by the eigenvectors of WᵀW; directions that are rounding only are replaced.
Small BlockLanczos::normalise(EightColumns& W) {
    constexpr double lost_below = 1e-14, weak_below = 1e-5;
    Small R = Small::Identity();
    std::vector<double> G;
    for (int pass = 0; pass < 3; ++pass) {
        const Small gram = Eigen::Map<const Small>(products({W.data()}, W).data());
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
        EightColumns V(n_);
        std::memset(V.data(), 0, sizeof(double) * width * static_cast<std::size_t>(n_));
        T = -T;
        subtract({W.data()}, T.data(), V);
        W = std::move(V);
        R = (step * R).eval();
        if (pass == 0 && lost.any()) fill_up(W, lost);
        if (pass == 0 && (lost.any() || length[0] < weak_below * std::max(scale_, length[7])))
            orthogonalise(W, G);   // rounding has been enlarged
        if (pass > 0 && (gram - Small::Identity()).cwiseAbs().maxCoeff() < 1e-8) break;
    }
    return R;
}

void BlockLanczos::invert(EightColumns& W) const {
    using Eight = Eigen::Map<Eigen::Array<double, width, 1>>;
    if (setting_.refine_with == nullptr) {
        solve_in_place(factor_, W.data());
        zeros_.project_out(W);
        return;
    }
    EightColumns rest(n_);   // W − (B − σI)X, then what is added to X
    std::copy_n(W.data(), width * n_, rest.data());
    solve_in_place(factor_, W.data());
    const SparseMatrix& B = *setting_.refine_with;
    tbb::parallel_for(Eigen::Index{0}, n_, [&](Eigen::Index i) {
        Eight r(rest.row(i));
        r += setting_.sigma * Eight(W.row(i));
        for (SparseMatrix::InnerIterator entry(B, i); entry; ++entry) r -= entry.value() * Eight(W.row(entry.row()));
    });
    solve_in_place(factor_, rest.data());
    for (Eigen::Index i = 0; i < n_; ++i) Eight(W.row(i)) += Eight(rest.row(i));
    zeros_.project_out(W);
}

void BlockLanczos::advance() {
    const double start = seconds();
    const std::size_t j = V_.size() - 1;
    EightColumns W(n_);
    std::memcpy(W.data(), V_[j].data(), sizeof(double) * width * static_cast<std::size_t>(n_));
    invert(W);
    const double solved = seconds();
    times.solve += solved - start;

    if (j > 0) subtract({V_[j - 1].data()}, Small(below_[j - 1].transpose()).data(), W);
    Small A = small_at(products({V_[j].data()}, W), 0);
    subtract({V_[j].data()}, A.data(), W);
    std::vector<double> G;
    orthogonalise(W, G);
    A += small_at(G, locked_count_ + j);
    diagonal_.push_back(0.5 * (A + A.transpose()));
    scale_ = std::max(scale_, A.norm());
    below_.push_back(normalise(W));
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
    const Eigen::SelfAdjointEigenSolver<DenseMatrix> small(T);
    std::vector<int> order(static_cast<std::size_t>(m));
    std::iota(order.begin(), order.end(), 0);
    const Vector mu = setting_.sigma + small.eigenvalues().array().inverse();
    std::sort(order.begin(), order.end(), [&](int a, int b) { return mu[a] < mu[b]; });
    RitzPairs pairs{mu(order), small.eigenvalues()(order), Vector(m), small.eigenvectors()(Eigen::all, order)};
    const DenseMatrix beyond = below_.back() * pairs.S.bottomRows<8>();
    const Vector distance = pairs.theta.cwiseInverse();
    pairs.residual = beyond.colwise().norm().transpose().array() * distance.array().square() / pairs.mu.array().abs();
    times.rayleigh_ritz += seconds() - start;
    return pairs;
}

std::vector<EightColumns> BlockLanczos::vectors(const RitzPairs& pairs, std::span<const int> chosen) {
    const double start = seconds();
    const auto groups = (chosen.size() + width - 1) / width;
    const auto blocks = V_.size();
    std::vector<EightColumns> X, G;
    for (std::size_t g = 0; g < groups; ++g) {
        X.emplace_back(n_);
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
    const std::vector<const double*> basis(all_.begin() + static_cast<std::ptrdiff_t>(locked_count_), all_.end());
    for_each_chunk(n_, setting_.parallel, [&](Eigen::Index, Eigen::Index first, Eigen::Index last) {
        for (Eigen::Index r = first; r < last; r += panel_rows) {   // a panel of the whole basis serves all groups
            const Eigen::Index end = std::min(last, r + panel_rows);
            for (std::size_t g = 0; g < groups; ++g) {
                std::fill(X[g].row(r), X[g].row(end), 0.0);
                subtract_combination(basis, G[g].data(), r, end, X[g].data());
            }
        }
    });
    times.rayleigh_ritz += seconds() - start;
    return X;
}

}   // namespace meshfolio
