/// @file
/// The parts of question 1.
#pragma once

#include <string>
#include <vector>

#include "questions/bench/ground_truth.h"
#include "questions/bench/uniform_curvature_study.h"
#include "report/document.h"

namespace meshfolio::q1_uniform {

inline constexpr report::Words words("q1");
inline constexpr std::size_t barycentric = 0, voronoi = 1, mixed = 2;   // in area_forms; figures and statistics have barycentric areas

using Meshes = std::vector<MeshCurvature>;
using Refinements = std::vector<UniformRefinement>;
using AngleSums = std::vector<AngleSum>;

/// L2 error of K, or of H.
inline ErrorHistory errors_of(const UniformRefinement& r, bool gaussian) { return gaussian ? deficit_K(r) : uniform_H(r); }
/// How far Σ deficit / 2π is from χ at most, where that applies.
double euler_gap(const AngleSums& sums);

// Tables and plots.
report::Table statistics_table(const Meshes& meshes);
report::Table error_table(const Refinements& refinements);
/// Errors of K on the finest meshes in one norm, one row an area form.
report::Table area_table(const Refinements& refinements, double FieldError::*norm, const std::string& key, const std::string& name);
report::Table gauss_bonnet_table(const AngleSums& sums);
report::Plot convergence_plot(const Refinements& refinements, bool gaussian);

/// H and K on every mesh, one colour range a quantity.
void add_figures(Answer& answer, const Meshes& meshes);
/// What the numbers say, in words that follow them.
void add_discussion(report::Section& section, const Meshes& meshes, const Refinements& refinements, const AngleSums& sums,
                    const std::vector<FlatMesh>& flat, const GroundTruth& truth);

}   // namespace meshfolio::q1_uniform
