#include "report/json/read_json.h"

#include <set>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "report/json/json_fields.h"
#include "report/json/json_line.h"
#include "report/json/json_reader.h"
#include "report/numbering.h"
#include "report/words.h"

namespace meshfolio::report {

namespace {

constexpr int deepest_json = 64;   // three times the depth of our own

const std::string& id_of(const FigureEntry& part) { return part.figure.id; }
const std::string& id_of(const auto& part) { return part.id; }

/// Calls visit(key, list) for each list of parts that blocks refer to.
template <class Visit> void for_each_list(auto& section, const Visit& visit) {
    visit("tables", section.tables);
    visit("plots", section.plots);
    visit("maps", section.maps);
    visit("diagrams", section.diagrams);
    visit("figures", section.figures);
}

/// Adds the ids of a section and its parts to `ids`.
/// @throws JsonProblem for an id that is taken
void add_ids(const SectionEntry& section, const JsonPlace& place, std::set<std::string>& ids) {
    const auto add = [&](const std::string& id, const JsonPlace& where) {
        if (!ids.insert(id).second) throw JsonProblem(where, "uses the id " + in_quotes(id) + " a second time", "give each its own");
    };
    add(section.section.id, place);
    for_each_list(section, [&](const char* key, const auto& list) {
        const JsonPlace all{&place, key};
        for (std::size_t i = 0; i < list.size(); ++i) add(id_of(list[i]), {&all, {}, i});
    });
    const JsonPlace blocks{&place, "blocks"};
    for (std::size_t i = 0; i < section.blocks.size(); ++i) {
        const BlockEntry& block = section.blocks[i];
        if (block.kind == BlockEntry::Kind::formula && !block.id.empty()) add(block.id, {&blocks, {}, i});
    }
}

/// Puts the blocks of a section in their order. Each list is used from its beginning, and completely.
class Joiner {
public:
    Joiner(SectionEntry& entry, DrawnFigures& drawn, const JsonPlace& place) : entry_(entry), drawn_(drawn), place_(place) {}

    std::vector<Block> blocks() {
        std::vector<Block> blocks;
        const JsonPlace all{&place_, "blocks"};
        for (std::size_t i = 0; i < entry_.blocks.size(); ++i) blocks.push_back(block_of(entry_.blocks[i], {&all, {}, i}));
        for_each_list(entry_, [&](const char* key, const auto& list) {
            if (used_[&list] != list.size())
                throw JsonProblem({&place_, key}, "has more entries than the section's `blocks` name, so the file was edited or damaged",
                                  "take an unchanged results.json");
        });
        return blocks;
    }

private:
    SectionEntry& entry_;
    DrawnFigures& drawn_;
    const JsonPlace& place_;
    std::map<const void*, std::size_t> used_;   // number of parts taken from each list

    Block block_of(BlockEntry& block, const JsonPlace& place) {
        using Kind = BlockEntry::Kind;
        if (block.kind == Kind::heading) return Heading{std::move(block.title)};
        if (block.kind == Kind::paragraph) return Paragraph{std::move(block.text)};
        if (block.kind == Kind::list) return BulletList{std::move(block.items)};
        if (block.kind == Kind::formula) return Formula{std::move(block.name), std::move(block.id)};
        if (block.kind == Kind::table) return next(entry_.tables, block.id, place);
        if (block.kind == Kind::plot) return next(entry_.plots, block.id, place);
        if (block.kind == Kind::map) return next(entry_.maps, block.id, place);
        if (block.kind == Kind::diagram) return next(entry_.diagrams, block.id, place);
        FigureEntry entry = next(entry_.figures, block.id, place);
        if (entry.is_drawn) drawn_[block.id] = std::move(entry.drawn);
        return std::move(entry.figure);
    }

    template <class Part> Part next(std::vector<Part>& parts, const std::string& id, const JsonPlace& place) {
        std::size_t& used = used_[&parts];
        if (used >= parts.size() || id_of(parts[used]) != id)
            throw JsonProblem(place, "refers to '" + id + "', which is not the next of its list", "take a whole results.json");
        return std::move(parts[used++]);
    }
};

/// @throws JsonProblem for a text of the user's that own_blocks() cannot read
void require_readable(const std::string& text, const JsonPlace& place) try { own_blocks(text); } catch (const std::logic_error& problem) {
    throw JsonProblem(place, std::string("has a text that cannot be read: ") + problem.what(), "take an unchanged results.json");
}

/// Returns the section of an entry and enters the data of its pictures into `drawn`.
/// @throws JsonProblem if the parameters or the order of blocks refer to missing parts, or the order leaves a part out
Section section_of(SectionEntry entry, DrawnFigures& drawn, const JsonPlace& place) {
    Section section = std::move(entry.section);
    for (const auto& [name, words] : entry.parameters) section.parameters[name] = words;
    const JsonPlace list{&place, "parameter_values"};
    for (std::size_t i = 0; i < entry.parameter_values.size(); ++i) {
        ParameterEntry& one = entry.parameter_values[i];
        const auto parameter = section.parameters.find(one.name);
        if (parameter == section.parameters.end())
            throw JsonProblem({&list, {}, i}, "names " + in_quotes(one.name) + ", which is no parameter", "take a whole results.json");
        parameter->second.value = std::move(one.value);
        parameter->second.unit = std::move(one.unit);
    }
    section.timings = std::move(entry.timings).value_or(std::vector<Timing>());
    require_readable(section.intro, {&place, "intro"});
    section.blocks = Joiner(entry, drawn, place).blocks();
    for (CheckEntry& check : entry.checks) section.checks.push_back(std::move(check.check));
    return section;
}

ReadReport report_of(const Json& json) {
    const JsonPlace root, provenance{&root, "provenance"};
    ReportEntry entry;
    FieldReader fields(json, root);
    describe(fields, entry);

    ReadReport read;
    read.timings = entry.timings.has_value();
    Document& document = read.document;
    document.title = std::move(entry.title);
    document.author = std::move(entry.author);
    document.course = std::move(entry.course);
    for (const OwnPage& page : entry.pages) require_readable(page.text, {&root, "pages"});
    document.pages = std::move(entry.pages);
    document.provenance = std::move(entry.provenance.provenance);
    document.timings = std::move(entry.timings).value_or(std::vector<Timing>());
    std::set<std::string> ids;
    const auto add_sections = [&](std::vector<SectionEntry>& entries, bool questions, const char* key) {
        const JsonPlace list{&root, key};
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const JsonPlace place{&list, {}, i};
            add_ids(entries[i], place, ids);
            if (is_question(entries[i].section.id) != questions)
                throw JsonProblem(place, std::string("belongs to ") + (questions ? "`supporting`" : "`questions`"), "move it there");
            if (entries[i].timings.has_value() != read.timings)
                throw JsonProblem(place, read.timings ? "has no timings, though the report has" : "has timings, though the report has none",
                                  "take an unchanged results.json");
            document.sections.push_back(section_of(std::move(entries[i]), read.figures, place));
        }
    };
    add_sections(entry.questions, true, "questions");
    add_sections(entry.supporting, false, "supporting");
    if (input_meshes(document.sections) != entry.provenance.inputs)
        throw JsonProblem({&provenance, "inputs"}, "does not list the inputs of the sections", "take an unchanged results.json");
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
        const JsonPlace root;
        if (!json.is_object() || !json.contains("schema_version"))
            throw JsonProblem(root, "is no results.json", "name the results.json of a report");
        if (const Json& version = json.at("schema_version"); version != schema_version)
            throw JsonProblem(
                {&root, "schema_version"},
                "is " + in_quotes(version.dump(-1, ' ', true, Json::error_handler_t::replace)) + ", not " + std::to_string(schema_version),
                "make the report anew, or take the meshfolio that made it");
        return report_of(json);
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
