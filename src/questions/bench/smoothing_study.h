/// @file
/// One smoothing run and what is measured along the way; shared by the questions on smoothing.
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
    Definiteness bottom;           // only where −C is semidefinite is any explicit step stable
    double critical = 0;           // λ_crit = 2/μ_max [length²; 1 for the uniform operator]
    double critical_floored = 0;   // λ_crit if triangles without area kept a stiffness; 0: there are none
    double mean_edge = 0;          // [length]
    double diagonal = 0;           // of the bounding box [length]
    double initial_energy = 0;     // Dirichlet energy of the input [length²]

    /// Twice the inverse of the Gershgorin bound; 0 where no step is proved stable.
    double safe() const { return bottom.semidefinite() ? 2 / top.upper_bound : 0; }
};
SmoothingSubject smoothing_subject(SharedMesh source, OperatorKind kind = OperatorKind::cotan, AreaForm area = AreaForm::barycentric);

/// All eigenpairs of −C on a mesh of at most so many vertices, with barycentric areas; found once for all chapters.
inline constexpr int all_modes_at_most = 1000;
std::shared_ptr<const Spectrum> all_modes(const OnMesh& subject);

/// What a factor of the implicit scheme costs, whatever λ.
FactorOperations implicit_operations_of(const SmoothingSubject& subject);

/// The steps of the settings, else these multiples of the explicit limit; ascending, each once. [length²]
std::vector<double> steps_of(const QuestionSettings& settings, double critical, const std::vector<double>& multiples);

struct SmoothingRun {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    double lambda = 0;    // [length²]
    int iterations = 0;   // asked for
    Smoothed result;
    MeshDifference moved;                  // the input against the result
    std::vector<double> energy;            // Dirichlet energy after t = 0, 1, … iterations, over that of the input
    std::vector<double> energy_rounding;   // by how much rounding may have raised it in step t, likewise; 0 for t = 0
    std::vector<double> volume;            // after t = 0, 1, … iterations, over that of the input; empty when open
    std::vector<double> size;              // after t = 0, 1, … iterations, of the component that has lost most: its volume, or with a
                                           // boundary the mean squared distance from its centroid, over that of the input
    Positions in_view;                     // the last positions before any leaves the pictures framed on the input
    int in_view_iteration = 0;
    Positions out_of_view;              // the first of which some have left them; empty: none
    std::vector<Positions> snapshots;   // at the iterations asked for
};

/// Smooths as smooth() does. A rebuilt run that reaches a surface of which M − λC cannot be factored keeps what it reached:
/// collapse_iteration is the step that could not be done.
/// @throws SolverError if the first step cannot be done
Smoothed smooth_until_collapse(const TriangleMesh& mesh, SmoothingOptions options, ImplicitSolver& solver);

/// One run, until it collapses if it is rebuilt; `keep` lists iterations (ascending, ≤ iterations) whose positions are kept in `snapshots`.
SmoothingRun run_smoothing(const SmoothingSubject& subject, SmoothingScheme scheme, double lambda, int iterations,
                           const std::vector<int>& keep = {});
/// The same with a solver that implicit runs share; `rebuild`: the operator is that of the current positions at every step.
SmoothingRun run_smoothing(const SmoothingSubject& subject, SmoothingScheme scheme, double lambda, int iterations,
                           const std::vector<int>& keep, ImplicitSolver& solver, bool rebuild = false);

/// Smoothing is recommended for as long as it leaves this share of the size.
inline constexpr double size_to_keep = 0.95;
/// Iterations of the run before less than `share` of the size is left; −1 when it never comes to that.
int iterations_keeping_size(const SmoothingRun& run, double share = size_to_keep);

/// Checks that the energy never rises beyond rounding. Undecided where rounding could hide a rise of 1e-9 of the input's energy.
report::Check energy_check(std::string name, const SmoothingRun& run);

/// The vertices where a mode is as large as anywhere, to a thousandth: on a symmetric mesh there are several.
std::vector<int> peaks_of(const Vector& mode);

/// Amplification of the top mode by `steps` explicit steps, against |1 − λμ_max|^steps. The mode is added a thousandth of a mean edge high,
/// because a symmetric input has none of it.
struct Amplification {
    double predicted = 0, measured = 0;
};
Amplification top_mode_amplification(const SmoothingSubject& subject, double lambda, int steps);

/// The share of the top mode in the motion X − X_input, in squared M-norms; NaN if nothing moved.
double share_of_top_mode(const SmoothingSubject& subject, const Positions& X);

/// Cotangent mean curvature at X times the subject's mean edge: the colours of smoothing figures. NaN where undefined.
Vector curvature_colours(const SmoothingSubject& subject, const Positions& X);

/// Largest λμ_max of a monitored run; NaN values are left out.
double largest_product(const Smoothed& run);

/// What is left of a size: "93 %"; "less than 10⁻¹²" where it is rounding.
std::string share_left(double share);

/// λ over λ_crit for people: "0.5".
std::string in_limits(const SmoothingSubject& subject, double lambda);
/// λ for file names: "lambda0.0123".
std::string step_name(double lambda);

/// Does X span no more than two boxes of the input? A cut-out of larger spikes shows nothing.
bool fits_a_frame(const SmoothingSubject& subject, const Positions& X);
/// X in the frame of the input; where it does not fit the cell is empty and says how many boxes it spans.
output::Panel framed_panel(const SmoothingSubject& subject, const Positions& X, std::string name, std::string label);

/// The mesh of the subject on the positions X, coloured by curvature_colours().
output::Panel smoothing_panel(const SmoothingSubject& subject, const Positions& X, std::string name, std::string label);

/// The colours of curvature_colours() that show these inputs: an unstable result has curvatures of any size.
output::ColorRange curvature_range(const std::vector<output::Panel>& inputs);

}   // namespace meshfolio
