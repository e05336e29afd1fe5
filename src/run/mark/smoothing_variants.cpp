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

/// Steps times vertices of a run with a new operator at each: beyond, with all wrong operators, one submission would take minutes.
constexpr double most_rebuilt = 2e5;

/// One step with an operator, X to the next X. That of a wrong sign may have no Cholesky factor.
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
            return next + factor->solve(DenseMatrix(right - system * next));   // what an indefinite factor rounds away
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

/// As smooth(), whatever operator and step are, and however far the positions go.
Positions steps_of(const OperatorOf& operator_of, const SmoothingOptions& options, TriangleMesh mesh) {
    auto step = step_of(operator_of(mesh), options);
    for (int i = 0; i < options.iterations && mesh.X.allFinite(); ++i) {
        if (options.rebuild && i > 0) step = step_of(operator_of(mesh), options);
        mesh.X = step(mesh.X);
    }
    return mesh.X;
}

}   // namespace

SmoothingOptions smoothing_of(const PreparedMesh& prepared, const AnswerSettings& s) {
    SmoothingOptions options{
        .scheme = s.scheme, .laplacian = s.laplacian, .iterations = s.iterations, .rebuild = s.rebuild, .area = s.area};
    // As `meshfolio smooth`: the largest stable step is that with barycentric areas.
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
            const Positions X = steps_of(operator_of, wrong, prepared.mesh);
            if (wrong.iterations > 0 && X.allFinite()) variants.push_back({key, flat(X)});
        } catch (const Error&) {   // no such run
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
        attempt(wrong.key, wrong.of, [&](SmoothingOptions& o) {   // whose largest stable step is another
            o.lambda = s.lambda * largest_stable_step(largest_eigenvalue(wrong.of(prepared.mesh)));
        });
    }
    return variants;
}

}   // namespace meshfolio::run
