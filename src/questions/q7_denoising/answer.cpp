// The answer to question 7, and the few sentences behind it.
#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

/// Names cases where the surface is nearer but the volume is lost, which is no success.
report::Text shrunk(const Grids& grids) {
    Names told;
    for (const Case& c : cases_of(grids))
        if (verdict_on(c.part) == "shrinks") told.push_back(words.line("shrunk.case", facts_of(c.whole, c.part)));
    return said_of(told, words, "shrunk");
}

/// Sharp edges suffer, here most.
report::Text rounded(const Grids& grids) {
    const DenoisingGrid* most = most_rounded(grids);
    const double times = most ? most->pictured().taken.features.times() : 0;
    return times > 1.2 ? words.say("rounded", "mesh"_a = most->name(), "times"_a = readable(times, 2)) : report::Text();
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
    int all = 0, ended = 0, near = 0, small = 0;
    for (const Case& c : cases_of(grids)) {
        for (const Measure& measure : measures) {
            const SearchState& best = c.part.best_by(measure);
            all += best.step > 0 ? 1 : 0;
            ended += is_unended(c.whole, best) ? 1 : 0;
            if (best.step == 0 || is_unended(c.whole, best)) continue;
            near += best.step == c.whole.iterations - 1 ? 1 : 0;
            small += best.value == c.whole.lambdas.front() && best.step < c.whole.iterations - 1 ? 1 : 0;
        }
    }
    return paragraph_of({ended + near == 0 ? report::Text() : words.say("ended", "all"_a = all, "ended"_a = ended, "near"_a = near),
                         small == 0 ? report::Text() : words.say("ended.small", "small"_a = small)});
}

/// The case with the least gain: little where the noise is weak, no success, or just the least.
report::Text least_gain(const Grids& grids) {
    constexpr double weak = 0.1;   // mean edges
    const DenoisingGrid& grid = hardest(grids);
    const NoisyTrial& least = hardest_in(grid);
    const double gain = least.gain(measures[0]);
    if (std::isnan(gain)) return {};
    const bool is_weak = least.sigma < weak * grid.mean_edge && gain < 1.25;
    const bool harms = is_weak && grid.after_one(least) > 1;
    return paragraph_of({words.say("least" + std::string(is_weak ? ".weak" : "") + (gain < helps ? ".fails" : ""), facts_of(grid, least)),
                         harms ? words.say("least.weak.harm", "middle"_a = readable(grid.middle_lambda(), 2)) : report::Text()});
}

/// Then it is part of the verdict.
bool least_fails(const Grids& grids) { return hardest_in(hardest(grids)).gain(measures[0]) < helps; }

/// The cases in which the distance to the surface is halved, whatever becomes of the volume.
std::ptrdiff_t halved(const Grids& grids) {
    return std::ranges::count_if(cases_of(grids), [](const Case& c) { return c.part.gain(measures[0]) >= works; });
}

/// The largest gain by a measure, of the cases whose noise does not halve the distance to the surface; null: no gain.
const Case* most_below(const std::vector<Case>& cases, const Measure& measure) {
    const Case* most = nullptr;
    for (const Case& c : cases)
        if (c.part.gain(measures[0]) < works && c.part.gain(measure) > (most ? most->part.gain(measure) : 1)) most = &c;
    return most;
}

/// Says from which noise on smoothing halves the distance, and what it gains below.
report::Text split_told(const Grids& grids, const NoiseSplit& split) {
    const std::vector<Case> cases = cases_of(grids);
    const Case* most = most_below(cases, measures[0]);
    const double gain = most ? most->part.gain(measures[0]) : 1;
    return words.say("answer.split", "halved"_a = readable(split.smallest_halved, 2), "count"_a = halved(grids),
                     "cases"_a = count_of(grids, measures[0]).cases(), "other"_a = readable(split.largest_other, 2),
                     "most"_a = readable(rounded_down(gain, 2), 2));
}

/// What normals gain, where that is far more, of the cases in which the distance is not halved.
report::Text normals_gain(const Grids& grids) {
    const std::vector<Case> cases = cases_of(grids);
    const Case *surface = most_below(cases, measures[0]), *normals = most_below(cases, measures[2]);
    if (normals == nullptr || !(normals->part.gain(measures[2]) >= works)) return {};
    if (surface && normals->part.gain(measures[2]) <= 1.2 * rounded_down(surface->part.gain(measures[0]), 2)) return {};
    return words.say("summary.normals", "gain"_a = readable(normals->part.gain(measures[2]), 2), "mesh"_a = normals->whole.name(),
                     "edges"_a = readable(normals->part.sigma / normals->whole.mean_edge, 2));
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
        const report::Fact left = "left"_a = readable_percent(c.part.volume_by(measure), 2);
        count.shrinking.push_back(words.line("counts.shrinking", facts_of(c.whole, c.part, {left})));
    }
    return count;
}

report::Text answer_of(const Grids& grids) {
    const bool gained = std::ranges::any_of(cases_of(grids), [](const Case& c) { return c.part.gain(measures[0]) >= helps; });
    if (!gained) return paragraph_of({words.say("answer.none"), rounded(grids)});
    const NoiseSplit split = noise_split(grids);
    const Count count = count_of(grids, measures[0]);
    const report::Text told = split.decides()
                                  ? split_told(grids, split)
                                  : words.say("answer.mixed", "works"_a = count.works, "helps"_a = count.helps, "cases"_a = count.cases());
    return paragraph_of({told, least_fails(grids) ? least_gain(grids) : report::Text(), shrunk(grids), rounded(grids)});
}

report::Text summary_of(const Grids& grids) {
    const Count surface = count_of(grids, measures[0]), places = count_of(grids, measures[1]), normals = count_of(grids, measures[2]);
    report::Text counted;
    if (surface.cases() > 0)
        counted = words.say("summary", "works"_a = surface.works, "helps"_a = surface.helps, "cases"_a = surface.cases());
    if (surface.fails > 0 && surface.fails == static_cast<int>(surface.shrinking.size()))
        go_on(counted, words.say("summary.volume", "fails"_a = surface.fails));
    if (surface.cases() > 0 && normals.cases() > 0)
        go_on(counted, words.say("summary.others", "places"_a = places.fails, "normals"_a = normals.fails));
    return paragraph_of({counted, least_fails(grids) ? report::Text() : least_gain(grids), normals_gain(grids), other_samples(grids),
                         at_the_end_of_the_grid(grids)});
}

}   // namespace meshfolio::q7_denoising
