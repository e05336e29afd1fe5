#include "run/mark/references.h"

#include <algorithm>

#include "base/errors.h"
#include "geometry/curvature/curvature.h"
#include "geometry/spectrum/spectral_mistakes.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "mesh/triangle_measures.h"

namespace meshfolio::run {

namespace {

/// Eigenvalues nearer than this, relative, have eigenvectors that are one choice of many.
constexpr double equal_eigenvalues = 1e-6;
/// Beyond, steps that each factor a matrix of their own would take too long.
constexpr int most_single_steps = 50;

/// A Laplacian with its kind: the uniform one makes a curvature in its own way.
struct MarkedLaplacian {
    std::string key;   // of the convention; empty: the right one
    OperatorKind kind = OperatorKind::cotan;
    AreaForm area = AreaForm::barycentric;
    LaplaceBeltrami L;
};

MarkedLaplacian right_laplacian(const TriangleMesh& mesh, const AnswerSettings& s) {
    return {"", s.laplacian, s.area, laplace_operator(mesh, s.laplacian, s.area)};
}

/// Calls `use` with each of the operator laboratory but the right one, and with what is made of that by wrong areas.
template <class Use>
void for_each_wrong_laplacian(const TriangleMesh& mesh, const AnswerSettings& s, const Use& use) {
    const auto attempt = [&](auto make) {
        try {
            use(make());
        } catch (const Error&) {   // no such operator on this mesh, or no such answer with it
        }
    };
    for (const OperatorEntry& entry : operator_list()) {
        if (entry.kind == s.laplacian) continue;
        attempt([&] {
            return MarkedLaplacian{"operator_" + std::string(entry.name), entry.kind, s.area, laplace_operator(mesh, entry.kind, s.area)};
        });
    }
    if (is_dimensionless(s.laplacian)) return;   // it has no areas
    for (const AreaForm form : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed}) {
        if (form == s.area) continue;
        attempt([&] {
            return MarkedLaplacian{"area_" + std::string(name_of(form)), s.laplacian, form, laplace_operator(mesh, s.laplacian, form)};
        });
    }
    const LaplaceBeltrami right = laplace_operator(mesh, s.laplacian, s.area);
    attempt([&] {
        const Vector ones = (right.M.array() > 0).select(Vector::Ones(right.M.size()), 0);
        return MarkedLaplacian{"without_area", s.laplacian, s.area, {right.C, ones}};
    });
    attempt([&] { return MarkedLaplacian{"whole_ring", s.laplacian, s.area, {right.C, 3 * right.M}}; });
    attempt([&] {
        const Vector ones = (right.M.array() > 0).select(Vector::Ones(right.M.size()), 0);
        return MarkedLaplacian{"unclamped", OperatorKind::edge_normalised, s.area, {edge_normalised_laplacian(mesh, false), ones}};
    });
}

Vector flat(const Positions& X) { return Eigen::Map<const Vector>(X.data(), X.size()); }

double diagonal_of(const PreparedMesh& prepared) { return (prepared.preflight.box_high - prepared.preflight.box_low).norm(); }

Vector mean_curvature_by(const PreparedMesh& prepared, const MarkedLaplacian& laplacian) {
    return operator_mean_curvature(prepared.mesh, prepared.topology, laplacian.kind, laplacian.L);
}

// ---- curvature ----------------------------------------------------------------------------------------------------------

std::vector<Variant> uniform_variants(const PreparedMesh& prepared, const Vector& right) {
    Vector valence(right.size());
    for (Eigen::Index v = 0; v < right.size(); ++v) valence[v] = prepared.topology.neighbours.size(static_cast<int>(v));
    return {{"valence_sum", right.cwiseProduct(valence)}, {"scaled", uniform_mean_curvature_scaled(prepared.mesh, prepared.topology)}};
}

std::vector<Variant> gaussian_variants(const PreparedMesh& prepared, AreaForm form) {
    std::vector<Variant> variants;
    const auto with = [&](const std::string& key, const Vector& areas) {
        variants.push_back({key, gaussian_curvature(prepared.mesh, prepared.topology, areas)});
    };
    for (const AreaForm other : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed})
        if (other != form) with("area_" + std::string(name_of(other)), vertex_areas(prepared.mesh, other));
    with("without_area", Vector::Ones(prepared.mesh.vertex_count()));
    with("whole_ring", 3 * vertex_areas(prepared.mesh, form));
    return variants;
}

// ---- spectra ------------------------------------------------------------------------------------------------------------

std::vector<Variant> spectrum_variants(const PreparedMesh& prepared, const AnswerSettings& s) {
    std::vector<Variant> variants;
    const Spectrum more = smallest_eigenpairs(laplace_operator(prepared.mesh, s.laplacian, s.area), s.k + 1);
    if (more.eigenvalues.size() > s.k) variants.push_back({"zero_left_out", more.eigenvalues.tail(s.k)});
    for_each_wrong_laplacian(prepared.mesh, s, [&](const MarkedLaplacian& laplacian) {
        const Vector eigenvalues = smallest_eigenpairs(laplacian.L, s.k).eigenvalues;
        if (eigenvalues.size() == s.k) variants.push_back({laplacian.key, eigenvalues});
    });
    return variants;
}

std::vector<Variant> reconstruction_variants(const PreparedMesh& prepared, const AnswerSettings& s) {
    std::vector<Variant> variants;
    const Positions& X = prepared.mesh.X;
    const LaplaceBeltrami L = laplace_operator(prepared.mesh, s.laplacian, s.area);
    const Spectrum spectrum = smallest_eigenpairs(L, s.k + 1);
    const auto found = static_cast<int>(spectrum.eigenvalues.size());
    variants.push_back({"unmapped", flat(reconstruct_unmapped(spectrum, L.M, X, std::min(s.k, found)))});
    variants.push_back({"unweighted", flat(reconstruct_unweighted(spectrum, L.M, X, std::min(s.k, found)))});
    if (s.k > 1 && s.k <= found) variants.push_back({"one_less", flat(reconstruct(spectrum, L.M, X, s.k - 1))});
    if (found > s.k) {
        const Positions more = reconstruct(spectrum, L.M, X, s.k + 1), constant = reconstruct(spectrum, L.M, X, 1);
        variants.push_back({"one_more", flat(more)});
        variants.push_back({"zero_left_out", flat(more - constant)});
    }
    for_each_wrong_laplacian(prepared.mesh, s, [&](const MarkedLaplacian& laplacian) {
        const Spectrum wrong = smallest_eigenpairs(laplacian.L, s.k);
        variants.push_back({laplacian.key, flat(reconstruct(wrong, laplacian.L.M, X, static_cast<int>(wrong.eigenvalues.size())))});
    });
    return variants;
}

// ---- smoothing ----------------------------------------------------------------------------------------------------------

SmoothingOptions smoothing_of(const PreparedMesh& prepared, const AnswerSettings& s) {
    SmoothingOptions options;
    options.scheme = s.scheme;
    options.laplacian = s.laplacian;
    options.area = s.area;
    options.iterations = s.iterations;
    options.rebuild = s.rebuild;
    // As `meshfolio smooth`: the largest stable step is that with barycentric areas.
    const double critical =
        s.unit == StepUnit::tau ? largest_stable_step(largest_eigenvalue(laplace_operator(prepared.mesh, s.laplacian))) : 0;
    options.lambda = step_in_model_units(s.lambda, s.unit, critical, mean_edge_length(prepared.mesh));
    return options;
}

/// Steps with a fixed operator, whatever it and the step are.
Positions steps_of(const LaplaceBeltrami& L, const SmoothingOptions& options, Positions X) {
    for (int i = 0; i < options.iterations && X.allFinite(); ++i) {
        X = options.scheme == SmoothingScheme::implicit_euler ? implicit_step(L, options.lambda, X) : explicit_step(L, options.lambda, X);
    }
    return X;
}

std::vector<Variant> smoothing_variants(const PreparedMesh& prepared, const AnswerSettings& s) {
    std::vector<Variant> variants;
    const SmoothingOptions right = smoothing_of(prepared, s);
    const auto attempt = [&](const std::string& key, auto change) {
        SmoothingOptions wrong = right;
        change(wrong);
        try {
            if (wrong.iterations > 0) variants.push_back({key, flat(smooth(prepared.mesh, wrong).X)});
        } catch (const Error&) {   // no such run
        }
    };
    attempt("lambda_doubled", [](SmoothingOptions& o) { o.lambda *= 2; });
    attempt("lambda_halved", [](SmoothingOptions& o) { o.lambda /= 2; });
    attempt("one_more", [](SmoothingOptions& o) { ++o.iterations; });
    attempt("one_less", [](SmoothingOptions& o) { --o.iterations; });
    attempt("other_rebuild", [](SmoothingOptions& o) { o.rebuild = !o.rebuild; });
    if (s.scheme == SmoothingScheme::taubin) return variants;
    const bool is_implicit = s.scheme == SmoothingScheme::implicit_euler;
    attempt("other_scheme",
            [&](SmoothingOptions& o) { o.scheme = is_implicit ? SmoothingScheme::explicit_euler : SmoothingScheme::implicit_euler; });
    SmoothingOptions backwards = right;
    backwards.lambda = -right.lambda;
    try {
        const LaplaceBeltrami L = laplace_operator(prepared.mesh, s.laplacian, s.area);
        variants.push_back({"lambda_negated", flat(steps_of(L, backwards, prepared.mesh.X))});
    } catch (const Error&) {   // M + |λ|C that cannot be factored
    }
    for_each_wrong_laplacian(prepared.mesh, s, [&](const MarkedLaplacian& laplacian) {
        const bool is_listed = laplacian.key.starts_with("operator_") || laplacian.key.starts_with("area_");
        SmoothingOptions wrong = right;
        wrong.laplacian = laplacian.kind;
        wrong.area = laplacian.area;
        if (is_listed || s.iterations <= most_single_steps)
            variants.push_back(
                {laplacian.key, flat(is_listed ? smooth(prepared.mesh, wrong).X : steps_of(laplacian.L, right, prepared.mesh.X))});
    });
    return variants;
}

std::vector<Variant> curvature_variants(const PreparedMesh& prepared, const AnswerSettings& s) {
    std::vector<Variant> variants;
    for_each_wrong_laplacian(prepared.mesh, s, [&](const MarkedLaplacian& laplacian) {
        variants.push_back({laplacian.key, mean_curvature_by(prepared, laplacian)});
    });
    return variants;
}

Reference reconstruction_of(const PreparedMesh& prepared, const AnswerSettings& s) {
    Reference reference;
    const LaplaceBeltrami L = laplace_operator(prepared.mesh, s.laplacian, s.area);
    const Spectrum spectrum = smallest_eigenpairs(L, s.k + 1);
    const auto found = static_cast<int>(spectrum.eigenvalues.size());
    reference.right.values = flat(reconstruct(spectrum, L.M, prepared.mesh.X, std::min(s.k, found)));
    if (found > s.k) {
        const double last = spectrum.eigenvalues[s.k - 1], next = spectrum.eigenvalues[s.k];
        reference.not_unique = next - last <= equal_eigenvalues * next;
    }
    return reference;
}

Reference computed(const RubricItem& item, const AnswerSettings& s, const PreparedMesh& prepared) {
    const TriangleMesh& mesh = prepared.mesh;
    const double diagonal = diagonal_of(prepared);
    Reference reference;
    switch (item.what) {
        case MarkedThing::H:
            reference.right = {mean_curvature_by(prepared, right_laplacian(mesh, s)), 1e-6 / diagonal};
            break;
        case MarkedThing::H_uniform:
            reference.right = {uniform_mean_curvature(mesh, prepared.topology), 1e-9 * diagonal};
            break;
        case MarkedThing::K:
            reference.right = {gaussian_curvature(mesh, prepared.topology, vertex_areas(mesh, s.area)), 1e-6 / (diagonal * diagonal)};
            break;
        case MarkedThing::eigenvalues:
            reference.right = {smallest_eigenpairs(laplace_operator(mesh, s.laplacian, s.area), s.k).eigenvalues, 0};
            break;
        case MarkedThing::reconstruction:
            reference = reconstruction_of(prepared, s);
            break;
        case MarkedThing::smoothed:
            reference.right.values = flat(smooth(mesh, smoothing_of(prepared, s)).X);
            break;
        case MarkedThing::number:
            break;
    }
    if (item.what == MarkedThing::reconstruction || item.what == MarkedThing::smoothed) {
        reference.right.scale = diagonal;
        reference.right.relative_to_scale = true;
    }
    return reference;
}

std::vector<Variant> computed_variants(const RubricItem& item, const AnswerSettings& s, const Reference& reference) {
    const PreparedMesh& prepared = *reference.mesh->prepared;
    switch (item.what) {
        case MarkedThing::H:
            return curvature_variants(prepared, s);
        case MarkedThing::H_uniform:
            return uniform_variants(prepared, reference.right.values);
        case MarkedThing::K:
            return gaussian_variants(prepared, s.area);
        case MarkedThing::eigenvalues:
            return spectrum_variants(prepared, s);
        case MarkedThing::reconstruction:
            return reconstruction_variants(prepared, s);
        case MarkedThing::smoothed:
            return smoothing_variants(prepared, s);
        case MarkedThing::number:
            break;
    }
    return {};
}

}   // namespace

References::References(const Rubric& rubric) {
    const MeshLibrary library({}, {});
    for (const RubricItem& item : rubric.items)
        if (item.what != MarkedThing::number) meshes_[item.id] = library.file(item.mesh, rubric.base);
}

const Reference& References::of(const RubricItem& item, const AnswerSettings& settings) {
    const Key key{item.id, settings};
    if (const auto known = references_.find(key); known != references_.end()) return known->second;
    Reference reference;
    if (item.what == MarkedThing::number) {
        reference.right.values = Vector::Constant(1, item.value);
    } else {
        reference = computed(item, settings, *meshes_.at(item.id)->prepared);
        reference.mesh = meshes_.at(item.id);
    }
    return references_[key] = std::move(reference);
}

const std::vector<Variant>& References::variants_of(const RubricItem& item, const AnswerSettings& settings) {
    const Key key{item.id, settings};
    if (const auto known = variants_.find(key); known != variants_.end()) return known->second;
    return variants_[key] = computed_variants(item, settings, of(item, settings));
}

}   // namespace meshfolio::run
