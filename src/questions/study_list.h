/// @file
/// What questions that study one mesh after the other do alike.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "questions/question.h"
#include "report/text.h"

namespace meshfolio {

using LibraryMeshes = std::vector<std::shared_ptr<const LibraryMesh>>;

/// One study a mesh, in order; told as each begins: "denoising of cube".
template <class Study>
std::vector<Study> studies_of(const LibraryMeshes& meshes, const std::string& work, const QuestionSettings& settings,
                              const Progress& progress, Study (*study_of)(std::shared_ptr<const LibraryMesh>, const QuestionSettings&)) {
    std::vector<Study> studies;
    for (const auto& mesh : meshes) {
        progress(work + " of " + mesh->name);
        studies.push_back(study_of(mesh, settings));
    }
    return studies;
}

std::vector<std::string> names_of(const LibraryMeshes& meshes);

/// Of a table, plot, figure or file about one mesh: "q5_cube_sweep".
std::string id_of(const std::string& question, const std::string& mesh, const std::string& what);

/// Appends the texts as paragraphs; an empty one has nothing to say and is left out.
void add_paragraphs(report::Section& section, std::initializer_list<report::Text> texts);

}   // namespace meshfolio
