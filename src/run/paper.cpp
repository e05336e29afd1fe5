#include "run/paper.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/child_process.h"
#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/sha256.h"
#include "output/publish/temporaries.h"
#include "report/page/volumes.h"
#include "report/pdf/pdf_finish.h"
#include "report/pdf/print_pdf.h"
#include "run/arguments.h"
#include "run/console.h"
#include "run/provenance.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

/// Creates a folder with a short path, because sockets that browsers make in it have paths of at most 107 bytes.
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

/// Returns the engine for --pdf; nothing for `off`, or with a warning if `auto` finds none.
/// @throws EngineError when one is required and none is there
std::optional<report::PdfEngine> wanted_engine(const ReportSettings& settings) {
    if (settings.pdf == "off") return {};
    report::EngineFinding finding = report::find_pdf_engine(report::engine_search(settings.pdf_browser));
    std::string refused;
    for (const std::string& one : finding.refused) refused += (refused.empty() ? " (" : "; ") + one;
    if (!refused.empty()) refused += ")";
    const std::string remedy = "install chromium-headless-shell, or name a browser with --pdf-browser";
    if (!finding.engine && settings.pdf == "require") throw EngineError("there is no PDF engine" + refused, remedy);
    if (!finding.engine) warn("there is no PDF engine" + refused + ", and so no report.pdf and no appendix.pdf; " + remedy);
    return finding.engine;
}

/// Returns the bytes of a PDF, which do not depend on the time or the place.
/// @throws EngineError if the engine does not deliver
std::string printed(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                    report::Volume volume, const report::PdfEngine& engine) {
    const bool mathml = engine.kind == report::PdfEngine::Kind::chromium;
    // A first look does without page numbers in the contents, and comes a third sooner. Read from the document, so that a report rendered
    // again is printed as it was.
    const auto quick = document.provenance.settings.find("quick");
    const bool first_look = quick != document.provenance.settings.end() && quick->second == "yes";
    const bool is_report = volume == report::Volume::report;   // the results are attached to it, once
    const report::PrintJob job{
        report::print_page(document, figures, templates, {.volume = volume, .mathml = mathml, .page_numbers = !first_look}),
        is_report ? document.title : "Appendix to " + document.title,
        document.author,
        "meshfolio " + document.provenance.version,
        report::pdf_date(environment("SOURCE_DATE_EPOCH")),
        is_report ? "results.json" : "",
        is_report ? report::write_json(document, figures, {.timings = false}) : ""};
    const output::Temporary scratch = scratch_folder();
    return report::print_pdf(job, engine, scratch.path());
}

/// Returns the cache key of a PDF, of everything that shapes its bytes: words, templates, pictures, program and browser.
std::string key_of(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                   report::Volume volume, const report::PdfEngine& engine, const fs::path& folder) {
    output::KeyMaker key;
    key.add(report::pdf_file(volume)).add(program_identity()).add(engine.program.string()).add(engine.version);
    key.add(environment("SOURCE_DATE_EPOCH"));
    for (const std::string& name : templates.names()) key.add(name).add(templates[name]);
    key.add(report::write_json(document, figures, {.timings = false}));
    for (const std::string& id : report::figures_in(document, volume)) {
        const auto drawn = figures.find(id);
        key.add(id).add(drawn == figures.end() ? "" : sha256_of_file(folder / drawn->second.sheet));
    }
    return key.key();
}

}   // namespace

Paper::Paper(const ReportSettings& settings, const report::Templates& templates, output::ResultCache* store)
    : templates_(templates), store_(store), required_(settings.pdf == "require"), engine_(wanted_engine(settings)) {}

Paper::~Paper() {
    if (std::ranges::any_of(printing_, [](const auto& volume) { return volume.second.valid(); })) abandon_children();
}

std::string Paper::pdf_of(report::Volume volume, const report::Document& document, const report::DrawnFigures& figures,
                          const fs::path& folder) const {
    if (store_ == nullptr || program_identity().empty()) return printed(document, figures, templates_, volume, *engine_);
    const std::string key = key_of(document, figures, templates_, volume, *engine_, folder);
    if (std::optional<std::string> stored = store_->get(key)) return std::move(*stored);
    std::string pdf = printed(document, figures, templates_, volume, *engine_);
    try {
        store_->put(key, pdf);
    } catch (const OutputError&) {
        // the cache is no part of the report
    }
    return pdf;
}

void Paper::begin(report::Volume volume, report::Document document, report::DrawnFigures figures, fs::path folder) {
    if (!is_wanted()) return;
    auto print = [this, volume, document = std::move(document), figures = std::move(figures), folder = std::move(folder)] {
        const std::string name = report::pdf_file(volume);
        std::string pdf;
        try {
            pdf = pdf_of(volume, document, figures, folder);
        } catch (const Error& error) {
            const std::string remedy = "name another browser with --pdf-browser, or take --pdf off";
            if (required_) throw EngineError(error.what(), remedy);
            return "there is no " + name + ": " + error.what() + "; " + remedy;
        }
        write_file(folder / name, pdf);
        return std::string();
    };
    // A thread that waits for the browser is none of those that compute.
    printing_[volume] = std::async(std::launch::async, std::move(print));
}

std::vector<std::string> Paper::finish() {
    std::vector<std::string> warnings;
    for (auto& [volume, warning] : printing_) warnings.push_back(warning.get());
    return warnings;
}

}   // namespace meshfolio::run
