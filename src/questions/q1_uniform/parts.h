/// @file
/// The parts of question 1.
#pragma once

#include "questions/q1_uniform/study.h"

namespace meshfolio::q1_uniform {

inline constexpr report::Words words("q1");

/// Curvature × mean edge below this cannot be seen in any picture: coordinates written with six digits leave as much.
inline constexpr double visible = 1e-4;

using Meshes = std::vector<MeshCurvature>;
using AngleSums = std::vector<AngleSum>;

/// How far Σ deficit / 2π is from χ at most, where that applies.
double euler_gap(const AngleSums& sums);

/// On the finest meshes together, the vertices whose area is ≤ 0.
int without_K(const BenchRuns& runs, AreaForm form);

report::Table statistics_table(const Meshes& meshes);
report::Table error_table(const BenchRuns& runs);
/// L∞ errors of K on the finest meshes, one row an area form.
report::Table area_table(const BenchRuns& runs);
report::Table gauss_bonnet_table(const AngleSums& sums);
report::Plot convergence_plot(const BenchRuns& runs);

/// Δx and its parts, the angle deficit, and the three areas, each of a real ring.
report::Diagram ring_diagram();

/// H and K, one figure each of all meshes.
void add_figures(Answer& answer, const Meshes& meshes);
/// Where on the curved meshes Δx lies along the surface.
void add_tangential_figure(Answer& answer, const Meshes& meshes, const std::string& colormap);

/// Of the curved meshes that whose ‖Δx‖² lies along the surface most, if there is one.
struct Drifting {
    const MeshCurvature* mesh;
    TangentialPart part;
};
std::optional<Drifting> most_drifting(const Meshes& meshes);

report::Text answer_of(const BenchRuns& runs);
report::Text lead_of(const BenchRuns& runs, const std::optional<Drifting>& drifting);
/// @param panel  runs on all surfaces
void add_discussion(report::Section& section, const Meshes& meshes, const std::vector<FlatMesh>& flat, const BenchRuns& runs,
                    const BenchRuns& panel, const AngleSums& sums, const std::optional<Drifting>& drifting);
/// What is said in the appendix: the boundary of flat meshes.
void add_flat_boundaries(report::Section& section, const std::vector<FlatMesh>& flat);

}   // namespace meshfolio::q1_uniform
