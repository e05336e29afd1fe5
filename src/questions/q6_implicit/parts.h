/// @file
/// The parts of question 6.
#pragma once

#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {

inline constexpr report::Words words("q6");
extern const LabOffer lab;

using Studies = std::vector<ImplicitStudy>;

/// The colour range of mean curvature on all inputs, used in every figure of shapes.
output::ColorRange colours_of(const Studies& studies);
/// Shows two states in each column, all in the frame of the input: explicit above implicit steps, many above few.
void add_pairs(Answer& answer, const ImplicitStudy& study, const output::ColorRange& colours);
/// Whether there is such a figure (not if all that is left is a dot), and which columns it has.
bool has_pairs(const ImplicitStudy& study);
bool compares_schemes(const ImplicitStudy& study);
bool compares_equal_times(const ImplicitStudy& study);
/// What is recommended of each mesh, from the six directions.
void add_views(Answer& answer, const Studies& studies, const output::ColorRange& colours);
/// How far the recommended results are from explicit ones of equal λt, vertex by vertex.
void add_gap_map(Answer& answer, const Studies& studies);

/// The gap between the schemes over t, a curve a mesh; no curves where no λ is within the limit.
report::Plot gap_plot(const Studies& studies);

/// What the answer, and what the discussion chooses its sentences by.
report::Facts answer_facts(const Studies& studies);
report::Facts discussion_facts(const Studies& studies);

/// A λt in squared mean edges.
inline double in_edges(const ImplicitStudy& study, double time) { return time / (study.subject.mean_edge * study.subject.mean_edge); }

}   // namespace meshfolio::q6_implicit
