#include "questions/bench/one_ring.h"
#include "questions/q5_explicit/parts.h"
#include "questions/q5_explicit/study.h"

namespace meshfolio::q5_explicit {

namespace {

// ---- one mesh

/// The part of the mesh that the top mode covers.
enum class Extent { spot, region, whole };

/// Returns the extent by the number of vertices that support the top mode.
Extent extent_of_top_mode(const ExplicitStudy& study) {
    const double support = study.subject.top.support;
    if (!(support < 0.1 * study.subject.preflight().vertices_in_use)) return Extent::whole;   // NaN too
    return support < 10 ? Extent::spot : Extent::region;
}

/// Returns the run with the largest stable step beyond half the limit; null if there is none or no step is recommended.
const SmoothingRun* larger_step(const ExplicitStudy& study) {
    const std::size_t beyond = study.first_beyond();
    if (!study.recommended || beyond == 0 || keeps_signs(study.subject, study.runs[beyond - 1].lambda)) return nullptr;
    return &study.runs[beyond - 1];
}

/// Returns E/E' − 1: E the energy after 20 steps of larger_step(), E' that of the recommended step at the same λt; 0 if a run is shorter.
double energy_gap(const ExplicitStudy& study) {
    const SmoothingRun* larger = larger_step(study);
    if (larger == nullptr) return 0;
    const SmoothingRun& half = study.runs[study.recommended->run];
    const std::ptrdiff_t t = 20, u = std::lround(20 * larger->lambda / half.lambda);
    return t < std::ssize(larger->energy) && u < std::ssize(half.energy) ? larger->energy[t] / half.energy[u] - 1 : 0;
}

/// Returns share_rougher() after t iterations of a strip; NaN if that state is not kept.
double rougher_at(const ExplicitStudy& study, const std::optional<Strip>& strip, int t) {
    const Positions* X = strip ? strip->at(t) : nullptr;
    return X ? share_rougher(study.subject, *X) : undefined;
}

/// Returns the number of faces that the recommended run turns over.
int turned_by(const ExplicitStudy& study) { return study.recommended ? study.recommended->stopped.moved.inverted_faces : 0; }

// ---- all meshes

/// Returns the fact `name`: the meshes where `holds` is true.
template <class Holds> report::Fact meshes(std::string_view name, const Studies& studies, const Holds& holds) {
    return {name, listed(names_where(studies, holds))};
}
template <class Holds> report::Fact recommended_meshes(std::string_view name, const Studies& studies, const Holds& holds) {
    return meshes(name, studies, [&](const ExplicitStudy& study) { return study.recommended && holds(*study.recommended); });
}

/// The vertices that set the limit, on the first mesh where a figure rings them.
void add_ringed_facts(report::Facts& facts, const Studies& studies) {
    const auto found =
        std::ranges::find_if(studies, [](const ExplicitStudy& study) { return study.recommended && !limiting_spot(study).empty(); });
    const std::vector<int> spot = found == studies.end() ? std::vector<int>() : limiting_spot(*found);
    double beside = pi, thinnest = 0;
    if (!spot.empty()) thinnest = corner_angles(found->subject.mesh()).minCoeff() * (1 + 1e-9);
    for (const int v : spot) beside = std::min(beside, smallest_angle_around(found->subject.mesh(), found->subject.topology(), v));
    facts.insert(facts.end(), {"ringed"_a = spot.empty() ? "" : found->name(), "peaks"_a = spot.size(),
                               "angle"_a = spot.empty() ? "" : readable(beside * 180 / pi, 2), "thinnest"_a = beside <= thinnest,
                               "figure"_a = recommended_figure(studies)});
}

void add_limit_facts(report::Facts& facts, const Studies& studies) {
    const auto [low, high] = std::ranges::minmax_element(studies, {}, &ExplicitStudy::critical_in_edges);
    const auto [uniform_low, uniform_high] = std::ranges::minmax_element(studies, {}, &ExplicitStudy::uniform_critical);
    // Right triangles of two sides s allow s²/4, and their mean edge is (2 + √2)s/3.
    static const double grid = 0.25 / std::pow((2 + std::sqrt(2.0)) / 3, 2);
    const double times = high->critical_in_edges() / low->critical_in_edges();
    double safe = 1;   // least limit by Gershgorin over λ_crit; 0: not all are proved
    for (const ExplicitStudy& study : studies) safe = std::min(safe, study.subject.safe() / study.subject.critical);
    const double lowest = uniform_low->uniform_critical(), highest = uniform_high->uniform_critical();
    const auto of = [](Extent extent) { return [=](const ExplicitStudy& study) { return extent_of_top_mode(study) == extent; }; };
    facts.insert(facts.end(),
                 {"several"_a = studies.size() > 1, "low"_a = readable(low->critical_in_edges(), 2), "low_mesh"_a = low->name(),
                  "high_mesh"_a = high->name(), "grid"_a = readable(grid, 2), "times"_a = times > 1.5 ? readable(times, 2) : "",
                  meshes("whole", studies, of(Extent::whole)), meshes("region", studies, of(Extent::region)),
                  meshes("spot", studies, of(Extent::spot)), "safe"_a = safe > 0 ? readable_percent(rounded_down(safe, 2), 2) : "",
                  "uniform"_a = span_of(readable(lowest, 3), readable(highest, 3)), "known"_a = lowest > 1 && highest < 1.5});
    add_ringed_facts(facts, studies);
}

void add_step_facts(report::Facts& facts, const Studies& studies) {
    bool signs = true, small = false, any = false;   // all recommended steps keep signs; one is below half the limit; there is one
    double gap = 0;
    Names steps, recommended;
    std::string flips, left, small_left;
    for (const ExplicitStudy& study : studies) {
        if (!study.recommended) continue;
        const SmoothingRun& half = study.recommended->stopped;
        any = true;
        signs = signs && keeps_signs(study.subject, half.lambda);
        small = small || half.lambda < 0.49 * study.subject.critical;
        steps.push_back(words.line("step.mesh", "lambda"_a = readable(half.lambda, 2), "mesh"_a = study.name()));
        recommended.push_back(words.line("stop.mesh", "iterations"_a = half.iterations, "mesh"_a = study.name()));
        gap = std::abs(energy_gap(study)) > std::abs(gap) ? energy_gap(study) : gap;
        const SmoothingRun* larger = larger_step(study);
        if (!larger || !flips.empty()) continue;   // alike on all meshes
        flips = in_limits(study.subject, larger->lambda);
        left = share_left(std::pow(std::abs(1 - larger->lambda * study.subject.top.value), 20));
        small_left = share_left(std::pow(std::abs(1 - half.lambda * study.subject.top.value), 20 * larger->lambda / half.lambda));
    }
    // At equal t, not λt, the larger step leaves less energy and less size, each by 2 % of the input's.
    const auto is_farther = [](const ExplicitStudy& study) {
        constexpr double seen = 0.02;
        const SmoothingRun* larger = larger_step(study);
        if (larger == nullptr) return false;
        const SmoothingRun& half = study.runs[study.recommended->run];
        return half.energy.back() - larger->energy.back() > seen && half.size.back() - larger->size.back() > seen;
    };
    facts.insert(facts.end(), {"any"_a = any, "signs"_a = any && signs, "small"_a = signs && small, "half"_a = any && signs && !small,
                               "steps"_a = listed(steps), "recommended"_a = listed(recommended), "flips"_a = flips, "left"_a = left,
                               "small_left"_a = small_left, "gap"_a = gap != 0 ? readable_percent(std::abs(gap), 2) : "",
                               "worse"_a = gap > 0.02, meshes("farther", studies, is_farther),
                               meshes("none", studies, [](const ExplicitStudy& study) { return !study.recommended; })});
}

constexpr double few = 0.2, many = 0.5;   // of the vertices

/// Facts about the runs just beyond the limit.
void add_near_facts(report::Facts& facts, const Studies& studies) {
    double off = 0, factor = 0, share = 0;
    int t = 0;
    for (const ExplicitStudy& study : studies) {
        const std::size_t i = study.first_beyond();
        if (i == study.runs.size()) continue;
        factor = 1 - study.runs[i].lambda * study.subject.top.value;
        off = std::max(off, std::abs(study.amplification[i].measured / study.amplification[i].predicted - 1));
        if (study.near) t = study.runs[study.near->run].iterations;
    }
    const auto first_beyond = [](const ExplicitStudy& study) {
        return study.first_beyond() < study.runs.size() ? &study.runs[study.first_beyond()] : nullptr;
    };
    const auto is_spotted = [&](const ExplicitStudy& study) {
        const double rougher = rougher_at(study, study.near, t);
        return rougher > 0 && rougher < few;
    };
    // The energy falls below the input's and rises again.
    const auto turns = [](const ExplicitStudy& study) {
        if (!study.near) return false;
        const std::vector<double>& energy = study.runs[study.near->run].energy;
        const auto least = std::ranges::min_element(energy);
        return least != energy.begin() && least + 1 != energy.end();
    };
    // The energy stays below the input's until the end.
    const auto is_hidden = [](const ExplicitStudy& study) {
        if (!study.near) return false;
        const SmoothingRun& run = study.runs[study.near->run];
        return !run.result.blew_up && run.energy.back() < run.energy.front();
    };
    for (const ExplicitStudy& study : studies)
        if (is_spotted(study)) share = std::max(share, rougher_at(study, study.near, t));
    facts.insert(
        facts.end(),
        {"beyond"_a = has_frames(studies), "near"_a = common_limits(studies, first_beyond), "factor"_a = readable(factor, 3),
         "off"_a = readable_percent(rounded_up(std::max(off, 1e-5), 1), 1), meshes("turns", studies, turns),
         meshes("hidden", studies, is_hidden),
         meshes("within", studies, [](const ExplicitStudy& study) { return study.first_beyond() == study.runs.size(); }),
         meshes("spotted", studies, is_spotted), "spotted_t"_a = t, "spotted_share"_a = readable_percent(rounded_up(share, 2), 2)});
}

/// Facts about the runs with the largest steps.
void add_far_facts(report::Facts& facts, const Studies& studies) {
    constexpr int t = 5;
    const auto blew_up = [](const ExplicitStudy& study) { return study.runs.back().result.blew_up; };
    const auto is_rough = [](const ExplicitStudy& study) { return rougher_at(study, study.far, t) > many; };
    const auto is_spotted = [](const ExplicitStudy& study) {
        const double rougher = rougher_at(study, study.far, t);
        return rougher > 0 && rougher < few;
    };
    int last = 0;
    double share = 1, spots = 0;
    for (const ExplicitStudy& study : studies) {
        if (blew_up(study)) last = std::max(last, study.runs.back().result.blow_up_iteration);
        if (is_rough(study)) share = std::min(share, rougher_at(study, study.far, t));
        if (is_spotted(study)) spots = std::max(spots, rougher_at(study, study.far, t));
    }
    const Names blown = names_where(studies, blew_up), rough = names_where(studies, is_rough);
    facts.insert(facts.end(),
                 {"far"_a = common_limits(studies, [&](const ExplicitStudy& s) { return blew_up(s) ? &s.runs.back() : nullptr; }),
                  "blown"_a = listed(blown), "all_blown"_a = blown.size() == studies.size(), "last"_a = last, "rough"_a = listed(rough),
                  "rough_all"_a = rough.size() == studies.size() && studies.size() > 1, "rough_t"_a = t,
                  "rough_share"_a = share < 1 ? readable_percent(rounded_down(share, 2), 2) : "", meshes("spikes", studies, is_spotted),
                  "spikes_share"_a = readable_percent(rounded_up(spots, 2), 2), meshes("at_top", studies, ends_by_top_mode)});
}

void add_stop_facts(report::Facts& facts, const Studies& studies) {
    double times = infinity;
    const auto is_smoother = [](const Recommendation& best) {
        return best.roughness_before > 5 && best.roughness_after < 0.5 * best.roughness_before;
    };
    for (const ExplicitStudy& study : studies)
        if (study.recommended && is_smoother(*study.recommended))
            times = std::min(times, study.recommended->roughness_before / study.recommended->roughness_after);
    const auto unfolds = [](const ExplicitStudy& s) {
        return turned_by(s) > 0 && s.recommended->folded_after < s.recommended->folded_before;
    };
    const auto folds = [](const ExplicitStudy& s) {
        return turned_by(s) > 0 && s.recommended->folded_after > s.recommended->folded_before;
    };
    facts.insert(facts.end(), {recommended_meshes("smoother", studies, is_smoother),
                               "smoother_times"_a = std::isfinite(times) ? readable(rounded_down(times, 2), 2) : "",
                               recommended_meshes("clean", studies,
                                                  [](const Recommendation& best) { return !best.all_kept && best.roughness_before < 1; }),
                               recommended_meshes("kept", studies, [](const Recommendation& best) { return best.all_kept; }),
                               recommended_meshes("features", studies, [](const Recommendation& best) { return best.on_features > 1.5; }),
                               recommended_meshes("boundary", studies, [](const Recommendation& best) { return best.on_boundary > 1.5; }),
                               meshes("unfolds", studies, unfolds), meshes("folds", studies, folds)});
}

}   // namespace

std::vector<int> limiting_spot(const ExplicitStudy& study) {
    return extent_of_top_mode(study) == Extent::spot ? study.peaks : std::vector<int>();
}

report::Facts facts_of(const Studies& studies) {
    report::Facts facts;
    for (const auto add_facts : {add_limit_facts, add_step_facts, add_near_facts, add_far_facts, add_stop_facts}) add_facts(facts, studies);
    return facts;
}

}   // namespace meshfolio::q5_explicit
