#include "questions/methods/study.h"
#include "base/parallel_tasks.h"
#include "geometry/denoising/component_size.h"
#include "geometry/spectrum/stability.h"
#include "mesh/decimation.h"
#include "mesh/samples/sample_shapes.h"

namespace meshfolio::methods {

namespace {

constexpr double s1_share = 0.2;   // of every extent of the box: "noise level 20" of an earlier report

/// Lists the noise to try, kind by kind.
std::vector<NoiseTrial> levels_of(const DenoisingSubject& subject, const QuestionSettings& settings) {
    std::vector<double> gaussian{0.03, 0.1, 0.3, 1}, others{0.3};
    if (settings.quick) gaussian = {0.1, 0.3}, others = {};
    if (settings.laboratory) gaussian = {0.01, 0.03, 0.1, 0.4, 0.8, 1.6, 3.2}, others = {0.1, 0.4, 1.6};
    if (!settings.noise.empty()) {
        gaussian.clear();
        for (const double share : each_once(settings.noise))
            if (share > 0) gaussian.push_back(share * subject.diagonal / subject.mean_edge);
        if (gaussian.empty()) gaussian = {0.1};   // no noise, nothing to mend
    }
    const double s1_edges = s1_share * subject.diagonal / (std::sqrt(3) * subject.mean_edge);
    std::vector<NoiseTrial> trials;
    const auto add = [&](NoiseKind kind, double edges, bool is_s1) {
        trials.push_back({.kind = kind, .edges = edges, .sigma = edges * subject.mean_edge, .s1_level = is_s1});
    };
    for (const NoiseEntry& entry : noise_list()) {
        const bool is_box = entry.kind == NoiseKind::box;
        // Noise scaled by the box is Gaussian if the box is a cube, so short reports have the one level that an earlier report used.
        if (!is_box || settings.laboratory)
            for (const double edges : entry.kind == NoiseKind::gaussian ? gaussian : others) add(entry.kind, edges, false);
        if (is_box && !settings.quick && settings.noise.empty()) add(entry.kind, s1_edges, true);
    }
    return trials;
}

/// Computes μ_max of the cotangent operator; falls back on Gershgorin's bound, which is never too small. [1/length²]
double largest_eigenvalue_of(const TriangleMesh& mesh) {
    const LaplaceBeltrami laplacian = laplace_beltrami(mesh);
    try {
        return largest_eigenvalue(laplacian).value;
    } catch (const SolverError&) {
        const OperatorWithMass whole = operator_with_mass(laplacian);
        return gershgorin_bound(whole.A, whole.M);
    }
}

/// Returns the index of the largest finite value; −1 without any.
int index_of_largest(const std::vector<double>& values) {
    int best = -1;
    for (int i = 0; i < std::ssize(values); ++i)
        if (std::isfinite(values[i]) && (best < 0 || values[i] > values[best])) best = i;
    return best;
}

/// Computes the geometric mean gain of each method over these trials.
std::vector<double> mean_gains(const std::vector<const NoiseTrial*>& trials, Gain gain) {
    std::vector<double> means;
    for (std::size_t method = 0; method < denoising_list().size(); ++method) {
        double sum = 0;
        int count = 0;
        for (const NoiseTrial* trial : trials) {
            // A trial without any gain is skipped. If this method alone has none, its mean is NaN.
            const double value = (trial->results[method].*gain)();
            if (std::isnan(value) && std::isnan((trial->results.front().*gain)())) continue;
            sum += std::log(value);
            ++count;
        }
        means.push_back(count > 0 ? std::exp(sum / count) : std::nan(""));
    }
    return means;
}

}   // namespace

std::string DenoisingSubject::class_title() const {
    return std::string(title_of(character.kind())) + (character.open ? ", open" : ", closed");
}

DenoisingSubject denoising_subject(std::string name, const TriangleMesh& mesh, int most_vertices) {
    DenoisingSubject subject;
    subject.name = std::move(name);
    subject.whole_vertices = mesh.vertex_count();
    subject.mesh = mesh;
    if (mesh.vertex_count() > most_vertices) {
        const MeshTopology whole = topology_of(mesh);
        subject.mesh = surface_patch(mesh, whole, sharpest_vertex(mesh, whole), most_vertices).mesh;
    }
    subject.topology = topology_of(subject.mesh);
    subject.character = mesh_character(subject.mesh, subject.topology);
    subject.mean_edge = mean_edge_length(subject.mesh, subject.topology.edges);
    subject.diagonal = bounding_box(subject.mesh).diagonal();
    subject.largest_eigenvalue = largest_eigenvalue_of(subject.mesh);
    subject.has_volume_to_keep = has_volume_to_keep(subject.mesh, subject.topology);
    return subject;
}

std::string NoiseTrial::title() const {
    return s1_level ? words.line("noise.box_level")
                    : words.line("noise.level", "noise"_a = noise_entry(kind).title, "edges"_a = readable(edges, 2));
}

std::string NoiseTrial::id() const {
    if (s1_level) return "box_level20";
    std::string digits = std::to_string(std::llround(1e3 * edges));
    return std::string(noise_entry(kind).name) + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

const SearchResult* winner(const NoiseTrial& trial, Gain gain) {
    const SearchResult* best = nullptr;
    for (const SearchResult& result : trial.results)
        if ((result.*gain)() > (best == nullptr ? 1 : (best->*gain)())) best = &result;
    return best;
}

std::vector<const NoiseTrial*> DenoisingTrials::of_kind(NoiseKind kind) const {
    std::vector<const NoiseTrial*> chosen;
    for (const NoiseTrial& trial : trials)
        if (trial.kind == kind && !trial.s1_level) chosen.push_back(&trial);
    return chosen;
}

SearchBudget search_budget(const QuestionSettings& settings) {
    return settings.quick ? SearchBudget{3, 4} : settings.laboratory ? SearchBudget{6, 6} : SearchBudget{4, 5};
}

DenoisingTrials denoising_trials(DenoisingSubject subject, const QuestionSettings& settings) {
    DenoisingTrials mesh;
    mesh.subject = std::move(subject);
    mesh.trials = levels_of(mesh.subject, settings);
    mesh.pictured = static_cast<int>(mesh.of_kind(NoiseKind::gaussian).size() / 2);
    const TriangleMesh& clean = mesh.subject.mesh;
    const Positions normals = face_normals(clean);
    const std::size_t methods = denoising_list().size();
    // Every task writes to a place of its own, so their order does not matter.
    for_each_task(mesh.trials.size(), [&](std::size_t i) {
        NoiseTrial& trial = mesh.trials[i];
        trial.noisy = with_noise(clean, trial.kind, trial.sigma, settings.seed);
        const TriangleMesh noisy = moved_to(clean, trial.noisy);
        trial.damage = compare_meshes(clean, noisy);
        trial.mean_edge = mean_edge_length(noisy, mesh.subject.topology.edges);
        trial.largest_eigenvalue = largest_eigenvalue_of(noisy);
        trial.results.resize(methods);
    });
    for_each_task(mesh.trials.size() * methods, [&](std::size_t i) {
        NoiseTrial& trial = mesh.trials[i / methods];
        const TriangleMesh noisy = moved_to(clean, trial.noisy);
        const SearchInput input{clean, normals, {noisy, mesh.subject.topology, trial.largest_eigenvalue}, trial.mean_edge};
        trial.results[i % methods] = search(input, denoising_list()[i % methods].method, search_budget(settings));
    });
    return mesh;
}

std::shared_ptr<const DenoisingLaboratory> denoising_laboratory(const MeshLibrary& library, const QuestionSettings& settings,
                                                                const Progress& progress, report::Section& section) {
    std::initializer_list<std::string_view> quick{"cube"}, usual{"cube", "armadillo"},
        all{"cube", "plane", "fandisk_ns", "lilium", "armadillo"};
    const LibraryMeshes meshes = meshes_for(library, settings, settings.quick ? quick : settings.laboratory ? all : usual, section);
    const bool own_choice = settings.meshes.empty() && !library.has_own_meshes();
    // The most vertices of a mesh that is not cut: fewer if there are more meshes than usual.
    const std::size_t count = meshes.size() + (own_choice ? 1 : 0), whole = settings.quick ? 250 : 700,
                      most_meshes = settings.laboratory ? 6 : 3;
    const int most = static_cast<int>(count <= most_meshes ? whole : std::max<std::size_t>(100, whole * most_meshes / count));
    const auto trials_on = [most](const SharedMesh& mesh, const QuestionSettings& all_settings) {
        return denoising_trials(denoising_subject(mesh->name, mesh->mesh(), most), all_settings);
    };
    DenoisingLaboratory laboratory{search_budget(settings),
                                   studies_of(meshes, "denoising by every method", settings, progress, section, trials_on)};
    if (own_choice && !settings.quick)
        laboratory.meshes.push_back(denoising_trials(denoising_subject("egg", ellipsoid_mesh(3, {1, 0.8, 0.65}), most), settings));
    return std::make_shared<DenoisingLaboratory>(std::move(laboratory));
}

std::vector<ClassResult> class_results(const DenoisingLaboratory& laboratory) {
    std::vector<ClassResult> classes;
    for (const DenoisingTrials& first : laboratory.meshes) {
        ClassResult result{first.subject.class_title()};
        if (std::ranges::find(classes, result.title, &ClassResult::title) != classes.end()) continue;
        std::vector<const NoiseTrial*> trials;
        for (const DenoisingTrials& mesh : laboratory.meshes) {
            if (mesh.subject.class_title() != result.title) continue;
            result.meshes.push_back(mesh.name());
            for (const NoiseTrial& trial : mesh.trials) trials.push_back(&trial);
        }
        result.trials = static_cast<int>(trials.size());
        result.gain = mean_gains(trials, &SearchResult::gain);
        result.angle_gain = mean_gains(trials, &SearchResult::angle_gain);
        result.best = index_of_largest(result.gain);
        result.best_by_angle = index_of_largest(result.angle_gain);
        classes.push_back(std::move(result));
    }
    return classes;
}

}   // namespace meshfolio::methods
