// results.json, for programs and for `report --from`. Its schema is json_schema.cpp, its reader read_json.cpp.
#include <set>
#include <utility>

#include "report/json/json_fields.h"
#include "report/json/json_writer.h"
#include "report/numbering.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

FigureEntry entry_of(const Figure& figure, const DrawnFigures& drawn) {
    const auto it = drawn.find(figure.id);
    FigureEntry entry{figure, it != drawn.end(), {}};
    if (!entry.is_drawn) return entry;
    // Pictures and models are files of their own.
    entry.drawn = it->second;
    for (DrawnPanel& panel : entry.drawn.panels)
        for (DrawnPicture& picture : panel.pictures) picture.jpeg.clear();
    for (DrawnModel& model : entry.drawn.models) model.glb.clear();
    return entry;
}

/// Sorts the blocks of a section by kind and records their order.
class Sorter {
public:
    Sorter(SectionEntry& entry, const DrawnFigures& drawn) : entry_(entry), drawn_(drawn) {}

    void operator()(const Heading& heading) { add(BlockEntry::Kind::heading).title = heading.title; }
    void operator()(const Paragraph& paragraph) { add(BlockEntry::Kind::paragraph).text = paragraph.text; }
    void operator()(const BulletList& list) { add(BlockEntry::Kind::list).items = list.items; }
    void operator()(const Formula& formula) { add(BlockEntry::Kind::formula, formula.id).name = formula.name; }
    void operator()(const Table& table) { enter(BlockEntry::Kind::table, entry_.tables, table.id, table); }
    void operator()(const Plot& plot) { enter(BlockEntry::Kind::plot, entry_.plots, plot.id, plot); }
    void operator()(const Map& map) { enter(BlockEntry::Kind::map, entry_.maps, map.id, map); }
    void operator()(const Diagram& diagram) { enter(BlockEntry::Kind::diagram, entry_.diagrams, diagram.id, diagram); }
    void operator()(const Figure& figure) { enter(BlockEntry::Kind::figure, entry_.figures, figure.id, entry_of(figure, drawn_)); }
    void operator()(const EntryList& list) {
        BlockEntry& block = add(BlockEntry::Kind::entries);
        block.title = list.kind;
        for (const Entry& one : list.entries) {
            block.ids.push_back(one.id);
            entry_.entries.push_back({list.kind, one});
        }
    }

private:
    SectionEntry& entry_;
    const DrawnFigures& drawn_;

    BlockEntry& add(BlockEntry::Kind kind, const std::string& id = "") {
        BlockEntry& block = entry_.blocks.emplace_back();
        block.kind = kind;
        block.id = id;
        return block;
    }
    template <class Part>
    void enter(BlockEntry::Kind kind, std::vector<Part>& list, const std::string& id, Part part) {
        add(kind, id);
        list.push_back(std::move(part));
    }
};

SectionEntry entry_of(const Section& section, const DrawnFigures& drawn, bool with_timings) {
    SectionEntry entry;
    Sorter sorter(entry, drawn);
    for (const Block& block : section.blocks) std::visit(sorter, block);
    entry.section = section;
    entry.section.blocks.clear();
    entry.section.checks.clear();
    entry.section.parameters.clear();
    entry.parameters = texts_of(section.parameters);
    std::vector<std::string> parameters = parameter_ids(section);
    for (const auto& [name, parameter] : section.parameters)
        entry.parameter_values.push_back({parameters[entry.parameter_values.size()], name, parameter.unit, parameter.value});
    const std::vector<std::string> ids = check_ids(section);
    for (std::size_t i = 0; i < ids.size(); ++i) entry.checks.push_back({ids[i], section.checks[i]});
    entry.section.timings.clear();
    if (with_timings) entry.timings = section.timings;
    return entry;
}

}   // namespace

std::vector<MeshDigest> input_meshes(const std::vector<Section>& sections) {
    std::set<std::pair<std::string, std::string>> meshes;
    for (const Section& section : sections)
        for (const Input& input : section.inputs) meshes.emplace(input.file, input.sha256);
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
    for (const Section& section : document.sections)
        (is_question(section.id) ? entry.questions : entry.supporting).push_back(entry_of(section, figures, options.timings));
    if (options.timings) entry.timings = document.timings;
    return json_of(entry).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}   // namespace meshfolio::report
