/// @file
/// The parts of question 1.
#pragma once

#include <string>
#include <vector>

#include "questions/bench/sentences.h"
#include "questions/q1_uniform/study.h"
#include "report/document.h"

namespace meshfolio::q1_uniform {

inline constexpr report::Words words("q1");

using Meshes = std::vector<MeshCurvature>;
using AngleSums = std::vector<AngleSum>;

/// How far Σ deficit / 2π is from χ at most, where that applies.
double euler_gap(const AngleSums& sums);

/// On the finest meshes together, the vertices whose area is ≤ 0.
int without_K(const BenchRuns& runs, AreaForm form);

// Tables and plots.
report::Table statistics_table(const Meshes& meshes);
report::Table error_table(const BenchRuns& runs);
/// Errors of K on the finest meshes in one norm, one row an area form.
report::Table area_table(const BenchRuns& runs, Norm norm, const std::string& key, const std::string& name);
report::Table gauss_bonnet_table(const AngleSums& sums);
report::Plot convergence_plot(const BenchRuns& runs, std::string_view estimator);

/// H and K on every mesh, one colour range a quantity.
void add_figures(Answer& answer, const Meshes& meshes);
/// What the numbers say, in words that follow them.
void add_discussion(report::Section& section, const Meshes& meshes, const BenchRuns& runs, const AngleSums& sums,
                    const std::vector<FlatMesh>& flat, const BenchRuns& panel);

}   // namespace meshfolio::q1_uniform
