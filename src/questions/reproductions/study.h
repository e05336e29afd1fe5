/// @file
/// Experiments of earlier reports done again: the meshes they are done on here, their parameters carried over, and what was measured.
#pragma once

#include "mesh/triangle_mesh.h"
#include "questions/bench/smoothing_study.h"

namespace meshfolio::reproductions {

/// What an experiment is done on. Several originals with the same stand-in are one.
struct ExperimentMesh {
    std::vector<OriginalMesh> originals;   // at least one; parameters carry over from the first
    std::shared_ptr<const LibraryMesh> used;
    std::string label;           // its name; numbered where two meshes of the experiment share it
    bool stand_in = false;       // not the mesh of the report
    double cotan_critical = 0;   // λ_crit of the cotangent operator with barycentric areas [length²]; 0 where it is not needed
    double mean_edge = 0;        // [length]
    double diagonal = 0;         // of the bounding box [length]
    Vector3 extent{0, 0, 0};     // of the bounding box [length]
    const TriangleMesh& mesh() const { return used->mesh(); }
    const std::string& name() const { return label; }
};

/// The meshes of an experiment: the originals, else their stand-ins; the user's own take their places.
std::vector<ExperimentMesh> experiment_meshes(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// By what rule the parameters of an experiment carry over to a mesh.
enum class Carried { as_given, by_limit, by_edge };
/// A raw λ becomes on a stand-in the same multiple of λ_crit, or with noise of the squared mean edge. The uniform operator, other units and
/// originals of unknown measure keep λ as given.
Carried lambda_rule(const Experiment& experiment, const ExperimentMesh& mesh, OperatorKind kind);
/// λ on this mesh. [length²; 1 for the uniform operator]
/// @param critical  λ_crit of the operator on this mesh, for unit tau
double lambda_on(const Experiment& experiment, const ExperimentMesh& mesh, OperatorKind kind, double lambda, double critical);

/// A raw σ carries over as the same share of the mean edge.
Carried noise_rule(const Experiment& experiment, const ExperimentMesh& mesh);
/// σ along each axis on this mesh. [length]
Vector3 noise_on(const Experiment& experiment, const ExperimentMesh& mesh, double noise);

/// One smoothing run of an experiment; its snapshots are at the experiment's iterations.
struct ExperimentRun {
    std::size_t mesh = 0;   // index into the meshes
    SmoothingMethod method;
    OperatorKind kind = OperatorKind::cotan;
    AreaForm area = AreaForm::barycentric;
    double given = 0;      // λ as the report has it, in the experiment's unit
    double critical = 0;   // λ_crit of this operator on this mesh
    SmoothingRun run;      // run.lambda is λ on this mesh

    double share() const { return run.lambda / critical; }   // λ/λ_crit
};

/// The largest step found usable by trial: `iterations` explicit steps leave every vertex within three box diagonals of the centre.
struct UsableStep {
    std::size_t mesh = 0;
    double critical = 0;   // λ_crit
    double lambda = 0;     // the largest usable one, to a thousandth [length²]
    int iterations = 0;
};
UsableStep largest_usable_step(const SmoothingSubject& subject, int iterations);

struct SmoothingExperiment {
    std::vector<ExperimentMesh> meshes;
    std::vector<ExperimentRun> runs;   // mesh by mesh, operator, area, method, λ
    std::vector<UsableStep> usable;    // one a mesh, when the experiment searches
};
/// Of the kind smoothing: every combination of mesh, operator, area form, method and λ
SmoothingExperiment smoothing_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// One noisy mesh smoothed with its own operator.
struct NoisyRun {
    std::size_t mesh = 0;
    SmoothingMethod method;
    OperatorKind kind = OperatorKind::cotan;
    AreaForm area = AreaForm::barycentric;
    double given = 0, lambda = 0;   // as the report has it, on this mesh
    double noise = 0;               // as the report has it
    Vector3 sigma{0, 0, 0};         // along each axis, on this mesh [length]
    int minimum_said = 0;           // where the report has the smallest error; 0: not said
    std::shared_ptr<const TriangleMesh> noisy = {};
    std::vector<double> rms = {};             // after t = 0, 1, … iterations, against the clean mesh [length]
    int best = 0;                             // iteration with the smallest
    Positions best_X = {};                    // there
    std::vector<Positions> snapshots = {};    // at the experiment's iterations, as far as they were reached
    double noisy_angle = 0, last_angle = 0;   // mean angle of face normals to the clean ones, before and after [rad]
    bool blew_up = false;
    int blow_up_iteration = 0;

    double gain() const { return rms.front() / rms[best]; }
};

struct NoisyExperiment {
    std::vector<ExperimentMesh> meshes;
    std::vector<NoisyRun> runs;   // mesh by mesh, operator, area, method, λ, noise
};
/// Of the kinds denoising and error_curve.
NoisyExperiment noisy_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

}   // namespace meshfolio::reproductions
