/// @file
/// The measurements of the section "stability": the limit of explicit smoothing, proved and tried on both sides, and both schemes over
/// planes of steps and iterations.
#pragma once

#include "geometry/smoothing/laplacian_smoothing.h"
#include "geometry/smoothing/mode_growth.h"
#include "geometry/smoothing/stability_certificate.h"
#include "questions/bench/smoothing_study.h"
#include "questions/stability/parts.h"

namespace meshfolio::stability {

/// The largest stable step of one operator, proved, and a run on either side of it.
struct OperatorLimit {
    std::string name;   // "cotangent", "uniform"
    StabilityCertificate certificate;
    ModeGrowth below, beyond;   // at 0.99 and 1.01 of the limit, the top mode seeded a thousandth of the mean edge high

    double critical() const { return largest_stable_step(certificate.top); }
};

/// The vertex at which the top mode is largest, compared with the other vertices.
struct LimitingVertex {
    int vertex = -1;
    double area_share = 0;        // its area over the median
    double stiffness_share = 0;   // its −C_ii over the median
    bool on_boundary = false;
    double smallest_angle = 0;   // of the triangles around it [rad]
};

/// The limits of both operators on one mesh.
struct StabilityStudy : OnMesh {
    std::array<OperatorLimit, 2> limits;   // cotangent, uniform
    LimitingVertex limiting;               // of the cotangent operator
    double mean_edge = 0;                  // [length]

    const OperatorLimit& cotangent() const { return limits[0]; }
    const OperatorLimit& uniform() const { return limits[1]; }
};
/// Proves the limit of the cotangent and of the uniform operator, and runs 500 steps (quick: 200) at 0.99 and at 1.01 of each limit.
StabilityStudy stability_study(SharedMesh source, const QuestionSettings& settings);

/// A run, and the first triangle that turned: its normal differs by more than 90° from that in the input.
struct WatchedRun {
    std::string name;     // "rebuilt, fixed λ"
    double lambda = 0;    // asked for [length²]
    int iterations = 0;   // asked for
    Smoothed run = {};
    int turned_iteration = 0;   // the step in which the first triangle turned; 0: none turned
    int turned_face = -1;       // that triangle
    int inverted = 0;           // triangles turned at the end
};

/// Runs with the operator rebuilt at every step, from half the limit of the input, and one run beyond the limit with a fixed operator.
struct RebuiltFlow : OnMesh {
    static constexpr double share = 0.95;   // of the proved limit, kept by the adaptive run
    static constexpr double beyond = 2;     // λ of the frozen run over the limit: the top mode triples in each step
    WatchedRun fixed, adaptive, frozen;

    std::array<const WatchedRun*, 3> runs() const { return {&fixed, &adaptive, &frozen}; }
};

// ---- the planes -----------------------------------------------------------------------------------------------------------

/// One quantity over the plane, row by row of iteration counts; NaN if the run had blown up or nothing is left to measure.
using PlaneValues = std::vector<double>;

/// The measurements of one scheme over the plane.
struct SchemeMap {
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    PlaneValues moved;          // rms distance from the input over the box diagonal
    PlaneValues error;          // rms distance from the clean mesh over the box diagonal; empty if there is no clean mesh
    PlaneValues size;           // volume over that of the input; for an open mesh, area over area
    PlaneValues inverted;       // share of the triangles that face away from their first normals
    std::vector<int> blow_up;   // iteration at which the run of each λ blew up; 0: it did not
    int factorisations = 0;

    std::string name() const { return scheme == SmoothingScheme::explicit_euler ? "explicit" : "implicit"; }
};

/// Predicts when a run beyond the limit blows up. t steps multiply mode i by |1 − λμ_i|ᵗ; its height in the input is
/// |⟨X, φ_i⟩_M| max|φ_i|. The run ends when a vertex is as far away as `distance`.
struct GrowingModes {
    Vector eigenvalues;    // [1/length²]
    Vector heights;        // of the input [length]
    double rounding = 0;   // of coordinates: no run has less of a mode than this [length]
    double distance = 0;   // [length]

    /// Returns the height above which a mode is no rounding, so that symmetry or cancellation cannot stop its growth. [length]
    double noticeable() const { return 1e4 * rounding; }
    /// Returns the iteration (not rounded up) at which the first mode of at least this height reaches `distance`; NaN if none grows.
    double blow_up(double lambda, double least_height = 0) const;
    /// Returns the first iteration up to `last` at which the heights of all modes add up to 0.999 `distance`; 0 if they never do.
    int earliest(double lambda, int last) const;
};

/// A cell of the plane that a picture shows. a: explicit, the last stable step, all iterations; b: the first unstable step, while it stays
/// in view; c: implicit, the same cell as b; d: implicit, the largest step, while a twentieth of the size is left (or after one measured
/// count); e and f: explicit and implicit, nearest to the clean mesh.
struct MapPlace {
    std::string letter;
    SmoothingScheme scheme = SmoothingScheme::explicit_euler;
    std::size_t step = 0, row = 0;   // in lambdas and iterations
    Positions X;
};

/// Both schemes on one mesh over the plane of steps λ and iterations t.
struct SmoothingMaps {
    SmoothingSubject subject;
    std::optional<TriangleMesh> clean;   // the mesh before its noise was added; only for meshes that the program made
    double input_error = 0;              // rms distance of the input from the clean mesh over the box diagonal
    std::vector<double> lambdas;         // [length²]
    std::vector<int> iterations;
    std::array<SchemeMap, 2> schemes;   // explicit, implicit
    GrowingModes top;                   // the top mode alone
    std::optional<GrowingModes> all;    // every mode, of a small mesh
    std::vector<MapPlace> places;

    const std::string& name() const { return subject.name(); }
    const SchemeMap& explicit_map() const { return schemes[0]; }
    const SchemeMap& implicit_map() const { return schemes[1]; }
    /// Return the index of a cell in PlaneValues, its index in `lambdas`, and its index in `iterations`.
    std::size_t index(std::size_t step, std::size_t row) const { return row * lambdas.size() + step; }
    std::size_t step_of(std::size_t cell) const { return cell % lambdas.size(); }
    std::size_t row_of(std::size_t cell) const { return cell / lambdas.size(); }
    /// λ/λ_crit of a step.
    double relative(std::size_t step) const { return lambdas[step] / subject.critical; }
    /// Returns the index of the cell with the smallest error from the clean mesh; none if no clean mesh is known.
    std::optional<std::size_t> best(const SchemeMap& map) const;
};

/// Runs both schemes with the λ of the settings, else a logarithmic grid with the explicit limit between two steps. Measures at
/// spaced_iterations() up to the last of the settings, else 100 (quick: 30, laboratory: 200).
SmoothingMaps smoothing_maps(SharedMesh source, const QuestionSettings& settings);

/// Returns 10^(i / per_decade), i = 0, 1, …, below `last`, rounded, each once, and then `last`: 1, 2, 3, 4, 6, 10, 16, 20 for (20, 5).
std::vector<int> spaced_iterations(int last, int per_decade);

/// The triangles with all corners within `rings` edges of a vertex, turned so that its normal faces the three-quarter view.
struct Neighbourhood {
    TriangleMesh mesh;
    Eigen::VectorXi original;   // row i is vertex original[i] of the whole mesh
    int vertex = -1;            // the row of the vertex itself
};
Neighbourhood neighbourhood(const TriangleMesh& mesh, const MeshTopology& topology, int vertex, int rings);

}   // namespace meshfolio::stability
