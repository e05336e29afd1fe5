// index.html: one file that needs nothing else, read by HTML and by XML parsers alike.
#include <array>
#include <nlohmann/json.hpp>

#include "errors.h"
#include "report/escape.h"
#include "report/template_render.h"
#include "report/view_model.h"
#include "report/writers.h"
#include "sha256.h"

namespace meshfolio::report {

namespace {

/// What each does is told at its head. They know nothing of one another.
constexpr std::array scripts{"page_contents.js", "page_tables.js", "page_lightbox.js", "page_comparison.js"};

const std::string& raw_text(const Templates& templates, const std::string& name) {
    const std::string& text = templates[name];
    for (const char* end : {"]]>", "</style", "</script", "<!--"}) {
        if (text.find(end) != std::string::npos) throw UsageError(std::string("\"") + end + "\" cannot stand in a page", "", {name, 0});
    }
    return text;
}

/// To an HTML parser style and script are raw text, to an XML parser they are markup: the CDATA section inside comments suits both.
std::string raw_element(const std::string& text) { return "/*<![CDATA[*/\n" + text + "/*]]>*/"; }

/// A block each: what one file declares is not seen by the others.
std::string joined_scripts(const Templates& templates) {
    std::string text = "\"use strict\";\n";
    for (const char* name : scripts) text += "{\n" + raw_text(templates, name) + "}\n";
    return text;
}

/// What the policy allows is exactly this text.
std::string policy_source(const std::string& text) { return "'sha256-" + base64(sha256_bytes(text)) + "'"; }

}   // namespace

std::string write_html(const Document& document, const DrawnFigures& figures, const Templates& templates, const WriteOptions& options) {
    ViewOptions view;
    view.timings = options.timings;
    view.plot_files = options.plot_files;
    nlohmann::json model = view_model(document, figures, templates, view);
    // The scheme is chosen before anything is drawn, hence a script of its own.
    const std::string style = raw_element(raw_text(templates, "report.css")), scheme = raw_element(raw_text(templates, "page_scheme.js")),
                      script = raw_element(joined_scripts(templates));
    model["style"] = style;
    model["scheme_script"] = scheme;
    model["script"] = script;
    model["policy"] = "default-src 'none'; img-src 'self' data:; style-src " + policy_source(style) + "; script-src " +
                      policy_source(scheme) + " " + policy_source(script) + "; base-uri 'none'; form-action 'none'";
    return render(templates, "report.html", model, xml_escape);
}

}   // namespace meshfolio::report
