#include "report/json/read_json.h"

#include <set>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "report/json/json_line.h"
#include "report/json/json_reader.h"
#include "report/json/json_report.h"
#include "report/json/json_sections.h"
#include "report/numbering.h"

namespace meshfolio::report {

namespace {

constexpr int deepest_json = 64;   // ours is at most a third as deep

/// Refuses an id that something else has already.
class Ids {
public:
    void add(const std::string& id, const JsonPlace& place) {
        if (!ids_.insert(id).second) throw JsonProblem(place, "uses the id " + in_quotes(id) + " a second time", "give each its own");
    }

    void add(const SectionEntry& section, const JsonPlace& place) {
        add(section.section.id, place);
        add_all(section.tables, {&place, "tables"}, [](const Table& table) { return table.id; });
        add_all(section.plots, {&place, "plots"}, [](const Plot& plot) { return plot.id; });
        add_all(section.maps, {&place, "maps"}, [](const Map& map) { return map.id; });
        add_all(section.figures, {&place, "figures"}, [](const FigureEntry& entry) { return entry.figure.id; });
        add_all(section.entries, {&place, "entries"}, [](const NumberedEntry& entry) { return entry.entry.id; });
        const JsonPlace blocks{&place, "blocks"};
        for (std::size_t i = 0; i < section.blocks.size(); ++i) {
            const BlockEntry& block = section.blocks[i];
            if (block.kind == BlockEntry::Kind::formula && !block.id.empty()) add(block.id, {&blocks, {}, i});
        }
    }

private:
    std::set<std::string> ids_;

    template <class Item, class IdOf>
    void add_all(const std::vector<Item>& items, const JsonPlace& place, IdOf id_of) {
        for (std::size_t i = 0; i < items.size(); ++i) add(id_of(items[i]), {&place, {}, i});
    }
};

/// An older reader must not take a newer file for its own.
void require_version(const Json& json) {
    const JsonPlace root;
    const auto version = json.is_object() ? json.find("schema_version") : json.end();
    if (!json.is_object() || version == json.end()) throw JsonProblem(root, "is no results.json", "name the results.json of a report");
    if (*version == schema_version) return;
    throw JsonProblem(
        {&root, "schema_version"},
        "is " + in_quotes(version->dump(-1, ' ', true, Json::error_handler_t::replace)) + ", not " + std::to_string(schema_version),
        "make the report anew, or take the meshfolio that made it");
}

void add_sections(std::vector<SectionEntry>& entries, bool questions, const char* key, Ids& ids, ReadReport& read) {
    const JsonPlace root, list{&root, key};
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const JsonPlace place{&list, {}, i};
        ids.add(entries[i], place);
        if (is_question(entries[i].section.id) != questions) throw JsonProblem(place, "belongs to the other list", "move it there");
        if (entries[i].with_timings != read.timings) throw JsonProblem(place, "has timings and others have none, or the other way round");
        read.document.sections.push_back(section_of(std::move(entries[i]), read.figures, place));
    }
}

ReadReport report_of(ReportEntry entry) {
    const JsonPlace root;
    ReadReport read;
    read.timings = entry.with_timings;
    Document& document = read.document;
    document.title = std::move(entry.title);
    document.author = std::move(entry.author);
    document.course = std::move(entry.course);
    document.provenance = std::move(entry.provenance.provenance);
    document.timings = std::move(entry.timings);
    Ids ids;
    if (entry.cover) {
        ids.add(entry.cover->figure.id, {&root, "cover"});
        document.cover = std::move(entry.cover->figure);
        if (entry.cover->is_drawn) read.figures[document.cover->id] = std::move(entry.cover->drawn);
    }
    add_sections(entry.questions, true, "questions", ids, read);
    add_sections(entry.supporting, false, "supporting", ids, read);
    if (input_meshes(document.sections) != entry.provenance.inputs) {
        const JsonPlace provenance{&root, "provenance"};
        throw JsonProblem({&provenance, "inputs"}, "does not list the inputs of the questions", "leave it as it was");
    }
    return read;
}

}   // namespace

ReadReport read_json(std::string_view text, const std::string& file) {
    if (const auto deep = deeper_than(deepest_json, text)) {
        throw InputError({file, line_of_byte(text, *deep)}, "is nested more than " + std::to_string(deepest_json) + " deep",
                         "take a results.json as meshfolio writes it");
    }
    try {
        const Json json = Json::parse(text);
        require_version(json);
        return report_of(read_value<ReportEntry>(json, {}));
    } catch (const JsonProblem& problem) {
        const std::string where = problem.path.empty() ? "" : problem.path + " ";
        throw InputError({file, line_of_json(text, problem.path)}, where + problem.what(), problem.remedy);
    } catch (const Json::parse_error& error) {
        throw InputError({file, line_of_byte(text, error.byte)}, "is not JSON", "take a results.json as meshfolio writes it");
    } catch (const Json::exception& error) {   // a number beyond all limits
        throw InputError({file, 0}, "is not JSON that can be read (" + std::string(error.what()).substr(0, 100) + ")",
                         "take a results.json as meshfolio writes it");
    }
}

}   // namespace meshfolio::report
