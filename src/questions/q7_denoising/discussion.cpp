#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/number_text.h"
#include "questions/bench/sentences.h"
#include "questions/core/study_list.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

using Names = std::vector<std::string>;

/// Above which noise, measured in mean edges, the gain reaches 1.2: a clean split of the cases or none.
report::Text limit_in_mean_edges(const Studies& studies) {
    const auto [smallest_helped, largest_failed] = noise_split(studies);
    if (!std::isfinite(smallest_helped) || largest_failed == 0) return {};
    return words.say(largest_failed < smallest_helped ? "split.clean" : "split.mixed", "failed"_a = readable(largest_failed, 2),
                     "helped"_a = readable(smallest_helped, 2));
}

report::Text verdict(const Studies& studies) {
    Names works, fails;
    for (const Case& c : cases_of(studies)) {
        const std::string name = words.line("verdict.mesh", facts_of(c.whole, c.part)), outcome = outcome_of(c.part);
        if (outcome == "works") works.push_back(name);
        if (outcome == "fails" || outcome == "harms") fails.push_back(name);
    }
    return paragraph_of({works.empty() ? words.say("works.none") : said_of(works, words, "works"),
                         fails.empty() ? words.say("fails.none") : said_of(fails, words, "fails"), limit_in_mean_edges(studies),
                         words.say("explained", "mesh"_a = studies.front().name())});
}

/// From the lowest to the highest level of noise on one mesh.
report::Text course_of(const DenoisingStudy& study) {
    const auto gain = [&](const DenoisingTrial& trial) {
        return words.line(trial.best_rms == 0 ? "course.no_gain" : "course.gain", facts_of(study, trial));
    };
    const DenoisingTrial& high = study.trials.back();
    const bool reached = high.best_rms != high.iterations();
    return words.say(study.trials.size() == 1 ? "course.one" : "course.several", "mesh"_a = study.name(),
                     "low"_a = gain(study.trials.front()), "high"_a = gain(high),
                     "unreached"_a = reached ? "" : words.line("course.unreached", "last"_a = high.iterations()));
}

/// Whether more noise asks for more iterations: on every mesh alike, or on which.
report::Text noise_and_iterations(const Studies& studies) {
    Names more, fewer;
    for (const DenoisingStudy& study : studies) {
        const int low = study.trials.front().best_rms, high = study.trials.back().best_rms;
        if (low == high) continue;
        (high > low ? more : fewer).push_back(words.line("course.iterations", "mesh"_a = study.name(), "low"_a = low, "high"_a = high));
    }
    return paragraph_of({said_of(more, words, "course.more"), said_of(fewer, words, "course.fewer")});
}

/// What it costs not to stop: of all trials that were taken to twice their best iteration, the dearest.
report::Text going_on(const Studies& studies) {
    const auto loss = [](const Case& c) { return c.part.rms.back() / c.part.least_rms(); };
    std::vector<Case> cases;
    std::ranges::copy_if(cases_of(studies), std::back_inserter(cases),
                         [](const Case& c) { return 2 * c.part.best_rms <= c.part.iterations(); });
    if (cases.empty()) return {};
    const Case& worst = *std::ranges::max_element(cases, {}, loss);
    report::Facts facts = facts_of(worst.whole, worst.part);
    facts.push_back("loss"_a = readable(loss(worst), 2));
    return words.say(worst.part.best_rms == 0 ? "going_on.harms" : "going_on", facts);
}

report::Text what_happened(const Studies& studies) {
    report::Text courses;
    for (const DenoisingStudy& study : studies) courses = paragraph_of({courses, course_of(study)});
    return paragraph_of({courses, noise_and_iterations(studies), going_on(studies)});
}

/// Error on sharp edges over that elsewhere at the best iterations, lowest and highest over the trials; highest 0: no trial has any.
struct FeatureRatio {
    double lowest = INFINITY, highest = 0;
};

FeatureRatio feature_ratio(const DenoisingStudy& study) {
    FeatureRatio ratio;
    for (const DenoisingTrial& trial : study.trials) {
        if (trial.best_rms == 0) continue;
        ratio.lowest = std::min(ratio.lowest, trial.feature_rms / trial.smooth_rms);
        ratio.highest = std::max(ratio.highest, trial.feature_rms / trial.smooth_rms);
    }
    return ratio;
}

report::Text features_pay(const Studies& studies) {
    Names larger, mixed, smaller, smooth, coarse;
    for (const DenoisingStudy& study : studies) {
        const int vertices = study.clean->mesh().vertex_count();
        const FeatureRatio ratio = feature_ratio(study);
        const report::Facts facts{"mesh"_a = study.name(), "features"_a = study.feature_vertices, "vertices"_a = vertices,
                                  "lowest"_a = readable(ratio.lowest, 3), "highest"_a = readable(ratio.highest, 3)};
        if (study.feature_vertices == 0)
            smooth.push_back(study.name());
        else if (2 * study.feature_vertices > vertices)
            coarse.push_back(words.line("features.mesh.coarse", facts));
        else if (ratio.highest > 0)
            (ratio.lowest > 1    ? larger
             : ratio.highest < 1 ? smaller
                                 : mixed)
                .push_back(words.line(ratio.highest > ratio.lowest ? "features.mesh.range" : "features.mesh", facts));
    }
    Names kinds;
    const auto tell = [&](const char* key, const Names& meshes) {
        if (!meshes.empty()) kinds.push_back(words.line(key, "meshes"_a = listed(meshes)));
    };
    tell("features.larger", larger);
    tell("features.smaller", smaller);
    tell("features.mixed", mixed);
    return paragraph_of({kinds.empty() ? report::Text() : words.say("features", "kinds"_a = listed(kinds)),
                         larger.empty() ? report::Text() : words.say("features.rounded"), said_of(smooth, words, "features.none"),
                         said_of(coarse, words, "features.coarse")});
}

/// Of each mesh the first trial whose error and angle are smallest at different iterations.
report::Text position_against_normals(const Studies& studies) {
    Names disagree;
    for (const DenoisingStudy& study : studies) {
        const auto trial =
            std::ranges::find_if(study.trials, [](const DenoisingTrial& t) { return std::abs(t.best_angle - t.best_rms) >= 3; });
        if (trial == study.trials.end()) continue;
        disagree.push_back(
            words.line(trial->best_angle == trial->iterations() ? "normals.mesh.later" : "normals.mesh", facts_of(study, *trial)));
    }
    return said_of(disagree, words, "normals");
}

}   // namespace

void add_discussion(report::Section& section, const Studies& studies) {
    add_words(section, words, "discussion");
    add_paragraphs(section, {verdict(studies), what_happened(studies), features_pay(studies), position_against_normals(studies)});
}

}   // namespace meshfolio::q7_denoising
