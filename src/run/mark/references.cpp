#include "run/mark/references.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "geometry/curvature/curvature.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/spectrum/spectral_reconstruction.h"
#include "mesh/triangle_measures.h"

namespace meshfolio::run {

namespace {

constexpr double equal_eigenvalues = 1e-6;   // relative difference below which eigenvalues count as equal
constexpr std::size_t most_variants = 64;    // sets of wrong answers in memory, each some 25 times the positions of a mesh

Vector ones_where_positive(const Vector& M) { return (M.array() > 0).select(Vector::Ones(M.size()), 0); }

/// Calls use(wrong, operator) for each wrong operator; skips operators without an answer on this mesh.
template <class Use> void for_each_wrong_laplacian(const TriangleMesh& mesh, const AnswerSettings& s, const Use& use) {
    for (const WrongLaplacian& wrong : wrong_laplacians(s)) {
        try {
            use(wrong, wrong.of(mesh));
        } catch (const Error&) {
        }
    }
}

double diagonal_of(const PreparedMesh& prepared) { return (prepared.preflight.box_high - prepared.preflight.box_low).norm(); }

Vector mean_curvature_by(const PreparedMesh& prepared, OperatorKind kind, const LaplaceBeltrami& L) {
    return operator_mean_curvature(prepared.mesh, prepared.topology, kind, L);
}

/// Returns sums over the neighbours of each vertex, from means over them.
Vector summed(const Vector& mean, const MeshTopology& topology) {
    Vector sum = mean;
    for (Eigen::Index v = 0; v < sum.size(); ++v) sum[v] *= topology.neighbours.size(static_cast<int>(v));
    return sum;
}

// ---- curvature ----------------------------------------------------------------------------------------------------------

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
    for_each_wrong_laplacian(prepared.mesh, s, [&](const WrongLaplacian& wrong, const LaplaceBeltrami& L) {
        const Vector eigenvalues = smallest_eigenpairs(L, s.k).eigenvalues;
        if (eigenvalues.size() == s.k) variants.push_back({wrong.key, eigenvalues});
    });
    return variants;
}

std::vector<Variant> reconstruction_variants(const PreparedMesh& prepared, const AnswerSettings& s) {
    std::vector<Variant> variants;
    const Positions& X = prepared.mesh.X;
    const LaplaceBeltrami right = laplace_operator(prepared.mesh, s.laplacian, s.area);
    const Spectrum spectrum = smallest_eigenpairs(right, s.k + 1);
    const auto found = static_cast<int>(spectrum.eigenvalues.size());
    variants.push_back({"unmapped", flat(reconstruct_unmapped(spectrum, right.M, X, std::min(s.k, found)))});
    variants.push_back({"unweighted", flat(reconstruct_unweighted(spectrum, right.M, X, std::min(s.k, found)))});
    if (s.k > 1 && s.k <= found) variants.push_back({"one_less", flat(reconstruct(spectrum, right.M, X, s.k - 1))});
    if (found > s.k) {
        const Positions more = reconstruct(spectrum, right.M, X, s.k + 1), constant = reconstruct(spectrum, right.M, X, 1);
        variants.push_back({"one_more", flat(more)});
        variants.push_back({"zero_left_out", flat(more - constant)});
    }
    for_each_wrong_laplacian(prepared.mesh, s, [&](const WrongLaplacian& wrong, const LaplaceBeltrami& L) {
        if (wrong.key == "half_kept") return;   // a factor does not change the modes
        const Spectrum its_own = smallest_eigenpairs(L, s.k);
        variants.push_back({wrong.key, flat(reconstruct(its_own, L.M, X, static_cast<int>(its_own.eigenvalues.size())))});
    });
    return variants;
}

/// Returns the modes that share their eigenvalue with mode k − 1; nothing if more than a few follow.
std::optional<EqualModes> equal_modes(const LaplaceBeltrami& L, const Positions& X, int k) {
    constexpr int a_few = 12;
    const Spectrum spectrum = smallest_eigenpairs(L, k + a_few);
    const double eigenvalue = spectrum.eigenvalues[k - 1];
    const auto is_equal = [&](Eigen::Index i) { return std::abs(spectrum.eigenvalues[i] - eigenvalue) <= equal_eigenvalues * eigenvalue; };
    Eigen::Index first = k - 1, end = k;
    while (first > 0 && is_equal(first - 1)) --first;
    while (end < spectrum.eigenvalues.size() && is_equal(end)) ++end;
    const bool is_cut_off = end == spectrum.eigenvalues.size() && end < operator_with_mass(L).size();
    if (first == 0 || is_cut_off) return {};
    return EqualModes{L.M, X, reconstruct(spectrum, L.M, X, static_cast<int>(first)), spectrum.eigenvectors.middleCols(first, end - first),
                      k - static_cast<int>(first)};
}

Reference reconstruction_of(const PreparedMesh& prepared, const AnswerSettings& s) {
    Reference reference;
    const LaplaceBeltrami L = laplace_operator(prepared.mesh, s.laplacian, s.area);
    const Spectrum spectrum = smallest_eigenpairs(L, s.k + 1);
    const auto found = static_cast<int>(spectrum.eigenvalues.size());
    reference.right = {flat(reconstruct(spectrum, L.M, prepared.mesh.X, std::min(s.k, found))), diagonal_of(prepared), true};
    if (found > s.k) {
        const double last = spectrum.eigenvalues[s.k - 1], next = spectrum.eigenvalues[s.k];
        reference.not_unique = next - last <= equal_eigenvalues * next;
        if (reference.not_unique) reference.equal = equal_modes(L, prepared.mesh.X, s.k);
    }
    return reference;
}

RightValues right_values(const RubricItem& item, const AnswerSettings& s, const PreparedMesh& prepared) {
    const TriangleMesh& mesh = prepared.mesh;
    const double diagonal = diagonal_of(prepared);
    if (item.what == MarkedThing::H)
        return {mean_curvature_by(prepared, s.laplacian, laplace_operator(mesh, s.laplacian, s.area)), 1e-6 / diagonal};
    if (item.what == MarkedThing::H_uniform) return {uniform_mean_curvature(mesh, prepared.topology), 1e-9 * diagonal};
    if (item.what == MarkedThing::K)
        return {gaussian_curvature(mesh, prepared.topology, vertex_areas(mesh, s.area)), 1e-6 / (diagonal * diagonal)};
    if (item.what == MarkedThing::eigenvalues) return {smallest_eigenpairs(laplace_operator(mesh, s.laplacian, s.area), s.k).eigenvalues};
    return {flat(smooth(mesh, smoothing_of(prepared, s)).X), diagonal, true};
}

std::vector<Variant> computed_variants(const RubricItem& item, const AnswerSettings& s, const Reference& reference) {
    const PreparedMesh& prepared = *reference.mesh->prepared;
    if (item.what == MarkedThing::H_uniform)
        return {{"valence_sum", summed(reference.right.values, prepared.topology)},
                {"scaled", uniform_mean_curvature_scaled(prepared.mesh, prepared.topology)}};
    if (item.what == MarkedThing::K) return gaussian_variants(prepared, s.area);
    if (item.what == MarkedThing::eigenvalues) return spectrum_variants(prepared, s);
    if (item.what == MarkedThing::reconstruction) return reconstruction_variants(prepared, s);
    if (item.what == MarkedThing::smoothed) return smoothing_variants(prepared, s);
    std::vector<Variant> variants;   // of H
    for_each_wrong_laplacian(prepared.mesh, s, [&](const WrongLaplacian& wrong, const LaplaceBeltrami& L) {
        const Vector H = mean_curvature_by(prepared, wrong.kind, L);
        variants.push_back({wrong.key, wrong.key == "valence_sum" ? summed(H, prepared.topology) : H});
    });
    return variants;
}

}   // namespace

std::vector<WrongLaplacian> wrong_laplacians(const AnswerSettings& s) {
    std::vector<WrongLaplacian> all;
    const auto named = [&](const std::string& key, OperatorKind kind, AreaForm area) {
        all.push_back({key, kind, [=](const TriangleMesh& mesh) { return laplace_operator(mesh, kind, area); }});
    };
    const auto with_masses = [&](const std::string& key, auto masses) {
        all.push_back({key, s.laplacian, [=](const TriangleMesh& mesh) {
                           const LaplaceBeltrami right = laplace_operator(mesh, s.laplacian, s.area);
                           return LaplaceBeltrami{right.C, masses(right.M), right.copies};
                       }});
    };
    const auto by_two_areas = [&](const std::string& key, double factor, bool clamp_negative) {
        all.push_back({key, OperatorKind::edge_normalised, [=](const TriangleMesh& mesh) {
                           return LaplaceBeltrami{factor * edge_normalised_laplacian(mesh, clamp_negative),
                                                  ones_where_positive(vertex_areas(mesh, AreaForm::barycentric))};
                       }});
    };
    for (const OperatorEntry& entry : operator_list())
        if (entry.kind != s.laplacian) named("operator_" + std::string(entry.name), entry.kind, s.area);
    if (is_dimensionless(s.laplacian)) {   // it has no areas: its masses are the valences
        with_masses("valence_sum", ones_where_positive);
        return all;
    }
    for (const AreaForm form : {AreaForm::barycentric, AreaForm::voronoi, AreaForm::mixed})
        if (form != s.area) named("area_" + std::string(name_of(form)), s.laplacian, form);
    with_masses("without_area", ones_where_positive);
    with_masses("whole_ring", [](const Vector& M) -> Vector { return 3 * M; });
    by_two_areas("unclamped", 1, false);
    by_two_areas("half_kept", 0.5, true);
    by_two_areas("half_kept", 0.5, false);
    return all;
}

// A choice projects all coefficients c to ĉ = Pc by a projector P of rank `taken`. Such a P exists if ĉᵀ(c − ĉ) = 0 and the ranks of ĉ and
// c − ĉ are not larger than those of P and I − P.
bool is_another_choice(const Positions& given, const EqualModes& equal, double tolerance) {
    const DenseMatrix D = given - equal.below, weighted = equal.modes.transpose() * equal.M.asDiagonal();
    const DenseMatrix all = weighted * equal.X, own = weighted * D, rest = all - own;
    if (!given.allFinite() || (D - equal.modes * own).cwiseAbs().maxCoeff() > tolerance) return false;
    const double off = tolerance * std::sqrt(equal.M.sum());   // of a coefficient [length²]
    const auto has_rank = [&](const DenseMatrix& A, Eigen::Index rank) {
        const Vector singular = A.jacobiSvd().singularValues();
        return rank >= singular.size() || singular[rank] <= off;
    };
    const double mixed = (own.transpose() * rest).cwiseAbs().maxCoeff();
    return mixed <= 3 * off * (all.norm() + off) && has_rank(own, equal.taken) && has_rank(rest, equal.modes.cols() - equal.taken);
}

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
        const auto& mesh = meshes_.at(item.id);
        if (item.what == MarkedThing::reconstruction) reference = reconstruction_of(*mesh->prepared, settings);
        else reference.right = right_values(item, settings, *mesh->prepared);
        reference.mesh = mesh;
    }
    return references_[key] = std::move(reference);
}

const std::vector<Variant>& References::variants_of(const RubricItem& item, const AnswerSettings& settings) {
    const Key key{item.id, settings};
    if (const auto known = variants_.find(key); known != variants_.end()) return known->second;
    if (variants_.size() >= most_variants) variants_.clear();   // every student chooses other settings
    return variants_[key] = computed_variants(item, settings, of(item, settings));
}

}   // namespace meshfolio::run
