#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "questions/bench/sentences.h"
#include "questions/core/study_list.h"
#include "questions/q5_explicit/parts.h"

namespace meshfolio::q5_explicit {

namespace {

using Names = std::vector<std::string>;

// ---- how large may it be

/// What holds the top mode: the whole triangulation, a region, or a single spot.
enum class Extent { spot, region, whole };

int vertices_of(const ExplicitStudy& study) { return study.subject.source->prepared->preflight.vertices_in_use; }

Extent extent_of_top_mode(const ExplicitStudy& study) {
    const double support = study.subject.top.support;
    const int vertices = vertices_of(study);
    if (support < 10 && support < 0.1 * vertices) return Extent::spot;
    return support < 0.1 * vertices ? Extent::region : Extent::whole;
}

/// The meshes on which it has this extent, with the vertex where there is one to name.
Names places(const Studies& studies, Extent extent) {
    Names places;
    for (const ExplicitStudy& study : studies) {
        if (extent_of_top_mode(study) != extent) continue;
        const LargestEigenvalue& top = study.subject.top;
        places.push_back(words.line(extent == Extent::whole ? "limit.place" : "limit.place.around", "mesh"_a = study.name(),
                                    "support"_a = readable(std::max(1.0, top.support), 2), "vertices"_a = vertices_of(study),
                                    "vertex"_a = top.vertex));
    }
    return places;
}

report::Text how_large(const Studies& studies) {
    Names limits;
    for (const ExplicitStudy& study : studies)
        limits.push_back(words.line("limit.mesh", "mesh"_a = study.name(), "critical"_a = readable(study.subject.critical, 2),
                                    "edges"_a = readable(study.critical_in_edges(), 2)));
    const auto worst = std::ranges::min_element(studies, {}, &ExplicitStudy::critical_in_edges);
    const double lowest = worst->critical_in_edges();
    // Right triangles of two sides s allow s²/4, and their mean edge is (2 + √2)s/3.
    static const double grid = 0.25 / std::pow((2 + std::sqrt(2.0)) / 3, 2);
    return paragraph_of({words.say("limit", "limits"_a = listed(limits)),
                         words.say(lowest < 0.5 * grid ? "limit.grid.worse" : "limit.grid.half", "grid"_a = readable(grid, 2),
                                   "mesh"_a = worst->name(), "meshes"_a = studies.size(), "times"_a = readable(grid / lowest, 2)),
                         said_of(places(studies, Extent::whole), words, "limit.whole"),
                         said_of(places(studies, Extent::region), words, "limit.region"),
                         said_of(places(studies, Extent::spot), words, "limit.spot")});
}

// ---- which one to take

/// What smoothing with the recommended step does to energy, volume and faces, and what going on would cost.
report::Text effect_of(const ExplicitStudy& study) {
    const SmoothingRun &run = study.recommended->stopped, &all = study.runs[study.recommended->run];
    const int turned = run.moved.inverted_faces;
    return paragraph_of(
        {words.say("good.mesh", "mesh"_a = study.name(), "step"_a = step_label(study.subject, run.lambda), "iterations"_a = run.iterations,
                   "fall"_a = energy_fall(run.energy.back()),
                   "volume"_a = words.line("good.mesh.volume", "volume"_a = readable_percent(run.size.back()))),
         run.iterations < all.iterations
             ? words.say("good.mesh.stopped", "iterations"_a = all.iterations, "volume"_a = readable_percent(all.size.back(), 2))
             : words.say("good.mesh.all"),
         turned > 0 ? words.say("good.mesh.turned", "turned"_a = turned, "faces"_a = study.subject.mesh().face_count()) : report::Text()});
}

report::Text good_step(const Studies& studies) {
    Names none;
    report::Text effects;
    bool all_keep_signs = true;
    for (const ExplicitStudy& study : studies) {
        if (!study.recommended) {
            none.push_back(study.name());
            continue;
        }
        all_keep_signs = all_keep_signs && keeps_signs(study.subject, study.recommended->stopped.lambda);
        effects = paragraph_of({effects, effect_of(study)});
    }
    const report::Text which = effects.empty() ? effects : words.say(all_keep_signs ? "good.keeps_signs" : "good.changes_signs");
    return paragraph_of({which, effects, said_of(none, words, "good.none")});
}

// ---- and beyond

using StudyPointers = std::vector<const ExplicitStudy*>;

/// The first run beyond the limit; as many as there are: there is none.
std::size_t first_beyond(const ExplicitStudy& study) {
    std::size_t i = 0;
    while (i < study.runs.size() && study.stable(i)) ++i;
    return i;
}

std::string step_and_iterations(const ExplicitStudy& study, const SmoothingRun& run) {
    return words.line("beyond.run", "at_step"_a = at_step(study.subject, run.lambda), "iterations"_a = run.result.iterations);
}

report::Text growth_of_the_top_mode(const StudyPointers& beyond) {
    std::vector<Observed> grown;
    for (const ExplicitStudy* study : beyond) {
        const std::size_t i = first_beyond(*study);
        const double lambda = study->runs[i].lambda;
        const Amplification& growth = study->amplification[i];
        grown.push_back(
            {words.line("beyond.grown", "factor"_a = readable(growth.measured, 3), "mesh"_a = study->name()),
             words.line("beyond.predicted", "factor"_a = readable(growth.predicted, 3),
                        "step"_a = readable(1 - lambda * study->subject.top.value, 3), "at_step"_a = at_step(study->subject, lambda))});
    }
    return said_of(grown, words, "beyond");
}

/// "fandisk_ns", "cube (one of 12 alike)": where the top mode is largest at the vertex that breaks away; empty where it is not.
std::string broken_at_top(const ExplicitStudy& study) {
    const int vertex = study.runs.back().result.blow_up_vertex;
    if (std::ranges::find(study.peaks, vertex) == study.peaks.end()) return "";
    return study.peaks.size() == 1 ? study.name()
                                   : words.line("beyond.at_top.tie", "mesh"_a = study.name(), "vertices"_a = study.peaks.size());
}

/// Where the largest step tried ends, and whether it breaks at the vertex that sets the limit.
report::Text where_it_breaks(const StudyPointers& beyond) {
    std::vector<Observed> blown, turned;
    Names at_top;
    for (const ExplicitStudy* study : beyond) {
        const SmoothingRun& last = study->runs.back();
        const report::Fact mesh = "mesh"_a = study->name();
        if (last.result.blew_up) {
            blown.push_back({words.line("beyond.blown.mesh", mesh, "iteration"_a = last.result.blow_up_iteration,
                                        "vertex"_a = last.result.blow_up_vertex),
                             at_step(study->subject, last.lambda)});
            if (std::string place = broken_at_top(*study); !place.empty()) at_top.push_back(std::move(place));
        } else if (last.moved.inverted_faces > 0) {
            turned.push_back({words.line("beyond.turned.mesh", mesh, "turned"_a = last.moved.inverted_faces,
                                         "faces"_a = study->subject.mesh().face_count()),
                              step_and_iterations(*study, last)});
        }
    }
    return paragraph_of(
        {said_of(blown, words, "beyond.blown"), said_of(at_top, words, "beyond.at_top"), said_of(turned, words, "beyond.turned")});
}

/// Just beyond the limit the energy may still fall; the faces that turn over show the growth.
report::Text what_energy_hides(const StudyPointers& beyond) {
    std::vector<Observed> hidden;
    Names turned;
    std::string table;   // where the first of them stands
    for (const ExplicitStudy* study : beyond) {
        const std::size_t first = first_beyond(*study);
        const SmoothingRun& run = study->runs[first];
        if (run.energy.back() >= run.energy.front()) continue;
        hidden.push_back({words.line("beyond.hidden.mesh", "fall"_a = energy_fall(run.energy.back()), "mesh"_a = study->name()),
                          step_and_iterations(*study, run)});
        const int now = run.moved.inverted_faces, before = first > 0 ? study->runs[first - 1].moved.inverted_faces : 0;
        if (now < 2 * before + 5) continue;   // faces turn over below the limit too
        if (table.empty()) table = id_of("q5", study->name(), "sweep_table");
        turned.push_back(words.line("beyond.hidden.faces", "mesh"_a = study->name(), "turned"_a = now, "before"_a = before));
    }
    return paragraph_of(
        {said_of(hidden, words, "beyond.hidden"),
         turned.empty() ? report::Text() : words.say("beyond.hidden.turned", "meshes"_a = listed(turned), "table"_a = table)});
}

report::Text too_large(const Studies& studies) {
    StudyPointers beyond;
    Names within;
    for (const ExplicitStudy& study : studies) {
        if (first_beyond(study) < study.runs.size())
            beyond.push_back(&study);
        else
            within.push_back(study.name());
    }
    return paragraph_of(
        {growth_of_the_top_mode(beyond), where_it_breaks(beyond), what_energy_hides(beyond), said_of(within, words, "beyond.none")});
}

// ---- what a number for λ means

report::Text units_of_lambda(const Studies& studies) {
    const auto limit = [](const ExplicitStudy& study) { return study.subject.critical; };
    const auto uniform = [](const ExplicitStudy& study) { return study.uniform.critical; };
    const auto [low, high] = std::ranges::minmax_element(studies, {}, limit);
    const auto [uniform_low, uniform_high] = std::ranges::minmax_element(studies, {}, uniform);
    const bool several = studies.size() > 1, known = uniform(*uniform_low) > 1 && uniform(*uniform_high) < 1.5;
    const std::string from = readable(uniform(*uniform_low), 3), to = readable(uniform(*uniform_high), 3);
    return paragraph_of({words.say(several ? "units.several" : "units.one", "times"_a = readable(limit(*high) / limit(*low), 2)),
                         words.say("units", "limit"_a = several ? words.line("units.range", "low"_a = from, "high"_a = to) : from,
                                   "known"_a = known ? words.line("units.known") : ".")});
}

}   // namespace

void add_discussion(report::Section& section, const Studies& studies) {
    add_words(section, words, "discussion");
    add_paragraphs(section, {how_large(studies), good_step(studies), too_large(studies), units_of_lambda(studies)});
}

}   // namespace meshfolio::q5_explicit
