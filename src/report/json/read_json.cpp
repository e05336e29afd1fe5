#include "report/json/read_json.h"

#include <set>

#include "base/errors.h"
#include "base/in_quotes.h"
#include "report/json/json_fields.h"
#include "report/json/json_line.h"
#include "report/json/json_reader.h"
#include "report/json/upgrade_json.h"
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
        add_all(section.diagrams, {&place, "diagrams"}, [](const Diagram& diagram) { return diagram.id; });
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

/// Puts the blocks of a section in their order; each list is used up from its beginning.
class Joiner {
public:
    Joiner(SectionEntry& entry, DrawnFigures& drawn, const JsonPlace& place) : entry_(entry), drawn_(drawn), place_(place) {}

    std::vector<Block> blocks() {
        std::vector<Block> blocks;
        const JsonPlace list{&place_, "blocks"};
        for (std::size_t i = 0; i < entry_.blocks.size(); ++i) blocks.push_back(block_of(entry_.blocks[i], {&list, {}, i}));
        require_used("tables", tables_, entry_.tables.size());
        require_used("plots", plots_, entry_.plots.size());
        require_used("maps", maps_, entry_.maps.size());
        require_used("diagrams", diagrams_, entry_.diagrams.size());
        require_used("figures", figures_, entry_.figures.size());
        require_used("entries", entries_, entry_.entries.size());
        return blocks;
    }

private:
    SectionEntry& entry_;
    DrawnFigures& drawn_;
    const JsonPlace& place_;
    std::size_t tables_ = 0, plots_ = 0, maps_ = 0, diagrams_ = 0, figures_ = 0, entries_ = 0;

    Block block_of(BlockEntry& block, const JsonPlace& place) {
        switch (block.kind) {
            case BlockEntry::Kind::heading:
                return Heading{std::move(block.title)};
            case BlockEntry::Kind::paragraph:
                return Paragraph{std::move(block.text)};
            case BlockEntry::Kind::list:
                return BulletList{std::move(block.items)};
            case BlockEntry::Kind::formula:
                return Formula{std::move(block.name), std::move(block.id)};
            case BlockEntry::Kind::table:
                return next(entry_.tables, tables_, block.id, place);
            case BlockEntry::Kind::plot:
                return next(entry_.plots, plots_, block.id, place);
            case BlockEntry::Kind::map:
                return next(entry_.maps, maps_, block.id, place);
            case BlockEntry::Kind::diagram:
                return next(entry_.diagrams, diagrams_, block.id, place);
            case BlockEntry::Kind::figure:
                return next_figure(block.id, place);
            default:
                return entries_of(block, place);
        }
    }

    static void require_next(bool is_next, const std::string& id, const JsonPlace& place) {
        if (!is_next) throw JsonProblem(place, "refers to '" + id + "', which is not the next of its list", "take a whole results.json");
    }

    template <class Item>
    static Item next(std::vector<Item>& items, std::size_t& used, const std::string& id, const JsonPlace& place) {
        require_next(used < items.size() && items[used].id == id, id, place);
        return std::move(items[used++]);
    }

    Figure next_figure(const std::string& id, const JsonPlace& place) {
        require_next(figures_ < entry_.figures.size() && entry_.figures[figures_].figure.id == id, id, place);
        FigureEntry& entry = entry_.figures[figures_++];
        if (entry.is_drawn) drawn_[id] = std::move(entry.drawn);
        return std::move(entry.figure);
    }

    EntryList entries_of(BlockEntry& block, const JsonPlace& place) {
        EntryList list{std::move(block.title), {}};
        for (const std::string& id : block.ids) {
            const bool is_next =
                entries_ < entry_.entries.size() && entry_.entries[entries_].entry.id == id && entry_.entries[entries_].kind == list.kind;
            require_next(is_next, id, place);
            list.entries.push_back(std::move(entry_.entries[entries_++].entry));
        }
        return list;
    }

    void require_used(const char* list, std::size_t used, std::size_t size) const {
        if (used != size) throw JsonProblem({&place_, list}, "holds what no block refers to", "take a whole results.json");
    }
};

/// Those of earlier files, which have no values, are words.
Parameters parameters_of(const SectionEntry& entry, const JsonPlace& place) {
    Parameters parameters;
    for (const auto& [name, words] : entry.parameters) parameters[name] = words;
    const JsonPlace list{&place, "parameter_values"};
    for (std::size_t i = 0; i < entry.parameter_values.size(); ++i) {
        const ParameterEntry& one = entry.parameter_values[i];
        const auto parameter = parameters.find(one.name);
        if (parameter == parameters.end())
            throw JsonProblem({&list, {}, i}, "names " + in_quotes(one.name) + ", which is no parameter", "take a whole results.json");
        parameter->second.value = one.value;
        parameter->second.unit = one.unit;
    }
    return parameters;
}

/// What is known of the pictures goes into `drawn`.
/// @throws JsonProblem where the order names a block that is not there, or leaves one out
Section section_of(SectionEntry entry, DrawnFigures& drawn, const JsonPlace& place) {
    Section section = std::move(entry.section);
    section.parameters = parameters_of(entry, place);
    section.blocks = Joiner(entry, drawn, place).blocks();
    for (CheckEntry& check : entry.checks) section.checks.push_back(std::move(check.check));
    return section;
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
    if (auto& cover = entry.cover) {
        ids.add(cover->drawn.figure.id, {&root, "cover"});
        document.cover = Cover{std::move(cover->drawn.figure), cover->section, cover->turnable, cover->worth};
        if (cover->drawn.is_drawn) read.figures[document.cover->id] = std::move(cover->drawn.drawn);
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
        Json json = Json::parse(text);
        upgrade_json(json);
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
