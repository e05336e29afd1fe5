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

/// Adds the description of the operators.
void add_method(report::Section& section);
/// Measures the operators on known surfaces, and adds their table and checks.
std::shared_ptr<const KnownTrials> add_known(report::Section& section, const QuestionSettings& settings);
/// Measures the operators on the meshes, and adds their tables, checks and the extent.
std::shared_ptr<const Labs> add_scores(report::Section& section, const LibraryMeshes& meshes, const QuestionSettings& settings,
                                       const Progress& progress);
/// Returns the mesh with the most Delaunay flips a vertex, where operators differ most.
const LaboratoryMesh& most_flipped(const Labs& labs);
/// Adds one small picture of H per operator, in the colour range of the default operator.
void add_figure_of(Answer& answer, const LaboratoryMesh& lab);
/// Adds the discussion, and sets the answer. @param shown  the mesh of the figure
void add_discussion(report::Section& section, const Labs& labs, const KnownTrials& known, const LaboratoryMesh& shown);

/// Returns the title in quotation marks: “cotangent”.
inline std::string quoted(const std::string& title) { return "“" + title + "”"; }

}   // namespace meshfolio::operators
