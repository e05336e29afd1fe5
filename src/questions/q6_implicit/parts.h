/// @file
/// The parts of question 6.
#pragma once

#include "questions/q6_implicit/study.h"

namespace meshfolio::q6_implicit {

inline constexpr report::Words words("q6");
extern const LabOffer lab;

using Studies = std::vector<ImplicitStudy>;

/// Returns the range of mean curvature on all inputs, which every figure of shapes uses.
output::ColorRange colours_of(const Studies& studies);
/// Adds a figure with two states in each column, all in the frame of the input: explicit above implicit steps, or many above few steps.
void add_pairs(Answer& answer, const ImplicitStudy& study, const output::ColorRange& colours);
/// True if add_pairs() adds a figure: something visible is left of the mesh.
bool has_pairs(const ImplicitStudy& study);
/// True if a column of add_pairs() has explicit above implicit steps.
bool compares_schemes(const ImplicitStudy& study);
/// True if a column of add_pairs() has many above few steps of equal λt.
bool compares_equal_times(const ImplicitStudy& study);
/// Adds a figure of the recommended results, from the six directions.
void add_views(Answer& answer, const Studies& studies, const output::ColorRange& colours);
/// Adds a figure of the distances of the recommended results from explicit results of equal λt.
void add_gap_map(Answer& answer, const Studies& studies);

/// Plots the gap between the schemes over t, a curve a mesh; a mesh without a λ within the limit has none.
report::Plot gap_plot(const Studies& studies);

report::Facts answer_facts(const Studies& studies);
/// Returns the facts of the paragraphs "method", "results" and "discussion".
report::Facts discussion_facts(const Studies& studies);

/// Converts a λt to squared mean edges.
inline double in_edges(const ImplicitStudy& study, double time) { return time / (study.subject.mean_edge * study.subject.mean_edge); }

}   // namespace meshfolio::q6_implicit
