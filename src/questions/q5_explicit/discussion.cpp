#include <set>

#include "questions/bench/one_ring.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

/// What holds the top mode: the whole triangulation, a region, or a single spot.
enum class Extent { spot, region, whole };

Extent extent_of_top_mode(const ExplicitStudy& study) {
    const double support = study.subject.top.support;
    if (!(support < 0.1 * study.subject.preflight().vertices_in_use)) return Extent::whole;   // NaN too
    return support < 10 ? Extent::spot : Extent::region;
}

report::Text places(const Studies& studies, Extent extent, const char* key) {
    return said_of(names_where(studies, [=](const ExplicitStudy& study) { return extent_of_top_mode(study) == extent; }), words, key);
}

/// Which vertex sets the limit, of the first mesh where a few do and its figure rings them.
report::Text ringed(const Studies& studies) {
    for (const ExplicitStudy& study : studies) {
        const std::vector<int> spot = limiting_spot(study);
        if (spot.empty() || !study.recommended) continue;
        const TriangleMesh& mesh = study.subject.mesh();
        double beside = pi;
        for (const int v : spot) beside = std::min(beside, smallest_angle_around(mesh, study.subject.topology(), v));
        const bool thinnest = beside <= corner_angles(mesh).minCoeff() * (1 + 1e-9);
        return words.say(thinnest ? "limit.ringed.thinnest" : "limit.ringed", "mesh"_a = study.name(), "peaks"_a = spot.size(),
                         "figure"_a = recommended_figure(studies), "angle"_a = readable(beside * 180 / pi, 2));
    }
    return {};
}

/// The largest stable step beyond half the limit that was tried, beside the one recommended.
struct Steps {
    const ExplicitStudy& study;
    std::size_t larger;   // run
    const SmoothingRun &run, &half;
};
std::vector<Steps> larger_steps(const Studies& studies) {
    std::vector<Steps> steps;
    for (const ExplicitStudy& study : studies) {
        const std::size_t beyond = study.first_beyond();
        if (study.recommended && beyond > 0 && !keeps_signs(study.subject, study.runs[beyond - 1].lambda))
            steps.push_back({study, beyond - 1, study.runs[beyond - 1], study.runs[study.recommended->run]});
    }
    return steps;
}

/// The energy that the larger and the smaller step leave at the same λt, on the mesh where they differ most.
report::Text energy_at_equal_time(const Studies& studies, int larger_steps_taken) {
    const ExplicitStudy* most = nullptr;
    double gap = 0, of_larger = 0, of_smaller = 0;
    for (const auto& [study, larger, run, half] : larger_steps(studies)) {
        const std::ptrdiff_t t = larger_steps_taken, u = std::lround(larger_steps_taken * run.lambda / half.lambda);
        if (t >= std::ssize(run.energy) || u >= std::ssize(half.energy)) continue;
        if (const double here = run.energy[t] / half.energy[u] - 1; !most || std::abs(here) > std::abs(gap))
            most = &study, gap = here, of_larger = run.energy[t], of_smaller = half.energy[u];
    }
    if (most == nullptr) return {};
    return words.say(gap > 0.02 ? "good.flips.energy" : "good.flips.alike", "mesh"_a = most->name(), "larger"_a = share_left(of_larger),
                     "smaller"_a = share_left(of_smaller), "gap"_a = readable_percent(std::abs(gap), 2));
}

/// Why a step that keeps signs and not the largest stable one: what is left of the top mode.
report::Text why_half(const Studies& studies) {
    Names smaller;   // than half the limit, although that was tried
    bool any = false, all_keep_signs = true;
    for (const ExplicitStudy& study : studies) {
        if (!study.recommended) continue;
        any = true;
        const std::size_t run = study.recommended->run;
        all_keep_signs = all_keep_signs && keeps_signs(study.subject, study.runs[run].lambda);
        if (run + 1 < study.runs.size() && keeps_signs(study.subject, study.runs[run + 1].lambda)) smaller.push_back(study.name());
    }
    if (!any) return {};
    if (!all_keep_signs) return words.say("good.changes_signs");
    report::Text flips;
    if (const std::vector<Steps> steps = larger_steps(studies); !steps.empty()) {   // the same on all
        const auto& [study, larger, run, half] = steps.front();
        const long half_steps = std::lround(20 * run.lambda / half.lambda);
        flips = words.say("good.flips", "limits"_a = in_limits(study.subject, run.lambda),
                          "left"_a = share_left(study.amplification[larger].measured),
                          "small_left"_a = share_left(std::pow(std::abs(1 - half.lambda * study.subject.top.value), half_steps)));
    }
    return paragraph_of({words.say("good.keeps_signs"), said_of(smaller, words, "good.smaller"), flips,
                         flips.empty() ? report::Text() : energy_at_equal_time(studies, 20)});
}

/// What the larger step takes with the energy, on the first mesh where it shows.
report::Text farther_along(const Studies& studies) {
    constexpr double seen = 0.02;
    for (const auto& [study, larger, run, half] : larger_steps(studies)) {
        if (half.energy.back() - run.energy.back() < seen || half.size.back() - run.size.back() < seen) continue;
        return words.say("good.farther", "mesh"_a = study.name(), "limits"_a = in_limits(study.subject, run.lambda),
                         "iterations"_a = run.iterations, "energy"_a = share_left(run.energy.back()),
                         "half_energy"_a = share_left(half.energy.back()), "size"_a = share_left(run.size.back()),
                         "half_size"_a = share_left(half.size.back()));
    }
    return {};
}

/// What the recommended step does to one mesh, as its figure shows.
report::Text effect_of(const ExplicitStudy& study) {
    const Recommendation& best = *study.recommended;
    const SmoothingRun& run = best.stopped;
    const int turned = run.moved.inverted_faces, faces = study.subject.mesh().face_count();
    const auto if_so = [&](bool holds, const char* key) {
        if (!holds) return report::Text();
        return words.say(key, "mesh"_a = study.name(), "iterations"_a = run.iterations, "size"_a = share_left(run.size.back()),
                         "features"_a = readable(best.on_features, 2), "boundary"_a = readable(best.on_boundary, 2),
                         "time"_a = readable(study.in_edges(best.time()), 2), "turned"_a = turned, "faces"_a = faces,
                         "share"_a = readable_percent(double(turned) / faces, 2), "before"_a = best.folded_before,
                         "after"_a = best.folded_after);
    };
    const bool unfolded = 2 * best.folded_before > turned && 10 * best.folded_after < best.folded_before;
    const bool clean = !best.all_kept && best.roughness_before < 1;
    return paragraph_of({if_so(clean, "stop.clean"), if_so(best.all_kept, "stop.kept"), if_so(best.on_features > 1.5, "stop.features"),
                         if_so(best.on_boundary > 1.5, "stop.boundary"), if_so(turned > 0, "stop.turned"),
                         if_so(unfolded, "stop.turned.unfolded"), if_so(!unfolded && best.folded_after > 0, "stop.turned.folded"),
                         if_so(!unfolded && best.folded_before > 0 && best.folded_after == 0, "stop.turned.flat")});
}

using StudyPointers = std::vector<const ExplicitStudy*>;

/// The run just beyond the limit: how fast its top mode grows, by theory and as measured, and when that shows.
report::Text growth_of_the_top_mode(const ExplicitStudy& study) {
    const std::size_t i = study.first_beyond();
    const std::vector<double>& energy = study.runs[i].energy;
    const double factor = 1 - study.runs[i].lambda * study.subject.top.value;
    const auto least = std::ranges::min_element(energy);
    const bool falls = least != energy.begin(), rises = least + 1 != energy.end();
    const auto told = [&](const char* key) {
        return words.say(key, "mesh"_a = study.name(), "limits"_a = in_limits(study.subject, study.runs[i].lambda),
                         "step"_a = readable(factor, 3), "measured"_a = readable(study.amplification[i].measured, 2),
                         "predicted"_a = readable(study.amplification[i].predicted, 2), "iteration"_a = least - energy.begin(),
                         "iterations"_a = study.runs[i].iterations);
    };
    return paragraph_of({told("beyond"), rises ? told(falls ? "beyond.turns" : "beyond.rises") : report::Text(),
                         study.runs[i].result.blew_up ? report::Text() : told("beyond.only_grows")});
}

/// How many faces the largest step, beyond the limit, has turned over in its last frame up to t = 5: at the end there is nothing to count.
report::Text turned_early(const ExplicitStudy& study) {
    const Strip& strip = study.strips.back();
    if (strip.run + 1 != study.runs.size() || !study.runs.back().result.blew_up) return {};
    std::size_t frame = strip.frames.size() - 1;
    while (study.frame_times[frame] > 5) --frame;
    const int turned = faces_turned(study.subject.mesh(), strip.frames[frame]);
    if (turned == 0) return {};
    return words.say("beyond.turned_early", "t"_a = study.frame_times[frame], "turned"_a = turned,
                     "faces"_a = study.subject.mesh().face_count(), "mesh"_a = study.name());
}

/// Does the mesh break first at a vertex where the top mode is largest?
bool broken_at_top(const ExplicitStudy& study) {
    return std::ranges::find(study.peaks, study.runs.back().result.blow_up_vertex) != study.peaks.end();
}

/// Says where the largest step ends, and whether it breaks at the vertex that sets the limit.
report::Text where_it_breaks(const StudyPointers& beyond) {
    std::vector<int> iterations;
    Names blown, at_top, turned;
    std::string limits;
    for (const ExplicitStudy* study : beyond) {
        const SmoothingRun& last = study->runs.back();
        if (last.result.blew_up) {
            limits = in_limits(study->subject, last.lambda);
            iterations.push_back(last.result.blow_up_iteration);
            blown.push_back(study->name());
            if (broken_at_top(*study)) at_top.push_back(study->name());
        } else if (last.moved.inverted_faces > 0) {
            turned.push_back(words.line("beyond.turned.mesh", "mesh"_a = study->name(), "turned"_a = last.moved.inverted_faces,
                                        "faces"_a = study->subject.mesh().face_count()));
        }
    }
    report::Text torn;
    if (!blown.empty()) {
        const auto [first, last] = std::ranges::minmax(iterations);
        torn = words.say(first == last ? "beyond.blown" : "beyond.blown.range", "limits"_a = limits, "meshes"_a = listed(blown),
                         "first"_a = first, "last"_a = last);
    }
    return paragraph_of({torn, said_of(at_top, words, "beyond.at_top"), said_of(turned, words, "beyond.turned")});
}

/// Says where the pictures show the growth: all over the surface, or at one place.
report::Text where_it_shows(const StudyPointers& beyond) {
    Names whole;
    report::Text spots;
    for (const ExplicitStudy* study : beyond) {
        if (!study->runs.back().result.blew_up) continue;
        if (extent_of_top_mode(*study) == Extent::whole)
            whole.push_back(study->name());
        else
            go_on(spots, words.say("beyond.one_place", "mesh"_a = study->name(), "figure"_a = id_of("q5", study->name(), "frames")));
    }
    return paragraph_of({said_of(whole, words, "beyond.everywhere"), spots});
}

/// Just beyond the limit the energy may still fall, although the top mode grows.
report::Text what_energy_hides(const StudyPointers& beyond) {
    Names hidden;
    for (const ExplicitStudy* study : beyond) {
        const SmoothingRun& run = study->runs[study->first_beyond()];
        if (!run.result.blew_up && run.energy.back() < run.energy.front()) hidden.push_back(study->name());
    }
    return said_of(hidden, words, "beyond.hidden");
}

StudyPointers tried_beyond(const Studies& studies) {
    StudyPointers beyond;
    for (const ExplicitStudy& study : studies)
        if (study.first_beyond() < study.runs.size()) beyond.push_back(&study);
    return beyond;
}

/// Summarises the blow-up if all meshes show it at one step.
report::Text beyond_in_short(const Studies& studies) {
    int last = 0;
    std::string limits;
    for (const ExplicitStudy& study : studies) {
        const SmoothingRun& run = study.runs.back();
        const std::string step = in_limits(study.subject, run.lambda);
        if (!run.result.blew_up || (!limits.empty() && step != limits)) return words.say("answer.beyond");
        limits = step;
        last = std::max(last, run.result.blow_up_iteration);
    }
    return words.say("answer.beyond.blown", "limits"_a = limits, "meshes"_a = studies.size(), "last"_a = last);
}

}   // namespace

std::vector<int> limiting_spot(const ExplicitStudy& study) {
    return extent_of_top_mode(study) == Extent::spot ? study.peaks : std::vector<int>();
}

report::Text how_large(const Studies& studies) {
    const auto [low, high] = std::ranges::minmax_element(studies, {}, &ExplicitStudy::critical_in_edges);
    // Right triangles of two sides s allow s²/4, and their mean edge is (2 + √2)s/3.
    static const double grid = 0.25 / std::pow((2 + std::sqrt(2.0)) / 3, 2);
    const double lowest = low->critical_in_edges(), times = high->critical_in_edges() / lowest;
    const report::Facts facts{
        "low"_a = readable(lowest, 2), "low_mesh"_a = low->name(),   "high"_a = readable(high->critical_in_edges(), 2),
        "high_mesh"_a = high->name(),  "grid"_a = readable(grid, 2), "grid_times"_a = readable(grid / lowest, 2),
        "times"_a = readable(times, 2)};
    const bool several = studies.size() > 1;
    return paragraph_of({words.say(several ? "limit.several" : "limit.one", facts),
                         several && times > 1.5 ? words.say("limit.times", facts) : report::Text(),
                         several ? report::Text() : words.say(lowest < 0.5 * grid ? "limit.grid.worse" : "limit.grid.half", facts),
                         places(studies, Extent::whole, "limit.whole"), places(studies, Extent::region, "limit.region"),
                         places(studies, Extent::spot, "limit.spot"), ringed(studies), words.say("limit.why")});
}

report::Text which_step(const Studies& studies) { return paragraph_of({why_half(studies), farther_along(studies)}); }

report::Text when_to_stop(const Studies& studies) {
    const Names none = names_where(studies, [](const ExplicitStudy& study) { return !study.recommended; });
    Names smoother;
    report::Text effects;
    for (const ExplicitStudy& study : studies) {
        if (!study.recommended) continue;
        const Recommendation& best = *study.recommended;
        if (best.roughness_before > 5 && best.roughness_after < 0.5 * best.roughness_before)
            smoother.push_back(words.line("stop.roughness.mesh", "mesh"_a = study.name(), "before"_a = readable(best.roughness_before, 2),
                                          "after"_a = readable(best.roughness_after, 2)));
        go_on(effects, effect_of(study));
    }
    report::Text stop;
    if (none.size() < studies.size())
        stop = paragraph_of({words.say("stop", "figure"_a = recommended_figure(studies)),
                             studies.size() > 1 ? words.say("stop.lambda_t") : report::Text(), said_of(smoother, words, "stop.roughness")});
    return paragraph_of({stop, effects, said_of(none, words, "good.none")});
}

report::Text too_large(const Studies& studies) {
    const StudyPointers beyond = tried_beyond(studies);
    const Names within = names_where(studies, [](const ExplicitStudy& study) { return study.first_beyond() == study.runs.size(); });
    report::Text growth, turned;
    if (!beyond.empty()) {
        const ExplicitStudy& telling_one = telling(studies);
        const ExplicitStudy& shown = telling_one.first_beyond() < telling_one.runs.size() ? telling_one : *beyond.front();
        growth = growth_of_the_top_mode(shown);
        turned = turned_early(shown);
    }
    return paragraph_of({growth, where_it_breaks(beyond), turned, where_it_shows(beyond), what_energy_hides(beyond),
                         said_of(within, words, "beyond.none")});
}

// ---- what a number for λ means

report::Text units_of_lambda(const Studies& studies) {
    const auto [low, high] = std::ranges::minmax_element(studies, {}, &ExplicitStudy::critical_in_edges);
    const auto [uniform_low, uniform_high] = std::ranges::minmax_element(studies, {}, &ExplicitStudy::uniform_critical);
    const double times = high->critical_in_edges() / low->critical_in_edges();
    double safe = 1;   // the least of Gershgorin's limits, over λ_crit; 0: not all are proved
    for (const ExplicitStudy& study : studies) safe = std::min(safe, study.subject.safe() / study.subject.critical);
    const double lowest = uniform_low->uniform_critical(), highest = uniform_high->uniform_critical();
    const bool known = lowest > 1 && highest < 1.5;
    return paragraph_of(
        {words.say(times > 1.1 ? "units.several" : "units.one", "times"_a = readable(times, 2)),
         safe > 0 ? words.say("units.gershgorin", "share"_a = readable_percent(rounded_down(safe, 2), 2)) : report::Text(),
         words.say(known ? "units.known" : "units.uniform", "limit"_a = span_of(readable(lowest, 3), readable(highest, 3)))});
}

// ---- first of all

const ExplicitStudy& telling(const Studies& studies) {
    return *std::ranges::max_element(studies, {}, [](const ExplicitStudy& study) {
        const std::size_t i = study.first_beyond();
        return i < study.runs.size() && !study.runs[i].result.blew_up ? study.runs[i].energy.back() : 0;
    });
}

report::Text answer_in_short(const Studies& studies) {
    double least = INFINITY, most = 0;   // of the recommended steps, over λ_crit
    for (const ExplicitStudy& study : studies) {
        if (!study.recommended) continue;
        least = std::min(least, study.recommended->stopped.lambda / study.subject.critical);
        most = std::max(most, study.recommended->stopped.lambda / study.subject.critical);
    }
    return words.say(most == 0      ? "answer.none"
                     : most > 0.51  ? "answer.stable"
                     : least < 0.49 ? "answer.smaller"
                                    : "answer",
                     "beyond"_a = beyond_in_short(studies));
}

report::Text lead(const Studies& studies) {
    Names steps;
    std::set<std::string> limits;
    for (const ExplicitStudy& study : studies) {
        if (!study.recommended) continue;
        const double lambda = study.recommended->stopped.lambda;
        const std::string limit = in_limits(study.subject, lambda);
        if (!limits.empty() && !limits.contains(limit)) continue;   // the table has the others
        limits.insert(limit);
        steps.push_back(words.line("lead.mesh", "lambda"_a = readable(lambda, 2), "mesh"_a = study.name()));
    }
    if (steps.empty()) return {};
    return words.say(limits.contains("0.5") ? "lead.half" : "lead", "limits"_a = *limits.begin(), "meshes"_a = listed(steps));
}

}   // namespace meshfolio::q5_explicit
