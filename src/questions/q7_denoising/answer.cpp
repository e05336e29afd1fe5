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

/// The thin shapes fail: every closed mesh on which the volume goes is thinner, in mean edges, than every one on which it does not.
bool thin_ones_shrink(const Grids& grids) {
    double thickest_shrinking = 0, thinnest_other = infinity;
    for (const DenoisingGrid& grid : grids) {
        if (std::isnan(grid.thickness)) continue;
        const bool shrinks = std::ranges::any_of(grid.trials, [](const NoisyTrial& trial) { return verdict_on(trial) == "shrinks"; });
        if (shrinks)
            thickest_shrinking = std::max(thickest_shrinking, grid.thickness);
        else
            thinnest_other = std::min(thinnest_other, grid.thickness);
    }
    return thinnest_other < infinity && thickest_shrinking < thinnest_other;
}

/// Where the surface is nearer, but the volume lost: no success.
report::Text shrunk(const Grids& grids) {
    Names told;
    for (const Case& c : cases_of(grids))
        if (verdict_on(c.part) == "shrinks") told.push_back(words.line("shrunk.case", facts_of(c.whole, c.part)));
    return said_of(told, words, thin_ones_shrink(grids) ? "shrunk.thin" : "shrunk");
}

/// Sharp edges suffer: in every case that has some, or in these.
report::Text rounded(const Grids& grids) {
    Names told;
    bool always = true;
    for (const DenoisingGrid& grid : grids) {
        const auto is_rounded = [](const NoisyTrial& trial) { return !trial.improved() || trial.taken.features.times() > 1.2; };
        if (!grid.has_features()) continue;
        const bool all = std::ranges::all_of(grid.trials, is_rounded);
        if (all && std::ranges::any_of(grid.trials, &NoisyTrial::improved)) told.push_back(grid.name());
        always = always && all;
    }
    return said_of(told, words, always ? "rounded.always" : "rounded");
}

/// Whether further samples of the noise gain as much by surface, and which cases they leave open.
report::Text other_samples(const Grids& grids) {
    double most = 0;
    std::size_t samples = 0;
    Names open;
    for (const Case& c : cases_of(grids)) {
        const double gain = c.part.gain(measures[0]);
        samples = std::max(samples, c.part.further_gains.size());
        if (!std::isnan(c.part.spread())) most = std::max(most, c.part.spread() / gain);
        const auto level = [](double g) { return g >= works ? 2 : g >= helps ? 1 : 0; };
        if (std::ranges::any_of(c.part.further_gains, [&](double g) { return level(g) != level(gain); }))
            open.push_back(words.line("samples.case", facts_of(c.whole, c.part)));
    }
    if (samples == 0) return {};
    return words.say(open.empty() ? "samples.same" : "samples.differ", "samples"_a = samples + 1, "spread"_a = readable_percent(most, 2),
                     "others"_a = open.size(), "cases"_a = listed(open));
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

/// The case with the least gain: little where the noise is weak, no success, or just the least.
report::Text least_gain(const Grids& grids) {
    constexpr double weak = 0.1;   // mean edges
    const DenoisingGrid& grid = hardest(grids);
    const NoisyTrial& least = hardest_in(grid);
    const double gain = least.gain(measures[0]);
    if (std::isnan(gain)) return {};
    report::Facts facts = facts_of(grid, least);
    facts.push_back("fall"_a = readable_percent(1 - 1 / gain, 2));
    const bool is_weak = least.sigma < weak * grid.mean_edge && gain < 1.25;
    return words.say("least" + std::string(is_weak ? ".weak" : "") + (gain < helps ? ".fails" : ""), facts);
}

/// Between which noise levels lies the one from which smoothing works: nothing there was tried.
report::Text untested(const Grids& grids) {
    const NoiseSplit split = noise_split(grids);
    if (!split.decides()) return {};
    return words.say("untested", "halved"_a = readable(split.smallest_halved, 2), "other"_a = readable(split.largest_other, 2));
}

}   // namespace

Count count_of(const Grids& grids, const Measure& measure) {
    Count count;
    for (const Case& c : cases_of(grids)) {
        const std::string verdict = verdict_on(c.part, measure);
        count.works += verdict == "works" ? 1 : 0;
        count.helps += verdict == "helps" ? 1 : 0;
        count.fails += is_failure(verdict) ? 1 : 0;
        if (verdict != "shrinks") continue;
        report::Facts facts = facts_of(c.whole, c.part);
        facts.push_back("left"_a = readable_percent(c.part.volume_by(measure), 2));
        count.shrinking.push_back(words.line("counts.shrinking", facts));
    }
    return count;
}

report::Text answer_of(const Grids& grids) {
    const bool gained = std::ranges::any_of(cases_of(grids), [](const Case& c) { return c.part.gain(measures[0]) >= helps; });
    if (!gained) return paragraph_of({words.say("answer.none"), rounded(grids)});
    const NoiseSplit split = noise_split(grids);
    const Count count = count_of(grids, measures[0]);
    const report::Text told = split.decides()
                                  ? words.say("answer.split", "halved"_a = readable(split.smallest_halved, 1))
                                  : words.say("answer.mixed", "works"_a = count.works, "helps"_a = count.helps, "cases"_a = count.cases());
    return paragraph_of({told, least_gain(grids), shrunk(grids), rounded(grids)});
}

report::Text summary_of(const Grids& grids) {
    const bool counted = std::ranges::any_of(measures, [&](const Measure& measure) { return count_of(grids, measure).cases() > 0; });
    return paragraph_of(
        {counted ? words.say("summary") : report::Text(), untested(grids), other_samples(grids), at_the_end_of_the_grid(grids)});
}

}   // namespace meshfolio::q7_denoising
