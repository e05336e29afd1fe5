/// @file
/// The parts of question 4.
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::q4_spectral {

inline constexpr report::Words words("q4");
extern const LabOffer lab;

struct Subject;   // study.h
using Subjects = std::vector<Subject>;
/// Rebuilds the meshes; a mesh without eigenpairs becomes a failed check.
std::shared_ptr<const Subjects> spectral_subjects(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                  report::Section& section);

/// Returns the facts about one of the meshes; common facts are true for the first mesh alone.
report::Facts facts_of(const Subjects& subjects, std::size_t which);

/// Adds the results and checks of each mesh, each figure and table after the paragraph that explains it.
void add_results(Answer& answer, const Subjects& subjects);
/// Adds figures of the reconstructions that the results do not show.
void add_further_figures(Answer& answer, const Subjects& subjects);
/// Adds the rebuilt meshes, and the parameters, timings and extent of the section.
void add_record(Answer& answer, const Subjects& subjects);

}   // namespace meshfolio::q4_spectral
