/// @file
/// Laws of every answer, for all meshes.
#pragma once

#include <string>
#include <string_view>

#include "questions/core/chapter.h"
#include "shared_meshes.h"

namespace meshfolio::testing_tools {

inline void no_progress(std::string_view) {}

inline QuestionSettings quick_settings() {
    QuestionSettings settings;
    settings.quick = true;
    return settings;
}

/// All text of an answer, joined.
std::string prose_of(const report::Section& section);

void expect_checks_pass(const report::Section& section);

/// Ids unique and well-formed, tables rectangular, figures drawn and asked for, references that lead somewhere, no NaN in the prose.
void expect_well_formed(const Answer& answer);

/// A library in which `mesh` takes every role.
MeshLibrary library_of(const TriangleMesh& mesh, const std::string& name);

}   // namespace meshfolio::testing_tools
