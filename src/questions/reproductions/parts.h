/// @file
/// Experiments of earlier reports done again: the meshes they are done on here, their parameters carried over, and what was measured.
#pragma once

#include "geometry/measures/mesh_error.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "mesh/triangle_mesh.h"
#include "questions/bench/smoothing_study.h"
#include "questions/core/experiment.h"

namespace meshfolio::reproductions {

inline constexpr report::Words words("reproductions");

/// What an experiment is done on. Several originals with the same stand-in are one.
struct ExperimentMesh {
    std::vector<OriginalMesh> originals;   // at least one; parameters carry over from the first
    SharedMesh used;
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

/// The rule by which parameters of an experiment carry over to a mesh.
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

struct ExperimentField {
    std::size_t mesh = 0;   // index into the meshes
    ExperimentColour colour = ExperimentColour::h_cotan;
    OperatorKind kind = OperatorKind::cotan;   // of h_cotan
    AreaForm area = AreaForm::barycentric;     // of h_cotan and gauss
    Vector inside = {};                        // NaN on the boundary, where it is no curvature; times h̄, 1/h̄ or h̄²: dimensionless
    Vector drawn = {};                         // the same formula applied on the boundary too, as the reports drew it
    double largest_boundary = NAN;             // |drawn| on the boundary; NaN on a closed mesh
    ValueSummary summary = {};                 // of `inside`
    double positive = 0;                       // share of the values inside that are > 0
    double largest_inside = 0;                 // |value|
};

struct CurvatureExperiment {
    std::vector<ExperimentMesh> meshes;
    std::vector<ExperimentField> fields;   // mesh by mesh, colour, operator, area; what does not depend on one is there once
};
CurvatureExperiment curvature_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// Colours of the mesh at X: curvature as `drawn` above, in mean edges of the mesh, or the distance to it [% of the box diagonal]; empty
/// without a colour.
Vector colours_of(const ExperimentMesh& mesh, ExperimentColour colour, const Positions& X);

/// A mesh rebuilt from the smoothest k eigenvectors of one operator.
struct RebuiltMesh {
    std::size_t mesh = 0;
    OperatorKind kind = OperatorKind::cotan;
    AreaForm area = AreaForm::barycentric;
    int k = 0;   // cut to the modes there are
    Positions X;
    MeshDifference difference;   // to the original
    double mass_rms = 0;         // in the norm of the operator's own mass, in which it falls with every k [length]
    double residual = 0;         // largest of the eigenpairs used
};

struct ReconstructionExperiment {
    std::vector<ExperimentMesh> meshes;
    std::vector<RebuiltMesh> rebuilt;   // mesh by mesh, operator, area, k ascending
};
ReconstructionExperiment reconstruction_experiment(const MeshLibrary& library, const Experiment& experiment,
                                                   const QuestionSettings& settings);

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
/// Runs every combination of mesh, operator, area form, method and λ, for the kind smoothing.
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
    int collapse_iteration = 0;   // of a rebuilt run: the step that could not be done; 0: none

    double gain() const { return rms.front() / rms[best]; }
};

struct NoisyExperiment {
    std::vector<ExperimentMesh> meshes;
    std::vector<NoisyRun> runs;   // mesh by mesh, operator, area, method, λ, noise
};
/// Runs experiments of the kinds denoising and error_curve.
NoisyExperiment noisy_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// One experiment and where its blocks go.
struct Reproduction {
    Answer& answer;
    const Experiment& experiment;
    const QuestionSettings& settings;
    std::string id;   // "reproductions_03": what its tables, figures and files begin with

    report::Section& section() const { return answer.section; }
    /// "S0, row 20".
    std::string where() const;
    std::string id_of(const std::string& what) const { return id + "_" + what; }
};

// Each: heading, what the report says, what was done here, figures, table or plot, and what was found.
void add_curvature_reproduction(const Reproduction& r, const CurvatureExperiment& done);
void add_forms_reproduction(const Reproduction& r);
void add_reconstruction_reproduction(const Reproduction& r, const ReconstructionExperiment& done);
void add_smoothing_reproduction(const Reproduction& r, const SmoothingExperiment& done);
void add_noisy_reproduction(const Reproduction& r, const NoisyExperiment& done);

/// Returns a row for each of the requirements 7 to 34: the experiments on it of the bundled files, those that were done in this run, those
/// that could not be done, and the section of a whole report that answers it.
report::Table coverage_table(const std::vector<Experiment>& bundled, const std::vector<Experiment>& done,
                             const std::vector<Experiment>& failed);
/// The rows that neither an experiment nor another section answers.
std::vector<int> uncovered_rows(const std::vector<Experiment>& experiments);

// ---- what they share -------------------------------------------------------------------------------------------------

/// Heading and opening: what the report says, on which meshes this is done here, how parameters carry over, which are lost.
void add_opening(const Reproduction& r, const std::vector<ExperimentMesh>& meshes);

/// Appends a sentence and a space.
inline void tell(report::Text& text, const report::Text& sentence) { report::extend(text, sentence, " "); }
/// "row 20", "rows 7, 8 and 9".
std::string rows_text(const std::vector<int>& rows);
/// "1×10⁻⁷", "0.5 λ_crit", "0.02 h̄²": as the settings have it.
std::string given_text(const Experiment& experiment, double lambda);
/// "0.0013", "1 % of the box", …
std::string noise_text(const Experiment& experiment, double noise);
/// How a run smooths: "implicit", "explicit, uniform"; operator and areas where they are not the usual ones or there are several.
std::string variant_text(const Experiment& experiment, OperatorKind kind, AreaForm area, const SmoothingMethod& method);
/// A number as people would write it who chose it: 0.05, 1 × 10⁻⁷; at most three digits.
std::string chosen_text(double x);
/// "0.3", "0.3 to 0.9": least and largest. @param values  at least one
std::string range_text(const std::vector<double>& values);
/// Makes the first letter upper case if it is a Latin one.
std::string sentence_case(std::string words);

/// How the id of what is coloured so ends: "h_cotan".
std::string key_of(ExperimentColour colour);
/// A figure on this mesh, with the mesh itself as its first panel.
output::FigureRequest figure_on(const Reproduction& r, const ExperimentMesh& mesh, const std::string& first_panel);
/// The range of a figure, from these panels alone; nothing when there are no values.
std::optional<output::ColorRange> range_of(const Reproduction& r, ExperimentColour colour, const std::vector<output::Panel>& panels);

}   // namespace meshfolio::reproductions
