/// @file
/// The parts of question 5.
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::q5_explicit {

inline constexpr report::Words words("q5");
extern const LabOffer lab;

struct ExplicitStudy;   // study.h
using Studies = std::vector<ExplicitStudy>;
/// Studies the meshes in order; a mesh that cannot be smoothed becomes a failed check of `section`.
std::shared_ptr<const Studies> explicit_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                report::Section& section);

/// Returns study.peaks, the vertices where the top mode is largest, if the mode is confined to a small spot there; else none.
std::vector<int> limiting_spot(const ExplicitStudy& study);

/// Draws a wave after 0, 1 and 2 explicit steps (line) and implicit steps (dashed), for λμ = 0.5, 1.5 and 2.2.
report::Diagram wave_diagram();
/// Adds a figure of the meshes before and after the recommended run, coloured by mean curvature; none if no step is recommended.
void add_recommended_figure(Answer& answer, const Studies& studies);
/// Returns the id of the figure of add_recommended_figure(): "q5_cube_recommended" for one mesh, else "q5_recommended".
std::string recommended_figure(const Studies& studies);
/// True if a step beyond the limit was tried on some mesh.
bool has_frames(const Studies& studies);
/// Adds a figure with a row for each mesh: the input, two states just beyond the limit, two at the largest step; none unless has_frames().
void add_frames_figure(Answer& answer, const Studies& studies);

/// Plots the factors 1 − λμ and 1/(1 + λμ) of a mode in one step over λμ from 0 to 2.4; the band from λμ = 2 on, where modes grow, is
/// shaded.
report::Plot damping_plot();
/// Returns a table with a row for each mesh: λ_crit, the recommended step and iterations, face angles before and after, and the size left.
report::Table limit_table(const Studies& studies);
/// Plots the energies over the iterations, a panel for each mesh, for at most five steps each; a curve ends before five times the input's
/// energy.
report::Plot energy_plot(const Studies& studies);

void add_checks(report::Section& section, const Studies& studies);
/// Adds a table of every step on every mesh, a table of bounds, and for meshes with triangles of zero area a paragraph on their limit.
void add_appendix(report::Section& section, const Studies& studies);
/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const Studies& studies);

/// Returns the facts of the answer and of the paragraphs "limit", "step", "beyond", "stop" and "units".
report::Facts facts_of(const Studies& studies);

}   // namespace meshfolio::q5_explicit
