#include "questions/q3_cotangent/parts.h"

#include <numeric>

#include "geometry/curvature/jet_fit.h"

namespace meshfolio::q3_cotangent {

namespace {

/// Mean curvature × mean edge below this is rounding, by which nothing can be divided.
constexpr double flat = 1e-6;

/// Returns the sum of the squares of the first `first` values.
double sum_of_squares(const std::vector<double>& values, std::size_t first) {
    return std::accumulate(values.begin(), values.begin() + first, 0.0, [](double sum, double v) { return sum + v * v; });
}

}   // namespace

Disagreement disagreement_with_jet(const CotangentComparison& c) {
    const CurvatureSubject& s = c.subject;
    Disagreement d;
    d.jet = jet_curvature(s.mesh(), s.topology()).H;
    d.size = (c.cotangent - d.jet).cwiseAbs();
    double scale = 0, uniform = 0;
    for (int i = 0; i < d.size.size(); ++i) {
        d.without_jet += s.inside(i) && std::isfinite(c.cotangent[i]) && !std::isfinite(d.jet[i]) ? 1 : 0;
        if (!std::isfinite(d.size[i])) continue;
        scale += c.cotangent[i] * c.cotangent[i];
        uniform += std::pow(c.uniform[i] - d.jet[i], 2);
    }
    std::vector<double> sizes = sorted_finite(d.size);
    std::ranges::reverse(sizes);
    if (sizes.empty()) return d;
    const double rms_H = std::sqrt(scale / double(sizes.size()));
    const double total = sum_of_squares(sizes, sizes.size());
    d.rms_uniform = std::sqrt(uniform / scale);
    d.rms = rms_H * s.mean_edge > flat ? std::sqrt(total / double(sizes.size())) / rms_H : std::nan("");
    d.median = rms_H * s.mean_edge > flat ? sizes[sizes.size() / 2] / rms_H : std::nan("");
    d.concentration = total > 0 ? sum_of_squares(sizes, std::max<std::size_t>(1, sizes.size() / 100)) / total : 0;
    return d;
}

std::vector<IndicatorTrial> indicator_trials(const MeshLibrary& library, const BenchRuns& runs, const QuestionSettings& settings) {
    std::vector<IndicatorTrial> trials;
    for (const BenchRun& run : runs) trials.push_back({std::string(name_of(run.kind)) + " " + run.surface, run.finest().indicator});
    trials.push_back({words.line("trust.random"), reference_level(library, settings.quick ? 2500 : 10000, settings.seed).indicator});
    return trials;
}

}   // namespace meshfolio::q3_cotangent
