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
/// Studies the meshes; a mesh that cannot be smoothed becomes a failed check.
std::shared_ptr<const Studies> implicit_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                report::Section& section);

/// Adds a figure for each of `count` studies from the first-th on. It has two states in each column, all in the frame of the input:
/// explicit above implicit steps, or many above few steps.
void add_pairs(Answer& answer, const Studies& studies, std::size_t first, std::size_t count = SIZE_MAX);
/// True if add_pairs() adds a figure: something visible is left of the mesh.
bool has_pairs(const ImplicitStudy& study);
/// True if a column of add_pairs() has explicit above implicit steps.
bool compares_schemes(const ImplicitStudy& study);
/// True if a column of add_pairs() has many above few steps of equal λt.
bool compares_equal_times(const ImplicitStudy& study);
/// Adds a figure of the recommended results, from the six directions.
void add_views(Answer& answer, const Studies& studies);
/// Adds a figure of the distances of the recommended results from explicit results of equal λt.
void add_gap_map(Answer& answer, const Studies& studies);

/// Plots the gap between the schemes over t, a curve a mesh; a mesh without a λ within the limit has none.
report::Plot gap_plot(const Studies& studies);

/// Returns a table of every λ × t of every mesh.
report::Table grid_table(const Studies& studies);
/// Returns a table of the recommended results, their smoothness, and their prices.
report::Table cost_table(const Studies& studies);
/// Returns a table of the price of every λ × t, and the iterations at which each λ pays and goes too far; meshes without prices have no
/// rows.
report::Table price_table(const Studies& studies);

void add_checks(report::Section& section, const Studies& studies);
/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const Studies& studies);

report::Facts answer_facts(const Studies& studies);
/// Returns the facts of the paragraphs "method", "results" and "discussion".
report::Facts discussion_facts(const Studies& studies);

}   // namespace meshfolio::q6_implicit
