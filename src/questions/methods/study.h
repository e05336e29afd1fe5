/// @file
/// The measurements of the section "methods": trials of kinds of noise × levels × methods within one budget of steps.
#pragma once

#include "mesh/vertex_noise.h"
#include "questions/bench/denoising_search.h"
#include "questions/bench/mesh_class.h"
#include "questions/methods/parts.h"

namespace meshfolio::methods {

/// A clean mesh for trials, or a patch of a mesh that is too large.
struct DenoisingSubject {
    std::string name;   // for ids
    TriangleMesh mesh;
    MeshTopology topology;
    int whole_vertices = 0;   // before it was cut
    MeshCharacter character;
    double mean_edge = 0, diagonal = 0;   // [length]
    double largest_eigenvalue = 0;        // of its operator [1/length²]
    bool has_volume_to_keep = false;

    bool is_patch() const { return mesh.vertex_count() < whole_vertices; }
    std::string class_title() const;   // "sharp-edged, closed"
};
/// Measures the mesh. @param most_vertices  a larger mesh is cut to a patch of that size around its sharpest edge
DenoisingSubject denoising_subject(std::string name, const TriangleMesh& mesh, int most_vertices);

/// One noisy mesh and the result of each method, in the order of denoising_list().
struct NoiseTrial {
    NoiseKind kind = NoiseKind::gaussian;
    double edges = 0;        // σ of with_noise() [mean edges of the clean mesh]
    double sigma = 0;        // [length]
    bool s1_level = false;   // σ is 20 % of every extent of the bounding box, as in an earlier report
    Positions noisy = {};
    MeshDifference damage = {};      // the noisy mesh against the clean one
    double mean_edge = 0;            // of the noisy mesh [length]
    double largest_eigenvalue = 0;   // of its operator [1/length²]
    std::vector<SearchResult> results = {};

    std::string title() const;   // "Gaussian, 0.3 mean edges"
    std::string id() const;      // "gaussian0300", in thousandths of a mean edge; "box_level20"
};

/// Returns the first result with the largest gain; null if no gain is above 1.
const SearchResult* winner(const NoiseTrial& trial, Gain gain);

struct DenoisingTrials {
    DenoisingSubject subject;
    std::vector<NoiseTrial> trials;   // kind by kind, each with ascending σ
    int pictured = 0;                 // index of the Gaussian trial with the middle level

    const std::string& name() const { return subject.name; }
    const NoiseTrial& pictured_trial() const { return trials[pictured]; }
    /// Returns the trials of a kind without s1_level, with ascending σ.
    std::vector<const NoiseTrial*> of_kind(NoiseKind kind) const;
};

struct DenoisingLaboratory {
    SearchBudget budget;
    std::vector<DenoisingTrials> meshes;
};

/// Returns the budget of every method on every noisy mesh: 4 values × 5 steps (quick: 3 × 4, laboratory: 6 × 6).
SearchBudget search_budget(const QuestionSettings& settings);
/// Adds noise of every kind and level to the mesh and searches the best result of every method. @throws MeshError, SolverError
DenoisingTrials denoising_trials(DenoisingSubject subject, const QuestionSettings& settings);

/// The geometric mean gains of each method over all trials on meshes of one class.
struct ClassResult {
    std::string title;   // "sharp-edged, closed"
    Names meshes = {};
    int trials = 0;
    std::vector<double> gain = {}, angle_gain = {};   // one per method; NaN if it is not defined on all meshes
    int best = -1, best_by_angle = -1;   // methods with the largest gains; −1 if no noise changed the shape, or turned a face
};
/// Computes the results of each class, classes in the order of their first mesh.
std::vector<ClassResult> class_results(const DenoisingLaboratory& laboratory);

inline constexpr double degrees = 180 / pi;

/// Returns the title of a method, by its place in denoising_list() or of a result: "explicit".
inline std::string method_title(std::size_t method) { return std::string(denoising_list()[method].title); }
inline std::string method_title(const SearchResult& result) { return std::string(denoising_entry(result.method).title); }

}   // namespace meshfolio::methods
