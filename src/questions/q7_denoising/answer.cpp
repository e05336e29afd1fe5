// The answer to question 7, and the few sentences behind it.
#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "geometry/linear/special_values.h"
#include "questions/bench/sentences.h"
#include "questions/core/study_list.h"
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

using Names = std::vector<std::string>;

/// The verdicts by a measure, of the cases that have it: noise within a plane changes neither surface nor normals.
struct Count {
    int works = 0, helps = 0, fails = 0;
    int cases() const { return works + helps + fails; }
};
Count count_of(const Grids& grids, const Measure& measure) {
    Count count;
    for (const Case& c : cases_of(grids)) {
        const std::string verdict = verdict_on(c.part, measure);
        count.works += verdict == "works" ? 1 : 0;
        count.helps += verdict == "helps" ? 1 : 0;
        count.fails += is_failure(verdict) ? 1 : 0;
    }
    return count;
}

report::Facts facts_of(const Count& count, const Measure& measure) {
    return {"works"_a = count.works, "helps"_a = count.helps, "fails"_a = count.fails, "cases"_a = count.cases(),
            "measure"_a = words.line("by." + std::string(measure.key))};
}

/// What smoothing takes off along the surface and across it. @return  its facts
report::Facts removed_on(const DenoisingGrid& grid) {
    const NoisyTrial& trial = grid.pictured();
    return {"mesh"_a = grid.name(), "along"_a = readable_percent(std::abs(trial.removed_along()), 2),
            "across"_a = readable_percent(trial.removed_across(), 2)};
}

/// "rounded edges and lost volume", and noise along the surface, as far as they are seen.
report::Text price_of(const Grids& grids) {
    Names losses;
    if (most_rounded(grids)) losses.push_back(words.line("loss.edges"));
    if (most_shrunk(grids)) losses.push_back(words.line("loss.volume"));
    const DenoisingGrid* drift = most_drifting(grids);
    return paragraph_of({said_of(losses, words, "loss"), drift ? along_surface(*drift, "loss.along") : report::Text()});
}

/// In how many cases smoothing works and helps, measure by measure.
report::Text verdicts(const Grids& grids) {
    Names told;
    for (const Measure& measure : measures)
        if (const Count count = count_of(grids, measure); count.cases() > 0)
            told.push_back(words.line(told.empty() ? "verdict.first" : "verdict.other", facts_of(count, measure)));
    return told.empty() ? report::Text() : words.say("verdict", "verdicts"_a = listed(told));
}

/// In how many cases it fails, measure by measure.
report::Text failures(const Grids& grids) {
    Names told;
    for (const Measure& measure : measures)
        if (const Count count = count_of(grids, measure); count.cases() > 0)
            told.push_back(words.line(told.empty() ? "fails.first" : "fails.other", facts_of(count, measure)));
    return told.empty() ? report::Text() : words.say("fails", "verdicts"_a = listed(told));
}

/// Where the surface is nearer, but the volume lost: no success.
report::Text shrunk(const Grids& grids) {
    Names told;
    for (const Case& c : cases_of(grids))
        if (verdict_on(c.part) == "shrinks") told.push_back(words.line("shrunk.case", facts_of(c.whole, c.part)));
    return told.empty() ? report::Text() : words.say("shrunk", "cases"_a = listed(told));
}

/// Whether further samples of the noise gain as much by surface.
report::Text other_samples(const Grids& grids) {
    double most = 0;
    std::size_t samples = 0, others = 0;
    for (const Case& c : cases_of(grids)) {
        const double gain = c.part.gain(measures[0]);
        samples = std::max(samples, c.part.further_gains.size());
        if (!std::isnan(c.part.spread())) most = std::max(most, c.part.spread() / gain);
        const auto level = [](double g) { return g >= works ? 2 : g >= helps ? 1 : 0; };
        others += std::ranges::any_of(c.part.further_gains, [&](double g) { return level(g) != level(gain); }) ? 1 : 0;
    }
    if (samples == 0) return {};
    return words.say(others == 0 ? "samples.same" : "samples.differ", "samples"_a = samples + 1, "spread"_a = readable_percent(most, 2),
                     "others"_a = others);
}

/// The gains that more smoothing, or less, might raise.
report::Text at_the_end_of_the_grid(const Grids& grids) {
    int all = 0, ended = 0, near = 0;
    for (const Case& c : cases_of(grids)) {
        for (const Measure& measure : measures) {
            const SearchState& best = c.part.best_by(measure);
            all += best.step > 0 ? 1 : 0;
            ended += is_unended(c.whole, best) ? 1 : 0;
            near += !is_unended(c.whole, best) && best.step == c.whole.iterations - 1 ? 1 : 0;
        }
    }
    return ended + near == 0 ? report::Text() : words.say("ended", "all"_a = all, "ended"_a = ended, "near"_a = near);
}

/// The case with the least gain.
report::Text least_gain(const Grids& grids) {
    const DenoisingGrid& grid = hardest(grids);
    const auto gain = [](const NoisyTrial& trial) { return std::isnan(trial.gain(measures[0])) ? infinity : trial.gain(measures[0]); };
    const NoisyTrial& least = *std::ranges::min_element(grid.trials, {}, gain);
    report::Facts facts = facts_of(grid, least);
    facts.push_back("fall"_a = readable_percent(1 - 1 / gain(least), 2));
    return words.say(gain(least) < helps ? "least.fails" : "least", facts);
}

}   // namespace

report::Text along_surface(const DenoisingGrid& grid, const std::string& key) {
    return words.say(grid.pictured().removed_along() > 0 ? key : key + ".grows", removed_on(grid));
}

report::Text answer_of(const Grids& grids) {
    const bool gained = std::ranges::any_of(cases_of(grids), [](const Case& c) { return c.part.gain(measures[0]) >= helps; });
    if (!gained) return paragraph_of({words.say("answer.none"), price_of(grids)});
    const NoiseSplit split = noise_split(grids);
    const report::Text told = split.decides() ? words.say("answer.split", "halved"_a = readable(split.smallest_halved, 2),
                                                          "other"_a = readable(split.largest_other, 2))
                                              : words.say("answer.mixed", facts_of(count_of(grids, measures[0]), measures[0]));
    return paragraph_of({told, least_gain(grids), failures(grids), shrunk(grids), price_of(grids)});
}

report::Text summary_of(const Grids& grids) { return paragraph_of({verdicts(grids), other_samples(grids), at_the_end_of_the_grid(grids)}); }

}   // namespace meshfolio::q7_denoising
