// The section "maps": what smoothing does over the plane of steps and iterations.
#include "questions/maps/parts.h"

#include "base/number_text.h"
#include "questions/bench/laboratory_meshes.h"
#include "questions/bench/smoothing_study.h"
#include "questions/core/chapter.h"
#include "questions/core/section_tools.h"
#include "questions/core/study_list.h"

namespace meshfolio::maps {

namespace {

using report::math;
using report::ref;

void add_method(report::Section& section) {
    add_heading(section, "Method");
    add_paragraph(
        section, "Every step ", math("λ"), " of a logarithmic grid is run once with each scheme, and measured as the iterations pass, at ",
        "counts that are spaced alike. The explicit limit lies on the edge between two steps. The implicit runs share the symbolic "
        "analysis, one for each of two lanes that run side by side, and need one numerical factorisation a step ",
        math("λ"), ".");
    add_paragraph(section, "Beyond the limit a mode grows by a constant factor, so that the iteration at which it reaches a distance ",
                  math("R"), " is known beforehand from how much of it the input has:");
    add_formula(section, "blow_up_iteration", "maps_eq_blow_up");
}

void add_pictures(Answer& answer, const SmoothingMaps& maps) {
    output::FigureRequest request;
    request.id = id_of("maps", maps.name(), "places");
    request.title = "Places of the plane: " + maps.name();
    request.subtitle = "λ_crit = " + readable(maps.subject.critical, 4);
    request.edges = maps.subject.mesh().face_count() < 5000;
    request.three_quarter = request.three_quarter_frame = true;
    request.panels.push_back(panel_of(*maps.subject.source, id_of("maps", maps.name(), "input"), "input",
                                      curvature_colours(maps.subject, maps.subject.mesh().X)));
    for (const MapPlace& place : maps.places) {
        const std::string label = place.letter + ": " + maps.map_of(place.scheme).name() + ", " + plain_text(maps.relative(place.step), 3) +
                                  "\u202fλ_crit, t = " + std::to_string(maps.iterations[place.row]);
        request.panels.push_back(smoothing_panel(maps.subject, place.X, id_of("maps", maps.name(), place.letter), label));
    }
    request.range = output::robust_range({request.panels.front()}, "diverging", "mean curvature × mean edge", "", 0.02);
    std::string caption = "The lettered places of the maps of " + maps.name() + ", all in the frame of the input.";
    caption += words_of(maps.places);
    caption += " Coloured by cotangent mean curvature times the mean edge of the input.";
    answer.section.blocks.push_back(report::Figure{request.id, caption, caption});
    answer.figures.push_back(std::move(request));
}

}   // namespace

Answer answer(const MeshLibrary& library, const QuestionSettings& settings, const Progress& progress) {
    Answer answer;
    report::Section& section = answer.section;
    section = section_of("maps");
    const auto meshes = laboratory_meshes(library, settings, section);
    add_method(section);

    add_heading(section, "Results");
    const auto studies = studies_of(meshes, "planes of smoothing", settings, progress, section, smoothing_maps);
    for (const SmoothingMaps& maps : studies) {
        for (report::Map& map : maps_of(maps)) section.blocks.emplace_back(std::move(map));
        add_pictures(answer, maps);
    }
    section.blocks.emplace_back(place_table(studies));
    section.blocks.emplace_back(region_table(studies));
    section.blocks.emplace_back(blow_up_table(studies));
    add_discussion(section, studies);
    append_checks(section, map_checks(studies));

    const SmoothingMaps& first = studies.front();
    std::vector<std::string> counts;
    for (const int t : first.iterations) counts.push_back(std::to_string(t));
    section.parameters["iterations measured"] = listed(counts);
    for (const SmoothingMaps& maps : studies) {
        section.parameters["λ/λ_crit on " + maps.name()] = counted(static_cast<int>(maps.lambdas.size()), "step") + " from " +
                                                           readable(maps.relative(0)) + " to " +
                                                           readable(maps.relative(maps.lambdas.size() - 1));
    }
    section.parameters["operator"] = "cotangent, of the input, barycentric areas";
    section.extent = "explicit and implicit smoothing over " + counted(static_cast<int>(first.lambdas.size()), "step") + " × " +
                     counted(static_cast<int>(first.iterations.size()), "iteration count") + " on " + listed(names_of(studies)) +
                     ": error, volume, smallest angle, turned triangles, the limit and the predicted blow-up drawn in";
    int within = 0, lost = 0;
    for (const SmoothingMaps& maps : studies) {
        for (std::size_t step = 0; step < maps.lambdas.size(); ++step) {
            if (maps.lambdas[step] > maps.subject.critical) continue;
            ++within;
            lost += maps.explicit_map.blow_up[step] > 0 ? 1 : 0;
        }
    }
    section.findings.push_back({report::text("Over the plane of steps and iterations (", ref(id_of("maps", first.name(), "error")), "), ",
                                             lost == 0 ? std::string("none") : std::to_string(lost), " of ",
                                             counted(within, "explicit run"), " within the limit blew up."),
                                40});
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
