#include "questions/q5_explicit/study.h"

#include <algorithm>
#include <cmath>

#include "geometry/operators/uniform_laplacian.h"
#include "questions/core/value_lists.h"

namespace meshfolio::q5_explicit {

namespace {

UniformLimit uniform_limit(const LibraryMesh& mesh) {
    const double top = largest_eigenvalue(uniform_operator(mesh.prepared->topology)).value;
    return {top, 2 / top};
}

std::optional<Recommendation> recommended(const ExplicitStudy& study) {
    for (const double limit : {0.5, 1.0}) {
        for (std::size_t i = study.runs.size(); i-- > 0;) {
            const SmoothingRun& run = study.runs[i];
            const int kept = iterations_keeping_size(run);
            if (run.lambda > limit * study.subject.critical * (1 + 1e-12) || kept == 0) continue;
            return Recommendation{i, kept < 0 ? run : run_smoothing(study.subject, run.scheme, run.lambda, kept)};
        }
    }
    return {};
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
    study.peaks = peaks_of(study.subject.top.mode);
    study.recommended = recommended(study);
    return study;
}

bool keeps_signs(const SmoothingSubject& subject, double lambda) { return lambda <= 0.5 * subject.critical * (1 + 1e-12); }

double barycentre_drift(const SmoothingSubject& subject, const Positions& X) {
    const Vector& M = subject.laplacian.M;
    return (((X - subject.mesh().X) / subject.diagonal).transpose() * (M / M.sum())).norm();
}

}   // namespace meshfolio::q5_explicit
