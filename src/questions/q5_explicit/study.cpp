#include "questions/q5_explicit/study.h"

#include "geometry/operators/uniform_laplacian.h"
#include "questions/bench/mesh_class.h"

namespace meshfolio::q5_explicit {

namespace {

// ---- the step to take

/// rms displacement of the flagged vertices over that of the others; 0 where there are none, or the others stay.
double moved_ratio(const Positions& before, const Positions& after, const std::vector<char>& flagged) {
    const FlaggedMeans squares = flagged_means((after - before).rowwise().squaredNorm(), flagged);
    return squares.count > 0 && squares.elsewhere > 0 ? std::sqrt(squares.there / squares.elsewhere) : 0;
}

/// What it does to the surface.
void look_at(Recommendation& recommendation, const SmoothingSubject& subject) {
    const MeshTopology& topology = subject.topology();
    const TriangleMesh smoothed = moved_to(subject.mesh(), recommendation.stopped.result.X);
    const MeshCharacter before = mesh_character(subject.mesh(), topology);
    recommendation.roughness_before = median_face_angle(subject.mesh(), topology);
    recommendation.roughness_after = median_face_angle(smoothed, topology);
    if (before.kind() == MeshClass::sharp_edged)
        recommendation.on_features = moved_ratio(subject.mesh().X, smoothed.X, feature_vertices(subject.mesh(), topology));
    if (before.open) recommendation.on_boundary = moved_ratio(subject.mesh().X, smoothed.X, topology.on_boundary);
}

/// What the faces turned over are like, before and after: folds that smoothing has undone, or made.
void count_folds(Recommendation& recommendation, const SmoothingSubject& subject) {
    const TriangleMesh& mesh = subject.mesh();
    const MeshTopology& topology = subject.topology();
    const Positions before = face_normals(mesh), after = face_normals(moved_to(mesh, recommendation.stopped.result.X));
    for (int t = 0; t < mesh.face_count(); ++t) {
        if (!(before.row(t).dot(after.row(t)) < 0)) continue;
        recommendation.folded_before += is_folded(mesh, topology, before, t) ? 1 : 0;
        recommendation.folded_after += is_folded(mesh, topology, after, t) ? 1 : 0;
    }
}

constexpr int patience = 10;   // times the iterations of the other runs: where λ_crit is small, many steps are little smoothing

/// The run that goes on for as long as enough of the size is left.
Recommendation stopped_in_time(const ExplicitStudy& study, std::size_t index, int kept) {
    const SmoothingRun& run = study.runs[index];
    Recommendation recommendation{.run = index, .stopped = {}};
    if (kept < 0) {
        recommendation.stopped = run_smoothing(study.subject, run.scheme, run.lambda, patience * run.iterations);
        kept = iterations_keeping_size(recommendation.stopped);
        recommendation.all_kept = kept < 0;
    }
    if (!recommendation.all_kept) recommendation.stopped = run_smoothing(study.subject, run.scheme, run.lambda, kept);
    look_at(recommendation, study.subject);
    count_folds(recommendation, study.subject);
    return recommendation;
}

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

// ---- frames

/// Early iterations show a step far beyond the limit, later ones a step just beyond it. The first is the last with the largest step in
/// view.
std::vector<int> frame_times(const SmoothingSubject& subject, double largest_step, int iterations) {
    constexpr int second = 5;
    const int seen =
        run_smoothing(subject, SmoothingScheme::explicit_euler, largest_step, std::min(second - 1, iterations)).in_view_iteration;
    std::vector<int> times{0};
    for (const int t : {std::max(1, seen), second, 10, 25})
        if (t < iterations) times.push_back(t);
    if (iterations > 0) times.push_back(iterations);
    return times;
}

/// The steps whose frames are kept.
std::vector<double> told_steps(const std::vector<double>& steps, const SmoothingSubject& subject) {
    std::vector<double> told;
    for (const double limit : {0.5, 1.0}) {   // the largest that keeps signs, else the largest stable one
        if (!told.empty()) break;
        for (const double step : steps)
            if (step <= limit * subject.critical * (1 + 1e-12)) told = {step};
    }
    const auto beyond = std::ranges::find_if(steps, [&](double step) { return step > subject.critical; });
    if (beyond != steps.end()) told.push_back(*beyond);
    if (told.empty() || told.back() != steps.back()) told.push_back(steps.back());
    return told;
}

}   // namespace

int iterations_of(const QuestionSettings& settings) { return last_or(settings.iterations, settings.quick ? 20 : 50); }

std::size_t ExplicitStudy::first_beyond() const {
    std::size_t i = 0;
    while (i < runs.size() && stable(i)) ++i;
    return i;
}

ExplicitStudy explicit_study(SharedMesh source, const QuestionSettings& settings) {
    ExplicitStudy study;
    study.subject = smoothing_subject(std::move(source));
    study.uniform_top = largest_eigenvalue(uniform_operator(study.subject.mesh(), study.subject.topology())).value;
    const int iterations = iterations_of(settings);
    const std::vector<double> steps = steps_of(settings, study.subject.critical, own_steps);
    const std::vector<double> told = told_steps(steps, study.subject);
    study.frame_times = frame_times(study.subject, steps.back(), iterations);
    for (const double lambda : steps) {
        const bool framed = std::ranges::find(told, lambda) != told.end();
        SmoothingRun run = run_smoothing(study.subject, SmoothingScheme::explicit_euler, lambda, iterations,
                                         framed ? study.frame_times : std::vector<int>());
        if (framed) {
            Strip strip{study.runs.size(), {study.subject.mesh().X}};
            std::ranges::move(run.snapshots, std::back_inserter(strip.frames));
            run.snapshots.clear();
            study.strips.push_back(std::move(strip));
        }
        study.runs.push_back(std::move(run));
        study.amplification.push_back(top_mode_amplification(study.subject, lambda, 20));
    }
    study.peaks = peaks_of(study.subject.top.mode);
    study.recommended = recommended(study);
    return study;
}

bool keeps_signs(const SmoothingSubject& subject, double lambda) { return lambda <= 0.5 * subject.critical * (1 + 1e-12); }

int faces_turned(const TriangleMesh& mesh, const Positions& X) {
    return static_cast<int>((face_normals(mesh).cwiseProduct(face_normals(moved_to(mesh, X))).rowwise().sum().array() < 0).count());
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
