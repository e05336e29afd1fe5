/// @file
/// The right answers of a rubric and the known wrong ones, each computed once for all students who name the same settings.
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

/// Modes with equal eigenvalues, of which a reconstruction takes an arbitrary choice.
struct EqualModes {
    Vector M;
    Positions X, below;   // of the mesh; rebuilt from the modes before the equal ones
    DenseMatrix modes;    // all modes with this eigenvalue
    int taken = 0;        // number of them in the reconstruction
};
/// True if a reconstruction that takes other combinations of the equal modes, `taken` of them, gives these positions.
/// @param tolerance  [length]
bool is_another_choice(const Positions& given, const EqualModes& equal, double tolerance);

/// The right answer for a student's file.
struct Reference {
    std::shared_ptr<const LibraryMesh> mesh;   // null for a number
    RightValues right;                         // per vertex, three per vertex for positions, or a list
    bool not_unique = false;                   // a reconstruction that takes some of several modes with equal eigenvalues
    std::optional<EqualModes> equal;           // these modes, unless there are too many
};

using OperatorOf = std::function<LaplaceBeltrami(const TriangleMesh&)>;

/// An operator that a student may have used instead of the right one.
struct WrongLaplacian {
    std::string key;                           // of the convention
    OperatorKind kind = OperatorKind::cotan;   // for the mean curvature, which the uniform operator defines differently
    OperatorOf of;
};

/// Returns the operators that a student may have used instead of the right one: all others of the program, and the right one with wrong
/// areas or none.
std::vector<WrongLaplacian> wrong_laplacians(const AnswerSettings& s);

/// Returns x, y, z of vertex 0, then of vertex 1, …
inline Vector flat(const Positions& X) { return Eigen::Map<const Vector>(X.data(), X.size()); }

/// Returns the options of the smoothing run with these settings, lambda converted to model units.
SmoothingOptions smoothing_of(const PreparedMesh& prepared, const AnswerSettings& s);
/// Returns the positions, x, y, z of each vertex, that known mistakes in step, iterations, scheme or operator lead to; runs that blow up
/// are left out.
std::vector<Variant> smoothing_variants(const PreparedMesh& prepared, const AnswerSettings& s);

/// Computes each answer once.
class References {
public:
    /// Opens every mesh. @throws InputError for a mesh that is missing or unusable
    explicit References(const Rubric& rubric);

    /// Returns the right answer to an item at these settings, computed once. @throws Error if these settings have none
    const Reference& of(const RubricItem& item, const AnswerSettings& settings);
    /// Returns the answers to an item that known mistakes give at these settings; the reference is valid until the next call.
    const std::vector<Variant>& variants_of(const RubricItem& item, const AnswerSettings& settings);

private:
    using Key = std::pair<std::string, AnswerSettings>;                  // id of the item
    std::map<std::string, std::shared_ptr<const LibraryMesh>> meshes_;   // by id of the item
    std::map<Key, Reference> references_;
    std::map<Key, std::vector<Variant>> variants_;
};

}   // namespace meshfolio::run
