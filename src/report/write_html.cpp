// index.html: one file that needs nothing else, read by HTML and by XML parsers alike.
#include <nlohmann/json.hpp>

#include "errors.h"
#include "report/escape.h"
#include "report/template_render.h"
#include "report/view_model.h"
#include "report/writers.h"
#include "sha256.h"

namespace meshfolio::report {

namespace {

/// To an HTML parser style and script are raw text, to an XML parser they are markup: the CDATA section inside comments suits both.
std::string raw_element(const Templates& templates, const std::string& name) {
    const std::string& text = templates[name];
    for (const char* end : {"]]>", "</style", "</script", "<!--"}) {
        if (text.find(end) != std::string::npos) throw UsageError(std::string("\"") + end + "\" cannot stand in a page", "", {name, 0});
    }
    return "/*<![CDATA[*/\n" + text + "/*]]>*/";
}

/// What the policy allows is exactly this text.
std::string policy_source(const std::string& text) { return "'sha256-" + base64(sha256_bytes(text)) + "'"; }

}   // namespace

void add_style(nlohmann::json& model, const Templates& templates, const std::string& design) {
    const bool has_script = design == "report";
    const std::string style = raw_element(templates, design + ".css"), script = has_script ? raw_element(templates, design + ".js") : "";
    model["style"] = style;
    model["script"] = script;
    model["policy"] = "default-src 'none'; img-src 'self' data:; style-src " + policy_source(style) + "; script-src " +
                      (has_script ? policy_source(script) : "'none'") + "; base-uri 'none'; form-action 'none'";
}

std::string write_html(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options) {
    ViewOptions view;
    view.timings = options.timings;
    view.plot_files = options.plot_files;
    nlohmann::json model = view_model(document, figures, templates, view);
    add_style(model, templates, options.design);
    return render(templates, options.design + ".html", model, xml_escape);
}

}   // namespace meshfolio::report
