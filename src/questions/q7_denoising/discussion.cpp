#include "questions/q7_denoising/parts.h"

namespace meshfolio::q7_denoising {

namespace {

/// Says that the noise in mean edges does not separate the cases that are halved; if it does, the answer says so.
report::Text noise_in_mean_edges(const Grids& grids) {
    const NoiseSplit split = noise_split(grids);
    if (!std::isfinite(split.smallest_halved) || split.largest_other == 0 || split.decides()) return {};
    return words.say("split.mixed", "halved"_a = readable(split.smallest_halved, 2), "other"_a = readable(split.largest_other, 2));
}

/// Names the meshes whose normals gain most at less than the strongest noise.
report::Text strongest_by_normals(const Grids& grids) {
    const Measure& normals = measures[2];
    Names told;
    for (const DenoisingGrid& grid : grids) {
        const NoisyTrial& last = grid.trials.back();
        const auto gain = [&](const NoisyTrial& trial) { return std::isnan(trial.gain(normals)) ? 0 : trial.gain(normals); };
        const NoisyTrial& most = *std::ranges::max_element(grid.trials, {}, gain);
        if (!(gain(most) > 1.05 * gain(last))) continue;
        told.push_back(words.line("strong.normals.mesh", "mesh"_a = grid.name(), "most"_a = readable(gain(most), 2),
                                  "noise"_a = readable_percent(most.relative, 2), "last"_a = readable(gain(last), 2),
                                  "strongest"_a = readable_percent(last.relative, 2)));
    }
    return said_of(told, words, "strong.normals");
}

/// Says that the strongest noise is not too strong where it gains most, and how much error is left.
report::Text strongest_noise(const Grids& grids) {
    Names meshes;
    double angle = infinity, strongest = infinity;
    for (const DenoisingGrid& grid : grids) {
        const auto gain = [](const NoisyTrial& trial) { return trial.gain(measures[0]); };
        const NoisyTrial& last = grid.trials.back();
        if (grid.trials.size() < 2 || !last.improved() || verdict_on(last) == "shrinks" ||
            !std::ranges::all_of(grid.trials, [&](const NoisyTrial& t) { return gain(t) <= gain(last); }))
            continue;
        meshes.push_back(grid.name());
        angle = std::min(angle, last.found.by_angle.angle);
        strongest = std::min(strongest, last.relative);
    }
    constexpr double crumpled = 10 * pi / 180;
    if (meshes.empty()) return {};
    return paragraph_of({words.say("strong", "meshes"_a = listed(meshes), "noise"_a = readable_percent(strongest, 2)),
                         strongest_by_normals(grids),
                         angle > crumpled ? words.say("strong.crumpled", "angle"_a = readable(180 / pi * angle, 2)) : report::Text()});
}

report::Text reading(const DenoisingGrid& grid) {
    const NoisyTrial& trial = grid.pictured();
    if (!trial.improved()) return words.say("reading.no_better", facts_of(grid, trial));
    const Remains& left = trial.remains;
    const bool at_edges = grid.has_features() && left.features.times() > 1.2;
    const bool at_bends = !at_edges && left.curved.times() > 1.2;
    const std::string verdict = verdict_on(trial);
    const report::Facts facts = facts_of(grid, trial, {"times"_a = readable((at_edges ? left.features : left.curved).times(), 2)});
    return paragraph_of({words.say(verdict == "works"     ? "reading.works"
                                   : verdict == "shrinks" ? "reading.shrinks"
                                   : verdict == "helps"   ? "reading.helps"
                                                          : "reading.fails",
                                   facts),
                         at_edges   ? words.say("reading.edges", facts)
                         : at_bends ? words.say("reading.bends", facts)
                                    : report::Text()});
}

/// The cases with the least and the largest gain, where they are pictured beside those of the meshes.
report::Text extremes(const Grids& grids) {
    report::Text told;
    for (const Case& c : pictured_cases(grids)) {
        if (&c.part == &c.whole.pictured() || !c.part.improved()) continue;
        const bool is_least = &c.part == &hardest_in(hardest(grids));
        const bool alike = is_least && c.part.gain(measures[0]) < 1.2;
        told = paragraph_of({told, words.say(alike      ? "reading.least.alike"
                                             : is_least ? "reading.least"
                                                        : "reading.most",
                                             facts_of(c.whole, c.part))});
    }
    return told;
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

/// Another step that reaches nearly as much at nearly the same λt, where there is one.
report::Text as_good_at_equal_time(const DenoisingGrid& grid, const NoisyTrial& trial) {
    const SearchState& best = trial.found.by_shape;
    const SearchState* other = nullptr;
    for (const SearchState& state : trial.states)
        if (state.value != best.value && (!other || state.shape < other->shape)) other = &state;
    if (!trial.improved() || !other || is_unended(grid, best)) return {};
    const double share = best.shape / other->shape, times = other->value * other->step / (best.value * best.step);
    if (share < 0.9 || times < 1 / 1.5 || times > 1.5) return {};
    return words.say("map.time", "noise"_a = readable_percent(trial.relative, 2), "other"_a = readable(other->value, 2),
                     "share"_a = readable_percent(share, 2));
}

/// What the map of the gain shows: where the best cell goes as the noise grows, that λt counts, and which steps only harm.
report::Text map_read(const Grids& grids) {
    const DenoisingGrid& grid = leading(grids);
    const NoisyTrial &first = grid.trials.front(), &last = grid.trials.back();
    const double low = first.found.by_shape.value, high = last.found.by_shape.value;
    report::Facts facts{"map"_a = id_of("q7", grid.name(), "gains"), "low"_a = readable(low, 2), "high"_a = readable(high, 2),
                        "noise"_a = readable_percent(first.relative, 2), "largest"_a = readable(grid.lambdas.back(), 2)};
    const auto gains = [&](const SearchState& state) {
        return state.value == grid.lambdas.back() && state.shape < first.found.noisy.shape;
    };
    const bool harms = grid.lambdas.size() > 1 && first.improved() && std::ranges::none_of(first.states, gains);
    return paragraph_of({words.say(first.improved() && last.improved() && low < high ? "map.grows" : "map", facts),
                         as_good_at_equal_time(grid, last), harms ? words.say("map.harms", facts) : report::Text()});
}

/// Finds the case where the measures differ most in how much smoothing they ask for.
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
    const auto [least, largest] = std::ranges::minmax_element(measures, {}, [&](const Measure& measure) { return time(most, measure); });
    return words.say("disagree", facts_of(most.whole, most.part,
                                          {"least"_a = readable(time(most, *least), 2), "largest"_a = readable(time(most, *largest), 2),
                                           "first"_a = words.line("measure." + std::string(least->key)),
                                           "last"_a = words.line("measure." + std::string(largest->key))}));
}

/// What it costs not to stop: of the pictured cases the one that loses most in four times as many iterations.
report::Text going_on(const Grids& grids) {
    const DenoisingGrid* loser = nullptr;
    double most = 1.05;
    for (const DenoisingGrid& grid : grids) {
        const NoisyTrial& trial = grid.pictured();
        if (!trial.improved()) continue;
        const TriangleMesh& clean = grid.clean->mesh();
        const double after = shape_rms(clean, trial.over.X);
        if (!(after > most * trial.found.by_shape.shape)) continue;
        most = after / trial.found.by_shape.shape;
        loser = &grid;
    }
    return loser ? words.say("going_on", facts_of(*loser, loser->pictured(), {"loss"_a = readable(most, 2)})) : report::Text();
}

/// Why the clean mesh, smoothed alike, loses more than the noisy one: said where the larger area explains at least half of it.
report::Text less_by_area(const DenoisingGrid& grid) {
    const double kept = grid.pictured().volume_by(measures[0]), alike = grid.pictured().taken.volume, less = grid.kept_by_less;
    if (!(kept > alike + 0.02 && std::abs(kept - less) < 0.5 * (kept - alike) && grid.noisy_area > 1.05)) return {};
    return words.say("cannot.area", "mesh"_a = grid.name(), "kept"_a = readable_percent(kept, 2), "area"_a = readable(grid.noisy_area, 2),
                     "less"_a = readable_percent(less, 2));
}

/// A message on the noise along the surface, at the noise to look at; it may also grow.
report::Text along_surface(const DenoisingGrid& grid) {
    const NoisyTrial& trial = grid.pictured();
    return words.say(trial.removed_along() > 0 ? "cannot.drift" : "cannot.drift.grows", "mesh"_a = grid.name(),
                     "along"_a = readable_percent(std::abs(trial.removed_along()), 2),
                     "across"_a = readable_percent(trial.removed_across(), 2));
}

/// Explains the lost volume: the shape is thin for so much smoothing.
report::Text thin(const Grids& grids) {
    const DenoisingGrid* thinnest = nullptr;
    double elsewhere = 1;
    for (const DenoisingGrid& grid : grids)
        if (verdict_on(grid.pictured()) == "shrinks" && (!thinnest || grid.ball_kept() < thinnest->ball_kept())) thinnest = &grid;
    if (!thinnest) return {};
    bool others = false;
    for (const DenoisingGrid& grid : grids) {
        if (&grid == thinnest || std::isnan(grid.ball_kept()) || !grid.pictured().improved()) continue;
        elsewhere = std::min(elsewhere, grid.ball_kept());
        others = true;
    }
    if (!(thinnest->ball_kept() < elsewhere)) return {};
    const report::Facts facts{"mesh"_a = thinnest->name(), "radius"_a = readable(thinnest->thickness, 2),
                              "kept"_a = readable_percent(thinnest->ball_kept(), 2), "elsewhere"_a = readable_percent(elsewhere, 2)};
    return paragraph_of({words.say("thin", facts), others ? words.say("thin.elsewhere", facts) : report::Text()});
}

/// For whoever has no clean mesh: what the rule that needs none reaches of the best gain, and where it does harm.
report::Text without_clean(const Grids& grids) {
    const std::vector<Case> cases = cases_of(grids);
    double sum = 0;
    int all = 0;
    bool all_as_noisy = true;
    Names harmed;
    const Case *least = nullptr, *worst = nullptr;   // by share of the best gain, by gain
    for (const Case& c : cases) {
        const Stopped& stopped = c.part.stopped;
        if (std::isnan(stopped.share())) continue;
        sum += stopped.share(), ++all;
        if (!least || stopped.share() < least->part.stopped.share()) least = &c;
        if (!worst || stopped.gain < worst->part.stopped.gain) worst = &c;
        all_as_noisy = all_as_noisy && std::abs(stopped.gain - 1) < 0.01;
        if (stopped.gain < 1) harmed.push_back(words.line("samples.case", facts_of(c.whole, c.part)));
    }
    if (all == 0) return {};
    if (all_as_noisy) return words.say("stopped.nothing");
    const Case& told = harmed.empty() ? *least : *worst;
    const report::Facts facts = facts_of(
        told.whole, told.part,
        {"mean"_a = readable_percent(sum / all, 2), "worst"_a = readable_percent(least->part.stopped.share(), 2),
         "middle"_a = readable(grids.front().middle_lambda(), 2), "harmed"_a = harmed.size(), "all"_a = all, "cases"_a = listed(harmed),
         "times"_a = readable(1 / worst->part.stopped.gain, 2), "false"_a = readable(worst->whole.fitted_to_clean, 2)});
    const bool by_shape = !harmed.empty() && worst->whole.fitted_to_clean * worst->whole.mean_edge > worst->part.sigma;
    return paragraph_of({words.say("stopped", facts), words.say(harmed.empty() ? "stopped.least" : "stopped.harms", facts),
                         by_shape ? words.say("stopped.shape", facts) : report::Text()});
}

/// Noise along the normals alone, and on few vertices.
report::Text other_noise(const Grids& grids) {
    std::vector<double> normal, impulsive;
    for (const DenoisingGrid& grid : grids) {
        if (grid.other_gains.size() != 2 || std::isnan(grid.other_gains[0] + grid.other_gains[1])) continue;
        normal.push_back(grid.other_gains[0]);
        impulsive.push_back(grid.other_gains[1]);
    }
    if (normal.empty()) return {};
    const auto least = [](const std::vector<double>& gains) { return readable(std::ranges::min(gains), 2); };
    return words.say("other_noise", "normal"_a = least(normal), "impulsive"_a = least(impulsive));
}

/// What smoothing cannot do, picture by picture.
report::Text cannot(const Grids& grids) {
    const auto left = [](const DenoisingGrid* grid) -> const Remains& { return grid->pictured().remains; };
    const DenoisingGrid *drift = most_drifting(grids), *edges = most_rounded(grids), *volume = most_shrunk(grids);
    if (!drift && !edges && !volume) return {};
    const auto degrees = [](double angle) { return readable(180 / pi * angle, 2); };
    return paragraph_of(
        {words.say("cannot"), drift ? along_surface(*drift) : report::Text(),
         edges ? words.say("cannot.edges", "mesh"_a = edges->name(), "times"_a = readable(edges->pictured().taken.features.times(), 2),
                           "there"_a = degrees(left(edges).feature_angle), "elsewhere"_a = degrees(left(edges).other_angle))
               : report::Text(),
         thin(grids),
         volume ? words.say("cannot.volume", "mesh"_a = volume->name(), "lost"_a = readable_percent(1 - volume->pictured().taken.volume, 2))
                : report::Text(),
         volume ? less_by_area(*volume) : report::Text()});
}

/// Meshes whose edges cannot be looked at, and why.
report::Text no_edges(const Grids& grids) {
    const Names smooth = names_where(grids, [](const DenoisingGrid& grid) { return grid.feature_vertices == 0; });
    const Names coarse = names_where(grids, [](const DenoisingGrid& grid) { return grid.feature_vertices > 0 && !grid.has_features(); });
    return paragraph_of({said_of(smooth, words, "features.none"), said_of(coarse, words, "features.coarse")});
}

}   // namespace

report::Text explanation_of(const Grids& grids) {
    const DenoisingGrid& grid = hardest(grids);
    const auto told = [&](const NoisyTrial& trial, const char* key) {
        return words.say(
            key,
            facts_of(grid, trial, {"taken"_a = readable(grid.taken_at_once(trial), 2), "middle"_a = readable(grid.middle_lambda(), 2)}));
    };
    const NoisyTrial &least = grid.trials.front(), &most = grid.trials.back();
    const bool rises = grid.after_one(least) > 1 && grid.taken_at_once(least) > 1;
    const bool falls = grid.after_one(most) < 1 && grid.taken_at_once(most) < 0.5;
    const bool smaller = least.improved() && least.found.by_shape.value < grid.middle_lambda();
    return paragraph_of({words.say("explained"), rises ? told(least, "explained.rises") : report::Text(),
                         rises && smaller ? words.say("explained.smaller") : report::Text(),
                         falls ? told(most, "explained.falls") : report::Text()});
}

report::Text reading_of(const Grids& grids) {
    const bool improved = std::ranges::any_of(grids, [](const DenoisingGrid& grid) { return grid.pictured().improved(); });
    report::Text seen = words.say(improved ? "reading" : "reading.noise");
    for (const DenoisingGrid& grid : grids) go_on(seen, reading(grid));
    return paragraph_of({seen, extremes(grids), going_on(grids)});
}

report::Text strength_of(const Grids& grids) { return paragraph_of({noise_in_mean_edges(grids), strongest_noise(grids)}); }

report::Text amount_of(const Grids& grids) { return paragraph_of({map_read(grids), noise_and_amount(grids), measures_disagree(grids)}); }

report::Text beyond_of(const Grids& grids) { return paragraph_of({without_clean(grids), other_noise(grids)}); }

report::Text limits_of(const Grids& grids) { return paragraph_of({cannot(grids), no_edges(grids)}); }

}   // namespace meshfolio::q7_denoising
