// index.html and appendix.html: each one file that needs nothing else, read by HTML and by XML parsers alike.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/escape.h"
#include "report/page/page_design.h"
#include "report/page/template_render.h"
#include "report/page/view_model.h"
#include "report/page/volumes.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

bool has_models(const Document& document, Volume volume, const DrawnFigures& figures) {
    const std::set<std::string> shown = figures_in(document, volume);
    return std::any_of(shown.begin(), shown.end(), [&](const std::string& id) {
        const auto figure = figures.find(id);
        return figure != figures.end() && !figure->second.models.empty();
    });
}

}   // namespace

std::string write_html(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options) {
    const bool can_turn = options.design == "report" && !options.viewer.empty();
    ViewOptions view{.volume = options.volume,
                     .other_page = page_file(other_of(options.volume)),
                     .timings = options.timings,
                     .paper = options.paper,
                     .plot_files = options.plot_files,
                     .models = can_turn};
    const std::vector<Lab> labs = can_turn && options.volume == Volume::report ? options.labs : std::vector<Lab>();
    for (const Lab& lab : labs) view.lab_questions += lab.questions + " ";
    nlohmann::json model = view_model(document, figures, templates, view);
    add_design(model, templates, options.design, {has_models(document, options.volume, figures), options.viewer, labs});
    return render(templates, options.design + ".html", model, xml_escape);
}

}   // namespace meshfolio::report
