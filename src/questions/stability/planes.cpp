#include "base/parallel_tasks.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "questions/core/mesh_roles.h"
#include "questions/stability/study.h"

namespace meshfolio::stability {

namespace {

/// Returns a bundled noisy mesh without its noise; nothing for other meshes.
std::optional<TriangleMesh> clean_mesh(const LibraryMesh& source) {
    const auto role = std::ranges::find(mesh_role_list(), source.input.role, &MeshRole::role);
    if (!source.input.stand_in || role == mesh_role_list().end() || role->clean == nullptr) return {};
    std::optional<TriangleMesh> clean = role->clean();
    return clean->F == source.mesh().F ? clean : std::nullopt;
}

/// Measures the positions X of a run and writes the values into cell i of the map. @param first_normals  of the faces of the input
void measure(const SmoothingMaps& maps, const Positions& first_normals, const Positions& X, std::size_t i, SchemeMap& map) {
    const bool closed = maps.subject.preflight().encloses_volume();
    const auto size_of = [&](const TriangleMesh& mesh) { return closed ? signed_volume(mesh) : surface_area(mesh); };
    const TriangleMesh& input = maps.subject.mesh();
    const TriangleMesh mesh = moved_to(input, X);
    map.moved[i] = vertex_rms(input.X, X) / maps.subject.diagonal;
    if (maps.clean) map.error[i] = vertex_rms(maps.clean->X, X) / maps.subject.diagonal;
    map.size[i] = size_of(mesh) / size_of(input);

    constexpr double vanished = 1e-6;   // of the box diagonal: a smaller surface has no meaningful normals
    if (bounding_box(mesh).diagonal() < vanished * maps.subject.diagonal) return;
    const Positions normals = face_normals(mesh);
    map.inverted[i] = double((normals.cwiseProduct(first_normals).rowwise().sum().array() < 0).count()) / std::max(mesh.face_count(), 1);
}

/// Runs lambdas[step] by the scheme of the map and measures it at the iterations of the plane.
void run_step(const SmoothingMaps& maps, const Positions& first_normals, std::size_t step, SchemeMap& map, ImplicitSolver& solver) {
    SmoothingOptions options{.scheme = map.scheme, .lambda = maps.lambdas[step], .iterations = maps.iterations.back()};
    std::size_t row = 0;
    options.after_step = [&](int iteration, const Positions& X) {
        if (iteration != maps.iterations[row]) return true;
        measure(maps, first_normals, X, maps.index(step, row++), map);
        return true;
    };
    const Smoothed result = smooth(maps.subject.mesh(), options, solver);
    map.blow_up[step] = result.blow_up_iteration;
    if (!result.blew_up || row == 0 || maps.iterations[row - 1] != result.blow_up_iteration) return;
    // The iteration that blew up was finite and has been measured: it is beyond the plane all the same.
    for (PlaneValues* values : {&map.moved, &map.error, &map.size, &map.inverted})
        if (!values->empty()) (*values)[maps.index(step, row - 1)] = undefined;
}

SchemeMap scheme_map(const SmoothingMaps& maps, SmoothingScheme scheme) {
    SchemeMap map;
    map.scheme = scheme;
    const PlaneValues nothing(maps.lambdas.size() * maps.iterations.size(), undefined);
    map.moved = map.size = map.inverted = nothing;
    if (maps.clean) map.error = nothing;
    map.blow_up.assign(maps.lambdas.size(), 0);
    const Positions first_normals = face_normals(maps.subject.mesh());
    constexpr std::size_t lanes = 2;   // each with a solver and every other λ; the number must not depend on the processors
    std::array<ImplicitSolver, lanes> solvers;
    for_each_task(lanes, [&](std::size_t lane) {
        for (std::size_t step = lane; step < maps.lambdas.size(); step += lanes) run_step(maps, first_normals, step, map, solvers[lane]);
    });
    for (const ImplicitSolver& solver : solvers) map.factorisations += solver.work().factorisations;
    return map;
}

/// Returns the modes with their heights in the input. @param modes  M-normalised, a column each
GrowingModes growing_modes(const SmoothingSubject& subject, const Vector& eigenvalues, const DenseMatrix& modes) {
    const Vector& M = subject.laplacian.M;
    const Positions near = subject.mesh().X.rowwise() - subject.mesh().X.row(0);
    const Positions X = near.rowwise() - (near.transpose() * M / M.sum()).transpose();
    GrowingModes growing{eigenvalues, Vector(eigenvalues.size()), epsilon * subject.diagonal,
                         SmoothingOptions{}.blow_up_at * subject.diagonal};
    for (Eigen::Index i = 0; i < eigenvalues.size(); ++i) {
        const double coefficient = (X.transpose() * M.cwiseProduct(modes.col(i))).norm();
        growing.heights[i] = coefficient * modes.col(i).cwiseAbs().maxCoeff();
    }
    return growing;
}

std::vector<MapPlace> places_of(const SmoothingMaps& maps) {
    std::vector<MapPlace> places;
    const auto add = [&](const char* letter, SmoothingScheme scheme, std::size_t step, std::size_t row) {
        const SmoothingOptions options{.scheme = scheme, .lambda = maps.lambdas[step], .iterations = maps.iterations[row]};
        places.push_back({letter, scheme, step, row, smooth(maps.subject.mesh(), options).X});
    };
    const auto beyond = std::upper_bound(maps.lambdas.begin(), maps.lambdas.end(), maps.subject.critical);
    const auto step = static_cast<std::size_t>(beyond - maps.lambdas.begin());
    const std::size_t last = maps.iterations.size() - 1, largest = maps.lambdas.size() - 1;
    if (step > 0) add("a", SmoothingScheme::explicit_euler, step - 1, last);

    std::optional<std::size_t> in_view;   // the last row that shows the first unstable step within its frame
    for (std::size_t row = 0; step <= largest && row <= last; ++row) {
        const double moved = maps.explicit_map().moved[maps.index(step, row)];
        if (!(moved < 0.05) && row > 0) break;
        if (std::isfinite(moved)) in_view = row;
    }
    if (in_view) {
        add("b", SmoothingScheme::explicit_euler, step, *in_view);
        add("c", SmoothingScheme::implicit_euler, step, *in_view);
    }
    std::size_t left = last;   // the last row with a twentieth of the size, else the first
    while (left > 0 && !(maps.implicit_map().size[maps.index(largest, left)] > 0.05)) --left;
    add("d", SmoothingScheme::implicit_euler, largest, left);
    for (const SchemeMap& map : maps.schemes)
        if (const auto best = maps.best(map))
            add(&map == &maps.explicit_map() ? "e" : "f", map.scheme, maps.step_of(*best), maps.row_of(*best));
    return places;
}

}   // namespace

double GrowingModes::blow_up(double lambda, double least_height) const {
    double first = undefined;
    for (Eigen::Index i = 0; i < eigenvalues.size(); ++i) {
        const double growth = lambda * eigenvalues[i] - 1;
        if (!(growth > 1) || heights[i] < least_height) continue;
        const double t = std::max(std::log(distance / std::max(heights[i], rounding)) / std::log(growth), 0.0);
        if (!(first <= t)) first = t;
    }
    return first;
}

int GrowingModes::earliest(double lambda, int last) const {
    const Vector growth = (lambda * eigenvalues.array() - 1).abs();
    Vector heights_now = heights.cwiseMax(rounding);
    for (int t = 1; t <= last; ++t) {
        heights_now = heights_now.cwiseProduct(growth);
        if (heights_now.sum() >= 0.999 * distance) return t;   // the mean is up to half a diagonal from the centre
    }
    return 0;
}

std::optional<std::size_t> SmoothingMaps::best(const SchemeMap& map) const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < map.error.size(); ++i)
        if (std::isfinite(map.error[i]) && !(best && map.error[i] >= map.error[*best])) best = i;
    return best;
}

std::vector<int> spaced_iterations(int last, int per_decade) {
    std::vector<int> counts;
    for (int i = 0; counts.empty() || counts.back() < last; ++i) {
        const double count = std::pow(10, double(i) / per_decade);
        counts.push_back(count < last ? static_cast<int>(std::lround(count)) : last);
    }
    return each_once(counts);
}

SmoothingMaps smoothing_maps(SharedMesh source, const QuestionSettings& settings) {
    struct Grid {
        int steps_per_decade, steps_below, steps_beyond, counts_per_decade, iterations;
    };
    const Grid grid = settings.laboratory ? Grid{10, 12, 22, 8, 200} : settings.quick ? Grid{3, 4, 6, 4, 30} : Grid{5, 6, 10, 6, 100};
    std::vector<double> relative_steps;   // the limit lies between two of them
    for (int i = -grid.steps_below; i < grid.steps_beyond; ++i) relative_steps.push_back(std::pow(10, (i + 0.5) / grid.steps_per_decade));

    SmoothingMaps maps;
    maps.subject = smoothing_subject(std::move(source));
    maps.clean = clean_mesh(*maps.subject.source);
    if (maps.clean) maps.input_error = vertex_rms(maps.clean->X, maps.subject.mesh().X) / maps.subject.diagonal;
    maps.lambdas = steps_of(settings, maps.subject.critical, relative_steps);
    maps.iterations = spaced_iterations(std::max(last_or(settings.iterations, grid.iterations), 1), grid.counts_per_decade);
    run_tasks([&] { maps.schemes[0] = scheme_map(maps, SmoothingScheme::explicit_euler); },
              [&] { maps.schemes[1] = scheme_map(maps, SmoothingScheme::implicit_euler); });

    const LargestEigenvalue& top = maps.subject.top;
    maps.top = growing_modes(maps.subject, Vector::Constant(1, top.value), top.mode);
    if (maps.subject.preflight().vertices_in_use <= all_modes_at_most) {
        const Spectrum& all = all_modes(maps.subject);
        maps.all = growing_modes(maps.subject, all.eigenvalues, all.eigenvectors);
    }
    maps.places = places_of(maps);
    return maps;
}

std::shared_ptr<const Planes> plane_studies(const Studies& studies, const QuestionSettings& settings, const Progress& progress,
                                            report::Section& section) {
    LibraryMeshes meshes = each_of(studies, [](const StabilityStudy& study) { return study.source; });
    if (!settings.laboratory) meshes.resize(std::min<std::size_t>(meshes.size(), settings.quick ? 1 : 2));
    return std::make_shared<Planes>(studies_of(meshes, "planes of smoothing", settings, progress, section, smoothing_maps));
}

}   // namespace meshfolio::stability
