#include "geometry/spectrum/engine/spectrum_modes.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/at.h"
#include "base/available_memory.h"
#include "base/errors.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {
namespace {

/// The number of vertices up to which a component is always solved densely: too few for Lanczos.
constexpr int always_dense = 100;

/// One component, in units where its own area is 1.
struct Part {
    std::vector<int> rows;   // of the whole operator, ascending
    SparseMatrix A;
    Vector M;
    double area = 0;   // of the whole, which is 1
    int wanted = 0;    // pairs
    Modes modes;

    int size() const { return static_cast<int>(rows.size()); }
    bool exhausted() const { return modes.pairs.count() == size(); }
    double value(int j) const { return modes.pairs.mu[j] / area; }   // in units of the whole
    double last_value() const { return value(modes.pairs.count() - 1); }
};

std::vector<Part> parts_of(const SparseMatrix& A, const Vector& M, const Components& components) {
    std::vector<Part> parts(at(components.count));
    std::vector<int> place(components.label.size());   // of a row within its component
    for (std::size_t i = 0; i < place.size(); ++i) {
        Part& part = parts[at(components.label[i])];
        place[i] = part.size();
        part.rows.push_back(static_cast<int>(i));
    }
    for (Part& part : parts) {
        part.M = M(part.rows);
        part.area = part.M.sum();
        part.M /= part.area;
        part.A.resize(part.size(), part.size());
        for (int j = 0; j < part.size(); ++j) {
            part.A.startVec(j);
            for (SparseMatrix::InnerIterator entry(A, part.rows[at(j)]); entry; ++entry) {
                const auto row = static_cast<std::size_t>(entry.row());
                const bool own = part.rows[at(place[row])] == entry.row();   // else an entry that is 0
                if (own) part.A.insertBack(place[row], j) = entry.value();
            }
        }
        part.A.finalize();
    }
    return parts;
}

/// Returns the pairs of a component below μ by Weyl's law, N(μ) ≈ area · μ / 4π, and its constant.
double weyl_share(const Part& part, double mu) { return std::min<double>(part.size(), 1 + part.area * mu / (4 * pi)); }

/// Sets the wanted pairs of each component: its share of the k smallest, and some more, so that their end is seen from above.
void set_first_shares(std::vector<Part>& parts, int k) {
    const auto sum = [&](double mu) {
        return std::accumulate(parts.begin(), parts.end(), 0.0, [&](double s, const Part& part) { return s + weyl_share(part, mu); });
    };
    double low = 0, high = 4 * pi * k;
    while (sum(high) < k) high *= 2;   // some have fewer vertices than Weyl's law gives pairs
    for (int i = 0; i < 60; ++i) (sum(0.5 * (low + high)) < k ? low : high) = 0.5 * (low + high);
    for (Part& part : parts) {
        const int share = static_cast<int>(std::ceil(weyl_share(part, high)));
        part.wanted = std::min({part.size(), k + 4, share + 4 + share / 20});
    }
}

bool goes_dense(const Part& part, const SpectrumOptions& options) { return part.size() <= std::max(always_dense, options.dense_below); }

void solve_densely(Part& part) {
    const int k = part.wanted;
    if (part.size() == 1) {
        part.modes.pairs = {Vector::Zero(1), DenseMatrix::Ones(1, 1)};   // its entry of A may be a rounding of 0
    } else {
        const SymmetricPairs all = dense_pairs(part.A, part.M);
        part.modes.pairs = {all.mu.head(k), all.Y.leftCols(k)};
    }
    part.modes.dense = true;
}

/// Solves parts and reports progress, never a smaller value than before; a part weighs as much as its vectors have entries.
class PartSolver {
public:
    PartSolver(std::vector<Part>& parts, const SpectrumOptions& options, double memory)
        : parts_(parts), options_(options), memory_(memory) {}

    void solve(const std::vector<Part*>& wanting) {
        const double from = reported_;
        double work = 0, done = 0;
        for (const Part* part : wanting) work += work_of(*part);
        const auto report = [&](double share) {
            reported_ = std::max(reported_, from + (0.95 - from) * share);
            if (options_.progress) options_.progress(reported_);
        };
        std::vector<Part*> small;
        for (Part* part : wanting)
            if (goes_dense(*part, options_)) small.push_back(part);
        tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::task_arena::automatic);
        arena.execute([&] { for_each_task(small.size(), [&](std::size_t i) { solve_densely(*small[i]); }); });
        for (const Part* part : small) done += work_of(*part);
        if (!small.empty()) report(done / work);
        for (Part* part : wanting) {
            if (goes_dense(*part, options_)) continue;
            SpectrumOptions own = options_;
            own.progress = [&](double share) { report((done + share * work_of(*part)) / work); };
            double held = 0;   // bytes
            for (const Part& other : parts_) held += 8.0 * other.size() * other.modes.pairs.count();
            if (memory_ > 0) own.memory_limit = std::max(1.0, memory_ - held);
            const int repairs = part->modes.repairs;
            part->modes = modes_of(part->A, part->M, part->wanted, own);
            part->modes.repairs += repairs;
            done += work_of(*part);
        }
    }

private:
    static double work_of(const Part& part) { return double(part.size()) * part.wanted; }

    std::vector<Part>& parts_;
    const SpectrumOptions& options_;
    double memory_;
    double reported_ = 0;
};

/// An eigenvalue of the merged spectrum: the j-th of its part.
struct Entry {
    double mu;
    std::size_t part;
    int j;
};

/// Returns all eigenvalues, ascending; equal ones in the order of the components.
std::vector<Entry> merged(const std::vector<Part>& parts) {
    std::vector<Entry> all;
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (int j = 0; j < parts[p].modes.pairs.count(); ++j) all.push_back({parts[p].value(j), p, j});
    std::stable_sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.mu < b.mu; });
    return all;
}

/// The merged spectrum, complete up to the upper end of `gap`, the first above its k-th entry.
struct Merged {
    std::vector<Entry> entries;
    Gap gap;
};

Merged solve_and_merge(std::vector<Part>& parts, int k, PartSolver& solver) {
    std::vector<Part*> wanting;
    for (Part& part : parts) wanting.push_back(&part);
    for (;;) {
        solver.solve(wanting);
        std::vector<Entry> entries = merged(parts);
        Vector mu(std::ssize(entries));
        std::transform(entries.begin(), entries.end(), mu.begin(), [](const Entry& entry) { return entry.mu; });
        const Gap gap = gap_behind(mu, k);
        wanting.clear();
        for (Part& part : parts) {
            if (part.exhausted() || part.last_value() >= gap.high) continue;
            const double growth = part.last_value() > 0 ? std::clamp(gap.high / part.last_value(), 1.0, 3.0) : 3;
            part.wanted = static_cast<int>(std::min<double>(part.size(), 1.05 * growth * part.wanted + 4));
            wanting.push_back(&part);
        }
        if (wanting.empty()) return {std::move(entries), gap};
    }
}

}   // namespace

Modes modes_of_components(const SparseMatrix& A, const Vector& M, const Components& components, int k, const SpectrumOptions& options) {
    const Eigen::Index n = A.rows();
    const double limit = options.memory_limit > 0 ? options.memory_limit : available_memory().bytes;
    const double left = limit > 0 ? limit - 8.0 * static_cast<double>(n) * k : 0;   // beside the k vectors of the whole; 0: not known
    if (limit > 0 && !(left > 0))
        throw SolverError("the vectors of " + std::to_string(k) + " eigenpairs of " + std::to_string(n) +
                              " vertices alone need more memory than is there",
                          "ask for fewer eigenpairs");
    std::vector<Part> parts = parts_of(A, M, components);
    set_first_shares(parts, k);
    PartSolver solver(parts, options, left);
    const Merged spectrum = solve_and_merge(parts, k, solver);

    Modes modes;
    modes.pairs = {Vector(k), DenseMatrix::Zero(n, k)};
    for (int j = 0; j < k; ++j) {
        const Entry& entry = spectrum.entries[at(j)];
        const Part& part = parts[entry.part];
        modes.pairs.mu[j] = entry.mu;
        for (int i = 0; i < part.size(); ++i) modes.pairs.Y(part.rows[at(i)], j) = part.modes.pairs.Y(i, entry.j);
    }
    modes.gap_middle = spectrum.gap.middle();
    modes.dense = A.rows() <= options.dense_below;
    for (const Part& part : parts) {
        modes.slices += part.modes.slices;
        modes.repairs += part.modes.repairs;
    }
    return modes;
}

}   // namespace meshfolio
