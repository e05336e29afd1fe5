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

/// In how many cases a measure gains so much, of those that have it: noise within a plane changes neither surface nor normals.
struct Count {
    std::ptrdiff_t reached = 0, measured = 0;
};
Count count_of(const Grids& grids, const Measure& measure, double gain) {
    Count count;
    for (const Case& c : cases_of(grids)) {
        count.measured += std::isnan(c.part.gain(measure)) ? 0 : 1;
        count.reached += c.part.gain(measure) >= gain ? 1 : 0;
    }
    return count;
}

/// "rounded edges and lost volume", and noise along the surface that stays, as far as they are seen.
report::Text price_of(const Grids& grids) {
    Names losses;
    if (most_rounded(grids)) losses.push_back(words.line("loss.edges"));
    if (most_shrunk(grids)) losses.push_back(words.line("loss.volume"));
    return paragraph_of({said_of(losses, words, "loss"), most_drifting(grids) ? words.say("loss.along") : report::Text()});
}

/// In how many cases smoothing works and helps, measure by measure.
report::Text verdict(const Grids& grids) {
    report::Text told;
    for (const Measure& measure : measures) {
        const Count working = count_of(grids, measure, works);
        report::Facts facts{"works"_a = working.reached, "helps"_a = count_of(grids, measure, helps).reached, "cases"_a = working.measured};
        if (working.measured == 0) continue;
        if (&measure != &measures[0]) facts.push_back("measure"_a = words.line("by." + std::string(measure.key)));
        told = paragraph_of({told, words.say(&measure == &measures[0] ? "verdict.measure" : "verdict.other", facts)});
    }
    return told;
}

/// Where the surface is nearer, but the volume lost: no success.
report::Text shrunk(const Grids& grids) {
    Names told;
    for (const Case& c : cases_of(grids))
        if (c.part.shrinks() && c.part.gain(measures[0]) >= helps) told.push_back(words.line("shrunk.case", facts_of(c.whole, c.part)));
    return told.empty() ? report::Text() : words.say("shrunk", "cases"_a = listed(told));
}

report::Facts facts_of(const NoiseSplit& split) {
    return {"halved"_a = readable(split.smallest_halved, 2), "other"_a = readable(split.largest_other, 2)};
}

/// Whether the noise in mean edges tells the cases that are halved from the others.
report::Text noise_in_mean_edges(const Grids& grids) {
    const NoiseSplit split = noise_split(grids);
    if (!std::isfinite(split.smallest_halved) || split.largest_other == 0) return {};
    return words.say(split.decides() ? "split.clean" : "split.mixed", facts_of(split));
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

/// Where the strongest noise tried gains most, it is not too strong; what is left of it is a lot all the same.
report::Text strongest_noise(const Grids& grids) {
    Names meshes;
    double angle = infinity;
    for (const DenoisingGrid& grid : grids) {
        const auto gain = [](const NoisyTrial& trial) { return trial.gain(measures[0]); };
        const NoisyTrial& last = grid.trials.back();
        if (grid.trials.size() < 2 || last.shrinks() ||
            !std::ranges::all_of(grid.trials, [&](const NoisyTrial& t) { return gain(t) <= gain(last); }))
            continue;
        meshes.push_back(grid.name());
        angle = std::min(angle, last.found.by_angle.angle);
    }
    constexpr double crumpled = 10 * pi / 180;
    return paragraph_of({said_of(meshes, words, "strong"), !meshes.empty() && angle > crumpled
                                                               ? words.say("strong.crumpled", "angle"_a = readable(180 / pi * angle, 2))
                                                               : report::Text()});
}

/// What one iteration takes from the clean mesh, beside the least and the most noise.
report::Text why(const Grids& grids) {
    const DenoisingGrid& grid = hardest(grids);
    const auto told = [&](const NoisyTrial& trial, const char* key) {
        report::Facts facts = facts_of(grid, trial);
        facts.push_back("taken"_a = readable(grid.taken_at_once(trial), 2));
        return words.say(key, facts);
    };
    const NoisyTrial &least = grid.trials.front(), &most = grid.trials.back();
    const bool rises = grid.after_one(least) > 1 && grid.taken_at_once(least) > 1;
    const bool falls = grid.after_one(most) < 1 && grid.taken_at_once(most) < 0.5;
    const bool smaller = least.improved() && least.found.by_shape.value < grid.middle_lambda();
    return paragraph_of({words.say("explained", "mesh"_a = grid.name()), rises ? told(least, "explained.rises") : report::Text(),
                         rises && smaller ? words.say("explained.smaller") : report::Text(),
                         falls ? told(most, "explained.falls") : report::Text()});
}

/// What the pictures of one mesh show.
report::Text reading(const DenoisingGrid& grid) {
    const NoisyTrial& trial = grid.pictured();
    report::Facts facts = facts_of(grid, trial);
    if (!trial.improved()) return words.say("reading.no_better", facts);
    const Remains& left = trial.remains;
    const bool at_edges = grid.has_features() && left.features.times() > 1.2;
    const bool at_bends = !at_edges && left.curved.times() > 1.2;
    const std::string verdict = verdict_on(trial);
    return paragraph_of({words.say(verdict == "works"     ? "reading.works"
                                   : verdict == "shrinks" ? "reading.shrinks"
                                   : verdict == "helps"   ? "reading.helps"
                                                          : "reading.fails",
                                   facts),
                         at_edges   ? words.say("reading.edges", facts)
                         : at_bends ? words.say("reading.bends", facts)
                                    : report::Text()});
}

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
    const auto [least, largest] = std::ranges::minmax_element(measures, {}, [&](const Measure& measure) { return time(most, measure); });
    facts.push_back("least"_a = readable(time(most, *least), 2));
    facts.push_back("largest"_a = readable(time(most, *largest), 2));
    facts.push_back("first"_a = words.line("measure." + std::string(least->key)));
    facts.push_back("last"_a = words.line("measure." + std::string(largest->key)));
    return words.say("disagree", facts);
}

/// What it costs not to stop: of the pictured cases the one that loses most in four times as many iterations.
report::Text going_on(const Grids& grids) {
    report::Facts facts;
    double most = 1.05;
    for (const DenoisingGrid& grid : grids) {
        const NoisyTrial& trial = grid.pictured();
        if (!trial.improved()) continue;
        const TriangleMesh& clean = grid.clean->mesh();
        const double after = shape_rms(clean, grid.clean->prepared->topology.vertex_faces, trial.over.X);
        if (!(after > most * trial.found.by_shape.shape)) continue;
        most = after / trial.found.by_shape.shape;
        facts = facts_of(grid, trial);
    }
    if (facts.empty()) return {};
    facts.push_back("loss"_a = readable(most, 2));
    return words.say("going_on", facts);
}

/// What smoothing cannot do, picture by picture.
report::Text cannot(const Grids& grids) {
    const auto left = [](const DenoisingGrid* grid) -> const Remains& { return grid->pictured().remains; };
    const DenoisingGrid *drift = most_drifting(grids), *edges = most_rounded(grids), *volume = most_shrunk(grids);
    if (!drift && !edges && !volume) return {};
    const auto degrees = [](double angle) { return readable(180 / pi * angle, 2); };
    return paragraph_of(
        {words.say("cannot"),
         drift ? words.say("cannot.drift", "mesh"_a = drift->name(), "share"_a = readable_percent(left(drift).along, 2)) : report::Text(),
         edges ? words.say("cannot.edges", "mesh"_a = edges->name(), "times"_a = readable(edges->pictured().taken.features.times(), 2),
                           "there"_a = degrees(left(edges).feature_angle), "elsewhere"_a = degrees(left(edges).other_angle))
               : report::Text(),
         volume ? words.say("cannot.volume", "mesh"_a = volume->name(), "lost"_a = readable_percent(1 - volume->pictured().taken.volume, 2))
                : report::Text()});
}

/// Meshes whose edges cannot be looked at, and why.
report::Text no_edges(const Grids& grids) {
    Names smooth, coarse;
    for (const DenoisingGrid& grid : grids)
        if (!grid.has_features()) (grid.feature_vertices == 0 ? smooth : coarse).push_back(grid.name());
    return paragraph_of({said_of(smooth, words, "features.none"), said_of(coarse, words, "features.coarse")});
}

}   // namespace

report::Text answer_of(const Grids& grids) {
    const Count helped = count_of(grids, measures[0], helps), halved = count_of(grids, measures[0], works);
    if (helped.reached == 0) return paragraph_of({words.say("answer.none"), price_of(grids)});
    const NoiseSplit split = noise_split(grids);
    report::Text told =
        split.decides() ? words.say("answer.split", facts_of(split))
                        : words.say("answer.mixed", "helps"_a = helped.reached, "works"_a = halved.reached, "cases"_a = helped.measured);
    return paragraph_of({told, least_gain(grids), shrunk(grids), price_of(grids)});
}

report::Text summary_of(const Grids& grids) { return verdict(grids); }

void add_discussion(report::Section& section, const Grids& grids) {
    const bool improved = std::ranges::any_of(grids, [](const DenoisingGrid& grid) { return grid.pictured().improved(); });
    report::Text seen = words.say(improved ? "reading" : "reading.noise");
    for (const DenoisingGrid& grid : grids) seen = paragraph_of({seen, reading(grid)});
    add_paragraphs(section, {seen, paragraph_of({why(grids), noise_in_mean_edges(grids), strongest_noise(grids), going_on(grids)}),
                             paragraph_of({noise_and_amount(grids), measures_disagree(grids)}),
                             paragraph_of({cannot(grids), no_edges(grids), words.say("elsewhere")})});
}

}   // namespace meshfolio::q7_denoising
