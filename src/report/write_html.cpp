// index.html: one file that needs nothing else, read by HTML and by XML parsers alike.
#include <algorithm>
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
std::string raw_element(const Templates& templates, const std::string& name, const std::string& and_then) {
    const std::string text = templates[name] + (and_then.empty() ? "" : templates[and_then]);
    for (const char* end : {"]]>", "</style", "</script", "<!--"}) {
        if (text.find(end) != std::string::npos) throw UsageError(std::string("\"") + end + "\" cannot stand in a page", "", {name, 0});
    }
    return "/*<![CDATA[*/\n" + text + "/*]]>*/";
}

/// What the policy allows is exactly this text.
std::string policy_source(const std::string& text) { return "'sha256-" + base64(sha256_bytes(text)) + "'"; }

bool has_models(const DrawnFigures& figures) {
    return std::any_of(figures.begin(), figures.end(), [](const auto& figure) { return !figure.second.models.empty(); });
}

}   // namespace

std::string write_html(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options) {
    ViewOptions view;
    view.timings = options.timings;
    view.plot_files = options.plot_files;
    view.models = !options.viewer.empty();
    nlohmann::json model = view_model(document, figures, templates, view);
    const bool with_models = has_models(figures), with_viewer = with_models && view.models;
    const std::string style = raw_element(templates, "report.css", with_models ? "models.css" : "");
    const std::string script = raw_element(templates, "report.js", with_viewer ? "models.js" : "");
    model["style"] = style;
    model["script"] = script;
    model["has_viewer"] = with_viewer;
    model["viewer"] = with_viewer ? packed(options.viewer) : "";
    model["policy"] = "default-src 'none'; img-src 'self' data:; style-src " + policy_source(style) + "; script-src " +
                      policy_source(script) + (with_viewer ? " " + policy_source(std::string(options.viewer)) : "") +
                      "; base-uri 'none'; form-action 'none'";
    return render(templates, "report.html", model, xml_escape);
}

}   // namespace meshfolio::report
