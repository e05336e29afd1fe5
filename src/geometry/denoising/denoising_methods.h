/// @file
/// Methods that remove noise from a mesh, chosen by name and run by one call. A run is a sequence of steps from mesh to mesh.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "geometry/smoothing/implicit_solver.h"
#include "mesh/mesh_topology.h"

namespace meshfolio {

enum class DenoisingMethod {
    explicit_flow,
    implicit_flow,
    rebuilt_flow,
    taubin,
    volume_rescaled,
    conformal_flow,
    bilateral_normals,
    guided_normals
};

struct DenoisingEntry {
    DenoisingMethod method;
    std::string_view name;          // "volume-rescaled"
    std::string_view title;         // in tables and pictures
    std::string_view reference;     // in the bibliography
    std::string_view description;   // one sentence
};
/// Lists all methods, in the order of tables.
std::span<const DenoisingEntry> denoising_list();
/// Returns the entry of a method in denoising_list().
const DenoisingEntry& denoising_entry(DenoisingMethod method);

/// True if the method filters face normals, which can keep edges, instead of diffusing positions.
bool filters_normals(DenoisingMethod method);
/// True if the method can run on the mesh; false for volume rescaling if a component encloses no volume.
bool is_defined(DenoisingMethod method, const TriangleMesh& mesh, const MeshTopology& topology);

/// A mesh with precomputed values that all runs share. The mesh and its topology must outlive it.
struct DenoisingInput {
    const TriangleMesh& mesh;
    const MeshTopology& topology;
    double largest_eigenvalue = 0;   // μ_max of its cotangent operator; only Taubin needs it [1/length²]
};

struct DenoisingOptions {
    DenoisingMethod method = DenoisingMethod::implicit_flow;
    /// Flows: λ [length²]. Taubin: the pass band, a share of μ_max/2; its λ is 1/μ_max. Filters of normals: σ_r, the difference of unit
    /// normals beyond which two faces count as different sides of an edge.
    double parameter = 0;
    int steps = 1;
    /// Called after every step with its number (from 1) and the positions; return false to stop.
    std::function<bool(int, const Positions&)> after_step = {};
};

struct DenoisingRun {
    Positions X;          // the last finite positions
    int steps = 0;        // steps done
    bool ended = false;   // ended early: the surface collapsed or blew up
};

/// Runs a method for options.steps steps, fewer if it ends early. Its step from X to X' is
///   explicit          X' = X + λLX, L of the input
///   implicit          (M − λC) X' = M X, M and C of the input
///   rebuilt           (M − λC) X' = M X, M and C of X
///   taubin            X' = (I + mL)(I + λL) X, L of the input
///   volume-rescaled   implicit, then each component scaled to the input's volume about its centroid
///   conformal         (M − λC) X' = M X, M of X, C of the input; then each component scaled to the input's area about its centroid
///   bilateral         the face normals of the step before filtered by themselves; then vertices moved towards them
///   guided            the face normals of X filtered by their guide; then vertices moved towards them
/// @param solver  shared by several runs: keeps factors from one to the next
/// @throws MeshError for a parameter that is not positive and finite, for steps < 0, or where the method is not defined;
///         SolverError if a system cannot be factored
DenoisingRun denoise(const DenoisingInput& input, const DenoisingOptions& options, ImplicitSolver& solver);

}   // namespace meshfolio
