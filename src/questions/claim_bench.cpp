#include "questions/claim_bench.h"

#include <algorithm>
#include <cmath>

#include "errors.h"
#include "geometry/uniform_laplacian.h"
#include "mesh/triangle_measures.h"
#include "mesh/vertex_noise.h"
#include "questions/section_tools.h"

namespace meshfolio {

namespace {

/// Vertices beyond which a claim would take longer than the section has.
int largest_mesh(const QuestionSettings& settings) { return settings.laboratory ? 200000 : settings.quick ? 7000 : 12000; }

}   // namespace

const ReportMesh& ClaimBench::mesh(std::string_view name) {
    auto it = meshes_.find(name);
    if (it == meshes_.end()) it = meshes_.emplace(std::string(name), report_mesh(library_, name)).first;
    const int n = it->second.mesh->mesh().vertex_count();
    if (n > largest_mesh(settings_)) {
        throw MeshError(it->second.mesh->name + " has " + std::to_string(n) +
                        " vertices, more than a run without laboratory = true measures");
    }
    return it->second;
}

std::string ClaimBench::called(std::initializer_list<std::string_view> names) {
    std::vector<std::string> words;
    for (const std::string_view name : names) words.push_back(mesh(name).called());
    return listed(words);
}

bool ClaimBench::has_limit_of_original(std::string_view name) {
    const ReportMesh& m = mesh(name);
    return m.original || std::abs(subject(name).critical / m.entry->critical - 1) < 1e-3;
}

const SmoothingSubject& ClaimBench::subject(std::string_view name) {
    const auto& source = mesh(name).mesh;
    auto it = subjects_.find(source.get());
    if (it == subjects_.end()) it = subjects_.emplace(source.get(), smoothing_subject(source)).first;
    return it->second;
}

double ClaimBench::uniform_limit(std::string_view name) {
    const auto& source = mesh(name).mesh;
    auto it = uniform_limits_.find(source.get());
    if (it == uniform_limits_.end()) {
        const double limit = largest_stable_step(largest_eigenvalue(uniform_operator(source->prepared->topology)));
        it = uniform_limits_.emplace(source.get(), limit).first;
    }
    return it->second;
}

double ClaimBench::raw_step(std::string_view name, double lambda) {
    const ReportMesh& m = mesh(name);
    return m.original ? lambda : lambda / m.entry->critical * subject(name).critical;
}

double ClaimBench::raw_length(std::string_view name, double length, int power) {
    const ReportMesh& m = mesh(name);
    return m.original ? length : length * std::pow(m.mesh->prepared->preflight.mean_edge / m.entry->mean_edge, power);
}

const Smoothed& ClaimBench::run(std::string_view name, const RunKey& key) {
    const auto& source = mesh(name).mesh;
    const std::pair<const LibraryMesh*, RunKey> whole{source.get(), key};
    if (const auto it = runs_.find(whole); it != runs_.end()) return it->second;
    SmoothingOptions options;
    options.scheme = key.scheme;
    options.laplacian = key.laplacian;
    options.lambda = key.lambda;
    options.iterations = key.iterations;
    return runs_.emplace(whole, smooth(source->mesh(), options, solvers_[source.get()])).first->second;
}

double ClaimBench::motion(std::string_view name, const RunKey& key) { return vertex_rms(mesh(name).mesh->mesh().X, run(name, key).X); }

const std::vector<double>& ClaimBench::denoised(std::string_view name, const NoisyKey& key) {
    const auto& source = mesh(name).mesh;
    const auto it = noisy_runs_.find({source.get(), key.tied()});
    return it != noisy_runs_.end() ? it->second : noisy_runs_[{source.get(), key.tied()}] = errors_along(source, key);
}

std::vector<double> ClaimBench::errors_along(const std::shared_ptr<const LibraryMesh>& source, const NoisyKey& key) {
    const TriangleMesh& clean = source->mesh();
    const TriangleMesh noisy = moved_to(clean, with_gaussian_noise(clean.X, key.sigma, settings_.seed));
    std::vector<double> errors{vertex_rms(clean.X, noisy.X)};
    SmoothingOptions options;
    options.scheme = key.scheme;
    options.laplacian = key.laplacian;
    options.lambda = key.lambda;
    options.iterations = key.iterations;
    options.rebuild = key.rebuild;
    options.after_step = [&](int, const Positions& X) {
        errors.push_back(vertex_rms(clean.X, X));
        return true;
    };
    smooth(noisy, options, solvers_[source.get()]);
    return errors;
}

const DenoisingStudy& ClaimBench::denoising(std::string_view name, const std::vector<double>& noise, int iterations) {
    const auto& source = mesh(name).mesh;
    const std::tuple key{source.get(), noise, iterations};
    if (const auto it = denoising_.find(key); it != denoising_.end()) return it->second;
    QuestionSettings settings = settings_;
    settings.noise = noise;
    settings.iterations = {iterations};
    settings.lambda.clear();
    return denoising_.emplace(key, denoising_study(source, settings)).first->second;
}

const SpectralStudy& ClaimBench::spectrum(std::string_view name) {
    const auto& source = mesh(name).mesh;
    auto it = spectra_.find(source.get());
    if (it == spectra_.end()) {
        QuestionSettings settings = settings_;
        settings.k = {5, 10, 15, 30, 60, 150};
        it = spectra_.emplace(source.get(), spectral_study(source, settings)).first;
    }
    return it->second;
}

const PanelLevel& ClaimBench::panel(const std::string& surface, MeshKind kind, int level) {
    const std::tuple key{surface, kind, level};
    if (const auto it = panels_.find(key); it != panels_.end()) return it->second;
    const std::vector<TruthSurface> surfaces = truth_surfaces();
    const auto s = std::find_if(surfaces.begin(), surfaces.end(), [&](const TruthSurface& t) { return t.surface.name == surface; });
    return panels_.emplace(key, panel_level(truth_mesh(*s, kind, level, settings_.seed))).first->second;
}

const PlaneTest& ClaimBench::plane() {
    if (!plane_) plane_ = std::make_unique<PlaneTest>(irregular_plane(settings_.seed));
    return *plane_;
}

std::vector<report::Input> ClaimBench::inputs() const {
    std::vector<report::Input> inputs;
    for (const auto& [name, found] : meshes_) {
        if (!found.own || inputs.empty()) inputs.push_back(found.input());
    }
    return inputs;
}

std::vector<std::string> ClaimBench::warnings() const {
    std::vector<std::string> warnings;
    for (const auto& [name, found] : meshes_) {
        report::Section section;
        enter_input(*found.mesh, section);
        for (std::string& warning : section.warnings) {
            if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(std::move(warning));
        }
    }
    return warnings;
}

double roughness(const SmoothingSubject& subject, const Positions& X) {
    const Positions near = X.rowwise() - X.row(0);   // rows of C sum to 0: the origin may be chosen where nothing is rounded away
    const Positions CX = subject.laplacian.C * near;
    double sum = 0;
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
        if (subject.laplacian.M[i] > 0) sum += CX.row(i).squaredNorm() / subject.laplacian.M[i];
    }
    return std::sqrt(sum);
}

int best_of(const std::vector<double>& errors) { return static_cast<int>(std::min_element(errors.begin(), errors.end()) - errors.begin()); }

}   // namespace meshfolio
