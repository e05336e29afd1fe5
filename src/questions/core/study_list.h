/// @file
/// What questions that study one mesh after the other do alike.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "base/errors.h"
#include "questions/core/chapter.h"
#include "questions/core/section_tools.h"
#include "report/text.h"

namespace meshfolio {

using LibraryMeshes = std::vector<std::shared_ptr<const LibraryMesh>>;

/// One study a mesh, in order; told as each begins: "denoising of cube". A mesh that defeats its study (whose operator has no factor,
/// say) costs the others nothing: it is a failed check of `section`.
/// @throws SolverError if none can be studied
template <class StudyOf>
auto studies_of(const LibraryMeshes& meshes, const std::string& work, const QuestionSettings& settings, const Progress& progress,
                report::Section& section, const StudyOf& study_of) {
    std::vector<decltype(study_of(meshes.front(), settings))> studies;
    std::string reasons;
    for (const auto& mesh : meshes) {
        progress(work + " of " + mesh->name);
        try {
            studies.push_back(study_of(mesh, settings));
        } catch (const Error& error) {
            const std::string reason = mesh->input.file + ": " + error.what();
            section.checks.push_back(unusable_mesh_check(reason));
            reasons += (reasons.empty() ? "" : "; ") + reason;
        }
    }
    if (studies.empty()) throw SolverError(reasons);
    return studies;
}

/// Those that were studied.
template <class Study>
std::vector<std::string> names_of(const std::vector<Study>& studies) {
    std::vector<std::string> names;
    for (const Study& study : studies) names.push_back(study.name());
    return names;
}

/// Of a table, plot, figure or file about one mesh: "q5_cube_sweep".
std::string id_of(const std::string& question, const std::string& mesh, const std::string& what);

/// Appends the texts as paragraphs; an empty one has nothing to say and is left out.
void add_paragraphs(report::Section& section, std::initializer_list<report::Text> texts);

}   // namespace meshfolio
