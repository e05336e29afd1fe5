#include "questions/bench/curvature_bench.h"

#include <charconv>
#include <numeric>

#include "base/parallel_tasks.h"
#include "geometry/curvature/curvature.h"
#include "geometry/measures/mesh_error.h"
#include "geometry/measures/mesh_laws.h"
#include "questions/bench/estimators.h"

namespace meshfolio {

using namespace report::literals;

namespace {

constexpr double rounding = 1e-9;        // smaller errors have no order
constexpr std::size_t fitted = 3;        // meshes that give an order
constexpr double student_95 = 12.7062;   // quantile of Student's t for their one degree of freedom

/// Computes the errors of the estimate over the measured vertices, relative to the truth.
/// @param substitute  scale of the error if the truth is 0 everywhere
EstimateError error_of(const Vector& estimate, const Vector& truth, const Vector& substitute, const BenchMesh& b) {
    const Vector& scale = truth.isZero() ? substitute : truth;
    EstimateError error;
    double squared = 0, scale_squared = 0, largest_scale = 0;
    for (Eigen::Index i = 0; i < estimate.size(); ++i) {
        if (!b.measured[i]) continue;
        scale_squared += b.areas[i] * scale[i] * scale[i];
        largest_scale = std::max(largest_scale, std::abs(scale[i]));
        if (!std::isfinite(estimate[i])) {
            ++error.undefined;
            continue;
        }
        const double difference = estimate[i] - truth[i];
        squared += b.areas[i] * difference * difference;
        error.linf = std::max(error.linf, std::abs(difference));
    }
    error.l2 = std::sqrt(squared / scale_squared);
    error.linf /= largest_scale;
    return error;
}

/// Compares |H_cotan − H_jet| with |H_cotan − H| over the vertices where both estimates are finite.
ErrorIndicator indicator_on(const BenchMesh& b) {
    const Vector cotangent = estimator("H.barycentric").estimate(b), jet = estimator("H.jet").estimate(b);
    const std::vector<int> both = where_finite(cotangent, jet);
    const Vector A = b.areas(both), H = b.H(both);
    const Vector error = (cotangent(both) - H).cwiseAbs(), indicated = (cotangent(both) - jet(both)).cwiseAbs();
    const std::size_t tenth = std::max<std::size_t>(1, both.size() / 10);
    const auto worst_tenth = [&](const Vector& values) {
        std::vector<Eigen::Index> order(both.size());
        std::iota(order.begin(), order.end(), 0);
        const auto larger = [&](Eigen::Index i, Eigen::Index j) { return values[i] != values[j] ? values[i] > values[j] : i < j; };
        std::partial_sort(order.begin(), order.begin() + tenth, order.end(), larger);
        order.resize(tenth);
        std::sort(order.begin(), order.end());
        return order;
    };
    std::vector<Eigen::Index> found;
    std::ranges::set_intersection(worst_tenth(error), worst_tenth(indicated), std::back_inserter(found));
    const double scale = A.dot(H.cwiseAbs2());
    return {static_cast<int>(both.size()), std::sqrt(A.dot(indicated.cwiseAbs2()) / scale), std::sqrt(A.dot(error.cwiseAbs2()) / scale),
            double(found.size()) / double(tenth)};
}

std::vector<KnownSurface> question_surfaces() { return {known_surface("sphere"), known_surface("ellipsoid"), known_surface("torus")}; }

std::string with_decimals(double x, int decimals) {
    char text[400];   // the largest double has 309 digits
    return {text, std::to_chars(text, text + sizeof text, x, std::chars_format::fixed, decimals).ptr};
}

}   // namespace

std::string words_of(const Order& order) {
    if (std::isnan(order.exponent)) return order.exact ? "exact" : "–";
    const std::string exponent = (order.exponent < -0.005 ? "−" : "") + with_decimals(std::abs(order.exponent), 2);
    if (std::isnan(order.margin)) return exponent;
    if (order.margin < 0.0005) return exponent + "\u202f±\u202f<\u202f0.001";
    return exponent + "\u202f±\u202f" + with_decimals(order.margin, order.margin < 0.01 ? 3 : 2);
}

Order ErrorHistory::order() const {
    std::vector<double> x, y;
    for (std::size_t i = errors.size() > fitted ? errors.size() - fitted : 0; i < errors.size(); ++i) {
        if (!(errors[i] > 0) || !std::isfinite(errors[i])) continue;
        x.push_back(std::log(mean_edges[i]));
        y.push_back(std::log(errors[i]));
    }
    Order order{undefined, undefined, errors.back() < rounding};
    const auto n = static_cast<Eigen::Index>(x.size());
    if (n < 2 || order.exact) return order;
    const Eigen::Map<const Vector> X(x.data(), n), Y(y.data(), n);
    const Vector dx = X.array() - X.mean(), dy = Y.array() - Y.mean();
    order.exponent = dx.dot(dy) / dx.squaredNorm();
    if (n == fitted) order.margin = student_95 * (dy - order.exponent * dx).norm() / dx.norm();
    return order;
}

std::string trend(const ErrorHistory& history) {
    const Order order = history.order();
    return curvature_words.line(order.exact              ? "trend.exact"
                                : order.converges()      ? "trend.falls"
                                : order.exponent <= -0.5 ? "trend.grows"
                                                         : "trend.stays",
                                "from"_a = readable_percent(history.first()), "to"_a = readable_percent(history.last()),
                                "order"_a = words_of(order));
}

report::Plot error_plot(std::string id, std::string caption, std::string alt) {
    return {.id = std::move(id),
            .caption = std::move(caption),
            .alt = std::move(alt),
            .x_label = "mean edge [length]",
            .y_label = "relative L2 error [%]",
            .log_x = true,
            .log_y = true};
}

report::Series error_series(std::string name, const ErrorHistory& history, report::Series::Style style) {
    report::Series series{std::move(name), history.mean_edges, {}, {}, {}, style};
    for (const double error : history.errors) series.y.push_back(100 * error);
    return series;
}

BenchLevel measured(const BenchMesh& b) {
    const double edges = static_cast<double>(b.topology.edges.size());
    BenchLevel level{.vertices = b.mesh.vertex_count(),
                     .faces = b.mesh.face_count(),
                     .euler = b.mesh.vertex_count() - static_cast<int>(edges) + b.mesh.face_count(),
                     .mean_edge = b.mean_edge,
                     .smallest_angle = smallest_angle(b.mesh),
                     .negative_weights = negative_weights(b.C(), b.topology).inside / edges,
                     .euler_from_angles = total_deficit(b.angle_deficits()) / (2 * pi),
                     .indicator = indicator_on(b)};
    const Vector bending = 2 * b.H.array().square() - b.K.array();   // ½(κ₁² + κ₂²)
    for (const Estimator& e : estimators()) {
        const bool of_H = e.quantity == Quantity::H;
        level.errors[e.key] = error_of(e.estimate(b), of_H ? b.H : b.K, of_H ? bending.cwiseSqrt() : bending, b);
    }
    return level;
}

ErrorHistory BenchRun::errors(std::string_view key, Norm norm) const {
    return {each_of(levels, &BenchLevel::mean_edge), each_of(levels, [&](const BenchLevel& level) { return level.error(key).*norm; })};
}

std::vector<std::reference_wrapper<const BenchRun>> of_kind(const BenchRuns& runs, MeshKind kind) {
    std::vector<std::reference_wrapper<const BenchRun>> found;
    std::ranges::copy_if(runs, std::back_inserter(found), [kind](const BenchRun& run) { return run.kind == kind; });
    return found;
}

BenchRuns bench_runs(const MeshLibrary& library, const std::vector<KnownSurface>& surfaces, std::span<const MeshKind> kinds,
                     const std::vector<int>& levels, std::uint64_t seed, const Progress& progress) {
    BenchRuns runs;
    for (const MeshKind kind : kinds)
        for (const KnownSurface& surface : surfaces)
            runs.push_back({surface.name, surface.dimensions, kind, std::vector<BenchLevel>(levels.size())});
    for (std::size_t l = levels.size(); l-- > 0;) {   // the finest first, which take longest
        const std::string on = ", level " + std::to_string(levels[l]);
        progress("curvature estimates on " + std::to_string(runs.size()) + " meshes" + on);
        for_each_task(runs.size(), [&](std::size_t i) {
            const auto measure = [&] { return measured(bench_mesh(surfaces[i % surfaces.size()], runs[i].kind, levels[l], seed)); };
            runs[i].levels[l] = library.once("bench: " + runs[i].title() + on + ", seed " + std::to_string(seed), measure);
        });
    }
    return runs;
}

BenchLevel reference_level(const MeshLibrary& library, int points, std::uint64_t seed) {
    return library.once("bench: " + std::to_string(points) + " points of the reference, seed " + std::to_string(seed), [&] {
        return measured(random_ellipsoid({1.5, 1, 0.7}, points, seed));
    });
}

const BenchRun& run_on(const BenchRuns& runs, std::string_view surface, MeshKind kind) {
    const auto found = std::ranges::find_if(runs, [&](const BenchRun& run) { return run.surface == surface && run.kind == kind; });
    if (found == runs.end())
        throw std::logic_error("no curvature run on the " + std::string(surface) + " in " + std::string(name_of(kind)) + " meshes");
    return *found;
}

double pentagon_excess() { return 3 / std::tan(54 * pi / 180) / (2 * std::sin(72 * pi / 180)) - 1; }

report::Check pentagon_check(const BenchRuns& runs) {
    const BenchLevel& sphere = run_on(runs, "sphere", MeshKind::regular).finest();
    return check_near(curvature_words.line("check.pentagon"), pentagon_excess(), sphere.error("H.barycentric").linf,
                      0.25 * sphere.mean_edge * sphere.mean_edge, curvature_words.line("check.pentagon.note"));
}

report::Plot convergence_plot(std::string id, const report::Words& words, const BenchRuns& runs,
                              std::initializer_list<std::pair<std::string_view, std::string_view>> estimators) {
    report::Plot plot = error_plot(std::move(id), words.line("convergence"), words.line("convergence.alt"));
    for (const KnownSurface& surface : question_surfaces()) {
        int color = 0;
        for (const auto& [estimator, key] : estimators) {
            for (const MeshKind kind : question_kinds) {
                using enum report::Series::Style;
                const ErrorHistory errors = run_on(runs, surface.name, kind).errors(estimator);
                const std::string name = words.line(key, "triangulation"_a = name_of(kind));
                report::Series& series =
                    plot.series.emplace_back(error_series(name, errors, kind == MeshKind::regular ? line_and_points : dashed));
                series.color = color;
                series.panel = surface.name;
                plot.alt += " " + words.line("convergence.alt.series", "series"_a = surface.name + ", " + name, "trend"_a = trend(errors));
            }
            ++color;
        }
    }
    return plot;
}

std::vector<int> refinement_levels(bool quick) { return quick ? std::vector{3, 4, 5} : std::vector{2, 3, 4, 5}; }

BenchRuns question_runs(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    return bench_runs(library, question_surfaces(), question_kinds, refinement_levels(settings.quick), settings.seed, progress);
}

BenchRuns panel_runs(const MeshLibrary& library, std::uint64_t seed, bool quick, const Progress& progress) {
    return bench_runs(library, known_surfaces(), panel_kinds, quick ? std::vector{2, 3, 4} : std::vector{2, 3, 4, 5}, seed, progress);
}

}   // namespace meshfolio
