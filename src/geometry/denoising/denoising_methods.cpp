#include "geometry/denoising/denoising_methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "base/number_text.h"
#include "geometry/denoising/component_size.h"
#include "geometry/denoising/normal_filters.h"
#include "geometry/operators/triangle_shape.h"
#include "geometry/operators/vertices_with_mass.h"
#include "geometry/smoothing/laplacian_smoothing.h"
#include "mesh/triangle_measures.h"

namespace meshfolio {
namespace {

constexpr std::array methods{
    DenoisingEntry{DenoisingMethod::explicit_flow, "explicit", "explicit", "taubin_1995",
                   "Diffusion by explicit steps, stable below 2/μ_max; the operator is that of the noisy mesh."},
    DenoisingEntry{DenoisingMethod::implicit_flow, "implicit", "implicit", "desbrun_1999",
                   "Diffusion by backward Euler steps of any size; the operator is that of the noisy mesh."},
    DenoisingEntry{DenoisingMethod::rebuilt_flow, "rebuilt", "rebuilt implicit", "desbrun_1999",
                   "Mean curvature flow: backward Euler steps with the operator of the current mesh."},
    DenoisingEntry{DenoisingMethod::taubin, "taubin", "Taubin λ|μ", "taubin_1995",
                   "An explicit step followed by one of the other sign: a low-pass filter that does not shrink."},
    DenoisingEntry{DenoisingMethod::volume_rescaled, "volume-rescaled", "volume rescaled", "desbrun_1999",
                   "Implicit diffusion, each component scaled back to the volume of the noisy mesh."},
    DenoisingEntry{
        DenoisingMethod::conformal_flow, "conformal", "conformalised flow", "kazhdan_2012",
        "Mean curvature flow that keeps the stiffness of the noisy mesh and rebuilds the masses alone, scaled back to its area."},
    DenoisingEntry{DenoisingMethod::bilateral_normals, "bilateral", "bilateral normals", "zheng_2011",
                   "Face normals averaged over those around that are similar; then the vertices follow."},
    DenoisingEntry{DenoisingMethod::guided_normals, "guided", "guided normals", "zhang_2015",
                   "The same, similarity being judged by the mean normals of the most consistent patches near."},
};

constexpr int vertex_updates = 10;   // of each step of a filter of normals

/// Runs smooth(), explicit, implicit or by Taubin: 1/λ + 1/m = pass_band · μ_max/2 with λ = 1/μ_max.
DenoisingRun diffused(const DenoisingInput& input, const DenoisingOptions& options, ImplicitSolver& solver) {
    SmoothingOptions smoothing;
    smoothing.scheme = SmoothingScheme::implicit_euler;
    smoothing.lambda = options.parameter;
    smoothing.iterations = options.steps;
    smoothing.after_step = options.after_step;
    if (options.method == DenoisingMethod::explicit_flow) smoothing.scheme = SmoothingScheme::explicit_euler;
    if (options.method == DenoisingMethod::rebuilt_flow) smoothing.rebuild = true;
    if (options.method == DenoisingMethod::taubin) {
        smoothing.scheme = SmoothingScheme::taubin;
        smoothing.lambda = 1 / input.largest_eigenvalue;
        smoothing.taubin_mu = 1 / (input.largest_eigenvalue * (0.5 * options.parameter - 1));
    }
    Smoothed run = smooth(input.mesh, smoothing, solver);
    return {std::move(run.X), run.iterations, run.blew_up || run.collapse_iteration > 0};
}

/// Runs implicit diffusion with each component scaled back to its volume. The flow is linear and keeps constants, so scaling a state does
/// not change the later ones: each state of the plain run is scaled alone.
DenoisingRun rescaled(const DenoisingInput& input, DenoisingOptions options, ImplicitSolver& solver) {
    const ComponentSizes wanted = component_sizes(input.mesh, input.topology);
    const auto scaled = [&](const Positions& X) { return with_volumes(moved_to(input.mesh, X), input.topology, wanted); };
    if (options.after_step)
        options.after_step = [scaled, after_step = options.after_step](int step, const Positions& X) {
            return after_step(step, scaled(X));
        };
    DenoisingRun run = diffused(input, options, solver);
    run.X = scaled(run.X);
    return run;
}

/// Runs conformalised mean curvature flow (Kazhdan, Solomon & Ben-Chen 2012): the stiffness stays that of the input, the masses are those
/// of the current surface. A conformal flow is mean curvature flow without its singularities.
DenoisingRun conformalised(const DenoisingInput& input, const DenoisingOptions& options, ImplicitSolver& solver) {
    const ComponentSizes wanted = component_sizes(input.mesh, input.topology);
    LaplaceBeltrami laplacian = laplace_beltrami(input.mesh);
    TriangleMesh current = input.mesh;
    DenoisingRun run{input.mesh.X, 0, false};
    while (run.steps < options.steps) {
        if (run.steps > 0) laplacian.M = vertex_areas(current, AreaForm::barycentric);
        run.ended = !(laplacian.M.sum() > 1e-24 * wanted.area.sum());
        if (run.ended) break;
        solver.prepare(operator_with_mass(laplacian), options.parameter);
        current.X = solver.step(current.X);
        current.X = with_areas(current, input.topology, wanted);
        run.ended = !current.X.allFinite();
        if (run.ended) break;
        run.X = current.X;
        ++run.steps;
        if (options.after_step && !options.after_step(run.steps, run.X)) break;
    }
    return run;
}

/// Filters face normals and moves the vertices after them. Zheng et al. keep the weights of the input and filter the normals again and
/// again; Zhang et al. take both from the current mesh.
DenoisingRun by_normals(const DenoisingInput& input, const DenoisingOptions& options) {
    DenoisingRun run{input.mesh.X, 0, false};
    TriangleMesh current = input.mesh;
    NormalKernel kernel = normal_kernel(input.mesh);
    Positions N = face_normals(input.mesh);
    while (run.steps < options.steps) {
        if (options.method == DenoisingMethod::guided_normals) {
            if (run.steps > 0) kernel = normal_kernel(current, std::move(kernel.rings));
            N = face_normals(current);
            N = filtered_normals(kernel, N, guiding_normals(current, kernel.rings, N), options.parameter);
        } else {
            N = filtered_normals(kernel, N, N, options.parameter);
        }
        current.X = moved_to_normals(current, input.topology.vertex_faces, N, vertex_updates);
        run.X = current.X;
        ++run.steps;
        if (options.after_step && !options.after_step(run.steps, run.X)) break;
    }
    return run;
}

}   // namespace

std::span<const DenoisingEntry> denoising_list() { return methods; }

const DenoisingEntry& denoising_entry(DenoisingMethod method) {
    return *std::find_if(methods.begin(), methods.end(), [&](const DenoisingEntry& entry) { return entry.method == method; });
}

bool filters_normals(DenoisingMethod method) {
    return method == DenoisingMethod::bilateral_normals || method == DenoisingMethod::guided_normals;
}

bool is_defined(DenoisingMethod method, const TriangleMesh& mesh, const MeshTopology& topology) {
    return method != DenoisingMethod::volume_rescaled || has_volume_to_keep(mesh, topology);
}

DenoisingRun denoise(const DenoisingInput& input, const DenoisingOptions& options, ImplicitSolver& solver) {
    const std::string name(denoising_entry(options.method).name);
    if (!(std::isfinite(options.parameter) && options.parameter > 0))
        throw MeshError("denoising, " + name + ": parameter = " + plain_text(options.parameter), "it must be positive and finite");
    if (options.steps < 0) throw MeshError("denoising, " + name + ": " + std::to_string(options.steps) + " steps", "give 0 or more");
    if (options.method == DenoisingMethod::taubin && !(input.largest_eigenvalue > 0))
        throw MeshError("denoising, " + name + ": largest eigenvalue = " + plain_text(input.largest_eigenvalue),
                        "it must be positive: give that of the cotangent operator");
    if (!is_defined(options.method, input.mesh, input.topology))
        throw MeshError("denoising, " + name + ": a component of the mesh encloses no volume to keep",
                        "close the mesh, or take another method");

    // About the box centre and scaled by a power of two, so that far coordinates and the model's unit cost no digits.
    const double scale = unit_scale(input.mesh);
    const Eigen::RowVector3d centre = bounding_box(input.mesh).centre().transpose();
    const auto outside = [&](const Positions& X) -> Positions { return (X / scale).rowwise() + centre; };
    const TriangleMesh inside = moved_to(input.mesh, scale * (input.mesh.X.rowwise() - centre));
    const DenoisingInput scaled_input{inside, input.topology, input.largest_eigenvalue / (scale * scale)};
    DenoisingOptions scaled = options;
    if (!filters_normals(options.method) && options.method != DenoisingMethod::taubin) scaled.parameter *= scale * scale;
    if (options.after_step) scaled.after_step = [&](int step, const Positions& X) { return options.after_step(step, outside(X)); };
    DenoisingRun run = filters_normals(options.method)                      ? by_normals(scaled_input, scaled)
                       : options.method == DenoisingMethod::conformal_flow  ? conformalised(scaled_input, scaled, solver)
                       : options.method == DenoisingMethod::volume_rescaled ? rescaled(scaled_input, scaled, solver)
                                                                            : diffused(scaled_input, scaled, solver);
    run.X = run.steps > 0 ? outside(run.X) : input.mesh.X;
    return run;
}

}   // namespace meshfolio
