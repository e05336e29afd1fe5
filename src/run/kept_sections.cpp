#include "run/kept_sections.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/parallel_tasks.h"
#include "base/sha256.h"
#include "output/publish/folder_system.h"
#include "output/publish/publish.h"
#include "run/arguments.h"
#include "run/earlier_report.h"
#include "run/provenance.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

using Inputs = std::set<std::tuple<std::string, std::string, std::string, std::string>>;

/// Without how much is done of each section: that follows from the rest, and from what is named.
report::Provenance without_efforts(report::Provenance provenance) {
    std::erase_if(provenance.settings, [](const auto& setting) { return setting.first.ends_with(effort_suffix); });
    return provenance;
}

/// What the earlier report was made of or with and this run is not; empty: nothing.
std::string difference_to(const EarlierReport& earlier, const std::vector<const report::Section*>& kept, const ReportSettings& settings,
                          const MeshLibrary& meshes) {
    const report::Provenance now = without_efforts(provenance_of(described(settings), settings.seed));
    if (const std::string what = difference(without_efforts(earlier.document.provenance), now); !what.empty()) return what;
    Inputs seen;
    for (const report::Section* section : kept) {
        for (const report::Input& input : section->inputs) {
            if (!seen.emplace(input.role, input.asked, input.file, input.sha256).second) continue;
            if (!meshes.still_has(input, settings.base)) return "another " + input.file;
        }
    }
    return "";
}

[[noreturn]] void refuse_missing(const std::string& file) { throw InputError({file}, "is missing", "make the report anew"); }

/// @throws InputError for a file that is missing or not what it was
StoredAnswer placed(const EarlierReport& earlier, const report::Section& section, report::DrawnFigures figures, const fs::path& folder) {
    StoredAnswer answer;
    answer.section = section;
    answer.section.timings.clear();   // of that run
    answer.figures = std::move(figures);
    for (auto& [id, figure] : answer.figures)
        if (!earlier.restore(figure)) refuse_missing(figure.sheet);
    for (const std::string& file : files_of(section, answer.figures)) {
        const auto bytes = earlier.bytes_of(file);
        if (!bytes) refuse_missing(file);
        output::make_folder((folder / file).parent_path());
        write_file(folder / file, *bytes);
        answer.digests[file] = sha256(*bytes);
    }
    return answer;
}

report::DrawnFigures figures_of(const EarlierReport& earlier, const std::string& section) {
    report::DrawnFigures figures;
    std::ranges::copy_if(earlier.figures, std::inserter(figures, figures.end()),
                         [&](const auto& figure) { return figure.first.starts_with(section + "_"); });
    return figures;
}

std::unique_ptr<const EarlierReport> earlier_at(const fs::path& out, std::string& note) try {
    if (!may_be_there(out / "results.json")) return nullptr;
    return std::make_unique<const EarlierReport>(out / "results.json");
} catch (const InputError& error) {   // of another version, perhaps
    note = error.what();
    return nullptr;
}

}   // namespace

void KeptSections::tell_efforts(std::map<std::string, std::string>& described) const {
    for (const auto& [id, answer] : answers) {
        const std::string name = id + effort_suffix;
        described.erase(name);
        if (const auto effort = settings.find(name); effort != settings.end()) described.insert(*effort);
    }
}

KeptSections kept_sections(const ReportSettings& settings, const MeshLibrary& meshes, const fs::path& folder) {
    KeptSections kept;
    const auto earlier = earlier_at(settings.out, kept.note);
    if (!earlier) return kept;
    std::vector<const report::Section*> sections;
    for (const report::Section& section : earlier->document.sections)
        if (section.status != report::Status::skipped && !contains(settings.only, section.id)) sections.push_back(&section);
    const std::string what = sections.empty() ? "" : difference_to(*earlier, sections, settings, meshes);
    if (!what.empty()) {
        kept.note = settings.out.string() + " has only what was asked for: its other sections were made with " + what;
        return kept;
    }
    std::vector<StoredAnswer> answers(sections.size());
    for_each_task(sections.size(),
                  [&](std::size_t i) { answers[i] = placed(*earlier, *sections[i], figures_of(*earlier, sections[i]->id), folder); });
    for (StoredAnswer& answer : answers) kept.answers[answer.section.id] = std::move(answer);
    kept.settings = earlier->document.provenance.settings;
    return kept;
}

}   // namespace meshfolio::run
