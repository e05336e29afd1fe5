/// @file
/// The parts of question 3.
#pragma once

#include <string>
#include <vector>

#include "questions/bench/cotangent_study.h"
#include "questions/bench/ground_truth.h"
#include "questions/q3_cotangent/error_indicator.h"
#include "report/document.h"

namespace meshfolio::q3_cotangent {

inline constexpr report::Words words("q3");
inline constexpr std::size_t barycentric = 0, voronoi = 1, mixed = 2;   // in area_forms

using Comparisons = std::vector<CotangentComparison>;
using Refinements = std::vector<CotangentRefinement>;

// Figures.
void add_comparison_figure(Answer& answer, const CotangentComparison& comparison);
void add_plane_figure(Answer& answer, const PlaneTest& plane, const std::string& colormap);
void add_disagreement_figure(Answer& answer, const CotangentComparison& comparison, const Disagreement& disagreement,
                             const std::string& colormap);

// Tables and plots.
report::Table difference_table(const Comparisons& meshes);
report::Table variant_table(const Comparisons& meshes);
/// Errors on the finest meshes in one norm, one row an estimator.
report::Table error_table(const Refinements& refinements, double FieldError::*norm, const std::string& key, const std::string& name);
report::Table order_table(const Refinements& refinements);
report::Table indicator_table(const std::vector<IndicatorTrial>& trials);
report::Plot convergence_plot(const Refinements& refinements, Triangulation triangulation);

/// What the indicator is worth, and where it doubts H on the meshes.
void add_error_indicator(Answer& answer, const Comparisons& meshes, const QuestionSettings& settings);
/// What the numbers say, in words that follow them.
void add_discussion(report::Section& section, const Comparisons& meshes, const Refinements& refinements, const PlaneTest& plane,
                    const GroundTruth& truth);

}   // namespace meshfolio::q3_cotangent
