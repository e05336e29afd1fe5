#include "run/mark/references.h"

#include <functional>
#include <memory>
#include <string>

#include "base/errors.h"
#include "geometry/linear/sparse_factor.h"
#include "geometry/operators/vertices_with_mass.h"
#include "mesh/triangle_measures.h"

namespace meshfolio::run {

namespace {

/// The most steps × vertices of a run that rebuilds its operator: beyond, all wrong operators together would take minutes.
constexpr double most_rebuilt = 2e5;

/// Returns the function that maps X to the next X. An LDLT factor serves, because a step with a wrong sign may have no Cholesky factor.
std::function<Positions(const Positions&)> step_of(const LaplaceBeltrami& L, const SmoothingOptions& options) {
    const OperatorWithMass whole = operator_with_mass(L);
    const auto explicit_step_by = [whole](double lambda, const Positions& X) -> Positions {
        return X - lambda * whole.M.cwiseInverse().asDiagonal() * (whole.A * X);
    };
    std::function<Positions(const Positions&)> step;
    if (options.scheme == SmoothingScheme::implicit_euler) {
        const SparseMatrix system = SparseMatrix(whole.M.asDiagonal()) + options.lambda * whole.A;
        const auto factor = std::make_shared<SparseFactor>(SparseFactor::ldlt(system));
        step = [=, M = whole.M](const Positions& X) -> Positions {
            const Positions right = M.asDiagonal() * X, next = factor->solve(DenseMatrix(right));
            return next + factor->solve(DenseMatrix(right - system * next));   // corrects the rounding of an indefinite factor
        };
    } else if (options.scheme == SmoothingScheme::taubin) {
        step = [=, lambda = options.lambda, mu = taubin_mu_of(L, options)](const Positions& X) {
            return explicit_step_by(mu, explicit_step_by(lambda, X));
        };
    } else {
        step = [=, lambda = options.lambda](const Positions& X) { return explicit_step_by(lambda, X); };
    }
    return [=, vertex = whole.vertex, copies = whole.copies](Positions X) {
        const Eigen::RowVector3d near = X.row(vertex.front());
        const Positions rows = X(vertex, Eigen::all).rowwise() - near;
        X(vertex, Eigen::all) = step(rows).rowwise() + near;
        spread(copies, X);
        return X;
    };
}

}   // namespace

SmoothingOptions smoothing_of(const PreparedMesh& prepared, const AnswerSettings& s) {
    SmoothingOptions options{
        .scheme = s.scheme, .laplacian = s.laplacian, .iterations = s.iterations, .rebuild = s.rebuild, .area = s.area};
    // Like `meshfolio smooth`: tau is the largest stable step with barycentric areas.
    const double critical =
        s.unit == StepUnit::tau ? largest_stable_step(largest_eigenvalue(laplace_operator(prepared.mesh, s.laplacian))) : 0;
    options.lambda = step_in_model_units(s.lambda, s.unit, critical, mean_edge_length(prepared.mesh));
    return options;
}

std::vector<Variant> smoothing_variants(const PreparedMesh& prepared, const AnswerSettings& s) {
    std::vector<Variant> variants;
    const SmoothingOptions right = smoothing_of(prepared, s);
    const auto attempt = [&](const std::string& key, const OperatorOf& operator_of, auto change) {
        SmoothingOptions wrong = right;
        try {
            change(wrong);
            TriangleMesh mesh = prepared.mesh;
            auto step = step_of(operator_of(mesh), wrong);
            for (int i = 0; i < wrong.iterations && mesh.X.allFinite(); ++i) {
                if (wrong.rebuild && i > 0) step = step_of(operator_of(mesh), wrong);
                mesh.X = step(mesh.X);
            }
            if (wrong.iterations > 0 && mesh.X.allFinite()) variants.push_back({key, flat(mesh.X)});
        } catch (const Error&) {   // the mistake has no result here
        }
    };
    const OperatorOf own = [&](const TriangleMesh& mesh) { return laplace_operator(mesh, s.laplacian, s.area); };
    attempt("lambda_doubled", own, [](SmoothingOptions& o) { o.lambda *= 2; });
    attempt("lambda_halved", own, [](SmoothingOptions& o) { o.lambda /= 2; });
    attempt("one_more", own, [](SmoothingOptions& o) { ++o.iterations; });
    attempt("one_less", own, [](SmoothingOptions& o) { --o.iterations; });
    attempt("other_rebuild", own, [](SmoothingOptions& o) { o.rebuild = !o.rebuild; });
    attempt("lambda_negated", own, [&](SmoothingOptions& o) {
        if (o.scheme == SmoothingScheme::taubin) o.taubin_mu = -taubin_mu_of(own(prepared.mesh), o);
        o.lambda *= -1;
    });
    if (s.scheme != SmoothingScheme::taubin) {
        const bool is_implicit = s.scheme == SmoothingScheme::implicit_euler;
        attempt("other_scheme", own,
                [&](SmoothingOptions& o) { o.scheme = is_implicit ? SmoothingScheme::explicit_euler : SmoothingScheme::implicit_euler; });
    }
    if (right.rebuild && static_cast<double>(right.iterations) * prepared.mesh.vertex_count() > most_rebuilt) return variants;
    for (const WrongLaplacian& wrong : wrong_laplacians(s)) {
        attempt(wrong.key, wrong.of, [](SmoothingOptions&) {});
        if (s.unit != StepUnit::tau) continue;
        attempt(wrong.key, wrong.of, [&](SmoothingOptions& o) {   // in units of its own largest stable step
            o.lambda = s.lambda * largest_stable_step(largest_eigenvalue(wrong.of(prepared.mesh)));
        });
    }
    return variants;
}

}   // namespace meshfolio::run
