/// @file
/// The right answers of a rubric, and the wrong ones that are known, each computed once for all students who name the same settings.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "questions/core/mesh_library.h"
#include "run/mark/conventions.h"

namespace meshfolio::run {

/// What a student's file is held against.
struct Reference {
    std::shared_ptr<const LibraryMesh> mesh;   // null for a number
    RightValues right;                         // one a vertex, three a vertex for positions, or a list
    bool not_unique = false;                   // a reconstruction that parts equal eigenvalues: others may be right as well
};

class References {
public:
    /// Opens every mesh. @throws InputError for one that is missing or unusable
    explicit References(const Rubric& rubric);

    /// @throws Error where these settings have no answer
    const Reference& of(const RubricItem& item, const AnswerSettings& settings);
    const std::vector<Variant>& variants_of(const RubricItem& item, const AnswerSettings& settings);

private:
    using Key = std::pair<std::string, AnswerSettings>;                  // id of the item
    std::map<std::string, std::shared_ptr<const LibraryMesh>> meshes_;   // by id of the item
    std::map<Key, Reference> references_;
    std::map<Key, std::vector<Variant>> variants_;
};

}   // namespace meshfolio::run
