// results.json, for programs and for `report --from`. Its schema is json_schema.cpp, its reader read_json.cpp.
#include <set>
#include <tuple>
#include <utility>

#include "report/json/json_fields.h"
#include "report/json/json_writer.h"
#include "report/numbering.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

FigureEntry entry_of(const Figure& figure, const DrawnFigures& drawn) {
    const auto it = drawn.find(figure.id);
    if (it == drawn.end()) return {figure, false, {}};
    FigureEntry entry{figure, true, it->second};
    // Pictures and models are files of their own.
    for (DrawnPanel& panel : entry.drawn.panels)
        for (DrawnPicture& picture : panel.pictures) picture.jpeg.clear();
    for (DrawnModel& model : entry.drawn.models) model.glb.clear();
    return entry;
}

/// Adds a block to the list of its kind and to the order of blocks.
void add_block(SectionEntry& entry, const Block& block, const DrawnFigures& drawn) {
    static_assert(std::variant_size_v<Block> == names_of(BlockEntry::Kind()).size(), "blocks and their kinds have one order");
    BlockEntry& place = entry.blocks.emplace_back();
    place.kind = static_cast<BlockEntry::Kind>(block.index());
    const auto add = [&](auto& list, const auto* part) {
        if (part == nullptr) return;
        place.id = part->id;
        list.push_back(*part);
    };
    add(entry.tables, std::get_if<Table>(&block));
    add(entry.plots, std::get_if<Plot>(&block));
    add(entry.maps, std::get_if<Map>(&block));
    add(entry.diagrams, std::get_if<Diagram>(&block));
    if (const auto* heading = std::get_if<Heading>(&block)) place.title = heading->title;
    if (const auto* paragraph = std::get_if<Paragraph>(&block)) place.text = paragraph->text;
    if (const auto* bullets = std::get_if<BulletList>(&block)) place.items = bullets->items;
    if (const auto* formula = std::get_if<Formula>(&block)) std::tie(place.name, place.id) = std::tie(formula->name, formula->id);
    if (const auto* figure = std::get_if<Figure>(&block)) {
        place.id = figure->id;
        entry.figures.push_back(entry_of(*figure, drawn));
    }
}

SectionEntry entry_of(const Section& section, const DrawnFigures& drawn, bool with_timings) {
    SectionEntry entry;
    for (const Block& block : section.blocks) add_block(entry, block, drawn);
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
    entry.pages = document.pages;
    entry.provenance = {document.provenance, input_meshes(document.sections)};
    for (const Section& section : document.sections)
        (is_question(section.id) ? entry.questions : entry.supporting).push_back(entry_of(section, figures, options.timings));
    if (options.timings) entry.timings = document.timings;
    return json_of(entry).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}   // namespace meshfolio::report
