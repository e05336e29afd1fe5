/// @file
/// The right answers of a rubric, and the wrong ones that are known, each computed once for all students who name the same settings.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "questions/core/mesh_library.h"
#include "run/mark/conventions.h"
#include "run/mark/rubric.h"

namespace meshfolio::run {

/// Modes of equal eigenvalues, of which a reconstruction uses an arbitrary choice.
struct EqualModes {
    Vector M;
    Positions X, below;   // and rebuilt from the modes before them
    DenseMatrix modes;    // all of them
    int taken = 0;        // by the reconstruction
};
/// Could the positions result from another choice? @param tolerance  [length]
bool is_another_choice(const Positions& given, const EqualModes& equal, double tolerance);

/// The right answer for a student's file.
struct Reference {
    std::shared_ptr<const LibraryMesh> mesh;   // null for a number
    RightValues right;                         // one a vertex, three a vertex for positions, or a list
    bool not_unique = false;                   // a reconstruction that parts equal eigenvalues: others are right as well
    std::optional<EqualModes> equal;           // those, unless they are too many
};

using OperatorOf = std::function<LaplaceBeltrami(const TriangleMesh&)>;

/// An operator that is taken for the right one.
struct WrongLaplacian {
    std::string key;                           // of the convention
    OperatorKind kind = OperatorKind::cotan;   // the uniform one makes a curvature in its own way
    OperatorOf of;
};

/// Those of the operator laboratory but the right one, and what is made of that by wrong areas.
std::vector<WrongLaplacian> wrong_laplacians(const AnswerSettings& s);

/// x, y, z of vertex 0, then of vertex 1, …
inline Vector flat(const Positions& X) { return Eigen::Map<const Vector>(X.data(), X.size()); }

/// The right smoothing run, and what comes of known mistakes.
SmoothingOptions smoothing_of(const PreparedMesh& prepared, const AnswerSettings& s);
std::vector<Variant> smoothing_variants(const PreparedMesh& prepared, const AnswerSettings& s);

/// Computes each answer once.
class References {
public:
    /// Opens every mesh. @throws InputError for one that is missing or unusable
    explicit References(const Rubric& rubric);

    /// @throws Error where these settings have no answer
    const Reference& of(const RubricItem& item, const AnswerSettings& settings);
    /// Valid until the next call.
    const std::vector<Variant>& variants_of(const RubricItem& item, const AnswerSettings& settings);

private:
    using Key = std::pair<std::string, AnswerSettings>;                  // id of the item
    std::map<std::string, std::shared_ptr<const LibraryMesh>> meshes_;   // by id of the item
    std::map<Key, Reference> references_;
    std::map<Key, std::vector<Variant>> variants_;
};

}   // namespace meshfolio::run
