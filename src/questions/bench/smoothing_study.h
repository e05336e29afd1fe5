/// @file
/// Smoothing runs and their measurements, for the questions on smoothing.
#pragma once

#include "geometry/measures/mesh_error.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/spectrum/definiteness.h"
#include "geometry/spectrum/stability.h"
#include "questions/core/section_tools.h"

namespace meshfolio {

struct FactorOperations;
struct Spectrum;

inline constexpr report::Words smoothing_words("smoothing");

/// A mesh with its operator and the limit of explicit smoothing on it.
struct SmoothingSubject : OnMesh {
    OperatorKind kind = OperatorKind::cotan;
    AreaForm area = AreaForm::barycentric;
    LaplaceBeltrami laplacian;     // of the input, frozen
    LargestEigenvalue top;         // of −L
    Definiteness bottom;           // no explicit step is stable unless −C is semidefinite
    double critical = 0;           // λ_crit = 2/μ_max [length²; 1 for the uniform operator]
    double critical_floored = 0;   // λ_crit with a stiffness for triangles without area; 0: the mesh has none
    double mean_edge = 0;          // [length]
    double diagonal = 0;           // of the bounding box [length]
    double initial_energy = 0;     // Dirichlet energy of the input [length²]

    /// Returns the step 2/(Gershgorin bound), which is proved stable; 0 if no step is. [length²]
    double safe() const { return bottom.semidefinite() ? 2 / top.upper_bound : 0; }
};
/// Assembles the operator of the mesh and finds the limit of explicit smoothing. @throws SolverError, MeshError
SmoothingSubject smoothing_subject(SharedMesh source, OperatorKind kind = OperatorKind::cotan, AreaForm area = AreaForm::barycentric);

inline constexpr int all_modes_at_most = 1000;   // vertices
/// Returns all eigenpairs of the cotangent operator with barycentric areas, for a mesh of at most all_modes_at_most vertices in use. They
/// are computed once for all chapters and live as long as the mesh.
const Spectrum& all_modes(const OnMesh& subject);

/// Counts the operations of factoring and solving with the matrix of an implicit step; they do not depend on λ.
FactorOperations implicit_operations_of(const SmoothingSubject& subject);

/// Returns the λ of the settings, or `multiples` × `critical` if there are none; ascending, without duplicates. [length²]
std::vector<double> steps_of(const QuestionSettings& settings, double critical, const std::vector<double>& multiples);

struct SmoothingRun {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    double lambda = 0;    // [length²]
    int iterations = 0;   // asked for
    Smoothed result;
    MeshDifference moved;                  // the input against the result
    std::vector<double> energy;            // Dirichlet energy after t = 0, 1, … iterations, over that of the input
    std::vector<double> energy_rounding;   // the rise in step t that rounding may explain, likewise; 0 for t = 0
    std::vector<double> volume;            // after t = 0, 1, … iterations, over that of the input; empty when open
    std::vector<double> size;              // after t = 0, 1, … iterations, of the component that has lost most: its volume, or with a
                                           // boundary the mean squared distance from its centroid, over that of the input
    Positions in_view;                     // the last positions that all lie within pictures framed on the input
    int in_view_iteration = 0;
    Positions out_of_view;              // the first positions that do not; empty: there are none
    std::vector<Positions> snapshots;   // at the iterations to keep
};

/// Smooths as smooth() does. If the operator is rebuilt and M − λC cannot be factored after some steps, returns the positions reached, with
/// the number of the failed step in collapse_iteration.
/// @throws SolverError if the first step fails
Smoothed smooth_until_collapse(const TriangleMesh& mesh, SmoothingOptions options, ImplicitSolver& solver);

/// Smooths the mesh of the subject and measures every iteration.
/// @param keep  iterations with a snapshot: ascending, at most `iterations`
SmoothingRun run_smoothing(const SmoothingSubject& subject, SmoothingScheme scheme, double lambda, int iterations,
                           const std::vector<int>& keep = {});
/// Smooths the mesh of the subject and measures every iteration, with a solver that implicit runs share.
/// @param rebuild  make the operator anew from the positions of every step, until one cannot be factored
SmoothingRun run_smoothing(const SmoothingSubject& subject, SmoothingScheme scheme, double lambda, int iterations,
                           const std::vector<int>& keep, ImplicitSolver& solver, bool rebuild = false);

inline constexpr double size_to_keep = 0.95;   // share of the size that recommended smoothing leaves
/// Returns the last iteration before less than `share` of the size is left; −1 if the run keeps it to the end.
int iterations_keeping_size(const SmoothingRun& run, double share = size_to_keep);

/// Checks that the energy never rises beyond rounding. Undecided if rounding could hide a rise of 1e-9 of the input's energy.
report::Check energy_check(std::string name, const SmoothingRun& run);

/// Returns the vertices with a magnitude within a thousandth of the mode's largest; on a symmetric mesh there are several.
std::vector<int> peaks_of(const Vector& mode);

struct Amplification {
    double predicted = 0, measured = 0;
};
/// Measures the amplification of the top mode by `steps` explicit steps and predicts it as |1 − λμ_max|^steps. A thousandth of a mean edge
/// of the mode is added to the input, because a symmetric mesh contains none of it.
Amplification top_mode_amplification(const SmoothingSubject& subject, double lambda, int steps);

/// Computes the share of the top mode in the motion X − X_input, in squared M-norms; NaN if nothing moved.
double share_of_top_mode(const SmoothingSubject& subject, const Positions& X);

/// Computes the values that colour smoothing figures: n times H·h̄, cotangent mean curvature at X times the input's mean edge; NaN where
/// undefined.
Vector curvature_colours(const SmoothingSubject& subject, const Positions& X);

/// Returns the largest λμ_max over the steps of a monitored run; skips NaN; 0 without steps.
double largest_product(const Smoothed& run);

/// Formats a share: "93 %", or "less than 10⁻¹²" if it is rounding.
std::string share_left(double share);
/// Formats λ/λ_crit for people: "0.5".
std::string in_limits(const SmoothingSubject& subject, double lambda);
/// Formats λ for file names: "lambda0.0123".
std::string step_name(double lambda);

/// True if the box diagonal of X is at most twice that of the input. A cut-out of larger spikes shows nothing.
bool fits_a_frame(const SmoothingSubject& subject, const Positions& X);
/// Makes a panel of the positions X without colours; unless fits_a_frame(), an empty panel with a label that says how many boxes they span.
output::Panel framed_panel(const SmoothingSubject& subject, const Positions& X, std::string name, std::string label);
/// Makes a panel of the positions X, coloured by curvature_colours().
output::Panel smoothing_panel(const SmoothingSubject& subject, const Positions& X, std::string name, std::string label);
/// Returns the diverging output::robust_range() of the panels of inputs, coloured by curvature_colours(), for all panels of a figure: an
/// unstable result has curvatures of any size.
output::ColorRange curvature_range(const std::vector<output::Panel>& inputs);

}   // namespace meshfolio
