/// @file
/// The parts of question 4.
#pragma once

#include "questions/core/section_tools.h"

namespace meshfolio::q4_spectral {

inline constexpr report::Words words("q4");
extern const LabOffer lab;

struct Subject;   // study.h
using Subjects = std::vector<Subject>;
/// Rebuilds the meshes from their modes; a mesh without eigenpairs becomes a failed check of `section`.
std::shared_ptr<const Subjects> spectral_subjects(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                  report::Section& section);

/// Returns the facts of all paragraphs about the mesh subjects[which]; facts about all meshes are said with the first mesh alone.
report::Facts facts_of(const Subjects& subjects, std::size_t which);

/// Adds the results and checks of each mesh, each figure and table after the paragraph that explains it.
void add_results(Answer& answer, const Subjects& subjects);
/// Adds for each mesh a figure of the reconstructions that are not is_shown(), if there are some.
void add_further_figures(Answer& answer, const Subjects& subjects);
/// Adds the rebuilt meshes as PLY files, and the parameters, timings and extent of the section.
void add_record(Answer& answer, const Subjects& subjects);

}   // namespace meshfolio::q4_spectral
