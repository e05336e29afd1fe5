/// @file
/// The parts of the operator laboratory.
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::operators {

inline constexpr report::Words words("operators");

// study.h
struct LaboratoryMesh;
struct KnownTrial;
using Labs = std::vector<LaboratoryMesh>;
using KnownTrials = std::vector<KnownTrial>;

/// Adds paragraphs and a list that describe all operators.
void add_method(report::Section& section);
/// Measures the operators on known surfaces, adds their table and checks, and returns the trials.
std::shared_ptr<const KnownTrials> add_known(report::Section& section, const QuestionSettings& settings);
/// Measures the operators on the meshes, adds their tables, checks and the extent, and returns the scores.
std::shared_ptr<const Labs> add_scores(report::Section& section, const LibraryMeshes& meshes, const QuestionSettings& settings,
                                       const Progress& progress);
/// Returns the mesh with the most Delaunay flips per vertex, the first of equals; operators differ most there.
const LaboratoryMesh& most_flipped(const Labs& labs);
/// Adds a figure of one mesh with a panel of H × mean edge for each operator, in the colour range of the default operator.
void add_figure_of(Answer& answer, const LaboratoryMesh& lab);
/// Adds the discussion, and sets the answer. @param shown  the mesh of the figure
void add_discussion(report::Section& section, const Labs& labs, const KnownTrials& known, const LaboratoryMesh& shown);

/// Returns the title in quotation marks: “cotangent”.
inline std::string quoted(const std::string& title) { return "“" + title + "”"; }

}   // namespace meshfolio::operators
