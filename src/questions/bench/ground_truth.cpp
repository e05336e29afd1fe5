#include "questions/bench/ground_truth.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>

#include "base/number_text.h"
#include "base/parallel_tasks.h"
#include "geometry/curvature/corrected_curvature.h"
#include "geometry/curvature/curvature.h"
#include "geometry/curvature/jet_fit.h"
#include "geometry/operators/cotangent_laplacian.h"
#include "geometry/operators/uniform_laplacian.h"
#include "questions/bench/uniform_curvature_study.h"

namespace meshfolio {

namespace {

/// Errors below this are rounding and have no order.
constexpr double rounding = 1e-9;

/// −½ Δx · n with the normal of the surface; NaN where the vertex has no area.
Vector along_normal(const Positions& laplacian_of_x, const Positions& normals) {
    return -0.5 * laplacian_of_x.cwiseProduct(normals).rowwise().sum();
}

struct Estimates {
    std::vector<Vector> H, K;   // in the order of estimators_of
};

void add_uniform(const TruthMesh& t, Estimates& estimates) {
    const Vector scale = 4 * mean_squared_ring_edge(t.mesh, t.topology).cwiseInverse();
    estimates.H.push_back(uniform_mean_curvature_scaled(t.mesh, t.topology));
    estimates.H.push_back(along_normal(uniform_laplacian(t.topology) * t.mesh.X, t.normals).cwiseProduct(scale));
}

void add_cotangent(const TruthMesh& t, Estimates& estimates) {
    LaplaceBeltrami laplacian{cotangent_stiffness(t.mesh.F, t.mesh.vertex_count(), corner_cotangents(t.mesh)), {}};
    const Vector stiffness_along_normal = along_normal(laplacian.C * t.mesh.X, t.normals);
    for (const AreaForm form : area_forms) {
        laplacian.M = form == AreaForm::barycentric ? t.areas : vertex_areas(t.mesh, form);
        estimates.H.push_back(cotangent_mean_curvature(t.mesh, t.topology, laplacian));
        estimates.H.push_back((laplacian.M.array() > 0)
                                  .select(stiffness_along_normal.cwiseQuotient(laplacian.M), Vector::Constant(t.H.size(), std::nan(""))));
        estimates.K.push_back(gaussian_curvature(t.mesh, t.topology, laplacian.M));
    }
}

void add_jet(const TruthMesh& t, Estimates& estimates) {
    JetCurvature jet = jet_curvature(t.mesh, t.topology);
    estimates.H.push_back(std::move(jet.H));
    estimates.K.push_back(std::move(jet.K));
}

void add_corrected(const TruthMesh& t, Estimates& estimates) {
    const auto add = [&](const Positions& normals) {
        CorrectedCurvature corrected = corrected_curvature(t.mesh, t.topology, normals);
        estimates.H.push_back(std::move(corrected.H));
        estimates.K.push_back(std::move(corrected.K));
    };
    for (const NormalWeights weights : {NormalWeights::area, NormalWeights::angle, NormalWeights::sphere}) {
        add(weighted_vertex_normals(t.mesh, weights));
    }
    add(t.normals);
}

EstimateError error_of(const Vector& estimate, const Vector& truth, const Vector& substitute, const TruthMesh& t) {
    const Vector& scale = truth.isZero() ? substitute : truth;
    EstimateError error;
    double squared = 0, scale_squared = 0, largest_scale = 0;
    for (Eigen::Index i = 0; i < estimate.size(); ++i) {
        if (!t.measured[static_cast<std::size_t>(i)]) continue;
        scale_squared += t.areas[i] * scale[i] * scale[i];
        largest_scale = std::max(largest_scale, std::abs(scale[i]));
        if (!std::isfinite(estimate[i])) {
            ++error.undefined;
            continue;
        }
        const double difference = estimate[i] - truth[i];
        squared += t.areas[i] * difference * difference;
        error.linf = std::max(error.linf, std::abs(difference));
    }
    error.l2 = std::sqrt(squared / scale_squared);
    error.linf /= largest_scale;
    return error;
}

std::string with_decimals(double x, int decimals) {
    char text[400];   // the largest double has 309 digits
    return {text, std::to_chars(text, text + sizeof text, x, std::chars_format::fixed, decimals).ptr};
}

}   // namespace

const std::vector<Estimator>& estimators_of(Quantity quantity) {
    static const std::vector<Estimator> of_H{{"uniform", "uniform"},
                                             {"uniform_n", "uniform.along_normal"},
                                             {"barycentric", "cotangent.barycentric"},
                                             {"barycentric_n", "cotangent.barycentric.along_normal"},
                                             {"voronoi", "cotangent.voronoi"},
                                             {"voronoi_n", "cotangent.voronoi.along_normal"},
                                             {"mixed", "cotangent.mixed"},
                                             {"mixed_n", "cotangent.mixed.along_normal"},
                                             {"jet", "jet"},
                                             {"corrected_area", "corrected.area"},
                                             {"corrected_angle", "corrected.angle"},
                                             {"corrected_max", "corrected.max"},
                                             {"corrected_exact", "corrected.exact"}};
    static const std::vector<Estimator> of_K{{"barycentric", "deficit.barycentric"},
                                             {"voronoi", "deficit.voronoi"},
                                             {"mixed", "deficit.mixed"},
                                             {"jet", "jet"},
                                             {"corrected_area", "corrected.area"},
                                             {"corrected_angle", "corrected.angle"},
                                             {"corrected_max", "corrected.max"},
                                             {"corrected_exact", "corrected.exact"}};
    return quantity == Quantity::H ? of_H : of_K;
}

std::size_t estimator_index(Quantity quantity, const std::string& key) {
    const auto& estimators = estimators_of(quantity);
    const auto found = std::ranges::find(estimators, key, &Estimator::key);
    if (found == estimators.end()) throw std::logic_error("no estimator " + key);
    return static_cast<std::size_t>(found - estimators.begin());
}

PanelLevel panel_level(const TruthMesh& t) {
    Estimates estimates;
    add_uniform(t, estimates);
    add_cotangent(t, estimates);
    add_jet(t, estimates);
    add_corrected(t, estimates);
    const Vector bending = 2 * t.H.array().square() - t.K.array();   // ½(κ₁² + κ₂²)
    PanelLevel level;
    level.vertices = t.mesh.vertex_count();
    level.mean_edge = t.mean_edge;
    for (const Vector& H : estimates.H) level.H.push_back(error_of(H, t.H, bending.cwiseSqrt(), t));
    for (const Vector& K : estimates.K) level.K.push_back(error_of(K, t.K, bending, t));
    return level;
}

FittedOrder order_with_error(const std::vector<double>& mean_edges, const std::vector<double>& errors) {
    FittedOrder fit{std::nan(""), std::nan("")};
    std::vector<double> x, y;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        if (!(errors[i] > 0) || !std::isfinite(errors[i])) continue;
        x.push_back(std::log(mean_edges[i]));
        y.push_back(std::log(errors[i]));
    }
    const auto n = static_cast<Eigen::Index>(x.size());
    if (n < 2 || errors.back() < rounding) return fit;
    const Eigen::Map<const Vector> X(x.data(), n), Y(y.data(), n);
    const Vector dx = X.array() - X.mean(), dy = Y.array() - Y.mean();
    fit.order = dx.dot(dy) / dx.squaredNorm();
    if (n > 2) fit.standard_error = std::sqrt((dy - fit.order * dx).squaredNorm() / double(n - 2) / dx.squaredNorm());
    return fit;
}

const PanelRun& GroundTruth::run(const std::string& surface, MeshKind kind) const {
    const auto found = std::ranges::find_if(runs, [&](const PanelRun& r) { return r.surface == surface && r.kind == kind; });
    if (found == runs.end()) throw std::logic_error("no run on the " + surface);
    return *found;
}

EstimateError GroundTruth::finest(const std::string& surface, MeshKind kind, Quantity quantity, const std::string& key) const {
    return run(surface, kind).finest(quantity, estimator_index(quantity, key));
}

FittedOrder GroundTruth::order(const PanelRun& r, Quantity quantity, std::size_t estimator, double EstimateError::*norm) const {
    std::vector<double> mean_edges, errors;
    for (std::size_t level = 0; level < r.levels.size(); ++level) {
        mean_edges.push_back(r.levels[level].mean_edge);
        errors.push_back(r.error(quantity, estimator, level).*norm);
    }
    return order_with_error(mean_edges, errors);
}

FittedOrder GroundTruth::order(const std::string& surface, MeshKind kind, Quantity quantity, const std::string& key) const {
    return order(run(surface, kind), quantity, estimator_index(quantity, key));
}

GroundTruth ground_truth(std::uint64_t seed, bool quick, const Progress& progress) {
    const std::vector<TruthSurface> surfaces = truth_surfaces();
    const std::vector<int> levels = quick ? std::vector{2, 3, 4} : std::vector{2, 3, 4, 5};
    GroundTruth truth{{}, {}, seed, quick};
    for (const MeshKind kind : mesh_kinds) {
        for (const TruthSurface& s : surfaces) {
            truth.runs.push_back({s.surface.name, s.surface.dimensions, kind, std::vector<PanelLevel>(levels.size())});
        }
    }
    // All runs of the finest level first: they take longest.
    for (std::size_t level = levels.size(); level-- > 0;) {
        progress("level " + std::to_string(levels[level]) + " of every surface and kind of mesh");
        for_each_task(truth.runs.size(), [&](std::size_t r) {
            truth.runs[r].levels[level] = panel_level(truth_mesh(surfaces[r % surfaces.size()], truth.runs[r].kind, levels[level], seed));
        });
    }
    truth.reference = panel_level(random_ellipsoid({1.5, 1, 0.7}, 10000, seed));
    return truth;
}

std::shared_ptr<const GroundTruth> shared_ground_truth(const QuestionSettings& settings, const Progress& progress) {
    static std::mutex mutex;
    static std::map<std::pair<std::uint64_t, bool>, std::shared_ptr<const GroundTruth>> known;
    const std::lock_guard lock(mutex);   // held meanwhile: whoever needs it too waits, rather than working it out again
    auto& truth = known[{settings.seed, settings.quick}];
    if (!truth) truth = std::make_shared<const GroundTruth>(ground_truth(settings.seed, settings.quick, progress));
    return truth;
}

std::string words_of(const FittedOrder& order) {
    if (std::isnan(order.order)) return "exact";
    const std::string sign = order.order < -0.005 ? "−" : "", size = with_decimals(std::abs(order.order), 2);
    if (std::isnan(order.standard_error)) return sign + size;
    if (order.standard_error < 0.0005) return sign + size + "\u202f±\u202f<\u202f0.001";
    return sign + size + "\u202f±\u202f" + with_decimals(order.standard_error, order.standard_error < 0.01 ? 3 : 2);
}

std::string error_and_order(const GroundTruth& truth, const std::string& surface, MeshKind kind, Quantity quantity,
                            const std::string& key) {
    return curvature_words.line("error_and_order", "error"_a = readable_percent(truth.finest(surface, kind, quantity, key).l2, 2),
                                "order"_a = words_of(truth.order(surface, kind, quantity, key)));
}

}   // namespace meshfolio
