// results.json, for programs and for `report --from`. Its schema is json_schema.cpp, its reader read_json.cpp.
#include <set>
#include <utility>

#include "report/json/json_report.h"
#include "report/json/json_sections.h"
#include "report/json/json_writer.h"
#include "report/numbering.h"
#include "report/writers.h"

namespace meshfolio::report {

std::vector<MeshDigest> input_meshes(const std::vector<Section>& sections) {
    std::set<std::pair<std::string, std::string>> meshes;
    for (const Section& section : sections) {
        for (const Input& input : section.inputs) meshes.emplace(input.file, input.sha256);
    }
    std::vector<MeshDigest> list;
    for (const auto& [file, sha256] : meshes) list.push_back({file, sha256});
    return list;
}

std::string write_json(const Document& document, const DrawnFigures& figures, const WriteOptions& options) {
    ReportEntry entry;
    entry.title = document.title;
    entry.author = document.author;
    entry.course = document.course;
    entry.provenance = {document.provenance, input_meshes(document.sections)};
    if (document.cover) entry.cover = entry_of(*document.cover, figures);
    for (const Section& section : document.sections)
        (is_question(section.id) ? entry.questions : entry.supporting).push_back(entry_of(section, figures, options.timings));
    entry.with_timings = options.timings;
    entry.timings = document.timings;
    return json_of(entry).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}   // namespace meshfolio::report
