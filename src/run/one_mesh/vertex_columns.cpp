#include "run/one_mesh/vertex_columns.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "base/at.h"
#include "base/number_text.h"
#include "geometry/curvature/curvature.h"
#include "geometry/curvature/jet_fit.h"

namespace meshfolio::run {

std::vector<VertexColumn> curvature_columns(const PreparedMesh& prepared, AreaForm form, OperatorKind kind, bool with_jets) {
    const auto& [mesh, topology] = std::tie(prepared.mesh, prepared.topology);
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh, form);
    const Vector& areas = laplacian.M;
    std::vector<VertexColumn> columns{{"area", (areas.array() > 0).select(areas, std::nan(""))},
                                      {"h_uniform", uniform_mean_curvature(mesh, topology)},
                                      {"k_gauss", gaussian_curvature(mesh, topology, areas)},
                                      {"h_cotan", cotangent_mean_curvature(mesh, topology, laplacian)},
                                      {"h_uniform_scaled", uniform_mean_curvature_scaled(mesh, topology)}};
    if (with_jets) {
        JetCurvature jet = jet_curvature(mesh, topology);
        columns.push_back({"h_jet", std::move(jet.H)});
        columns.push_back({"k_jet", std::move(jet.K)});
    }
    const bool has_column = kind == OperatorKind::cotan || kind == OperatorKind::uniform;   // h_cotan, h_uniform_scaled
    if (has_column) return columns;
    std::string name = "h_" + std::string(operator_entry(kind).name);   // h_idt, h_cotan_no_half, …
    std::ranges::replace(name, '-', '_');
    columns.push_back({name, operator_mean_curvature(mesh, topology, kind, laplace_operator(mesh, kind, form))});
    return columns;
}

Attributes beside_attributes(const PreparedMesh& prepared, std::vector<VertexColumn> columns) {
    Attributes all = prepared.attributes;
    std::erase_if(all.columns,
                  [&](const VertexColumn& old) { return std::ranges::find(columns, old.name, &VertexColumn::name) != columns.end(); });
    std::ranges::move(columns, std::back_inserter(all.columns));
    return all;
}

std::string vertex_table(const PreparedMesh& prepared, const std::vector<VertexColumn>& columns) {
    std::string csv = "vertex,x,y,z,boundary";
    for (const VertexColumn& column : columns) csv += ',' + column.name;
    csv += '\n';
    for (int v = 0; v < prepared.mesh.vertex_count(); ++v) {
        csv += std::to_string(v);
        for (int axis = 0; axis < 3; ++axis) csv += ',' + exact_text(prepared.mesh.X(v, axis));
        csv += prepared.topology.on_boundary[at(v)] ? ",1" : ",0";
        for (const VertexColumn& column : columns) csv += ',' + exact_text(column.values[v]);
        csv += '\n';
    }
    return csv;
}

}   // namespace meshfolio::run
