#include "geometry/spectrum/engine/slice_limits.h"

#include "base/errors.h"
#include "base/parallel_tasks.h"
#include "geometry/linear/special_values.h"

namespace meshfolio {
namespace {

/// Returns counts, the last with at least `wanted` and not many more: from Weyl's law N(μ) ≈ μ / 4π at area 1, then by the secant, then by
/// halves. Before it come 0 and, where `wanted` cuts a large cluster, the count below that.
std::vector<Count> counts_about(const SpectrumProblem& problem, int wanted) {
    constexpr int most_counts = 60, secants = 4;
    const int enough = wanted + std::max(6, wanted / 24);
    const double middle = 0.5 * (wanted + enough);
    Count below, above{problem.highest, problem.others(), 0};
    bool bracketed = false;
    double sigma = std::min(4 * pi * (wanted + 10), 0.9 * problem.highest);
    const auto width = [&] { return above.sigma - below.sigma; };
    const auto close = [&] { return width() <= (above.others > 2 * enough + 100 ? least_gap : 4 * clear_gap) * above.sigma; };
    for (int i = 0; i < most_counts && above.others > enough && !close(); ++i) {
        const Count count = count_near(problem, sigma, std::min(1e-5 * sigma, 0.01 * width()));
        bracketed = bracketed || count.others >= wanted;
        (count.others >= wanted ? above : below) = count;
        if (!bracketed) {
            sigma = std::min(sigma * std::clamp(middle / std::max(1, count.others), 1.02, 4.0), 0.5 * (sigma + problem.highest));
            continue;
        }
        const double share = i < secants ? (middle - below.others) / std::max(1, above.others - below.others) : 0.5;
        sigma = below.sigma + share * width();
        sigma = std::clamp(sigma, below.sigma + 0.02 * width(), above.sigma - 0.02 * width());
    }
    if (above.others > 2 * enough + 100 && below.others > 0) return {{}, below, above};
    return {{}, above};
}

}   // namespace

Count count_near(const SpectrumProblem& problem, double sigma, double reach) {
    const Shift shift = shift_near(problem, sigma, reach);
    return {shift.sigma, shift.others_below(), shift.delta()};
}

std::vector<Count> slice_limits(const SpectrumProblem& problem, int wanted, int pairs_per_slice) {
    constexpr int most_rounds = 12;
    std::vector<Count> counts = counts_about(problem, wanted);
    for (int round = 0; round < most_rounds; ++round) {
        std::vector<double> places;
        for (std::size_t i = 1; i < counts.size(); ++i) {
            const Count &a = counts[i - 1], &b = counts[i];
            if (2 * (b.others - a.others) <= 3 * pairs_per_slice || b.sigma - a.sigma <= 10 * clear_gap * b.sigma) continue;
            const int pieces = (b.others - a.others + pairs_per_slice - 1) / pairs_per_slice;
            for (int p = 1; p < pieces; ++p) places.push_back(a.sigma + p * (b.sigma - a.sigma) / pieces);
        }
        if (places.empty()) break;
        std::vector<Count> more(places.size());
        for_each_task(places.size(), [&](std::size_t i) { more[i] = count_near(problem, places[i], 1e-5 * places[i]); });
        counts.insert(counts.end(), more.begin(), more.end());
        std::sort(counts.begin(), counts.end(), [](const Count& a, const Count& b) { return a.sigma < b.sigma; });
    }
    std::vector<Count> limits{counts.front()};   // without those that leave a slice less than half full
    for (std::size_t i = 1; i + 1 < counts.size(); ++i) {
        const int others = counts[i].others;
        if (others - limits.back().others >= pairs_per_slice / 2 && others < counts.back().others) limits.push_back(counts[i]);
    }
    limits.push_back(counts.back());
    return limits;
}

}   // namespace meshfolio
