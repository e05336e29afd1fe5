#include "geometry/spectrum/engine/spectrum_slices.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <set>

#include "base/errors.h"
#include "base/first_failure.h"
#include "geometry/linear/special_values.h"
#include "geometry/spectrum/engine/slice_limits.h"
#include "geometry/spectrum/engine/slice_overlaps.h"

namespace meshfolio {

namespace {

/// Adds up the progress of all slices. Called from several threads; reports one value at a time, never a smaller one.
class SharedProgress {
public:
    explicit SharedProgress(const std::function<void(double)>& tell) : tell_(tell) {}

    void begin_round(std::size_t slices) {
        from_ = told_;
        shares_.assign(slices, 0.0);
    }
    StepReport of_slice(std::size_t i) {
        return [this, i](double share) {
            if (!tell_) return;
            const std::lock_guard lock(mutex_);
            shares_[i] = std::max(shares_[i], share);
            const double round = std::accumulate(shares_.begin(), shares_.end(), 0.0) / static_cast<double>(shares_.size());
            told_ = std::max(told_, from_ + (0.95 - from_) * round);
            tell_(told_);
        };
    }

private:
    const std::function<void(double)>& tell_;
    std::mutex mutex_;
    std::vector<double> shares_;
    double from_ = 0, told_ = 0;
};

/// Everything found so far, each eigenvalue in one slice only.
class SliceSet {
public:
    SliceSet(const SpectrumProblem& problem, const SliceOptions& options)
        : problem_(problem), options_(options), progress_(options.progress) {}

    /// Solves all goals, halving those that are too wide for their basis.
    void solve(std::vector<SliceGoal> goals) {
        constexpr int most_rounds = 12;
        for (int round = 0; !goals.empty(); ++round) {
            if (round == most_rounds)
                throw SolverError("the eigenvalues lie too close to each other to be sliced", "ask for fewer eigenpairs");
            std::vector<Slice> solved = solve_round(goals, {});
            goals.clear();
            for (Slice& slice : solved) {
                if (!slice.complete) append_halves(slice, goals);
                take(std::move(slice));
            }
        }
        std::sort(slices_.begin(), slices_.end(), [](const Slice& a, const Slice& b) { return a.goal.low < b.goal.low; });
        for (std::size_t i = 1; i < slices_.size(); ++i) slices_[i].begin = slices_[i - 1].cut;
    }

    /// Looks again, beside what is known, wherever inertia counts more than was found.
    void repair() {
        constexpr int most_repairs = 6;
        for (; !missing().empty(); ++repairs_) {
            if (repairs_ == most_repairs)
                throw SolverError(what_is_missing(),
                                  "ask for fewer eigenpairs; needles and crowded eigenvalues, as of many triangles around one edge, are "
                                  "the usual causes");
            std::vector<SliceGoal> goals;
            std::vector<std::vector<const EightColumns*>> locked;
            const std::set<std::size_t> wanting = missing();
            for (const std::size_t i : wanting) {
                SliceGoal goal = slices_[i].goal;
                goal.high = std::isfinite(slices_[i].cut) ? slices_[i].cut : goal.high;
                goal.at_least = 0;
                goal.expected = 0;
                goal.below_sigma = -1;
                goal.to_the_end = false;
                goal.seed += 7919 * static_cast<std::uint64_t>(repairs_ + 1);
                goals.push_back(goal);
                locked.push_back(groups_near(i));
            }
            std::vector<Slice> solved = solve_round(goals, locked);
            auto which = wanting.begin();
            for (Slice& more : solved) {
                times_ += more.times;
                if (!more.complete) throw SolverError(what_is_missing(), "ask for fewer eigenpairs");
                more.begin = slices_[*which].begin;
                more.cut = slices_[*which++].cut;
                if (!more.X.empty()) extra_.push_back(std::move(more));
            }
        }
    }

    /// One slice alone; false if its basis did not suffice.
    bool solve_alone(const SliceGoal& goal) {
        take(std::move(solve_round({goal}, {}).front()));
        return !slices_.empty();
    }

    void note_proof(const Inertia& inertia) { proofs_.push_back({inertia}); }
    double highest_cut() const { return slices_.back().cut; }

    SlicedPairs pairs(int k);

private:
    void take(Slice slice) {
        times_ += slice.times;
        note_proof({slice.goal.sigma, slice.counted, slice.delta});
        if (slice.complete) slices_.push_back(std::move(slice));
    }

    std::vector<Slice> solve_round(const std::vector<SliceGoal>& goals, const std::vector<std::vector<const EightColumns*>>& locked) {
        std::vector<Slice> solved(goals.size());
        progress_.begin_round(goals.size());
        FirstFailure failure;
        const auto one = [&](std::size_t i) {
            const StepReport tell = progress_.of_slice(i);
            const auto report = [&](double share) {
                failure.check();
                tell(share);
            };
            const std::vector<const EightColumns*> fixed = locked.empty() ? std::vector<const EightColumns*>() : locked[i];
            failure.guard([&] { solved[i] = solve_slice(problem_, goals[i], fixed, report); });
        };
        if (goals.size() == 1) {
            one(0);
        } else {
            tbb::task_arena arena(options_.threads > 0 ? options_.threads : tbb::task_arena::automatic);
            arena.execute([&] { tbb::parallel_for(std::size_t{0}, goals.size(), one, tbb::simple_partitioner()); });
        }
        failure.rethrow();
        return solved;
    }

    static void append_halves(const Slice& slice, std::vector<SliceGoal>& goals) {
        SliceGoal lower = slice.goal, upper = slice.goal;
        lower.high = upper.low = slice.goal.sigma > 0 ? slice.goal.sigma : 0.4 * slice.goal.high;
        if (slice.goal.low > 0) lower.sigma = 0.5 * (lower.low + lower.high);
        upper.sigma = 0.5 * (upper.low + upper.high);
        lower.to_the_end = false;
        lower.below_sigma = upper.below_sigma = -1;
        lower.parallel = upper.parallel = false;
        goals.insert(goals.end(), {lower, upper});
    }

    /// Calls visit(mu, group, lane) for every pair.
    template <class Visit>
    void for_each_pair(const Visit& visit) const {
        for (const std::vector<Slice>* slices : {&slices_, &extra_}) {
            for (const Slice& slice : *slices) {
                for (Eigen::Index j = 0; j < slice.mu.size(); ++j) {
                    const bool own = slice.mu[j] > slice.begin && slice.mu[j] <= slice.cut;
                    if (own) visit(slice.mu[j], slice.X[static_cast<std::size_t>(j / lanes)], static_cast<int>(j % lanes));
                }
            }
        }
    }

    double nearest_to(double sigma) const {
        double distance = problem_.zeros.count() > 0 ? std::abs(sigma) : infinity;
        for_each_pair([&](double mu, const EightColumns&, int) { distance = std::min(distance, std::abs(mu - sigma)); });
        return distance;
    }

    int found_below(double sigma) const {
        int found = sigma > 0 ? problem_.zeros.count() : 0;
        for_each_pair([&](double mu, const EightColumns&, int) { found += mu < sigma; });
        return found;
    }

    /// Slices that reach between two proofs which do not agree with what was found. Counts that rounding may have changed are passed over.
    std::set<std::size_t> missing() {
        std::sort(proofs_.begin(), proofs_.end(), [](const InertiaProof& a, const InertiaProof& b) { return a.sigma < b.sigma; });
        std::set<std::size_t> wanting;
        double low = 0;
        int missed_below = 0;
        for (InertiaProof& proof : proofs_) {
            proof.found = found_below(proof.sigma);
            proof.trusted = proof.delta < nearest_to(proof.sigma);
            if (!proof.trusted) continue;
            const int missed = proof.below - proof.found;
            if (missed != missed_below) {
                for (std::size_t i = 0; i < slices_.size(); ++i)
                    if (slices_[i].goal.low < proof.sigma && slices_[i].cut > low) wanting.insert(i);
            }
            missed_below = missed;
            low = proof.sigma;
        }
        return wanting;
    }

    std::string what_is_missing() const {
        for (const InertiaProof& proof : proofs_) {
            if (!proof.trusted || proof.below == proof.found) continue;
            return "the smallest eigenpairs did not converge: inertia counts " + std::to_string(proof.below) +
                   " eigenvalues below a shift, " + std::to_string(proof.found) + " were found";
        }
        return "the smallest eigenpairs did not converge";
    }

    /// Vectors of the slice, of those beside it, and of those found by repairs.
    std::vector<const EightColumns*> groups_near(std::size_t i) const {
        std::vector<const EightColumns*> groups;
        const auto add = [&](const Slice& slice) {
            for (const EightColumns& group : slice.X) groups.push_back(&group);
        };
        for (std::size_t j = i > 0 ? i - 1 : 0; j < std::min(slices_.size(), i + 2); ++j) add(slices_[j]);
        for (const Slice& slice : extra_) add(slice);
        return groups;
    }

    const SpectrumProblem& problem_;
    const SliceOptions& options_;
    SharedProgress progress_;
    std::vector<Slice> slices_, extra_;   // ascending; found by repairs
    std::vector<InertiaProof> proofs_;
    SpectrumTimes times_;
    int repairs_ = 0;
};

SlicedPairs SliceSet::pairs(int k) {
    struct Pair {
        double mu;
        const EightColumns* group;
        int lane;
    };
    std::vector<Pair> all;
    for_each_pair([&](double mu, const EightColumns& group, int lane) { all.push_back({mu, &group, lane}); });
    std::stable_sort(all.begin(), all.end(), [](const Pair& a, const Pair& b) { return a.mu < b.mu; });
    if (static_cast<int>(all.size()) < k) throw SolverError(what_is_missing());

    SlicedPairs result;
    result.gap_middle = std::isfinite(highest_cut()) ? highest_cut() : 0;
    const auto mu = [&](std::size_t i) { return i > 0 ? all[i - 1].mu : 0; };   // of the first i pairs the last
    auto behind = static_cast<std::size_t>(k);
    while (behind < all.size() && mu(behind + 1) - mu(behind) <= clear_gap * mu(behind + 1)) ++behind;
    if (behind < all.size()) result.gap_middle = 0.5 * (mu(behind) + mu(behind + 1));
    result.slices = static_cast<int>(slices_.size());
    result.mu.resize(k);
    const int groups = (k + lanes - 1) / lanes;
    for (int j = 0; j < k; ++j) result.mu[j] = all[static_cast<std::size_t>(j)].mu;
    std::vector<EightColumns> packed(static_cast<std::size_t>(groups));
    tbb::parallel_for(0, groups, [&](int g) {
        const int first = lanes * g, columns = std::min(lanes, k - first);
        const double* from[lanes];
        for (int c = 0; c < columns; ++c) {
            const Pair& pair = all[static_cast<std::size_t>(first + c)];
            from[c] = pair.group->data() + pair.lane;
        }
        EightColumns X(problem_.size());
        for (Eigen::Index i = 0; i < X.rows(); ++i)
            for (int c = 0; c < lanes; ++c) X.row(i)[c] = c < columns ? from[c][lanes * i] : 0;
        problem_.zeros_in_order.project_out(X);   // the share of the zero modes that rounding added
        packed[static_cast<std::size_t>(g)] = std::move(X);
    });
    slices_.clear();
    extra_.clear();
    make_orthonormal(packed, k);
    damp_noise(problem_, packed, result.mu);
    result.Y.resize(problem_.size(), k);
    const std::vector<int>& order = problem_.analysis.order();
    tbb::parallel_for(0, groups, [&](int g) {
        const EightColumns X = std::move(packed[static_cast<std::size_t>(g)]);
        for (int c = 0; c < std::min(lanes, k - lanes * g); ++c)
            for (Eigen::Index i = 0; i < X.rows(); ++i) result.Y(order[static_cast<std::size_t>(i)], lanes * g + c) = X.row(i)[c];
    });
    result.proofs = proofs_;
    result.times = times_;
    result.repairs = repairs_;
    return result;
}

}   // namespace

SlicedPairs find_by_slices(const SpectrumProblem& problem, int k, const SliceOptions& options) {
    SliceSet set(problem, options);
    const int zeros = problem.zeros.count();
    if (k <= options.one_slice_up_to && set.solve_alone(one_goal(problem, k, options))) {
        const double above = std::isfinite(set.highest_cut()) ? set.highest_cut() : above_all(problem.B);
        set.note_proof(count_near(problem, above));
    } else {
        const std::vector<Inertia> counts = bracket_from_above(problem, zeros + k);
        set.note_proof(counts.back());
        set.solve(slice_goals(problem, counts, options));
    }
    set.repair();
    return set.pairs(k);
}

}   // namespace meshfolio
