// The section "maps": what smoothing does over the plane of steps and iterations.
#include "questions/maps/parts.h"

namespace meshfolio::maps {

namespace {

/// How many runs there are on either side of the explicit limit, how many of them blew up, and how many implicit ones did.
struct BlowUps {
    int within = 0, beyond = 0, within_lost = 0, beyond_lost = 0, implicit_lost = 0;
    double off = 0;   // largest distance of a measured iteration from the best prediction at hand

    int faults() const { return within_lost + implicit_lost; }
    bool sharp() const { return faults() == 0 && beyond > 0 && beyond_lost == beyond; }
};
BlowUps blow_ups_of(const Studies& studies) {
    BlowUps found;
    for (const SmoothingMaps& maps : studies) {
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
            const int measured = maps.explicit_map.blow_up[step], lost = measured > 0 ? 1 : 0;
            const bool stable = maps.lambdas[step] <= maps.subject.critical;
            (stable ? found.within : found.beyond) += 1;
            (stable ? found.within_lost : found.beyond_lost) += lost;
            found.implicit_lost += maps.implicit_map.blow_up[step] > 0 ? 1 : 0;
            const double predicted = maps.known_modes().blow_up(maps.lambdas[step]);
            if (lost > 0 && predicted > 0) found.off = std::max(found.off, std::abs(measured - std::ceil(predicted)));
        }
    }
    return found;
}

std::string none_or(int count) { return count == 0 ? words.line("none") : std::to_string(count); }

std::string cell_words(const SmoothingMaps& maps, std::size_t i) {
    return words.line("cell", "step"_a = readable(maps.relative(maps.step_of(i))), "iterations"_a = maps.iterations[maps.row_of(i)]);
}

report::Text about_limit(const Studies& studies) {
    const BlowUps found = blow_ups_of(studies);
    report::Text t =
        words.say(found.sharp() ? "limit.sharp" : "limit", "mesh"_a = studies.front().name(), "within"_a = found.within,
                  "within_lost"_a = none_or(found.within_lost), "beyond"_a = found.beyond, "beyond_lost"_a = none_or(found.beyond_lost),
                  "implicit"_a = found.within + found.beyond, "implicit_lost"_a = none_or(found.implicit_lost));
    if (found.beyond_lost > 0) go_on(t, words.say(found.off < 0.5 ? "limit.met" : "limit.missed", "off"_a = std::lround(found.off)));
    return t;
}

/// A symmetric mesh has none of its top mode: what its runs die of.
report::Text about_seed(const SmoothingMaps& maps) {
    const double height = maps.top.heights[0];
    if (height > 1e4 * maps.top.rounding) return {};
    return words.say(maps.all ? "seed.all" : "seed.top", "mesh"_a = maps.name(), "height"_a = readable(height / maps.subject.diagonal, 2));
}

report::Text about_agreement(const SmoothingMaps& maps) {
    double largest = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < maps.explicit_map.moved.size(); ++i) {
        if (maps.relative(maps.step_of(i)) >= 0.5) continue;
        const double difference = std::abs(maps.explicit_map.moved[i] / maps.implicit_map.moved[i] - 1);
        if (!(difference > largest)) continue;
        largest = difference;
        where = i;
    }
    if (largest == 0) return {};
    return words.say("agreement", "mesh"_a = maps.name(), "difference"_a = readable_percent(largest, 2),
                     "cell"_a = cell_words(maps, where));
}

report::Text about_equal_time(const SmoothingMaps& maps) {
    const EqualTime implicit = largest_difference_at_equal_time(maps, maps.implicit_map),
                    explicit_ = largest_difference_at_equal_time(maps, maps.explicit_map);
    if (implicit.few == implicit.many) return {};
    const auto percent = [](const EqualTime& pair) { return readable_percent(std::abs(pair.difference), 2); };
    return words.say(
        "equal_time", "mesh"_a = maps.name(), "implicit"_a = percent(implicit),
        "cells"_a = words.line(implicit.difference > 0 ? "equal_time.more" : "equal_time.less", "many"_a = cell_words(maps, implicit.many),
                               "few"_a = cell_words(maps, implicit.few)),
        "explicit"_a = explicit_.few == explicit_.many ? "" : words.line("equal_time.explicit", "difference"_a = percent(explicit_)));
}

/// Names the best cell, and says if its run was about to end or the plane ends there.
std::string best_place(const SmoothingMaps& maps, const SchemeMap& map, std::size_t i) {
    const std::size_t step = maps.step_of(i), row = maps.row_of(i);
    Names caveats;
    if (map.scheme == SmoothingScheme::explicit_euler && maps.relative(step) > 1)
        caveats.push_back(words.line(map.blow_up[step] > 0 ? "best.before_blow_up" : "best.beyond"));
    if (step == 0 || step + 1 == maps.lambdas.size() || row == 0 || row + 1 == maps.iterations.size())
        caveats.push_back(words.line("best.edge"));
    return cell_words(maps, i) + (caveats.empty() ? "" : " (" + listed(caveats) + ")");
}

report::Text about_best(const SmoothingMaps& maps) {
    const auto by_explicit = maps.best(maps.explicit_map), by_implicit = maps.best(maps.implicit_map);
    if (!by_explicit || !by_implicit) return {};
    const double e = maps.explicit_map.error[*by_explicit], i = maps.implicit_map.error[*by_implicit], ratio = i / e;
    const std::string input = readable_percent(maps.input_error, 3);
    if (std::min(e, i) >= maps.input_error) return words.say("best.nowhere", "mesh"_a = maps.name(), "input"_a = input);
    const std::string verdict = ratio < 0.98   ? words.line("best.implicit", "gain"_a = readable_percent(1 - ratio, 2))
                                : ratio > 1.02 ? words.line("best.explicit", "gain"_a = readable_percent(1 - 1 / ratio, 2))
                                               : words.line("best.alike");
    return words.say("best", "mesh"_a = maps.name(), "input"_a = input, "explicit"_a = readable_percent(e, 3),
                     "explicit_at"_a = best_place(maps, maps.explicit_map, *by_explicit), "implicit"_a = readable_percent(i, 3),
                     "implicit_at"_a = best_place(maps, maps.implicit_map, *by_implicit), "verdict"_a = verdict);
}

/// "Triangles turn over in 96 of the 113 measurable cells of the explicit plane, at most 61.7 % of them."
report::Text about_turned(const SmoothingMaps& maps, const SchemeMap& map) {
    int measured = 0, turned = 0;
    double most = 0;
    for (const double share : map.inverted) {
        if (std::isnan(share)) continue;
        ++measured;
        turned += share > 0 ? 1 : 0;
        most = std::max(most, share);
    }
    const bool all = measured == static_cast<int>(map.inverted.size());
    return words.say(all ? "turned.in" : "turned.in_measured", "mesh"_a = maps.name(), "turned"_a = none_or(turned), "cells"_a = measured,
                     "scheme"_a = map.name(), "most"_a = turned == 0 ? "" : words.line("turned.most", "share"_a = readable_percent(most)));
}

report::Text about_health(const SmoothingMaps& maps) {
    double least = infinity;
    for (const double size : maps.implicit_map.size) least = std::min(least, size);   // NaN is left out
    return paragraph_of({about_turned(maps, maps.explicit_map), about_turned(maps, maps.implicit_map),
                         words.say(maps.closed ? "kept.volume" : "kept.area",
                                   "least"_a = least < 1e-6 ? words.line("nothing") : readable_percent(least, 2))});
}

void add_pictures(Answer& answer, const SmoothingMaps& maps) {
    output::FigureRequest request{.id = id_of("maps", maps.name(), "places"),
                                  .title = words.line("pictures.title", "mesh"_a = maps.name()),
                                  .subtitle = "λ_crit = " + readable(maps.subject.critical, 4),
                                  .panels = {panel_of(*maps.subject.source, id_of("maps", maps.name(), "input"), "input",
                                                      curvature_colours(maps.subject, maps.subject.mesh().X))},
                                  .edges = maps.subject.mesh().face_count() < 5000,
                                  .layout = output::Layout::one_frame};
    for (const MapPlace& place : maps.places) {
        const std::string label =
            words.line("pictures.panel", "letter"_a = place.letter, "scheme"_a = maps.map_of(place.scheme).name(),
                       "step"_a = plain_text(maps.relative(place.step), 3), "iterations"_a = maps.iterations[place.row]);
        request.panels.push_back(smoothing_panel(maps.subject, place.X, id_of("maps", maps.name(), place.letter), label));
    }
    request.range = output::robust_range({request.panels.front()}, "diverging", words.line("pictures.quantity"), "", 0.02);
    const std::string caption = words.line("pictures.caption", "mesh"_a = maps.name(), "places"_a = words_of(maps.places));
    add_figure(answer, std::move(request), caption, caption);
}

void add_checks(report::Section& section, const SmoothingMaps& maps) {
    const auto name = [&](std::string_view key) { return words.line(key, "mesh"_a = maps.name()); };
    const int last = maps.iterations.back();
    int below = 0, implicit = 0, late = 0, early = 0, compared = 0;
    for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
        const double lambda = maps.lambdas[step];
        const int blow_up = maps.explicit_map.blow_up[step];
        implicit += maps.implicit_map.blow_up[step] > 0 ? 1 : 0;
        below += lambda < maps.subject.critical && blow_up > 0 ? 1 : 0;
        if (lambda <= maps.subject.critical) continue;
        const double latest = 1.1 * maps.known_modes().latest(lambda) + 1;
        late += latest < last && !(blow_up > 0 && blow_up <= latest) ? 1 : 0;
        if (!maps.all) continue;
        ++compared;
        const int earliest = maps.all->earliest(lambda, last);
        early += blow_up > 0 && (earliest == 0 || blow_up < earliest) ? 1 : 0;
    }
    append_checks(section, {check_near(name("check.explicit"), 0, below, 0), check_near(name("check.implicit"), 0, implicit, 0),
                            check_near(name("check.late"), 0, late, 0, words.line("check.late.note"))});
    if (compared > 0) add(section, check_near(name("check.early"), 0, early, 0));
    add(section, check_near(name("check.factorisations"), 1, double(maps.implicit_map.factorisations) / double(maps.lambdas.size()), 0));
}

}   // namespace

void add_discussion(report::Section& section, const Studies& studies) {
    add_words(section, words, "discussion");
    add_paragraphs(section, {about_limit(studies)});
    for (const SmoothingMaps& maps : studies)
        add_paragraphs(section, {about_seed(maps), about_agreement(maps), about_equal_time(maps), about_best(maps), about_health(maps)});
}

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer{section_of("maps")};
    report::Section& section = answer.section;
    const auto meshes = laboratory_meshes(library, settings, section);
    add_words(section, words, {"method", "results"});
    const auto studies = studies_of(meshes, "planes of smoothing", settings, progress, section, smoothing_maps);
    for (const SmoothingMaps& maps : studies) {
        for (report::Map& map : maps_of(maps)) add(section, std::move(map));
        add_pictures(answer, maps);
    }
    add(section, place_table(studies), region_table(studies), blow_up_table(studies));
    add_discussion(section, studies);
    for (const SmoothingMaps& maps : studies) add_checks(section, maps);

    const SmoothingMaps& first = studies.front();
    const Names counts = each_of(first.iterations, [&](const int t) { return std::to_string(t); });
    section.parameters = {{"iterations measured", {listed(counts), first.iterations}}, {"operator", words.line("parameter.operator")}};
    for (const SmoothingMaps& maps : studies) {
        std::vector<double> relative;
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step) relative.push_back(maps.relative(step));
        section.parameters[words.line("parameter.steps", "mesh"_a = maps.name())] = {
            words.line("parameter.steps.value", "steps"_a = relative.size(), "first"_a = readable(relative.front()),
                       "last"_a = readable(relative.back())),
            relative};
    }
    section.extent =
        words.line("extent", "steps"_a = first.lambdas.size(), "counts"_a = counts.size(), "meshes"_a = listed(names_of(studies)));
    const BlowUps blow_ups = blow_ups_of(studies);
    section.answer = words.say(blow_ups.faults() > 0 ? "answer.fault"
                               : blow_ups.sharp()    ? "answer.sharp"
                                                     : "answer.late",
                               "lost"_a = blow_ups.faults() > 0 ? blow_ups.faults() : blow_ups.beyond_lost, "beyond"_a = blow_ups.beyond,
                               "mesh"_a = first.name());
    return answer;
}

extern const Chapter chapter{
    .id = "maps",
    .code = {{"smoothing_maps", "src/questions/maps/study.cpp"},
             {"growing_modes", "src/questions/maps/study.cpp"},
             {"ImplicitSolver::prepare", "src/geometry/smoothing/implicit_solver.cpp"},
             {"answer", "src/questions/maps/chapter.cpp"}},
    .answer = answer,
};

}   // namespace meshfolio::maps
