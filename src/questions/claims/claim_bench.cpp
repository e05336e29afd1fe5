#include "geometry/operators/uniform_laplacian.h"
#include "mesh/vertex_noise.h"
#include "questions/bench/curvature_subject.h"
#include "questions/bench/estimators.h"
#include "questions/bench/mesh_class.h"
#include "questions/claims/parts.h"

namespace meshfolio::claims {

namespace {

/// Vertices beyond which a claim would take longer than the section has.
int largest_mesh(const QuestionSettings& settings) { return settings.laboratory ? 200000 : settings.quick ? 7000 : 12000; }

bool same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
    const bool same_size = a.X.rows() == b.X.rows() && a.F.rows() == b.F.rows();
    return same_size && a.X == b.X && a.F == b.F;
}

bool has_negative_weights(const SparseMatrix& C) {
    for (int column = 0; column < C.outerSize(); ++column)
        for (SparseMatrix::InnerIterator entry(C, column); entry; ++entry)
            if (entry.row() != entry.col() && entry.value() < -1e-12 * std::abs(C.coeff(column, column))) return true;
    return false;
}

/// The key of the message that says that a mesh lacks this property.
std::string key_of_lacking(Property property) {
    static constexpr std::array keys{
        "flat", "not_flat", "closed", "flat_with_edges", "negative_weights", "unequal_areas", "clean_form_known", "above_1500_vertices"};
    return std::string("lacks.") + keys[int(property)];
}

/// What a run or a noisy run is made with.
SmoothingOptions options_of(const auto& key) {
    return {.scheme = key.scheme, .laplacian = key.laplacian, .lambda = key.lambda, .iterations = key.iterations};
}

/// What the map keeps under the key, made when it is first asked for.
template <class Map, class Make>
const auto& kept(Map& map, const typename Map::key_type& key, const Make& make) {
    const auto found = map.find(key);
    return found != map.end() ? found->second : map.emplace(key, make()).first->second;
}

}   // namespace

const ReportMesh& ClaimBench::mesh(std::string_view name) {
    const ReportMesh& found = kept(meshes_, std::string(name), [&] { return report_mesh(library_, name); });
    const int n = found.mesh->mesh().vertex_count();
    if (n > largest_mesh(settings_))
        throw MeshError(found.mesh->name + " has " + std::to_string(n) + " vertices, more than a run without laboratory = true measures");
    return found;
}

std::string ClaimBench::called(const MeshNames& names) {
    return listed(each_of(names, [&](std::string_view name) { return mesh(name).called(); }));
}

bool ClaimBench::is_itself(std::string_view name) {
    const ReportMesh& m = mesh(name);
    if (!m.entry) return m.original;
    const auto agrees = [](double measured, double expected) { return std::abs(measured / expected - 1) < 1e-4; };
    const Preflight& p = m.mesh->preflight();
    return p.vertices_in_use == m.entry->vertices && p.triangles == m.entry->triangles && agrees(p.mean_edge, m.entry->mean_edge) &&
           agrees(subject(name).critical, m.entry->critical);
}

bool ClaimBench::in_scope(std::string_view name, About::Scope scope) {
    if (scope == any_mesh || is_itself(name)) return true;
    return scope == its_kind && !mesh(name).own && !mesh(name).entry;   // a bundled mesh is of the kind that its role names
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
    return property == negative_weights ? has_negative_weights(C) : areas.minCoeff() < 0.99 * areas.maxCoeff();
}

Measurable ClaimBench::measurable(const About& about) {
    Measurable result;
    Names reasons;
    const auto refuse = [&](const std::string& reason) {
        if (std::ranges::find(reasons, reason) == reasons.end()) reasons.push_back(reason);
    };
    const auto counted_already = [&](std::string_view name) {
        return std::ranges::any_of(result.meshes,
                                   [&](std::string_view before) { return same_mesh(mesh(before).mesh->mesh(), mesh(name).mesh->mesh()); });
    };
    const auto enter = [&](std::string_view name) {
        const std::string& here = mesh(name).mesh->name;
        if (!in_scope(name, about.scope)) {
            return refuse(words.line(about.scope == About::Scope::itself ? "elsewhere.itself" : "elsewhere.kind",
                                     "asked"_a = mesh(name).asked, "here"_a = here));
        }
        const auto lacks = std::ranges::find_if(about.properties, [&](Property property) { return !has(name, property); });
        if (lacks != about.properties.end()) return refuse(words.line(key_of_lacking(*lacks), "mesh"_a = here));
        if (!counted_already(name)) result.meshes.push_back(name);
    };
    for (const std::string_view name : about.meshes) {
        try {
            enter(name);
        } catch (const MeshError& error) {   // too large, without an operator
            refuse(error.what());
        }
    }
    const std::size_t needed = about.meshes.empty() ? 0 : about.compared;
    if (result.meshes.size() >= needed) return result;
    if (needed > 1 && reasons.empty()) refuse(words.line("one_mesh"));
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
    return kept(subjects_, source.get(), [&] { return smoothing_subject(source); });
}

double ClaimBench::uniform_limit(std::string_view name) {
    const auto& source = mesh(name).mesh;
    return kept(uniform_limits_, source.get(),
                [&] { return largest_stable_step(largest_eigenvalue(uniform_operator(source->mesh(), source->topology()))); });
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
    return kept(runs_, {source.get(), key}, [&] { return smooth(source->mesh(), options_of(key), solvers_[source.get()]); });
}

double ClaimBench::motion(std::string_view name, const RunKey& key) { return vertex_rms(mesh(name).mesh->mesh().X, run(name, key).X); }

const std::vector<double>& ClaimBench::denoised(std::string_view name, const NoisyKey& key) {
    const LibraryMesh& source = *mesh(name).mesh;
    return kept(noisy_runs_, {&source, key.tied()}, [&] {
        const TriangleMesh& clean = source.mesh();
        const TriangleMesh noisy = moved_to(clean, with_gaussian_noise(clean.X, key.sigma, settings_.seed));
        std::vector<double> errors{vertex_rms(clean.X, noisy.X)};
        SmoothingOptions options = options_of(key);
        options.rebuild = key.rebuild;
        options.after_step = [&](int, const Positions& X) {
            errors.push_back(vertex_rms(clean.X, X));
            return true;
        };
        smooth_until_collapse(noisy, options, solvers_[&source]);
        return errors;
    });
}

const SpectralStudy& ClaimBench::spectrum(std::string_view name) {
    const auto& source = mesh(name).mesh;
    return kept(spectra_, source.get(), [&] {
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
    if (!plane_) plane_ = std::make_unique<PlaneTest>(irregular_plane(settings_.seed));
    return *plane_;
}

std::vector<report::Input> ClaimBench::inputs() const {
    std::vector<report::Input> inputs;
    for (const auto& [name, found] : meshes_)
        if (!found.own || inputs.empty()) inputs.push_back(found.input());
    return inputs;
}

Names ClaimBench::warnings() const {
    Names warnings;
    for (const auto& [name, found] : meshes_) {
        report::Section section;
        enter_input(*found.mesh, section);
        for (const std::string& warning : section.warnings)
            if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
    }
    return warnings;
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
