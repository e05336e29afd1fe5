#include "base/parallel_tasks.h"
#include "geometry/spectrum/laplace_spectrum.h"
#include "mesh/samples/sample_parts.h"
#include "mesh/samples/sample_shapes.h"
#include "questions/stability/parts.h"

namespace meshfolio::stability {

namespace {

constexpr double vanished = 1e-6;   // of the box diagonal: what is smaller has no normals that mean anything

/// Cells per factor of ten, and the decades on either side of the limit.
struct PlaneGrid {
    int steps_per_decade, steps_below, steps_beyond, counts_per_decade, iterations;
};
PlaneGrid grid_of(const QuestionSettings& settings) {
    if (settings.laboratory) return {10, 12, 22, 8, 200};
    if (settings.quick) return {3, 4, 6, 4, 30};
    return {5, 6, 10, 6, 100};
}

/// Spaces the steps so that the limit lies between two cells.
std::vector<double> relative_steps(const PlaneGrid& grid) {
    std::vector<double> steps;
    for (int i = -grid.steps_below; i < grid.steps_beyond; ++i) steps.push_back(std::pow(10, (i + 0.5) / grid.steps_per_decade));
    return steps;
}

/// The bundled noisy meshes before their noise.
std::optional<TriangleMesh> clean_mesh(const LibraryMesh& source) {
    if (!source.input.stand_in) return {};
    std::optional<TriangleMesh> clean;
    if (source.input.role == "plane_ns") clean = uneven_plane_sample(0);
    if (source.input.role == "fandisk_ns") clean = make_sample("fandisk_like");
    if (clean && clean->F != source.mesh().F) clean.reset();
    return clean;
}

struct Measured {
    double moved, error, size, angle, inverted;
};

class Ruler {
public:
    explicit Ruler(const SmoothingMaps& maps)
        : maps_(maps), mesh_(maps.subject.mesh()), normals_(face_normals(mesh_)), size_(size_of(mesh_)) {}

    Measured operator()(const Positions& X) const {
        Measured m{vertex_rms(mesh_.X, X) / maps_.subject.diagonal, undefined, undefined, undefined, undefined};
        if (maps_.clean) m.error = vertex_rms(maps_.clean->X, X) / maps_.subject.diagonal;
        const TriangleMesh mesh = moved_to(mesh_, X);
        m.size = size_of(mesh) / size_;
        if (bounding_box(mesh).diagonal() < vanished * maps_.subject.diagonal) return m;
        m.angle = smallest_angle(mesh);
        const Positions now = face_normals(mesh);
        m.inverted = double((now.cwiseProduct(normals_).rowwise().sum().array() < 0).count()) / std::max(mesh.face_count(), 1);
        return m;
    }

private:
    double size_of(const TriangleMesh& mesh) const { return maps_.closed ? signed_volume(mesh) : surface_area(mesh); }

    const SmoothingMaps& maps_;
    const TriangleMesh& mesh_;
    Positions normals_;
    double size_;
};

/// Makes one run and measures it at the iterations of the plane.
void run_step(const SmoothingMaps& maps, const Ruler& ruler, std::size_t step, SchemeMap& map, ImplicitSolver& solver) {
    SmoothingOptions options{.scheme = map.scheme, .lambda = maps.lambdas[step], .iterations = maps.iterations.back()};
    std::size_t row = 0;
    const bool compared = !map.apart.empty() && maps.relative(step) < 0.5;
    Positions beside = compared ? maps.subject.mesh().X : Positions();   // after as many explicit steps
    options.after_step = [&](int iteration, const Positions& X) {
        if (compared) beside = explicit_step(maps.subject.laplacian, options.lambda, beside);
        if (iteration != maps.iterations[row]) return true;
        const Measured m = ruler(X);
        const std::size_t i = maps.index(step, row);
        map.moved[i] = m.moved;
        if (!map.error.empty()) map.error[i] = m.error;
        map.size[i] = m.size;
        map.angle[i] = m.angle;
        map.inverted[i] = m.inverted;
        if (compared) map.apart[i] = vertex_rms(beside, X) / maps.subject.diagonal / m.moved;
        ++row;
        return true;
    };
    const Smoothed result = smooth(maps.subject.mesh(), options, solver);
    map.blow_up[step] = result.blow_up_iteration;
    if (!result.blew_up || row == 0 || maps.iterations[row - 1] != result.blow_up_iteration) return;
    // The iteration that blew up was finite and has been measured: it is beyond the plane all the same.
    for (PlaneValues* values : {&map.moved, &map.error, &map.size, &map.angle, &map.inverted})
        if (!values->empty()) (*values)[maps.index(step, row - 1)] = undefined;
}

SchemeMap scheme_map(const SmoothingMaps& maps, SmoothingScheme scheme) {
    SchemeMap map;
    map.scheme = scheme;
    const PlaneValues nothing(maps.lambdas.size() * maps.iterations.size(), undefined);
    map.moved = map.size = map.angle = map.inverted = nothing;
    if (maps.clean) map.error = nothing;
    if (scheme == SmoothingScheme::implicit_euler) map.apart = nothing;
    map.blow_up.assign(maps.lambdas.size(), 0);
    const Ruler ruler(maps);
    // Every other λ with a solver of its own: how many there are must not depend on the processors.
    constexpr std::size_t lanes = 2;
    std::array<ImplicitSolver, lanes> solvers;
    for_each_task(lanes, [&](std::size_t lane) {
        for (std::size_t step = lane; step < maps.lambdas.size(); step += lanes) run_step(maps, ruler, step, map, solvers[lane]);
    });
    for (const ImplicitSolver& solver : solvers) {
        map.analyses += solver.work().analyses;
        map.factorisations += solver.work().factorisations;
    }
    return map;
}

/// @param modes  M-normalised, a column each
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

/// The iteration at which one of the modes higher than `least` gets to the blow-up distance; NaN where none grows.
double first_alone(const GrowingModes& modes, double lambda, double least) {
    double first = undefined;
    for (Eigen::Index i = 0; i < modes.eigenvalues.size(); ++i) {
        const double growth = lambda * modes.eigenvalues[i] - 1;
        if (!(growth > 1) || modes.heights[i] < least) continue;
        const double height = std::max(modes.heights[i], modes.rounding);
        const double t = std::max(std::log(modes.distance / height) / std::log(growth), 0.0);
        if (!(first <= t)) first = t;
    }
    return first;
}

/// The last row that shows the surface within its frame.
std::optional<std::size_t> last_in_view(const SmoothingMaps& maps, const SchemeMap& map, std::size_t step) {
    std::optional<std::size_t> last;
    for (std::size_t row = 0; row < maps.iterations.size(); ++row) {
        const double moved = map.moved[maps.index(step, row)];
        if (!(moved < 0.05) && row > 0) break;
        if (std::isfinite(moved)) last = row;
    }
    return last;
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
    const auto seen = step < maps.lambdas.size() ? last_in_view(maps, maps.explicit_map, step) : std::nullopt;
    if (seen) {
        add("b", SmoothingScheme::explicit_euler, step, *seen);
        add("c", SmoothingScheme::implicit_euler, step, *seen);
    }
    std::size_t left = last;   // while a twentieth is left to be seen
    while (left > 0 && !(maps.implicit_map.size[maps.index(largest, left)] > 0.05)) --left;
    add("d", SmoothingScheme::implicit_euler, largest, left);
    if (const auto best = maps.best(maps.explicit_map)) add("e", SmoothingScheme::explicit_euler, maps.step_of(*best), maps.row_of(*best));
    if (const auto best = maps.best(maps.implicit_map)) add("f", SmoothingScheme::implicit_euler, maps.step_of(*best), maps.row_of(*best));
    return places;
}

}   // namespace

double GrowingModes::blow_up(double lambda) const { return first_alone(*this, lambda, 0); }

double GrowingModes::latest(double lambda) const { return first_alone(*this, lambda, 1e4 * rounding); }

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

EqualTime largest_difference_at_equal_time(const SmoothingMaps& maps, const SchemeMap& map) {
    EqualTime largest;
    for (std::size_t many = 0; many < map.moved.size(); ++many) {
        for (std::size_t few = 0; few < many; ++few) {
            if (maps.iterations[maps.row_of(many)] != 10 * maps.iterations[maps.row_of(few)]) continue;
            const double large = maps.lambdas[maps.step_of(few)], small = maps.lambdas[maps.step_of(many)];
            if (std::abs(large / small / 10 - 1) > 1e-9) continue;
            const double difference = map.moved[many] / map.moved[few] - 1;
            const bool counts = large < maps.subject.critical || &map == &maps.implicit_map;
            if (counts && std::abs(difference) > std::abs(largest.difference)) largest = {many, few, difference};
        }
    }
    return largest;
}

SmoothingMaps smoothing_maps(SharedMesh source, const QuestionSettings& settings) {
    const PlaneGrid grid = grid_of(settings);
    SmoothingMaps maps;
    maps.subject = smoothing_subject(std::move(source));
    maps.closed = maps.subject.preflight().encloses_volume();
    maps.clean = clean_mesh(*maps.subject.source);
    if (maps.clean) maps.input_error = vertex_rms(maps.clean->X, maps.subject.mesh().X) / maps.subject.diagonal;
    maps.lambdas = steps_of(settings, maps.subject.critical, relative_steps(grid));
    maps.iterations = spaced_iterations(std::max(last_or(settings.iterations, grid.iterations), 1), grid.counts_per_decade);
    run_tasks([&] { maps.explicit_map = scheme_map(maps, SmoothingScheme::explicit_euler); },
              [&] { maps.implicit_map = scheme_map(maps, SmoothingScheme::implicit_euler); });

    const LargestEigenvalue& top = maps.subject.top;
    maps.top = growing_modes(maps.subject, Vector::Constant(1, top.value), top.mode);
    if (maps.subject.preflight().vertices_in_use <= all_modes_at_most) {
        const Spectrum& all = all_modes(maps.subject);
        maps.all = growing_modes(maps.subject, all.eigenvalues, all.eigenvectors);
    }
    maps.places = places_of(maps);
    return maps;
}

}   // namespace meshfolio::stability
