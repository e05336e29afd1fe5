#include "run/print_report.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "output/publish/leftovers.h"
#include "output/publish/temporaries.h"
#include "report/pdf/pdf_finish.h"
#include "report/pdf/print_page.h"
#include "report/pdf/print_pdf.h"
#include "run/console.h"

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

}   // namespace

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

std::string printed_report(const report::Document& document, const report::DrawnFigures& figures, const report::Templates& templates,
                           report::Extent extent, const report::PdfEngine& engine) {
    const bool mathml = engine.kind == report::PdfEngine::Kind::chromium;
    // A first look does without page numbers in the contents, and comes a third sooner. Read from the document, so that a report rendered
    // again is printed as it was.
    const auto quick = document.provenance.settings.find("quick");
    const bool first_look = quick != document.provenance.settings.end() && quick->second == "yes";
    report::PrintPage page =
        report::print_page(document, figures, templates, {.extent = extent, .mathml = mathml, .page_numbers = !first_look});
    const char* seconds = std::getenv("SOURCE_DATE_EPOCH");
    const report::PrintJob job{std::move(page.html),
                               std::move(page.files),
                               document.title,
                               document.author,
                               "meshfolio " + document.provenance.version,
                               report::pdf_date(seconds != nullptr ? seconds : ""),
                               "results.json",
                               report::write_json(document, figures, {.timings = false})};
    const output::Temporary scratch = scratch_folder();
    return report::print_pdf(job, engine, scratch.path());
}

}   // namespace meshfolio::run
