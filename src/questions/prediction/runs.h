/// @file
/// Noisy meshes smoothed with each of three operators, and what is measured along the way.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/denoising/risk_estimate.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/implicit_solver.h"
#include "mesh/triangle_mesh.h"

namespace meshfolio::prediction {

/// Whose operator smooths the noisy mesh: that of the clean mesh, its own, or that of the current positions at every step.
enum class FlowOperator { clean, noisy, rebuilt };
std::string name_of(FlowOperator kind);

/// Implicit smoothing of meshes with the triangles of `clean`.
struct DenoisingFlow {
    TriangleMesh clean;
    OperatorWithMass whole;   // of the clean mesh
    Positions normals;        // n × 3, of the clean mesh
    double lambda = 0;        // [length²]

    DenoisingFlow(TriangleMesh mesh, double step);
};

/// Solvers kept from run to run; each thread has its own.
struct FlowSolvers {
    ImplicitSolver clean, own;
};

/// From Y, T + 1 positions; fewer where triangles collapse until no operator can be built or factored.
Trajectory denoising_run(const DenoisingFlow& flow, FlowOperator kind, const Positions& Y, int iterations, FlowSolvers& solvers);
/// One that ended early stays where it ended.
Trajectory kept_at_its_end(Trajectory run, int iterations);

/// Squared errors of one run against the clean mesh after t = 0, 1, … T steps.
struct RunErrors {
    Vector vertices;   // mean over the vertices [length²]
    Vector mass;       // mean with the areas of the clean mesh as weights [length²]
    Vector along;      // of `vertices`, the part along the clean surface [length²]
};
RunErrors errors_of_run(const DenoisingFlow& flow, const Trajectory& run);

/// Over the seeds, after t = 0, 1, … T steps.
struct MeasuredCurve {
    Vector square, square_error;   // mean squared error and its standard error [length²]
    Vector mass, mass_error;       // the same, weighted by area
    Vector along;                  // mean of the part along the surface
    Vector low, high;              // tenth and ninetieth percentile of the rms error [length]
    int seeds = 0;

    int iterations() const { return static_cast<int>(square.size()) - 1; }
    Vector rms() const { return square.cwiseSqrt(); }
    int best() const;   // first iteration with the smallest mean squared error
};
/// The mean, in order of the seeds. @throws MeshError without a run
MeasuredCurve measured_curve(const std::vector<RunErrors>& runs);

/// First index of the smallest value.
int first_smallest(const Vector& values);

}   // namespace meshfolio::prediction
