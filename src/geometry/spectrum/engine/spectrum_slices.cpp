#include "geometry/spectrum/engine/spectrum_slices.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <mutex>
#include <numeric>

#include "base/available_memory.h"
#include "base/errors.h"
#include "base/number_text.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {
namespace {

/// Sums the progress of all slices, for calls from several threads; reports one value at a time, never a smaller one.
class SharedProgress {
public:
    SharedProgress(const std::function<void(double)>& report, std::size_t slices) : report_(report), shares_(slices, 0.0) {}

    std::function<void(double)> of_slice(std::size_t i) {
        return [this, i](double share) {
            if (!report_) return;
            const std::lock_guard lock(mutex_);
            shares_[i] = std::max(shares_[i], share);
            report_(0.95 * std::accumulate(shares_.begin(), shares_.end(), 0.0) / static_cast<double>(shares_.size()));
        };
    }

private:
    const std::function<void(double)>& report_;
    std::mutex mutex_;
    std::vector<double> shares_;
};

/// Eigenvalues between two counts.
struct Slice {
    Count low, high;
    int wanted = high.others - low.others;   // all of them, or some of a cluster

    // Eigenvalues that rounding moves across a limit belong to the slice, too.
    double begin() const { return low.sigma * (1 - clear_gap); }
    double end() const { return high.sigma * (1 + clear_gap); }
    int held(const SymmetricPairs& pairs) const { return pairs.count_below(end()) - pairs.count_below(begin()); }
    SymmetricPairs own(const SymmetricPairs& pairs) const { return part_of(pairs, pairs.count_below(begin()), pairs.count_below(end())); }
    double width() const { return high.sigma - low.sigma; }
    bool can_be_halved() const { return wanted == high.others - low.others && width() > least_gap * high.sigma; }
    double middle() const { return 0.5 * (low.sigma + high.sigma); }
};

/// Returns −10⁻⁶ of an ordinary eigenvalue: small beside those sought, large enough for positive pivots. The median of the diagonal,
/// because needles raise its mean.
double sigma_below_zero(const SparseMatrix& B) {
    Vector diagonal = B.diagonal();
    double* const middle = diagonal.data() + diagonal.size() / 2;
    std::nth_element(diagonal.data(), middle, diagonal.data() + diagonal.size());
    return *middle > 0 ? -1e-6 * *middle : -1e-6;
}

/// Returns the first clear gap above the k-th of these pairs, besides the constant.
Gap gap_after(const SymmetricPairs& pairs, int k) {
    Vector mu(pairs.count() + 1);
    mu << 0, pairs.mu;
    return gap_behind(mu, k + 1);
}

/// Returns the last clear gap below the k-th pair.
Gap gap_before(const SymmetricPairs& pairs, int k) {
    Eigen::Index i = std::max(0, k - 1);
    while (i > 0 && pairs.mu[i] - pairs.mu[i - 1] <= clear_gap * pairs.mu[i]) --i;
    return {i > 0 ? pairs.mu[i - 1] : 0, pairs.mu[i]};
}

/// Returns the pairs of `right` without those that `left`, the slice below, has already, and orthogonal to its vectors.
SymmetricPairs beside(const SymmetricPairs& left, SymmetricPairs right) {
    constexpr double rounding = 1e-14, shared = 1e-3, new_direction = 0.1;
    if (left.count() == 0 || right.count() == 0) return right;
    const DenseMatrix overlap = left.Y.transpose() * right.Y;
    if (overlap.cwiseAbs().maxCoeff() <= rounding) return right;
    right.Y -= left.Y * overlap;
    std::vector<Eigen::Index> kept;
    for (Eigen::Index j = 0; j < right.count(); ++j) {
        auto y = right.Y.col(j);
        const bool in_both = overlap.col(j).cwiseAbs().maxCoeff() > shared;
        if (in_both) {   // of a cluster on the limit, in another basis
            y -= left.Y * (left.Y.transpose() * y).eval();
            for (const Eigen::Index i : kept) y -= right.Y.col(i) * right.Y.col(i).dot(y);
        }
        if (in_both && y.norm() < new_direction) continue;
        y.normalize();
        kept.push_back(j);
    }
    return {right.mu(kept), right.Y(Eigen::all, kept)};
}

class Slicer {
public:
    Slicer(const SpectrumProblem& problem, const SpectrumOptions& options) : problem_(problem), options_(options) {}

    Modes find(int k) {
        if (!(k <= options_.one_slice_up_to && find_in_one_slice(k)))
            find_in_slices(slice_limits(problem_, k, options_.pairs_per_slice), k);
        return united(k);
    }

private:
    /// Returns a shift among the k smallest by Weyl's law, N(μ) ≈ μ / 4π at area 1, if it holds: two steps of Lanczos a pair instead of
    /// three. Else a shift below 0.
    Shift shift_among_lowest(int k) const {
        const double sigma = 2 * pi * k;
        if (k > 4 && sigma < 0.5 * problem_.highest) {
            Shift shift = shift_near(problem_, sigma, 0.02 * sigma);
            if (4 * shift.others_below() >= k && 4 * shift.others_below() <= 3 * k) return shift;
        }
        return shift_below_zero(problem_, sigma_below_zero(problem_.B));
    }

    /// Finds k pairs by one shift. Returns false if Spectra does not find as many.
    bool find_in_one_slice(int k) {
        SharedProgress progress(options_.progress, 1);
        const Shift shift = shift_among_lowest(k);
        const int below = shift.sigma > 0 ? shift.others_below() : 0, more = 4 + k / 20;
        const int nearest = below > 0 ? 2 * std::max(below, k - below) : k;
        const PairSearch search{std::min(nearest + more, problem_.others()), options_.tolerance, progress.of_slice(0)};
        SymmetricPairs found = pairs_near(problem_, shift, {}, search);
        if (found.count() < std::max(k, 1)) return false;
        last_ = count_in(gap_after(found, k));
        if (is_cluster(last_, found, k)) last_ = count_in(gap_before(found, k));
        if (is_cluster(last_, found, k)) return false;
        const SymmetricPairs beyond = part_of(found, found.count_below(last_.sigma), found.count());
        found = found_in({{}, last_}, shift, std::move(found), search.report);
        blocks_ = {merged(found, beside(found, beyond))};
        return true;
    }

    Count count_in(const Gap& gap) const { return count_near(problem_, gap.middle(), 0.2 * (gap.high - gap.low)); }

    /// True if many more lie below than were found: k cuts a cluster, of which any members will do, or the run missed one.
    static bool is_cluster(const Count& count, const SymmetricPairs& found, int k) {
        return count.others - found.count_below(count.sigma) > 40 + k;
    }

    /// Finds the pairs of all slices in parallel; the result does not depend on the number of threads.
    void find_in_slices(const std::vector<Count>& limits, int k) {
        std::vector<Slice> slices;
        for (std::size_t i = 1; i < limits.size(); ++i) slices.push_back({limits[i - 1], limits[i]});
        Slice& top = slices.back();
        const int needed = k - top.low.others;
        const bool cuts_cluster = top.wanted > 2 * needed + 100;   // any of its members will do
        if (cuts_cluster) top.wanted = needed;
        last_ = cuts_cluster ? top.low : top.high;
        blocks_.resize(slices.size());
        SharedProgress progress(options_.progress, blocks_.size());
        FirstFailure failure;
        const auto one = [&](std::size_t i) {
            const auto report = [&, add = progress.of_slice(i)](double share) {
                failure.check();
                add(share);
            };
            failure.guard([&] { blocks_[i] = found_in(slices[i], report, 0); });
        };
        tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::task_arena::automatic);
        arena.execute([&] { tbb::parallel_for(std::size_t{0}, blocks_.size(), one, tbb::simple_partitioner()); });
        failure.rethrow();
        for (std::size_t i = 1; i < blocks_.size(); ++i) blocks_[i] = beside(blocks_[i - 1], std::move(blocks_[i]));
    }

    /// Returns the pairs of a slice, which is halved where Spectra finds too few.
    SymmetricPairs found_in(Slice slice, const std::function<void(double)>& report, int halvings) {
        constexpr int most_halvings = 6;
        if (slice.wanted == 0) return no_pairs();
        // Distances from σ are accurate, so the smallest eigenvalues need a σ near zero.
        const Shift shift = slice.low.sigma > 0 ? shift_near(problem_, slice.middle(), 0.05 * slice.width())
                                                : shift_below_zero(problem_, sigma_below_zero(problem_.B));
        SymmetricPairs found = found_in(slice, shift, no_pairs(), report);
        if (slice.held(found) >= slice.wanted || halvings == most_halvings || !slice.can_be_halved()) return found;
        Count middle = count_near(problem_, slice.middle(), 0.1 * slice.width());
        while (slice.can_be_halved() && (middle.others == slice.low.others || middle.others == slice.high.others)) {
            (middle.others == slice.low.others ? slice.low : slice.high) = middle;
            middle = count_near(problem_, slice.middle(), 0.1 * slice.width());
        }
        const SymmetricPairs lower = found_in({slice.low, middle}, report, halvings + 1);
        return merged(lower, beside(lower, found_in({middle, slice.high}, report, halvings + 1)));
    }

    /// Returns the pairs of a slice: repeats runs, orthogonal to the pairs found, until as many are found as are counted, or no more
    /// appear.
    SymmetricPairs found_in(const Slice& slice, const Shift& shift, SymmetricPairs found, const std::function<void(double)>& report) {
        constexpr int most_runs = 40;
        for (int run = found.count() > 0 ? 1 : 0; run < most_runs && slice.held(found) < slice.wanted; ++run) {
            repairs_ += run > 0 ? 1 : 0;
            const int missing = slice.wanted - slice.held(found);
            const PairSearch search{std::min(missing + 2, problem_.others() - found.count()), options_.tolerance, report};
            SymmetricPairs more = pairs_near(problem_, shift, found.Y, search);
            if (slice.held(more) == 0 && more.count() < search.wanted) {   // a cluster that no Krylov space separates
                found = merged(found, more);
                more = pairs_by_iteration(problem_, shift, found.Y, search);
            }
            found = merged(found, more);
            if (slice.held(more) == 0) break;
        }
        return slice.own(found);
    }

    SymmetricPairs no_pairs() const { return {Vector(0), DenseMatrix(problem_.size(), 0)}; }

    /// Compares the values mu found with the last count. @throws CrowdedSpectrum if not as many lie below its σ as are counted, unless
    /// rounding may have changed the count
    void check_count(const std::vector<double>& mu) const {
        int found = 0;
        double nearest = last_.sigma;
        for (const double value : mu) {
            found += value < last_.sigma ? 1 : 0;
            nearest = std::min(nearest, std::abs(value - last_.sigma));
        }
        if (!(last_.delta < nearest) || found == last_.others) return;
        throw CrowdedSpectrum(
            "the smallest eigenpairs did not converge: inertia counts " + std::to_string(last_.others + 1) +
                " eigenvalues below a shift, " + std::to_string(found + 1) + " were found",
            "ask for fewer eigenpairs; eigenvalues too close to each other, as of many triangles around one edge, are the "
            "usual cause");
    }

    /// Returns the k smallest pairs of all slices. @throws CrowdedSpectrum if there are fewer, or as check_count()
    Modes united(int k) {
        struct Place {
            std::size_t block;
            Eigen::Index column;
        };
        std::vector<Place> all;
        for (std::size_t b = 0; b < blocks_.size(); ++b)
            for (Eigen::Index j = 0; j < blocks_[b].count(); ++j) all.push_back({b, j});
        const auto value = [&](const Place& p) { return blocks_[p.block].mu[p.column]; };
        std::stable_sort(all.begin(), all.end(), [&](const Place& a, const Place& b) { return value(a) < value(b); });
        std::vector<double> mu;
        for (const Place& place : all) mu.push_back(value(place));

        check_count(mu);
        Modes result;
        if (static_cast<int>(mu.size()) < k) throw CrowdedSpectrum("the smallest eigenpairs did not converge", "ask for fewer eigenpairs");
        const SymmetricPairs values{Eigen::Map<const Vector>(mu.data(), static_cast<Eigen::Index>(mu.size())), {}};
        const Gap gap = gap_after(values, k);
        const bool seen = gap.high <= values.mu[values.count() - 1];
        result.gap_middle = seen ? gap.middle() : std::max(0.0, last_.sigma > gap.low * (1 + clear_gap) ? last_.sigma : 0.0);
        result.slices = static_cast<int>(blocks_.size());
        result.repairs = repairs_;
        result.pairs = {Eigen::Map<const Vector>(mu.data(), k), DenseMatrix(problem_.size(), k)};
        tbb::parallel_for(0, k, [&](int j) {
            const Place& place = all[static_cast<std::size_t>(j)];
            result.pairs.Y(problem_.order.row, j) = blocks_[place.block].Y.col(place.column);
        });
        return result;
    }

    const SpectrumProblem& problem_;
    const SpectrumOptions& options_;
    std::vector<SymmetricPairs> blocks_;   // of the slices, ascending
    Count last_;                           // above all of them, or below a cluster that k cuts
    std::atomic<int> repairs_ = 0;
};

/// Memory for the factor and the basis of one slice, and for all vectors, twice while they are sorted. [bytes]
struct SpectrumMemory {
    double of_slice, of_vectors;
};

SpectrumMemory memory_of(const SpectrumProblem& problem, int k, const SpectrumOptions& options) {
    const double n = problem.size(), pairs = k > options.one_slice_up_to ? 1.5 * options.pairs_per_slice : k;
    return {problem.order.memory + 8 * n * (5 * pairs + 40), 2 * 8 * n * k};
}

}   // namespace

Modes find_by_slices(const SpectrumProblem& problem, int k, const SpectrumOptions& options) { return Slicer(problem, options).find(k); }

double memory_of_one_slice(const SpectrumProblem& problem, int k, const SpectrumOptions& options) {
    const SpectrumMemory needed = memory_of(problem, k, options);
    return needed.of_slice + needed.of_vectors;
}

int slices_that_fit(const SpectrumProblem& problem, int k, const SpectrumOptions& options) {
    const int processors = options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency();
    const double limit = options.memory_limit > 0 ? options.memory_limit : available_memory().bytes;
    if (limit <= 0) return processors;
    const SpectrumMemory needed = memory_of(problem, k, options);
    const double slices = (limit - needed.of_vectors) / needed.of_slice;
    if (slices >= 1) return static_cast<int>(std::min<double>(processors, slices));
    int fitting = 0, too_many = k;   // memory grows with the pairs
    while (too_many - fitting > 1) {
        const int middle = (fitting + too_many) / 2;
        (memory_of_one_slice(problem, middle, options) <= limit ? fitting : too_many) = middle;
    }
    const auto gigabytes = [](double bytes) { return plain_text(bytes / 1e9, 3) + " GB"; };
    throw SolverError(std::to_string(k) + " eigenpairs of " + std::to_string(problem.size()) + " vertices need " +
                          gigabytes(memory_of_one_slice(problem, k, options)) + " of memory, " + gigabytes(limit) + " are there",
                      fitting >= 1 ? std::to_string(fitting) + (fitting == 1 ? " eigenpair" : " eigenpairs") + " would fit"
                                   : "not even one eigenpair would fit: simplify the mesh");
}

}   // namespace meshfolio
