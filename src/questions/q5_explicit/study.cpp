#include "questions/q5_explicit/study.h"

#include "geometry/operators/uniform_laplacian.h"
#include "questions/bench/mesh_class.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

/// Returns the rms displacement of the flagged vertices over that of the others; 0 if no vertex is flagged or the others stay.
double moved_ratio(const Positions& before, const Positions& after, const std::vector<char>& flagged) {
    const FlaggedMeans squares = flagged_means((after - before).rowwise().squaredNorm(), flagged);
    return squares.count > 0 && squares.elsewhere > 0 ? std::sqrt(squares.there / squares.elsewhere) : 0;
}

/// Measures the surface of the recommended run against the input: roughness, features, boundary, and folds undone or made.
void compare_with_input(Recommendation& recommendation, const SmoothingSubject& subject) {
    const TriangleMesh& mesh = subject.mesh();
    const MeshTopology& topology = subject.topology();
    const TriangleMesh smoothed = moved_to(mesh, recommendation.stopped.result.X);
    const MeshCharacter before = mesh_character(mesh, topology);
    recommendation.roughness_before = median_face_angle(mesh, topology);
    recommendation.roughness_after = median_face_angle(smoothed, topology);
    if (before.kind() == MeshClass::sharp_edged)
        recommendation.on_features = moved_ratio(mesh.X, smoothed.X, feature_vertices(mesh, topology));
    if (before.open) recommendation.on_boundary = moved_ratio(mesh.X, smoothed.X, topology.on_boundary);
    const Positions normals = face_normals(mesh), smoothed_normals = face_normals(smoothed);
    for (int t = 0; t < mesh.face_count(); ++t) {
        if (!(normals.row(t).dot(smoothed_normals.row(t)) < 0)) continue;
        recommendation.folded_before += is_folded(mesh, topology, normals, t) ? 1 : 0;
        recommendation.folded_after += is_folded(mesh, topology, smoothed_normals, t) ? 1 : 0;
    }
}

/// Most iterations of a recommended run over those of the others: if λ_crit is small, many steps are little smoothing.
constexpr int patience = 10;

/// Smooths with the λ of study.runs[index] for as long as 95 % of the size is left. @param kept  iterations that leave as much; negative:
/// all of that run
Recommendation stopped_in_time(const ExplicitStudy& study, std::size_t index, int kept) {
    const SmoothingRun& run = study.runs[index];
    Recommendation recommendation{.run = index, .stopped = {}};
    if (kept < 0) {
        recommendation.stopped = run_smoothing(study.subject, run.scheme, run.lambda, patience * run.iterations);
        kept = iterations_keeping_size(recommendation.stopped);
        recommendation.all_kept = kept < 0;
    }
    if (!recommendation.all_kept) recommendation.stopped = run_smoothing(study.subject, run.scheme, run.lambda, kept);
    compare_with_input(recommendation, study.subject);
    return recommendation;
}

/// Returns the recommended run; none if no stable step leaves 95 % of the size after one iteration.
std::optional<Recommendation> recommended(const ExplicitStudy& study) {
    for (const double limit : {0.5, 1.0}) {
        for (std::size_t i = study.runs.size(); i-- > 0;) {
            const SmoothingRun& run = study.runs[i];
            const int kept = iterations_keeping_size(run);
            if (run.lambda > limit * study.subject.critical * (1 + 1e-12) || kept == 0) continue;
            return stopped_in_time(study, i, kept);
        }
    }
    return {};
}

}   // namespace

int iterations_of(const QuestionSettings& settings) { return last_or(settings.iterations, settings.quick ? 20 : 50); }

std::size_t ExplicitStudy::first_beyond() const {
    std::size_t i = 0;
    while (i < runs.size() && stable(i)) ++i;
    return i;
}

const Positions* Strip::at(int t) const {
    const auto found = std::ranges::find(times, t);
    const std::ptrdiff_t i = found - times.begin();
    return found != times.end() && i < std::ssize(frames) ? &frames[i] : nullptr;
}

ExplicitStudy explicit_study(SharedMesh source, const QuestionSettings& settings) {
    ExplicitStudy study;
    study.subject = smoothing_subject(std::move(source));
    study.uniform_top = largest_eigenvalue(uniform_operator(study.subject.mesh(), study.subject.topology())).value;
    constexpr double far_beyond = 1.5;   // λ_crit: spikes are there at once
    const int iterations = iterations_of(settings);
    const double critical = study.subject.critical;
    const std::vector<double> steps = steps_of(settings, critical, own_steps);
    for (const double lambda : steps) {
        const bool far = lambda == steps.back() && lambda > far_beyond * critical;
        const bool near = !far && !study.near && lambda > critical;
        std::vector<int> times;
        if (far) times = {1, 2, 3, 4, 5};
        if (near) times = each_once(std::vector{iterations / 2, iterations});
        std::erase_if(times, [&](int t) { return t < 1 || t > iterations; });
        SmoothingRun run = run_smoothing(study.subject, SmoothingScheme::explicit_euler, lambda, iterations, times);
        if (far || near) (far ? study.far : study.near) = Strip{study.runs.size(), times, std::exchange(run.snapshots, {})};
        study.runs.push_back(std::move(run));
        study.amplification.push_back(top_mode_amplification(study.subject, lambda, 20));
    }
    study.peaks = peaks_of(study.subject.top.mode);
    study.recommended = recommended(study);
    return study;
}

std::shared_ptr<const Studies> explicit_studies(const LibraryMeshes& meshes, const QuestionSettings& settings, const Progress& progress,
                                                report::Section& section) {
    return std::make_shared<const Studies>(studies_of(meshes, "explicit smoothing", settings, progress, section, explicit_study));
}

bool keeps_signs(const SmoothingSubject& subject, double lambda) { return lambda <= 0.5 * subject.critical * (1 + 1e-12); }

double share_rougher(const SmoothingSubject& subject, const Positions& X) {
    const Vector before = vertex_face_angles(subject.mesh(), subject.topology());
    const Vector after = vertex_face_angles(moved_to(subject.mesh(), X), subject.topology());
    return double((after.array() > before.array() + 1).count()) / std::max(subject.preflight().vertices_in_use, 1);
}

bool ends_by_top_mode(const ExplicitStudy& study) {
    const Smoothed& last = study.runs.back().result;
    return last.blew_up && std::ranges::find(study.peaks, last.blow_up_vertex) != study.peaks.end() &&
           share_of_top_mode(study.subject, last.X) > 0.5;
}

bool is_folded(const TriangleMesh& mesh, const MeshTopology& topology, const Positions& normals, int t) {
    Vector3 around = Vector3::Zero();
    for (const int v : mesh.F.row(t))
        for (const int* other = topology.vertex_faces.begin(v); other != topology.vertex_faces.end(v); ++other)
            if (*other != t) around += normals.row(*other).transpose();
    return normals.row(t).dot(around) < 0;
}

double barycentre_drift(const SmoothingSubject& subject, const Positions& X) {
    const Vector& M = subject.laplacian.M;
    return (((X - subject.mesh().X) / subject.diagonal).transpose() * (M / M.sum())).norm();
}

}   // namespace meshfolio::q5_explicit
