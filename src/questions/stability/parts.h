/// @file
/// The parts of the section "stability".
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::stability {

inline constexpr report::Words words("stability");

struct StabilityStudy;   // study.h
struct RebuiltFlow;
struct SmoothingMaps;
using Studies = std::vector<StabilityStudy>;
using Planes = std::vector<SmoothingMaps>;

/// Studies the limits of the meshes; a mesh that cannot be smoothed becomes a failed check.
std::shared_ptr<const Studies> limit_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                             report::Section& section);
/// Runs the flow with a rebuilt operator on the last mesh.
std::shared_ptr<const RebuiltFlow> rebuilt_flow(const Studies& studies, const QuestionSettings& settings, const Progress& progress);
/// Runs both schemes over the planes of the first two meshes (quick: the first; laboratory: all).
std::shared_ptr<const Planes> plane_studies(const Studies& studies, const QuestionSettings& settings, const Progress& progress,
                                            report::Section& section);

/// Returns a table of the bounds of λ_crit and the safe step, a row for each operator on each mesh.
report::Table certificate_table(const Studies& studies);
/// Returns a table of the cotangent limit in other units and the vertex that sets it, a row for each mesh.
report::Table unit_table(const Studies& studies);
/// The top mode of the last mesh over the iterations on both sides of the limit, measured and predicted.
report::Plot growth_plot(const Studies& studies);
report::Table flow_table(const RebuiltFlow& flow);
/// Plots λμ_max over the steps, a curve for each run, with a dashed line at 2.
report::Plot flow_plot(const RebuiltFlow& flow);
/// Adds a map of each plane: the error, or the motion if no clean mesh is known; explicit beside implicit.
void add_error_maps(report::Section& section, const Planes& planes);
/// Returns a table of usable cells, turned triangles and the smallest error, a row for each scheme on each mesh.
report::Table region_table(const Planes& planes);
/// Returns a table of the predicted and measured iteration of blowing up, a row for each of up to four evenly chosen λ beyond the
/// limit on each mesh.
report::Table blow_up_table(const Planes& planes);

/// Adds one figure: every mesh seen along the normal of its limiting vertex, and below it the triangles around, coloured by the top mode.
void add_top_mode_figure(Answer& answer, const Studies& studies);
/// Adds a figure of the lettered places of the planes, with a row for each mesh.
void add_place_figure(Answer& answer, const Planes& planes);

void add_checks(report::Section& section, const Studies& studies, const RebuiltFlow& flow, const Planes& planes);
/// Adds the parameters and the extent of the section.
void add_record(report::Section& section, const Studies& studies, const Planes& planes);

/// Returns the facts that the words of answer and discussion choose from.
report::Facts facts_of(const Studies& studies, const RebuiltFlow& flow, const Planes& planes);

}   // namespace meshfolio::stability
