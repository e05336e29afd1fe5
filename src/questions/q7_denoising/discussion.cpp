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

/// In how many cases smoothing works and helps, measure by measure.
report::Text verdict(const Grids& grids) {
    const std::vector<Case> cases = cases_of(grids);
    report::Text told = words.say("verdict");
    for (const Measure& measure : measures) {
        const auto reached = [&](double gain) {
            return std::ranges::count_if(cases, [&](const Case& c) { return c.part.gain(measure) >= gain; });
        };
        const auto measured = std::ranges::count_if(cases, [&](const Case& c) { return !std::isnan(c.part.gain(measure)); });
        if (measured > 0)   // noise within a plane changes neither surface nor normals
            go_on(told, words.say("verdict.measure", "measure"_a = words.line("of." + std::string(measure.key)), "works"_a = reached(works),
                                  "helps"_a = reached(helps), "cases"_a = measured));
    }
    return told;
}

/// Above which noise, in mean edges, the gain reaches 1.2: a clean split of the cases or none, by each measure.
report::Text limits_in_mean_edges(const Grids& grids) {
    report::Text limits;
    for (const Measure& measure : measures) {
        const auto [smallest_helped, largest_failed] = noise_split(grids, measure);
        if (!std::isfinite(smallest_helped) || largest_failed == 0) continue;
        limits = paragraph_of({limits, words.say(largest_failed < smallest_helped ? "split.clean" : "split.mixed",
                                                 "measure"_a = words.line("by." + std::string(measure.key)),
                                                 "failed"_a = readable(largest_failed, 2), "helped"_a = readable(smallest_helped, 2))});
    }
    return limits;
}

report::Text why(const Grids& grids) { return words.say("explained", "mesh"_a = grids.front().name()); }

/// The best amount of smoothing λt [h̄²] from the lowest to the highest noise, by surface distance.
report::Text noise_and_amount(const Grids& grids) {
    Names more, less;
    for (const DenoisingGrid& grid : grids) {
        const auto time = [](const NoisyTrial& trial) { return trial.found.by_shape.value * trial.found.by_shape.step; };
        const double low = time(grid.trials.front()), high = time(grid.trials.back());
        if (low == 0 || high == 0 || low == high) continue;
        (high > low ? more : less)
            .push_back(words.line("amount.mesh", "mesh"_a = grid.name(), "low"_a = readable(low, 2), "high"_a = readable(high, 2)));
    }
    return paragraph_of({said_of(more, words, "amount.more"), said_of(less, words, "amount.less")});
}

/// Of all cases the one where the measures differ most in how much smoothing they ask for.
report::Text measures_disagree(const Grids& grids) {
    const auto time = [](const Case& c, const Measure& measure) { return c.part.best_by(measure).value * c.part.best_by(measure).step; };
    const auto spread = [&](const Case& c) {
        double least = infinity, most = 0;
        for (const Measure& measure : measures) {
            if (!(c.part.gain(measure) >= helps)) return 0.0;   // a best of little worth says nothing
            least = std::min(least, time(c, measure));
            most = std::max(most, time(c, measure));
        }
        return most / least;
    };
    const std::vector<Case> cases = cases_of(grids);
    const Case& most = *std::ranges::max_element(cases, {}, spread);
    if (spread(most) < 2) return {};
    report::Facts facts = facts_of(most.whole, most.part);
    for (const Measure& measure : measures) facts.push_back({measure.key, readable(time(most, measure), 2)});
    return words.say("disagree", facts);
}

/// How much of the error that is left lies along the surface, which neither distance nor normals show.
report::Text drift(const Grids& grids) {
    Names shares;
    for (const DenoisingGrid& grid : grids) {
        const SearchState& best = grid.trials.back().found.by_shape;
        if (best.step == 0 || !(best.rms > 0)) continue;
        shares.push_back(words.line("drift.mesh", "mesh"_a = grid.name(),
                                    "share"_a = readable_percent(1 - best.shape * best.shape / (best.rms * best.rms), 2)));
    }
    return said_of(shares, words, "drift");
}

/// Where the surface distance that is left sits: on edges or off them.
report::Text features(const Grids& grids) {
    Names rounded, alike, smooth, coarse;
    for (const DenoisingGrid& grid : grids) {
        const int vertices = grid.clean->mesh().vertex_count();
        double highest = 0, lowest = infinity;
        for (const NoisyTrial& trial : grid.trials) {
            if (trial.found.by_shape.step == 0 || !(trial.elsewhere > 0)) continue;
            highest = std::max(highest, trial.on_features / trial.elsewhere);
            lowest = std::min(lowest, trial.on_features / trial.elsewhere);
        }
        const report::Facts facts{"mesh"_a = grid.name(), "features"_a = grid.feature_vertices, "vertices"_a = vertices,
                                  "lowest"_a = readable(lowest, 2), "highest"_a = readable(highest, 2)};
        if (grid.feature_vertices == 0)
            smooth.push_back(grid.name());
        else if (2 * grid.feature_vertices > vertices)
            coarse.push_back(words.line("features.mesh.coarse", facts));
        else if (highest > 0)
            (lowest > 1 ? rounded : alike).push_back(words.line(highest > lowest ? "features.mesh.range" : "features.mesh", facts));
    }
    return paragraph_of({said_of(rounded, words, "features.rounded"), said_of(alike, words, "features.alike"),
                         said_of(smooth, words, "features.none"), said_of(coarse, words, "features.coarse")});
}

/// What it costs not to stop: the case that loses most in four times as many iterations.
report::Text going_on(const Grids& grids) {
    const auto after = [](const Case& c) {
        return shape_rms(c.whole.clean->mesh(), c.whole.clean->prepared->topology.vertex_faces, c.part.over.X);
    };
    std::vector<Case> helped;
    std::ranges::copy_if(cases_of(grids), std::back_inserter(helped), [](const Case& c) { return c.part.found.by_shape.step > 0; });
    if (helped.empty()) return {};
    const auto loss = [&](const Case& c) { return after(c) / c.part.found.by_shape.shape; };
    const Case& worst = *std::ranges::max_element(helped, {}, loss);
    report::Facts facts = facts_of(worst.whole, worst.part);
    if (loss(worst) < 1.05) return {};
    facts.push_back("loss"_a = readable(loss(worst), 2));
    return words.say("going_on", facts);
}

}   // namespace

void add_discussion(report::Section& section, const Grids& grids) {
    add_words(section, words, "discussion");
    add_paragraphs(section, {verdict(grids), paragraph_of({limits_in_mean_edges(grids), why(grids)}),
                             paragraph_of({noise_and_amount(grids), measures_disagree(grids), going_on(grids)}),
                             paragraph_of({drift(grids), features(grids), words.say("elsewhere")})});
}

}   // namespace meshfolio::q7_denoising
