#include "geometry/smoothing/conformal_flow.h"

#include "geometry/denoising/component_size.h"
#include "geometry/operators/vertices_with_mass.h"

namespace meshfolio {

DenoisingRun conformalised(const DenoisingInput& input, const DenoisingOptions& options, ImplicitSolver& solver) {
    const ComponentSizes wanted = component_sizes(input.mesh, input.topology);
    LaplaceBeltrami laplacian = laplace_beltrami(input.mesh);
    TriangleMesh current = input.mesh;
    DenoisingRun run{input.mesh.X, 0, false};
    while (run.steps < options.steps) {
        if (run.steps > 0) laplacian.M = vertex_areas(current, AreaForm::barycentric);
        if (!(laplacian.M.sum() > 1e-24 * wanted.area.sum())) {
            run.ended = true;
            break;
        }
        solver.prepare(operator_with_mass(laplacian), options.parameter);
        current.X = solver.step(current.X);
        current.X = with_areas(current, input.topology, wanted);
        if (!current.X.allFinite()) {
            run.ended = true;
            break;
        }
        run.X = current.X;
        ++run.steps;
        if (options.after_step && !options.after_step(run.steps, run.X)) break;
    }
    return run;
}

}   // namespace meshfolio
