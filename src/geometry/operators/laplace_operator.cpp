#include "geometry/operators/laplace_operator.h"

#include <array>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "geometry/curvature/curvature.h"
#include "geometry/operators/intrinsic_delaunay.h"
#include "geometry/operators/tufted_cover.h"
#include "geometry/operators/uniform_laplacian.h"

namespace meshfolio {
namespace {

constexpr std::array operators{
    OperatorEntry{OperatorKind::cotan, "cotan", "cotangent", "Half the sum of the two opposite cotangents: the finite-element matrix."},
    OperatorEntry{OperatorKind::uniform, "uniform", "uniform", "Mean of the neighbours minus the vertex; it sees no lengths."},
    OperatorEntry{OperatorKind::cotan_no_half, "cotan-no-half", "cotangent without ½",
                  "The sum of the two opposite cotangents, without the half."},
    OperatorEntry{OperatorKind::clamped, "clamped", "clamped", "Cotangent weights, the negative ones replaced by 0."},
    OperatorEntry{OperatorKind::opposite_mean, "opposite-mean", "mean over opposite vertices",
                  "The mean of the cotangents at the n opposite vertices; boundary weights double."},
    OperatorEntry{OperatorKind::edge_normalised, "edge-normalised", "normalised per edge",
                  "(cot α + cot β)/(Aᵢ + Aⱼ), negative weights replaced by 0, rows summing to 0."},
    OperatorEntry{OperatorKind::idt, "idt", "intrinsic Delaunay", "Cotangents and areas of the intrinsic Delaunay triangulation."},
    OperatorEntry{OperatorKind::idt_original_mass, "idt-original-mass", "intrinsic Delaunay, own areas",
                  "Cotangents of the intrinsic Delaunay triangulation with the areas of the mesh itself."},
    OperatorEntry{OperatorKind::tufted, "tufted", "tufted cover",
                  "Intrinsic Delaunay on the two-sided cover with mollified lengths, for non-manifold meshes too."},
};

/// Returns the edge-normalised, tufted or Delaunay operator of a mesh without coincident vertices.
LaplaceBeltrami assembled(const TriangleMesh& mesh, OperatorKind kind, AreaForm area) {
    if (kind == OperatorKind::edge_normalised) {
        LaplaceBeltrami laplacian{edge_normalised_laplacian(mesh), Vector::Zero(mesh.X.rows())};
        for (const int v : mesh.F.reshaped()) laplacian.M[v] = 1;
        return laplacian;
    }
    if (kind == OperatorKind::tufted) return tufted_laplacian(mesh, area);
    const IntrinsicTriangles delaunay = intrinsic_delaunay(intrinsic_triangles(mesh)).triangles;
    LaplaceBeltrami laplacian = laplace_beltrami(delaunay.F, delaunay.vertex_count, delaunay.lengths, area);
    if (kind == OperatorKind::idt_original_mass) laplacian.M = vertex_areas(mesh, area);
    return laplacian;
}

}   // namespace

std::span<const OperatorEntry> operator_list() { return operators; }

const OperatorEntry& operator_entry(OperatorKind kind) {
    return *std::find_if(operators.begin(), operators.end(), [&](const OperatorEntry& entry) { return entry.kind == kind; });
}

OperatorKind operator_named(const std::string& name) {
    std::vector<std::string> known;
    std::string list;
    for (const OperatorEntry& entry : operators) {
        if (entry.name == name) return entry.kind;
        known.emplace_back(entry.name);
        list += (list.empty() ? "" : ", ") + known.back();
    }
    throw UsageError("unknown operator '" + printable(name) + "'", "did you mean '" + nearest_word(name, known) + "'? Known are " + list);
}

bool is_dimensionless(OperatorKind kind) { return kind == OperatorKind::uniform; }

bool has_intrinsic_lengths(OperatorKind kind) {
    return kind == OperatorKind::idt || kind == OperatorKind::idt_original_mass || kind == OperatorKind::tufted;
}

Assembly assembly_of(OperatorKind kind) {
    return kind == OperatorKind::cotan || kind == OperatorKind::cotan_no_half ? Assembly::triangles : Assembly::unknown;
}

LaplaceBeltrami laplace_operator(const TriangleMesh& mesh, OperatorKind kind, AreaForm area) {
    switch (kind) {
        case OperatorKind::cotan: return laplace_beltrami(mesh, area);
        case OperatorKind::uniform: return uniform_operator(mesh, topology_of(mesh));
        case OperatorKind::cotan_no_half: {
            LaplaceBeltrami laplacian = laplace_beltrami(mesh, area);
            laplacian.C *= 2;
            return laplacian;
        }
        case OperatorKind::clamped: return laplace_beltrami(mesh, area, {.clamp_negative = true});
        case OperatorKind::opposite_mean: return laplace_beltrami(mesh, area, {.opposite = CotangentOptions::OppositeVertices::mean});
        case OperatorKind::edge_normalised:
        case OperatorKind::tufted: return assembled_joined(mesh, [&](const TriangleMesh& joined) { return assembled(joined, kind, area); });
        case OperatorKind::idt:
        case OperatorKind::idt_original_mass:
            return assembled_joined(
                mesh, [&](const TriangleMesh& joined) { return assembled(joined, kind, area); }, no_length_to_flips);
    }
    throw UsageError("there is no operator number " + std::to_string(static_cast<int>(kind)), "take one of operator_list()");
}

Vector operator_mean_curvature(const TriangleMesh& mesh, const MeshTopology& topology, OperatorKind kind,
                               const LaplaceBeltrami& laplacian) {
    return is_dimensionless(kind) ? uniform_mean_curvature_scaled(mesh, topology) : cotangent_mean_curvature(mesh, topology, laplacian);
}

}   // namespace meshfolio
