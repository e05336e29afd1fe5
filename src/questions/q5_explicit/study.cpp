#include "questions/q5_explicit/study.h"

#include <algorithm>

#include "geometry/operators/uniform_laplacian.h"
#include "questions/core/value_lists.h"

namespace meshfolio::q5_explicit {

namespace {

UniformLimit uniform_limit(const LibraryMesh& mesh) {
    const double top = largest_eigenvalue(uniform_operator(mesh.prepared->topology)).value;
    return {top, 2 / top};
}

/// Of the runs in which no mode changes its sign the one that removes most Dirichlet energy; if there is none, the same among the stable
/// ones.
int recommended(const ExplicitStudy& study) {
    for (const double limit : {0.5, 1.0}) {
        int best = -1;
        for (std::size_t i = 0; i < study.runs.size(); ++i) {
            if (study.runs[i].lambda > limit * study.subject.critical * (1 + 1e-12)) continue;
            if (best < 0 || study.runs[i].energy.back() < study.runs[static_cast<std::size_t>(best)].energy.back())
                best = static_cast<int>(i);
        }
        if (best >= 0) return best;
    }
    return -1;
}

}   // namespace

ExplicitStudy explicit_study(std::shared_ptr<const LibraryMesh> source, const QuestionSettings& settings) {
    ExplicitStudy study;
    study.subject = smoothing_subject(std::move(source));
    study.uniform = uniform_limit(*study.subject.source);
    const int iterations = last_or(settings.iterations, settings.quick ? 20 : 50);
    for (const double lambda : steps_of(settings, study.subject, {0.05, 0.5, 0.95, 1.05, 2.0})) {
        study.runs.push_back(run_smoothing(study.subject, SmoothingScheme::explicit_euler, lambda, iterations));
        study.amplification.push_back(top_mode_amplification(study.subject, lambda, 20));
    }
    study.best = recommended(study);
    return study;
}

bool keeps_signs(const SmoothingSubject& subject, double lambda) { return lambda <= 0.5 * subject.critical * (1 + 1e-12); }

double barycentre_drift(const SmoothingSubject& subject, const Positions& X) {
    const Vector& M = subject.laplacian.M;
    return (((X - subject.mesh().X) / subject.diagonal).transpose() * (M / M.sum())).norm();
}

int iterations_keeping_volume(const SmoothingRun& run, double share) {
    const auto lost = std::ranges::find_if(run.volume, [&](double v) { return v < share; });
    return lost != run.volume.end() ? static_cast<int>(lost - run.volume.begin()) - 1 : -1;
}

}   // namespace meshfolio::q5_explicit
