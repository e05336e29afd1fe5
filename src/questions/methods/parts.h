/// @file
/// What the section "methods" measures, kinds of noise × levels × methods on meshes within one budget of steps, and what it shows of it.
#pragma once

#include "mesh/vertex_noise.h"
#include "questions/bench/denoising_search.h"
#include "questions/bench/mesh_class.h"
#include "questions/core/section_tools.h"

namespace meshfolio::methods {

inline constexpr report::Words words("methods");

/// A mesh to be spoilt and mended: a whole one, or a patch of one that is too large.
struct DenoisingSubject {
    std::string name;   // for ids
    TriangleMesh mesh;
    MeshTopology topology;
    int whole_vertices = 0;   // of the mesh it is, or was cut from
    MeshCharacter character;
    double mean_edge = 0, diagonal = 0;   // [length]
    double largest_eigenvalue = 0;        // of its operator [1/length²]

    bool has_volume_to_keep = false;

    bool is_patch() const { return mesh.vertex_count() < whole_vertices; }
    /// "sharp-edged, closed"
    std::string class_title() const;
};
/// @param most_vertices  beyond it, the patch around the sharpest edge is taken
DenoisingSubject denoising_subject(std::string name, const TriangleMesh& mesh, int most_vertices);

/// One noisy mesh and the result of each method, in the order of denoising_list().
struct NoiseTrial {
    NoiseKind kind = NoiseKind::gaussian;
    double edges = 0;        // σ of with_noise() [mean edges of the clean mesh]
    double sigma = 0;        // [length]
    bool s1_level = false;   // 20 % of every extent of the bounding box
    Positions noisy = {};
    MeshDifference spoilt = {};      // of the noisy mesh from the clean one
    double mean_edge = 0;            // of the noisy mesh [length]
    double largest_eigenvalue = 0;   // of its operator [1/length²]
    std::vector<SearchResult> results = {};

    std::string title() const;   // "Gaussian, 0.3 mean edges"
    std::string id() const;      // "gaussian0300", thousandths of a mean edge; "box_level20"
};

/// Is a gain as large as the largest, but for rounding? Methods that differ in size alone turn the normals alike.
inline bool ties(double gain, double largest) { return gain >= largest * (1 - 1e-9); }

/// The result of the largest gain, the first of them where several tie; null where none is above 1.
const SearchResult* winner(const NoiseTrial& trial, Gain gain);

struct DenoisingTrials {
    DenoisingSubject subject;
    std::vector<NoiseTrial> trials;   // kind by kind, each with ascending σ
    int pictured = 0;                 // of trials: Gaussian, of the middle of its levels

    const std::string& name() const { return subject.name; }
    const NoiseTrial& pictured_trial() const { return trials[pictured]; }
    /// Trials of a kind, the level of S1 aside, ascending.
    std::vector<const NoiseTrial*> of_kind(NoiseKind kind) const;
};

struct DenoisingLaboratory {
    SearchBudget budget;
    std::vector<DenoisingTrials> meshes;
};

/// Largest mesh that is taken whole. [vertices]
int largest_subject(const QuestionSettings& settings, std::size_t meshes);
/// What every method gets on every noisy mesh.
SearchBudget search_budget(const QuestionSettings& settings);
/// Noise of every kind and level on the mesh, and what each method makes of it. @throws MeshError, SolverError
DenoisingTrials denoising_trials(DenoisingSubject subject, const QuestionSettings& settings);

/// Meshes of one class, and the geometric means of each method's gains over all trials on them.
struct ClassResult {
    std::string title;   // "sharp-edged, closed"
    Names meshes;
    int trials = 0;
    std::vector<double> gain, angle_gain;   // one a method; NaN where it is not defined on all of them
    int best() const;                       // method with the largest gain; −1 where no noise changed the shape
    int best_by_angle() const;              // −1 where no noise turned a face
};
/// Computes the results of each class, in the order of their first mesh.
std::vector<ClassResult> class_results(const DenoisingLaboratory& laboratory);

/// Tables tell angles in degrees.
inline constexpr double degrees = 180 / pi;

/// "explicit": the title of a method by its place in denoising_list(), of that of a result.
inline std::string method_title(std::size_t method) { return std::string(denoising_list()[method].title); }
inline std::string method_title(const SearchResult& result) { return std::string(denoising_entry(result.method).title); }

report::Table subject_table(const DenoisingLaboratory& laboratory);
/// Gains of every method in shape, and the largest by the other measures, one row a noisy mesh.
report::Table gain_table(const DenoisingLaboratory& laboratory);
report::Table winner_table(const std::vector<ClassResult>& classes);
/// Gain over the level of Gaussian noise, one panel a mesh, of methods that differ.
report::Plot gain_plot(const DenoisingLaboratory& laboratory);
using Shown = Within<DenoisingTrials, NoiseTrial>;
/// Clean, noisy and the methods of the plot at their best, one small picture each and one row a noisy mesh.
void add_method_figure(Answer& answer, const std::vector<Shown>& shown);

/// What the discussion tells.
report::Facts facts_of(const DenoisingLaboratory& laboratory);

}   // namespace meshfolio::methods
