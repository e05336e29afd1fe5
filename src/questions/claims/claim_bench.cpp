#include "geometry/operators/uniform_laplacian.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/curvature_subject.h"
#include "questions/bench/estimators.h"
#include "questions/bench/mesh_class.h"
#include "questions/claims/parts.h"
#include "questions/core/experiment.h"

namespace meshfolio::claims {

namespace {

/// For each Property, the key of the message "lacks.<key>" that it is missing.
constexpr std::array missing{
    "flat", "not_flat", "closed", "flat_with_edges", "negative_weights", "unequal_areas", "clean_form_known", "above_1500_vertices"};

SmoothingOptions options_of(const RunKey& key) {
    return {.scheme = key.scheme, .laplacian = key.laplacian, .lambda = key.lambda, .iterations = key.iterations, .rebuild = key.rebuild};
}

/// The value of the map for the key; calls `make` if there is none yet.
template <class Map, class Make> const auto& cached(Map& map, const typename Map::key_type& key, const Make& make) {
    const auto found = map.find(key);
    return found != map.end() ? found->second : map.emplace(key, make()).first->second;
}

void add_once(Names& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

}   // namespace

const ReportMesh& ClaimBench::mesh(std::string_view name) {
    const ReportMesh& found = cached(meshes_, std::string(name), [&] { return report_mesh(library_, name); });
    const int n = found.mesh->mesh().vertex_count(), most = settings_.laboratory ? 200000 : settings_.quick ? 7000 : 12000;
    if (n > most)
        throw MeshError(found.mesh->name + " has " + std::to_string(n) + " vertices, but this run measures up to " + std::to_string(most),
                        settings_.laboratory ? "take a smaller mesh" : "take a smaller mesh, or set laboratory = true");
    return found;
}

bool ClaimBench::is_itself(std::string_view name) {
    const ReportMesh& m = mesh(name);
    if (!m.entry) return m.original;
    const auto agrees = [](double measured, double expected) { return std::abs(measured / expected - 1) < 1e-4; };
    const Preflight& p = m.mesh->preflight();
    return p.vertices_in_use == m.entry->vertices && p.triangles == m.entry->triangles && agrees(p.mean_edge, m.entry->mean_edge) &&
           agrees(subject(name).critical, m.entry->critical);
}

bool ClaimBench::has(std::string_view name, Property property) {
    const PreparedMesh& prepared = *mesh(name).mesh->prepared;
    if (property == flat || property == not_flat) return common_plane_normal(prepared.mesh).has_value() == (property == flat);
    if (property == closed) return prepared.preflight.closed();
    if (property == clean_known) return clean_form(name).has_value();
    if (property == above_1500_vertices) return prepared.preflight.vertices_in_use > 1500;
    if (property == flat_with_edges) {
        const MeshCharacter character = mesh_character(prepared.mesh, prepared.topology);
        return character.kind() == MeshClass::sharp_edged && character.typical_angle < 2;
    }
    const auto& [C, areas, copies] = subject(name).laplacian;
    if (property == unequal_areas) return areas.minCoeff() < 0.99 * areas.maxCoeff();
    for (int column = 0; column < C.outerSize(); ++column)
        for (SparseMatrix::InnerIterator entry(C, column); entry; ++entry)
            if (entry.row() != entry.col() && entry.value() < -1e-12 * std::abs(C.coeff(column, column))) return true;
    return false;
}

Measurable ClaimBench::measurable(const About& about) {
    const auto reason_against = [&](std::string_view name) -> std::string {   // empty: the mesh may be measured
        const ReportMesh& here = mesh(name);
        const bool of_its_kind = about.scope == its_kind && !here.own && !here.entry;   // a bundled mesh, by its role
        if (about.scope != any_mesh && !of_its_kind && !is_itself(name))
            return words.line(about.scope == itself ? "elsewhere.itself" : "elsewhere.kind", "asked"_a = here.asked,
                              "here"_a = here.mesh->name);
        for (const Property property : about.properties)
            if (!has(name, property)) return words.line("lacks." + std::string(missing[int(property)]), "mesh"_a = here.mesh->name);
        return "";
    };
    Measurable result;
    Names reasons;
    for (const std::string_view name : about.meshes) {
        std::string reason;
        try {
            reason = reason_against(name);
        } catch (const MeshError& error) {   // too large, without an operator
            reason = error.what();
        }
        if (!reason.empty()) {
            add_once(reasons, reason);
            continue;
        }
        const TriangleMesh& here = mesh(name).mesh->mesh();
        const bool counted = std::ranges::any_of(result.meshes, [&](std::string_view before) {
            const TriangleMesh& other = mesh(before).mesh->mesh();
            return other.X.rows() == here.X.rows() && other.F.rows() == here.F.rows() && other.X == here.X && other.F == here.F;
        });
        if (!counted) result.meshes.push_back(name);
    }
    const std::size_t needed = about.meshes.empty() ? 0 : about.compared;
    if (result.meshes.size() >= needed) return result;
    if (needed > 1 && reasons.empty()) reasons.push_back(words.line("one_mesh"));
    result.why_not = listed(reasons);
    return result;
}

std::optional<Positions> ClaimBench::clean_form(std::string_view noisy) {
    const LibraryMesh& source = *mesh(noisy).mesh;
    if (mesh(noisy).own) return {};
    if (source.input.file == "plane_noisy.obj") {
        Positions X = source.mesh().X;   // flat; along the plane nothing is known, so that motion within it is no error
        X.col(2).setZero();
        return X;
    }
    if (source.input.file != "fandisk_noisy.obj") return {};
    return mesh("fandisk").mesh->mesh().X;
}

const SmoothingSubject& ClaimBench::subject(std::string_view name) {
    const auto& source = mesh(name).mesh;
    return cached(subjects_, source.get(), [&] { return smoothing_subject(source); });
}

double ClaimBench::uniform_limit(std::string_view name) {
    const LibraryMesh& source = *mesh(name).mesh;
    return largest_stable_step(largest_eigenvalue(uniform_operator(source.mesh(), source.topology())));
}

double ClaimBench::raw_step(std::string_view name, double lambda) {
    return is_itself(name) ? lambda : lambda / mesh(name).entry->critical * subject(name).critical;
}

double ClaimBench::raw_length(std::string_view name, double length, int power) {
    const ReportMesh& m = mesh(name);
    return is_itself(name) ? length : length * std::pow(m.mesh->preflight().mean_edge / m.entry->mean_edge, power);
}

const Smoothed& ClaimBench::run(std::string_view name, const RunKey& key) {
    const auto& source = mesh(name).mesh;
    return cached(runs_, {source.get(), key}, [&] { return smooth(source->mesh(), options_of(key), solvers_[source.get()]); });
}

double ClaimBench::motion(std::string_view name, const RunKey& key) { return vertex_rms(mesh(name).mesh->mesh().X, run(name, key).X); }

const std::vector<double>& ClaimBench::denoised(std::string_view name, const RunKey& key) {
    const LibraryMesh& source = *mesh(name).mesh;
    return cached(noisy_runs_, {&source, key}, [&] {
        const Positions& clean = source.mesh().X;
        const Positions noisy = with_gaussian_noise(clean, Vector3(key.sigma.data()), settings_.seed);
        std::vector<double> errors{vertex_rms(clean, noisy)};
        SmoothingOptions options = options_of(key);
        options.after_step = [&](int, const Positions& X) {
            errors.push_back(vertex_rms(clean, X));
            return true;
        };
        smooth_until_collapse(moved_to(source.mesh(), noisy), options, solvers_[&source]);
        return errors;
    });
}

Sweep ClaimBench::sweep(std::string_view noisy, RunKey key, std::vector<double> lambdas) {
    const Positions clean = clean_form(noisy).value();
    const auto error_of = [&](const Positions& X) {
        return noisy == "plane_ns" ? std::sqrt((X.col(2) - clean.col(2)).squaredNorm() / double(X.rows())) : vertex_rms(X, clean);
    };
    Sweep sweep{std::move(lambdas), {}, error_of(mesh(noisy).mesh->mesh().X)};
    for (const double lambda : sweep.steps) {
        key.lambda = lambda;
        sweep.errors.push_back(error_of(run(noisy, key).X));
    }
    return sweep;
}

const SpectralStudy& ClaimBench::spectrum(std::string_view name) {
    const auto& source = mesh(name).mesh;
    return cached(spectra_, source.get(), [&] {
        QuestionSettings settings = settings_;
        settings.k = {5, 10, 15, 30, 60, 150};
        return spectral_study(source, settings);
    });
}

BenchRun ClaimBench::curvature(const std::string& surface, MeshKind kind, int coarse, int fine) const {
    std::vector<int> levels;
    for (int level = coarse; level <= fine; ++level) levels.push_back(level);
    return bench_runs(library_, {known_surface(surface)}, std::array{kind}, levels, settings_.seed, [](std::string_view) {}).front();
}

const PlaneTest& ClaimBench::plane() {
    if (!plane_) plane_ = irregular_plane(settings_.seed);
    return *plane_;
}

void ClaimBench::enter_inputs(report::Section& section) const {
    for (const auto& [name, found] : meshes_) {
        if (!found.own || section.inputs.empty()) section.inputs.push_back(found.input());
        report::Section of_mesh;
        enter_input(*found.mesh, of_mesh);
        for (const std::string& warning : of_mesh.warnings) add_once(section.warnings, warning);
    }
}

double roughness(const SmoothingSubject& subject, const Positions& X) {
    const Positions near = X.rowwise() - X.row(0);   // rows of C sum to 0: the origin may be chosen where nothing is rounded away
    const Positions CX = subject.laplacian.C * near;
    const Vector M = summed_at_first(subject.laplacian.copies, subject.laplacian.M);
    double sum = 0;
    for (Eigen::Index i = 0; i < X.rows(); ++i)
        if (M[i] > 0) sum += CX.row(i).squaredNorm() / M[i];
    return std::sqrt(sum);
}

double implicit_operations(const Smoothed& run, int steps) {
    const auto entries = static_cast<double>(run.factor_nonzeros);
    return 6 * entries * steps + entries * entries / static_cast<double>(run.X.rows());
}

double explicit_operations(const SmoothingSubject& subject, int steps) {
    return 3.0 * static_cast<double>(subject.laplacian.C.nonZeros()) * steps;
}

int best_of(const std::vector<double>& errors) { return static_cast<int>(std::ranges::min_element(errors) - errors.begin()); }

}   // namespace meshfolio::claims
