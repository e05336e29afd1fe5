#include "questions/q3_cotangent/error_indicator.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/number_text.h"
#include "geometry/curvature/curvature.h"
#include "geometry/curvature/jet_fit.h"
#include "questions/bench/ground_truth_meshes.h"
#include "questions/core/six_view_figure.h"

namespace meshfolio::q3_cotangent {

namespace {

using report::math;
using report::ref;

/// Below this, mean curvature × mean edge is rounding and no scale to divide by.
constexpr double flat = 1e-6;

std::vector<double> descending_finite(const Vector& values) {
    std::vector<double> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double v) { return std::isfinite(v); });
    std::sort(finite.rbegin(), finite.rend());
    return finite;
}

double sum_of_squares(const std::vector<double>& values, std::size_t first) {
    return std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first), 0.0,
                           [](double sum, double v) { return sum + v * v; });
}

/// Of the tenth of the vertices where `error` is largest, the share in the tenth where `indicator` is. Both without NaN.
double share_found(const Vector& error, const Vector& indicator) {
    const auto n = error.size();
    const std::size_t tenth = std::max<std::size_t>(1, static_cast<std::size_t>(n) / 10);
    const auto worst = [&](const Vector& values) {
        std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
        std::iota(order.begin(), order.end(), 0);
        const auto larger = [&](Eigen::Index a, Eigen::Index b) { return values[a] != values[b] ? values[a] > values[b] : a < b; };
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(tenth), order.end(), larger);
        order.resize(tenth);
        std::sort(order.begin(), order.end());
        return order;
    };
    const auto a = worst(error), b = worst(indicator);
    std::vector<Eigen::Index> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return double(both.size()) / double(tenth);
}

IndicatorTrial trial_on(std::string name, const TriangleMesh& mesh, const MeshTopology& topology, const Vector& truth,
                        const Vector& areas) {
    const Vector cotangent = cotangent_mean_curvature(mesh, topology, laplace_beltrami(mesh));
    const Vector jet = jet_curvature(mesh, topology).H;
    std::vector<Eigen::Index> both;
    for (Eigen::Index i = 0; i < truth.size(); ++i) {
        if (std::isfinite(cotangent[i]) && std::isfinite(jet[i])) both.push_back(i);
    }
    const Vector A = areas(both), H = truth(both);
    const Vector error = (cotangent(both) - H).cwiseAbs(), indicator = (cotangent(both) - jet(both)).cwiseAbs();
    const double scale = A.dot(H.cwiseAbs2());
    return {std::move(name), static_cast<int>(both.size()), std::sqrt(A.dot(indicator.cwiseAbs2()) / scale),
            std::sqrt(A.dot(error.cwiseAbs2()) / scale), share_found(error, indicator)};
}

// ---- in the section ---------------------------------------------------------------------------------------------------

void add_map(Answer& answer, const CotangentComparison& c, const Disagreement& d, const std::string& colormap) {
    const CurvatureSubject& s = c.subject;
    SixViewFigure figure;
    figure.id = "q3_" + s.name() + "_disagreement";
    figure.title = "|H cotangent − H jet| × mean edge: an error indicator";
    figure.subtitle = s.source->input.file + ", " + counted(s.mesh().vertex_count(), "vertex", "vertices");
    figure.panels = {panel_of(*s.source, figure.id, s.name(), s.mean_edge * d.size)};
    figure.range = output::robust_range(figure.panels, colormap, "|ΔH| × mean edge", "", 0.001);
    figure.range->low = 0;
    figure.range = range_for(*figure.range, figure.panels);
    figure.caption = "Where the cotangent estimate of H on " + s.name() +
                     " is to be doubted: its distance from that of a degree-3 jet over two rings, times the mean edge.";
    figure.caption += undefined_words(s);
    add_figure(answer, std::move(figure));
}

report::Text map_words(const CotangentComparison& c, const Disagreement& d) {
    report::Text t = report::text("On ", c.subject.name(), " cotangent and jet differ by ", readable_percent(d.rms), " of H (rms) and by ",
                                  readable_percent(d.median), " at half of the vertices; the worst hundredth of the vertices holds ",
                                  readable_percent(d.concentration, 2), " of the squared difference (",
                                  ref("q3_" + c.subject.name() + "_disagreement"), ").");
    if (d.without_jet > 0) report::extend(t, " ", counted(d.without_jet, "vertex has", "vertices have"), " too few neighbours for a jet.");
    return t;
}

void add_trials(report::Section& section, const std::vector<IndicatorTrial>& trials) {
    report::Table table;
    table.id = "q3_indicator";
    table.caption =
        "What the indicator is worth where the truth is known: L2 error of cotangent H (barycentric areas) as the jet would have it and as "
        "it "
        "is, and how much of the worst tenth of the vertices is in the tenth indicated.";
    table.columns = {{"mesh"}, {"vertices"}, {"indicated", "%", 3}, {"actual", "%", 3}, {"ratio", "", 3}, {"worst tenth found", "%", 3}};
    for (const IndicatorTrial& t : trials) {
        table.rows.push_back(
            {t.mesh, double(t.vertices), 100 * t.indicated, 100 * t.actual, cell_of(t.indicated / t.actual, t.actual > 0), 100 * t.found});
    }
    section.blocks.push_back(std::move(table));
}

report::Text trial_words(const std::vector<IndicatorTrial>& trials) {
    double off = 0, found = 1;
    int large = 0;
    for (const IndicatorTrial& t : trials) {
        if (t.actual < 0.05) continue;
        ++large;
        off = std::max(off, std::abs(t.indicated / t.actual - 1));
        found = std::min(found, t.found);
    }
    const auto smallest = std::min_element(trials.begin(), trials.end(),
                                           [](const IndicatorTrial& a, const IndicatorTrial& b) { return a.actual < b.actual; });
    report::Text t = report::text("Where no closed form says how good H is, a second estimate does. ");
    if (large > 0) {
        report::extend(
            t, "On the ", counted(large, "mesh", "meshes"),
            " with known truth where the cotangent formula errs by 5 % or more, its distance from the jet equals its true error to ",
            readable_percent(rounded_up(off, 2), 2), ", and at least ", readable_percent(rounded_down(found, 2), 2),
            " of the worst tenth of the vertices are found. ");
    }
    report::extend(t, "Where both are good the indicator says only that: on the ", smallest->mesh, " it shows ",
                   readable_percent(smallest->indicated, 2), " for an error of ", readable_percent(smallest->actual, 2), " (",
                   ref("q3_indicator"),
                   "). Jets assume a smooth surface: at creases of the model itself a large difference says that H is not defined there.");
    return t;
}

}   // namespace

Disagreement disagreement_with_jet(const CotangentComparison& c) {
    const CurvatureSubject& s = c.subject;
    const Vector jet = jet_curvature(s.mesh(), s.topology()).H;
    Disagreement d;
    d.size = (c.cotangent - jet).cwiseAbs();
    double scale = 0;
    for (int i = 0; i < d.size.size(); ++i) {
        d.without_jet += s.inside(i) && std::isfinite(c.cotangent[i]) && !std::isfinite(jet[i]) ? 1 : 0;
        if (std::isfinite(d.size[i])) scale += c.cotangent[i] * c.cotangent[i];
    }
    const std::vector<double> sizes = descending_finite(d.size);
    if (sizes.empty()) return d;
    const double rms_H = std::sqrt(scale / double(sizes.size()));
    const double total = sum_of_squares(sizes, sizes.size());
    d.rms = rms_H * s.mean_edge > flat ? std::sqrt(total / double(sizes.size())) / rms_H : std::nan("");
    d.median = rms_H * s.mean_edge > flat ? sizes[sizes.size() / 2] / rms_H : std::nan("");
    d.concentration = total > 0 ? sum_of_squares(sizes, std::max<std::size_t>(1, sizes.size() / 100)) / total : 0;
    return d;
}

std::vector<IndicatorTrial> indicator_trials(const QuestionSettings& settings) {
    const int level = refinement_levels(settings.quick).back();
    std::vector<IndicatorTrial> trials;
    for (const Triangulation triangulation : {Triangulation::regular, Triangulation::jittered}) {
        for (const KnownSurface& surface : known_surfaces()) {
            const SampledSurface s = sampled(surface, level, triangulation, settings.seed);
            trials.push_back(trial_on(name_of(triangulation) + " " + surface.name, s.mesh, s.topology, s.H, s.areas));
        }
    }
    const TruthMesh random = random_ellipsoid({1.5, 1, 0.7}, settings.quick ? 2500 : 10000, settings.seed);
    trials.push_back(trial_on("random points on the ellipsoid", random.mesh, random.topology, random.H, random.areas));
    return trials;
}

void add_error_indicator(Answer& answer, const std::vector<CotangentComparison>& meshes, const QuestionSettings& settings) {
    report::Section& section = answer.section;
    add_heading(section, "How far to trust H without a closed form");
    const std::vector<IndicatorTrial> trials = indicator_trials(settings);
    section.blocks.push_back(report::Paragraph{trial_words(trials)});
    add_trials(section, trials);
    for (const CotangentComparison& c : meshes) {
        const Disagreement d = disagreement_with_jet(c);
        if (!std::isfinite(d.rms) || d.rms == 0) continue;   // flat, or nothing inside: no H to doubt
        add_map(answer, c, d, settings.colormap);
        section.blocks.push_back(report::Paragraph{map_words(c, d)});
    }
    const IndicatorTrial& random = trials.back();
    section.checks.push_back(report::check_near("jet-based indicator over the true L2 error of cotangent H, " + random.mesh, 1,
                                                random.indicated / random.actual, 0.05));
}

}   // namespace meshfolio::q3_cotangent
