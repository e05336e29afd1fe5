// The facts of question 7; templates/words/q7.md chooses among them.
#include "questions/q7_denoising/study.h"

namespace meshfolio::q7_denoising {

namespace {

constexpr double clearly = 1.2;   // smaller ratios are not mentioned

std::string degrees(double angle) { return readable(180 / pi * angle, 2); }

/// Counts of each verdict, and the noise that separates them.
void add_verdict_facts(report::Facts& facts, const Grids& grids) {
    const std::vector<Case> cases = cases_of(grids);
    const auto count = [&](std::string_view verdict) {
        return std::ranges::count_if(cases, [&](const Case& c) { return verdict_on(c.part) == verdict; });
    };
    const NoiseSplit split = noise_split(grids);
    Names shrinking;
    for (const Case& c : cases)
        if (verdict_on(c.part) == "shrinks") shrinking.push_back(c.whole.name());
    const auto rises = [](const DenoisingGrid& grid) {
        return grid.trials.size() > 1 && std::ranges::is_sorted(grid.trials, {}, [](auto& t) { return t.gain(); });
    };
    const bool gained = std::ranges::any_of(cases, [](const Case& c) { return c.part.gain() >= helps; });
    facts.insert(facts.end(),
                 {"rises"_a = gained && std::ranges::all_of(grids, rises), "works"_a = count("works"), "helps"_a = count("helps"),
                  "fails"_a = count("fails"), "shrinks"_a = count("shrinks"), "cases"_a = std::ssize(cases) - count("–"),
                  "gained"_a = count("works") + count("helps") + count("shrinks"), "shrinking"_a = listed(each_once(shrinking)),
                  "always"_a = std::isfinite(split.always_from) ? readable(split.always_from, 2) : "",
                  "never"_a = split.never_to > 0 ? readable(split.never_to, 2) : "", "between"_a = !split.decides});
}

/// Dependence of the gain on the sample of the noise.
void add_sample_facts(report::Facts& facts, const Grids& grids) {
    const auto level = [](double gain) { return gain >= works ? 2 : gain >= helps ? 1 : 0; };
    std::size_t samples = 0, open = 0;
    double spread = 0;
    for (const Case& c : cases_of(grids)) {
        samples = std::max(samples, c.part.further_gains.size());
        spread = std::fmax(spread, c.part.spread() / c.part.gain());
        open += std::ranges::any_of(c.part.further_gains, [&](double gain) { return level(gain) != level(c.part.gain()); }) ? 1 : 0;
    }
    facts.insert(facts.end(), {"samples"_a = samples > 0 ? samples + 1 : 0, "spread"_a = readable_percent(spread, 2), "open"_a = open});
}

/// The meshes where the strongest noise gains most, with the verdict "works".
void add_strength_facts(report::Facts& facts, const Grids& grids) {
    const auto strongest_gains_most = [](const DenoisingGrid& grid) {
        const NoisyTrial& last = grid.trials.back();
        return grid.trials.size() > 1 && verdict_on(last) == "works" &&
               std::ranges::all_of(grid.trials, [&](const NoisyTrial& t) { return t.gain() <= last.gain(); });
    };
    double angle = infinity, noise = infinity;
    for (const DenoisingGrid& grid : grids) {
        if (!strongest_gains_most(grid)) continue;
        angle = std::min(angle, grid.trials.back().found.by_shape.angle);
        noise = std::min(noise, grid.trials.back().relative);
    }
    facts.insert(facts.end(), {"strong"_a = listed(names_where(grids, strongest_gains_most)), "strongest"_a = readable_percent(noise, 2),
                               "crumpled"_a = degrees(angle)});
}

/// Places of the largest distance left, and the cost of smoothing on.
void add_state_facts(report::Facts& facts, const Grids& grids) {
    const auto at_edges = [](const DenoisingGrid& grid) {
        const NoisyTrial& trial = grid.pictured();
        return trial.improved() && grid.has_features() && trial.residual.features.times() > clearly;
    };
    const auto at_bends = [&](const DenoisingGrid& grid) {
        const NoisyTrial& trial = grid.pictured();
        return trial.improved() && !at_edges(grid) && trial.residual.curved.times() > clearly;
    };
    const DenoisingGrid* loser = nullptr;
    double loss = clearly;
    for (const DenoisingGrid& grid : grids) {
        const NoisyTrial& trial = grid.pictured();
        if (!trial.improved()) continue;
        const double times = shape_rms(grid.clean->mesh(), trial.over.X) / trial.found.by_shape.shape;
        if (times > loss) loser = &grid, loss = times;
    }
    facts.insert(facts.end(), {"seen"_a = std::ranges::any_of(grids, [](const DenoisingGrid& grid) { return grid.pictured().improved(); }),
                               "at_edges"_a = listed(names_where(grids, at_edges)), "at_bends"_a = listed(names_where(grids, at_bends)),
                               "loser"_a = loser ? loser->name() : "", "loss"_a = readable(loss, 2)});
}

/// Losses at edges and of volume and drift along the surface, each on the mesh with the largest.
void add_cost_facts(report::Facts& facts, const Grids& grids) {
    const DenoisingGrid *drift = most_drifting(grids), *edges = most_rounded(grids), *volume = most_shrunk(grids);
    const NoisyTrial none;
    const auto trial = [&](const DenoisingGrid* grid) -> const NoisyTrial& { return grid ? grid->pictured() : none; };
    const double along = trial(drift).removed_along();
    const auto coarse = [](const DenoisingGrid& grid) { return grid.feature_vertices > 0 && !grid.has_features(); };
    facts.insert(facts.end(),
                 {"costs"_a = edges || volume, "rounded"_a = edges ? edges->name() : "",
                  "times"_a = readable(trial(edges).clean_loss.features.times(), 2),
                  "normals_there"_a = degrees(trial(edges).residual.feature_angle),
                  "normals_elsewhere"_a = degrees(trial(edges).residual.other_angle), "coarse"_a = listed(names_where(grids, coarse)),
                  "shrunk"_a = volume ? volume->name() : "", "lost"_a = readable_percent(1 - trial(volume).clean_loss.volume, 2),
                  "lost_noisy"_a = readable_percent(1 - trial(volume).residual.volume, 2), "drifting"_a = drift ? drift->name() : "",
                  "grows"_a = along < 0, "grown"_a = readable(std::sqrt(1 - along), 2), "along"_a = readable_percent(along, 2),
                  "across"_a = readable_percent(trial(drift).removed_across(), 2)});
}

/// The least gain over the meshes for each other kind of noise.
void add_other_noise_facts(report::Facts& facts, const Grids& grids) {
    double normal = infinity, same = infinity, best = infinity, spread = infinity, gaussian = infinity;
    for (const DenoisingGrid& grid : grids) {
        for (const OtherNoise& other : grid.other_noise) {
            if (std::isnan(other.same)) continue;
            if (other.kind == NoiseKind::normal) normal = std::min(normal, other.same);
            if (other.kind != NoiseKind::impulsive) continue;
            same = std::min(same, other.same), best = std::min(best, other.best), spread = std::fmin(spread, other.spread);
            gaussian = std::min(gaussian, grid.pictured().gain());
        }
    }
    facts.insert(facts.end(), {"others"_a = std::isfinite(normal) && std::isfinite(same), "normal"_a = readable(rounded_down(normal, 2), 2),
                               "impulsive"_a = readable(rounded_down(same, 2), 2), "impulsive_best"_a = readable(rounded_down(best, 2), 2),
                               "gaussian"_a = readable(rounded_down(gaussian, 2), 2), "harder"_a = same < gaussian,
                               "spills"_a = std::isfinite(spread) && spread > 0.1, "spill"_a = readable_percent(spread, 2)});
}

/// The rule that needs no clean mesh: its share of the best gain, and the number of cases where it fails or does harm.
void add_rule_facts(report::Facts& facts, const Grids& grids) {
    double sum = 0;
    int all = 0, failed = 0, harmed = 0;
    const Case* worst = nullptr;
    const std::vector<Case> cases = cases_of(grids);
    for (const Case& c : cases) {
        const Stopped& stopped = c.part.stopped;
        if (std::isnan(stopped.share())) continue;
        sum += stopped.share(), ++all;
        failed += stopped.fails() ? 1 : 0;
        harmed += stopped.harms() ? 1 : 0;
        if (!worst || stopped.gain < worst->part.stopped.gain) worst = &c;
    }
    const bool by_shape = harmed > 0 && worst->whole.fitted_to_clean > worst->whole.edges(worst->part);
    facts.insert(facts.end(), {"rules"_a = all, "reached"_a = readable_percent(sum / std::max(all, 1), 2), "rule_fails"_a = failed,
                               "rule_harms"_a = harmed, "middle"_a = readable(grids.front().middle_lambda(), 2),
                               "mistaken"_a = by_shape ? worst->whole.name() : "",
                               "mistaken_edges"_a = readable(worst ? worst->whole.fitted_to_clean : 0, 2)});
}

/// Counts of halved errors by the other measures, and another λ with nearly the largest gain at nearly the same λt.
void add_measure_facts(report::Facts& facts, const Grids& grids) {
    const auto works_by = [cases = cases_of(grids)](const Measure& measure) {
        return std::ranges::count_if(cases, [&](const Case& c) { return c.part.gain(measure) >= works; });
    };
    const DenoisingGrid& grid = grid_with_largest_gain(grids);
    const NoisyTrial& trial = *std::ranges::max_element(grid.trials, {}, [](const NoisyTrial& t) { return std::fmax(0, t.gain()); });
    const SearchState& best = trial.found.by_shape;
    const SearchState* other = nullptr;
    for (const SearchState& state : trial.states)
        if (state.value != best.value && (!other || state.shape < other->shape)) other = &state;
    const double times = other && trial.improved() ? other->value * other->step / trial.amount() : 0;
    const bool alike = times > 1 / 1.5 && times < 1.5 && best.shape > 0.9 * other->shape;
    facts.insert(facts.end(),
                 {"works_by_places"_a = works_by(measures[1]), "works_by_normals"_a = works_by(measures[2]), "best_mesh"_a = grid.name(),
                  "map"_a = id_of("q7", grid.name(), "gains"), "other_lambda"_a = readable(alike ? other->value : 0, 2),
                  "share"_a = alike ? readable_percent(best.shape / other->shape, 2) : ""});
}

/// The plots of modes and errors of one mesh.
void add_reason_facts(report::Facts& facts, const Reasons& reasons) {
    if (!reasons.grid) {
        for (const char* name : {"mesh", "wave", "sum", "low", "high", "weakest", "weakest_gain", "larger"}) facts.push_back({name, ""});
        for (const char* name : {"crosses", "above", "modes", "all", "exceeds", "sums", "later", "joins", "slower"})
            facts.push_back({name, 0});
        return;
    }
    const DenoisingGrid& grid = *reasons.grid;
    const NoisyTrial &first = grid.trials.front(), &last = grid.trials.back();
    const double deviation = reasons.parts.deviation_of_sum();
    const double larger = surface_area(grid.pictured().noisy) / surface_area(grid.clean->mesh());
    const bool moved = grid.pictured().amount() > clearly * reasons.parts.best_lambda * reasons.parts.best_step;
    const bool is_weak = grid.trials.size() > 1 && first.gain() < clearly;
    facts.insert(facts.end(),
                 {"mesh"_a = grid.name(), "crosses"_a = reasons.bands.crosses(), "wave"_a = readable(reasons.bands.wavelength(), 2),
                  "above"_a = reasons.bands.above, "modes"_a = reasons.bands.modes, "all"_a = reasons.bands.all,
                  "exceeds"_a = reasons.bands.modes > 0 && reasons.bands.above == reasons.bands.modes, "sums"_a = deviation < 0.25,
                  "sum"_a = deviation < 0.005 ? "" : readable_percent(rounded_up(deviation, 2), 2),
                  "later"_a = first.improved() && last.amount() > clearly * first.amount(), "low"_a = readable(first.amount(), 2),
                  "high"_a = readable(last.amount(), 2), "weakest"_a = is_weak ? readable(grid.edges(first), 2) : "",
                  "weakest_gain"_a = readable(rounded_down(first.gain(), 3), 3), "joins"_a = approaches_clean_curve(reasons),
                  "slower"_a = moved && larger > clearly, "larger"_a = readable(larger, 2)});
}

}   // namespace

report::Facts facts_of(const Grids& grids, const Reasons& reasons) {
    report::Facts facts;
    add_reason_facts(facts, reasons);
    for (const auto add_facts : {add_verdict_facts, add_sample_facts, add_strength_facts, add_state_facts, add_cost_facts,
                                 add_other_noise_facts, add_rule_facts, add_measure_facts})
        add_facts(facts, grids);
    return facts;
}

}   // namespace meshfolio::q7_denoising
