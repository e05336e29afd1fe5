#include "run/paper_copy.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/sha256.h"
#include "output/publish/temporaries.h"
#include "report/pdf/pdf_finish.h"
#include "report/pdf/print_page.h"
#include "report/pdf/print_pdf.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/program_identity.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

/// Short, because sockets that browsers make in it have paths of at most 107 bytes.
output::Temporary scratch_folder() {
    std::error_code error;
    const fs::path place = fs::temp_directory_path(error);
    const std::string stem = "meshfolio-print-";
    output::sweep_scratch_leftovers(error ? "/tmp" : place, stem);
    std::string name = ((error ? fs::path("/tmp") : place) / (stem + output::process_number() + "-XXXXXX")).string();
    const auto permission = output::permission_to_create();
    if (::mkdtemp(name.data()) == nullptr)
        throw OutputError(name, std::string("cannot be made (") + std::strerror(errno) + ")", "set TMPDIR");
    return output::Temporary(name);
}

/// The engine that --pdf asks for; with `auto`, when there is none, says so in a warning.
/// @throws EngineError when one is required and none is there
std::optional<report::PdfEngine> wanted_engine(const ReportSettings& settings) {
    if (settings.pdf == "off") return {};
    report::EngineFinding finding = report::find_pdf_engine(report::engine_search(settings.pdf_browser));
    std::string refused;
    for (const std::string& one : finding.refused) refused += (refused.empty() ? " (" : "; ") + one;
    if (!refused.empty()) refused += ")";
    const std::string remedy = "install chromium-headless-shell, or name a browser with --pdf-browser";
    if (!finding.engine && settings.pdf == "require") throw EngineError("there is no PDF engine" + refused, remedy);
    if (!finding.engine) warn("there is no PDF engine" + refused + ", and so no report.pdf; " + remedy);
    return finding.engine;
}

/// The bytes of report.pdf. Nothing in them depends on the time or the place.
/// @throws EngineError if the engine does not deliver
std::string printed_report(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                           report::Extent extent, const report::PdfEngine& engine) {
    const bool mathml = engine.kind == report::PdfEngine::Kind::chromium;
    // A first look does without page numbers in the contents, and comes a third sooner. Read from the document, so that a report rendered
    // again is printed as it was.
    const auto quick = document.provenance.settings.find("quick");
    const bool first_look = quick != document.provenance.settings.end() && quick->second == "yes";
    report::PrintPage page =
        report::print_page(document, figures, templates, {.extent = extent, .mathml = mathml, .page_numbers = !first_look});
    const report::PrintJob job{std::move(page.html),
                               std::move(page.files),
                               document.title,
                               document.author,
                               "meshfolio " + document.provenance.version,
                               report::pdf_date(environment("SOURCE_DATE_EPOCH")),
                               "results.json",
                               report::write_json(document, figures, {.timings = false})};
    const output::Temporary scratch = scratch_folder();
    return report::print_pdf(job, engine, scratch.path());
}

}   // namespace

PaperCopy::PaperCopy(const ReportSettings& settings, const report::Templates& templates, report::Extent extent)
    : templates_(templates), extent_(extent), required_(settings.pdf == "require"), engine_(wanted_engine(settings)) {}

/// Of everything that shapes the bytes: the words, the templates, the pictures, who sets and prints them.
std::string PaperCopy::key_of(const report::Document& document, const report::DrawnFigures& figures, const fs::path& folder) const {
    output::KeyMaker key;
    key.add("report.pdf").add(program_identity()).add(engine_->program.string()).add(engine_->version);
    key.add(extent_ == report::Extent::whole ? "whole" : "brief").add(environment("SOURCE_DATE_EPOCH"));
    for (const std::string& name : templates_.names()) key.add(name).add(templates_[name]);
    key.add(report::write_json(document, figures, {.timings = false}));
    for (const std::string& id : report::figures_shown(document, extent_)) {
        const auto drawn = figures.find(id);
        key.add(id).add(drawn == figures.end() ? "" : sha256_of_file(folder / drawn->second.sheet));
    }
    return key.key();
}

void PaperCopy::look_up(const report::Document& document, const report::DrawnFigures& figures, output::ResultCache* store,
                        const fs::path& folder) {
    if (!is_wanted() || store == nullptr || program_identity().empty()) return;
    key_ = key_of(document, figures, folder);
    stored_ = store->get(key_);
}

std::string PaperCopy::write(const report::Document& document, const report::DrawnFigures& figures, output::ResultCache* store,
                             const fs::path& folder) const {
    if (!is_wanted()) return "";
    std::string pdf;
    if (stored_) {
        pdf = *stored_;
    } else {
        try {
            pdf = printed_report(document, figures, templates_, extent_, *engine_);
        } catch (const Error& error) {
            const std::string remedy = "name another browser with --pdf-browser, or take --pdf off";
            if (required_) throw EngineError(error.what(), remedy);
            return std::string("there is no report.pdf: ") + error.what() + "; " + remedy;
        }
        try {
            if (!key_.empty()) store->put(key_, pdf);
        } catch (const OutputError&) {
            // the cache is no part of the report
        }
    }
    write_file(folder / "report.pdf", pdf);
    return "";
}

}   // namespace meshfolio::run
