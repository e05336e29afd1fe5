/// @file
/// The parts of question 6.
#pragma once

#include <cstdint>

#include "questions/core/section_tools.h"

namespace meshfolio::q6_implicit {

inline constexpr report::Words words("q6");
extern const LabOffer lab;

struct ImplicitStudy;   // study.h
using Studies = std::vector<ImplicitStudy>;
/// Studies the meshes in order; a mesh that cannot be smoothed becomes a failed check of `section`.
std::shared_ptr<const Studies> implicit_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                report::Section& section);

/// Adds a figure for each of `count` studies from studies[first] on that has_pairs(). After the input with the recommended result below it,
/// each column has two states: explicit above implicit steps, or many above few steps of equal λt.
void add_pairs(Answer& answer, const Studies& studies, std::size_t first, std::size_t count = SIZE_MAX);
/// True if add_pairs() adds a figure of this mesh: a result is recommended, or two states are neither too small nor too large to be seen.
bool has_pairs(const ImplicitStudy& study);
/// True if a column of add_pairs() has explicit above implicit steps.
bool compares_schemes(const ImplicitStudy& study);
/// True if a column of add_pairs() has many above few steps of equal λt.
bool compares_equal_times(const ImplicitStudy& study);
/// Adds one figure with a panel for each recommended result, from three quarters and along the six axes; none if nothing is recommended.
void add_views(Answer& answer, const Studies& studies);
/// Adds a figure of the recommended results, coloured by the distance from an explicit result of equal λt in % of the rms motion; none if
/// no such distance is known.
void add_gap_map(Answer& answer, const Studies& studies);

/// Plots ImplicitStudy::gaps() in % over t, a curve for each mesh; a mesh without a λ within the limit has none.
report::Plot gap_plot(const Studies& studies);

/// Returns a table with a row for each cell (λ, t) of each mesh: energies, motion, gap, size, faces turned, blow-up; for files only.
report::Table grid_table(const Studies& studies);
/// Returns a table with a row for each mesh that has a recommended result: λ, t, energy, size, face angles, and the explicit steps and
/// price to equal energy.
report::Table cost_table(const Studies& studies);
/// Returns a table with a row for each mesh and λ: ImplicitStudy::price() at each t, and the iterations from which λ pays (break_even())
/// and goes too far (too_far()). Meshes without counted prices have no rows.
report::Table price_table(const Studies& studies);

void add_checks(report::Section& section, const Studies& studies);
/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const Studies& studies);

/// Returns the facts of the answer.
report::Facts answer_facts(const Studies& studies);
/// Returns the facts of the paragraphs "method", "results" and "discussion".
report::Facts discussion_facts(const Studies& studies);

}   // namespace meshfolio::q6_implicit
