/// @file
/// Experiments of earlier reports done again: their meshes and parameters here, the measurements, and the blocks that show them.
#pragma once

#include "geometry/measures/mesh_error.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "mesh/triangle_mesh.h"
#include "questions/bench/smoothing_study.h"
#include "questions/core/experiment.h"
#include "questions/reproductions/parts.h"

namespace meshfolio::reproductions {

/// A mesh of an experiment: one original, or the stand-in of one original or of several.
struct ExperimentMesh {
    std::vector<OriginalMesh> originals;   // at least one; parameters carry over from the first
    SharedMesh used;
    std::string name = {};       // numbered if two meshes of the experiment share it
    bool stand_in = false;       // not the mesh of the report
    double cotan_critical = 0;   // λ_crit of the cotangent operator with barycentric areas [length²]; 0 if it is not needed
    double mean_edge = 0;        // [length]
    double diagonal = 0;         // of the bounding box [length]
    Vector3 extent{0, 0, 0};     // of the bounding box [length]

    const TriangleMesh& mesh() const { return used->mesh(); }
    /// Returns the factor from a length to % of the box diagonal.
    double percent() const { return 100 / diagonal; }
};

/// Returns the originals of an experiment, else their stand-ins, one for originals with the same stand-in; or the user's own meshes
/// instead.
std::vector<ExperimentMesh> experiment_meshes(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// The rule by which parameters of an experiment carry over to a mesh.
enum class Carried { as_given, by_limit, by_edge };
/// Returns by_limit for a raw λ on a stand-in, which keeps its multiple of λ_crit; by_edge in noisy experiments, where it keeps its
/// multiple of the squared mean edge; as_given for the uniform operator, other units, and originals of unknown measure.
Carried lambda_rule(const Experiment& experiment, const ExperimentMesh& mesh, OperatorKind kind);
/// Returns λ on this mesh by lambda_rule(). [length²; none for the uniform operator]
/// @param critical  λ_crit of the operator on this mesh, for unit tau
double lambda_on(const Experiment& experiment, const ExperimentMesh& mesh, OperatorKind kind, double lambda, double critical);

/// Returns by_edge for a raw σ on a stand-in, which keeps its share of the mean edge if the original's is known; else as_given.
Carried noise_rule(const Experiment& experiment, const ExperimentMesh& mesh);
/// Returns σ along each axis on this mesh by noise_rule() and the experiment's unit. [length]
Vector3 noise_on(const Experiment& experiment, const ExperimentMesh& mesh, double noise);

/// One combination of the parameters of an experiment.
struct Variant {
    const ExperimentMesh* mesh = nullptr;
    OperatorKind kind = OperatorKind::cotan;
    AreaForm area = AreaForm::barycentric;
    SmoothingMethod method = {};
    double given = 0;   // λ in the report, in the experiment's unit

    friend bool operator==(const Variant&, const Variant&) = default;
};

/// A finished experiment. The results refer to the meshes, so it moves but is not copied.
template <class Result> struct Done {
    std::vector<ExperimentMesh> meshes;
    std::vector<Result> results;   // mesh by mesh, then by operator, area form, method, λ, …

    Done() = default;
    Done(Done&&) = default;
    Done& operator=(Done&&) = default;
};

/// One estimate of curvature on a mesh.
struct ExperimentField : Variant {
    ExperimentColour colour = ExperimentColour::h_cotan;
    Vector inside = {};              // NaN on the boundary, where it is no curvature; times h̄, 1/h̄ or h̄²: dimensionless
    Vector drawn = {};               // the same formula applied on the boundary too, as the reports drew it
    double largest_boundary = NAN;   // |drawn| on the boundary; NaN on a closed mesh
    ValueSummary summary = {};       // of `inside`
    double positive = 0;             // share of the values inside that are > 0
    double largest_inside = 0;       // |value|
};
/// Estimates each colour on each mesh with each operator and area form; a colour that does not depend on them is estimated once.
Done<ExperimentField> curvature_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// Returns n values for the mesh at X: curvature × mean edge (K × its square), also on the boundary, or the distance from the mesh's own
/// vertices [% of the box diagonal]; empty for ExperimentColour::none.
Vector colours_of(const ExperimentMesh& mesh, ExperimentColour colour, const Positions& X);

/// A mesh rebuilt from the smoothest k eigenvectors of one operator.
struct RebuiltMesh : Variant {
    int k = 0;   // at most the number of modes
    Positions X = {};
    MeshDifference difference = {};   // to the original
    double mass_rms = 0;              // in the norm of the operator's own mass, in which it falls with every k [length]
    double residual = 0;              // largest of the eigenpairs used
};
/// Rebuilds each mesh with each operator from each k, ascending.
Done<RebuiltMesh> reconstruction_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// One smoothing run; its snapshots are at the experiment's iterations.
struct ExperimentRun : Variant {
    double critical = 0;     // λ_crit of this operator on this mesh
    SmoothingRun run = {};   // run.lambda is λ on this mesh

    /// λ/λ_crit.
    double share() const { return run.lambda / critical; }
    bool is(SmoothingScheme scheme) const { return method.scheme == scheme; }
};
/// Returns the largest λ with which `iterations` explicit steps leave every vertex within three box diagonals of the centre, to a
/// thousandth; at least λ_crit. [length²]
double largest_usable_step(const SmoothingSubject& subject, int iterations);

struct SmoothingExperiment : Done<ExperimentRun> {
    /// The largest usable step on a mesh, and λ_crit. [length²]
    struct UsableStep {
        const ExperimentMesh* mesh;
        double lambda, critical;
    };
    std::vector<UsableStep> usable;   // one for each mesh, if the experiment searches for it
};
/// Runs every combination of mesh, operator, area form, method and λ.
SmoothingExperiment smoothing_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// One noisy mesh smoothed with its own operator.
struct NoisyRun : Variant {
    double lambda = 0;                        // on this mesh
    double noise = 0;                         // as the report has it
    Vector3 sigma{0, 0, 0};                   // along each axis, on this mesh [length]
    int minimum_said = 0;                     // iteration with the smallest error in the report; 0: not said
    Positions noisy_X = {};                   // before smoothing
    std::vector<double> rms = {};             // after t = 0, 1, … iterations, against the clean mesh [length]
    int best = 0;                             // iteration with the smallest error
    Positions best_X = {};                    // after that iteration
    std::vector<Positions> snapshots = {};    // at the experiment's iterations, as far as they were reached
    double noisy_angle = 0, last_angle = 0;   // mean angle of face normals to the clean ones, before and after [rad]
    bool blew_up = false;
    int blow_up_iteration = 0;
    int collapse_iteration = 0;   // of a rebuilt run: the step that could not be done; 0: none

    double gain() const { return rms.front() / rms[best]; }
    int last() const { return static_cast<int>(rms.size()) - 1; }
    /// Returns the rms error after t iterations. [% of the box diagonal]
    double percent(int t) const { return mesh->percent() * rms[t]; }
};
/// True for the kinds denoising and error_curve.
inline bool is_noisy(const Experiment& e) { return e.kind == ExperimentKind::denoising || e.kind == ExperimentKind::error_curve; }
/// Runs every combination of mesh, operator, area form, method, λ and noise level.
Done<NoisyRun> noisy_experiment(const MeshLibrary& library, const Experiment& experiment, const QuestionSettings& settings);

/// One experiment, and the answer that its blocks are added to.
struct Reproduction {
    Answer& answer;
    const Experiment& experiment;
    const QuestionSettings& settings;
    std::string id;   // "reproductions_03": the beginning of the ids of its tables, figures and files

    report::Section& section() const { return answer.section; }
    /// "S0, row 20".
    std::string where() const;
    std::string id_of(const std::string& what) const { return id + "_" + what; }
};

// Each adds a heading, the words of the report, figures, a table or plot, the results in words, and checks.
void add_curvature_reproduction(const Reproduction& r, const Done<ExperimentField>& done);
void add_forms_reproduction(const Reproduction& r);
void add_reconstruction_reproduction(const Reproduction& r, const Done<RebuiltMesh>& done);
void add_smoothing_reproduction(const Reproduction& r, const SmoothingExperiment& done);
void add_noisy_reproduction(const Reproduction& r, const Done<NoisyRun>& done);

/// Returns a row for each of the requirements 7 to 34: its bundled experiments, those done in this run, those that could not be done, and
/// the section of a whole report that answers it.
report::Table coverage_table(const std::vector<Experiment>& bundled, const std::vector<Experiment>& done,
                             const std::vector<Experiment>& failed);
/// Returns the requirements, 7 to 34, that neither one of these experiments nor another section answers; ascending.
std::vector<int> uncovered_rows(const std::vector<Experiment>& experiments);

// ---- shared by the kinds ---------------------------------------------------------------------------------------------

/// Adds the heading, the words of the report, the meshes used here, how parameters carry over, and which are lost.
void add_opening(const Reproduction& r, const std::vector<ExperimentMesh>& meshes);

/// Appends a sentence and a space.
inline void add_sentence(report::Text& text, const report::Text& sentence) { report::extend(text, sentence, " "); }
/// Returns "row 20", "rows 7, 8 and 9".
std::string rows_text(const std::vector<int>& rows);
/// Returns λ, which is in the unit of the settings, with that unit: "1×10⁻⁷", "0.5 λ_crit", "0.02 h̄²".
std::string given_text(const Experiment& experiment, double lambda);
/// Returns the noise in the unit of the settings: "0.0013", "1 % of the box", "0.3 h̄".
std::string noise_text(const Experiment& experiment, double noise);
/// Returns the method, and operator and area form if they are not cotangent and barycentric or there are several: "explicit, uniform".
std::string variant_text(const Experiment& experiment, const Variant& variant);
/// Returns variant_text() with λ: "explicit, uniform, λ = 0.5".
std::string run_text(const Experiment& experiment, const Variant& variant);
/// Returns a number with at most three digits: "0.05", "1 × 10⁻⁷".
std::string chosen_text(double x);
/// Returns the least and the largest value: "0.3 to 0.9", "0.3" if they look alike. @param values  at least one
std::string range_text(const std::vector<double>& values);
/// Returns the words with the first letter in upper case if it is one of a to z.
std::string sentence_case(std::string words);

/// Returns the key of a colour in ids and messages: "h_cotan".
std::string key_of(ExperimentColour colour);
/// Returns a figure of one mesh; its first panel is the mesh itself, labelled `first_panel`, in the first colour of the experiment.
output::FigureRequest figure_on(const Reproduction& r, const ExperimentMesh& mesh, const std::string& first_panel);
/// Adds a panel of the mesh at X with this label, in the first colour of the experiment.
void add_panel(output::FigureRequest& figure, const Reproduction& r, const ExperimentMesh& mesh, const Positions& X, std::string label);
/// Returns the output::robust_range() of these panels in the map of the colour; nothing for ExperimentColour::none.
std::optional<output::ColorRange> range_of(const Reproduction& r, ExperimentColour colour, const std::vector<output::Panel>& panels);

}   // namespace meshfolio::reproductions
