#include "report/page/page_design.h"

#include <libdeflate.h>
#include <memory>
#include <new>

#include "base/base64.h"
#include "base/errors.h"
#include "base/sha256.h"
#include "embedded_page_fonts.h"
#include "embedded_viewer.h"
#include "report/page/view_value.h"

namespace meshfolio::report {

namespace {

const std::string& raw_text(const Templates& templates, const std::string& name) {
    const std::string& text = templates[name];
    for (const char* end : {"]]>", "</style", "</script", "<!--"})
        if (text.find(end) != std::string::npos)
            throw UsageError(std::string("\"") + end + "\" would break the script or style that holds it", "take it out of this template",
                             {name, 0});
    return text;
}

/// Returns a style or script in a CDATA section inside comments, because it is raw text to an HTML parser and markup to an XML parser.
std::string raw_element(const std::string& text) { return "/*<![CDATA[*/\n" + text + "/*]]>*/"; }

/// Returns fonts.css with the fonts inside, followed by the other sheets. Pages other than reports omit mathematics and italics.
std::string joined_styles(const Templates& templates, const std::vector<std::string>& names, bool is_report) {
    std::string text = raw_text(templates, "fonts.css");
    for (const auto& font : meshfolio_embedded::embedded_page_fonts()) {
        const std::string file = "url(" + std::string(font.name) + ")";
        const bool left_out = !is_report && (font.name.starts_with("math") || font.name.find("italic") != std::string_view::npos);
        const std::string source = left_out ? "local(none)" : "url(data:font/woff2;base64," + base64(font.bytes) + ")";
        if (const std::size_t at = text.find(file); at != std::string::npos) text.replace(at, file.size(), source);
    }
    for (const std::string& name : names) text += raw_text(templates, name);
    return raw_element(text);
}

/// Returns a content security policy that allows exactly these texts.
std::string policy_for(const std::string& style, const std::vector<std::string>& scripts) {
    const auto source = [](const std::string& text) { return " 'sha256-" + base64(sha256_bytes(text)) + "'"; };
    std::string allowed;
    for (const std::string& script : scripts) allowed += source(script);
    return "default-src 'none'; img-src 'self' data:; font-src data:; style-src" + source(style) + "; script-src" + allowed +
           "; base-uri 'none'; form-action 'none'";
}

}   // namespace

void add_design(nlohmann::json& model, const Templates& templates, const std::string& design, const DesignParts& parts) {
    const bool on_screen = design != "print", has_models = on_screen && (parts.models || !parts.labs.empty());
    const bool with_viewer = has_models && !parts.viewer.empty();
    // The head of each script names those before it that it depends on.
    std::vector<std::string> styles = {"figure.css", on_screen ? "report.css" : "print.css"}, scripts;
    if (design == "print") scripts = {"print_hyphens.js", "print_text.js", "print_pages.js", "print_float.js"};
    if (design == "report") styles.emplace_back("page_lightbox.css"), scripts = {"page_contents.js", "page_tables.js", "page_lightbox.js"};
    for (const char* sheet : {"batch", "class", "compare", "diff", "mark"})
        if (design == sheet) styles.emplace_back("sheets.css"), scripts = {"page_tables.js"};
    if (design == "diff") scripts.emplace_back("page_slider.js");
    if (has_models) styles.emplace_back("models.css");
    if (with_viewer && !parts.labs.empty()) styles.emplace_back("lab.css");
    if (with_viewer) scripts.emplace_back("models.js");

    const std::string style = joined_styles(templates, styles, design == "report" || !on_screen);
    std::string joined_scripts = "\"use strict\";\n";
    for (const std::string& name : scripts) joined_scripts += "{\n" + raw_text(templates, name) + "}\n";   // declarations stay local
    const std::string script = raw_element(joined_scripts);
    // The scheme is a script of its own, as it is chosen before the page is drawn.
    const std::string scheme = on_screen ? raw_element(raw_text(templates, "page_scheme.js")) : "";
    std::vector<std::string> run = {script};   // scripts that run
    if (on_screen) run.push_back(scheme);
    if (with_viewer) run.emplace_back(parts.viewer);
    enter(model, {{"style", "report.css or print.css", style},
                  {"scheme_script", "page_scheme.js, which is run before anything is drawn (report.html only)", scheme},
                  {"script", "what the page does by itself", script},
                  {"has_viewer", "some figure can be turned, and the page carries the program for it (report.html only)", with_viewer},
                  {"viewer", "the program that turns models, zlib and base64 (report.html only)", with_viewer ? packed(parts.viewer) : ""},
                  {"labs", "meshes of the laboratory, each once (report.html and lab.html only)",
                   list_of(with_viewer ? parts.labs : std::vector<Lab>(),
                           [](const Lab& lab) {
                               return view_of({{"questions", "ids of those that open it", lab.questions},
                                               {"data", "its modes, zlib and base64", lab.data}});
                           })},
                  {"policy", "content security policy that allows just these", policy_for(style, run)},
                  {"is_screen", "the page is for a screen, not for paper", on_screen}});
}

std::string_view viewer_program() { return meshfolio_embedded::embedded_viewer().front().bytes; }

std::string packed(std::string_view bytes) {
    constexpr int level = 9;   // of 12; the next takes several times as long for one percent
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(libdeflate_alloc_compressor(level),
                                                                                                   &libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::string zlib(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
    zlib.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), zlib.data(), zlib.size()));
    return base64(zlib);
}

}   // namespace meshfolio::report
