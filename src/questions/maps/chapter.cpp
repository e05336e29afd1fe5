// The section "maps": what smoothing does over the plane of steps and iterations.
#include "questions/maps/parts.h"

namespace meshfolio::maps {

namespace {

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
