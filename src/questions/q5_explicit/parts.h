/// @file
/// The parts of question 5.
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::q5_explicit {

inline constexpr report::Words words("q5");
extern const LabOffer lab;

struct ExplicitStudy;   // study.h
using Studies = std::vector<ExplicitStudy>;
/// Studies the meshes; a mesh that cannot be smoothed becomes a failed check.
std::shared_ptr<const Studies> explicit_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                report::Section& section);

/// Returns the vertices where the top mode is largest if a few set the limit; else none.
std::vector<int> limiting_spot(const ExplicitStudy& study);

/// Draws a wave after 0, 1 and 2 steps, explicit beside implicit, for three products λμ.
report::Diagram wave_diagram();
/// Adds a figure of the inputs and the results of the recommended steps; none if no step is recommended.
void add_recommended_figure(Answer& answer, const Studies& studies);
/// Returns the id of that figure.
std::string recommended_figure(const Studies& studies);
/// True if a step beyond the limit was tried.
bool has_frames(const Studies& studies);
/// Adds a figure of states of the runs beyond the limit, one row a mesh, if has_frames().
void add_frames_figure(Answer& answer, const Studies& studies);

/// Plots the factors of a mode in one explicit and one implicit step; the band beyond λμ = 2, where modes grow, is shaded.
report::Plot damping_plot();
/// Returns a table of the limit and the recommended step of each mesh.
report::Table limit_table(const Studies& studies);
/// Plots the energies over the iterations, a panel a mesh, for at most five steps; a curve ends beyond five times the input's energy.
report::Plot energy_plot(const Studies& studies);

void add_checks(report::Section& section, const Studies& studies);
/// Adds the tables of steps and bounds, and the limit with triangles of zero area on meshes that have some.
void add_appendix(report::Section& section, const Studies& studies);
/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const Studies& studies);

/// Returns the facts of the answer and of the paragraphs "limit", "step", "beyond", "stop" and "units".
report::Facts facts_of(const Studies& studies);

}   // namespace meshfolio::q5_explicit
