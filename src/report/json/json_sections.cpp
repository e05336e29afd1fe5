#include "report/json/json_sections.h"

#include <utility>

namespace meshfolio::report {

namespace {

using Kind = BlockEntry::Kind;

/// Takes the blocks of a section apart.
class Sorter {
public:
    Sorter(SectionEntry& entry, const DrawnFigures& drawn) : entry_(entry), drawn_(drawn) {}

    void operator()(const Heading& heading) { add(Kind::heading).title = heading.title; }
    void operator()(const Paragraph& paragraph) { add(Kind::paragraph).text = paragraph.text; }
    void operator()(const BulletList& list) { add(Kind::list).items = list.items; }
    void operator()(const Formula& formula) { add(Kind::formula, formula.id).name = formula.name; }
    void operator()(const Table& table) {
        add(Kind::table, table.id);
        entry_.tables.push_back(table);
    }
    void operator()(const Plot& plot) {
        add(Kind::plot, plot.id);
        entry_.plots.push_back(plot);
    }
    void operator()(const Map& map) {
        add(Kind::map, map.id);
        entry_.maps.push_back(map);
    }
    void operator()(const Figure& figure) {
        add(Kind::figure, figure.id);
        entry_.figures.push_back(entry_of(figure, drawn_));
    }
    void operator()(const EntryList& list) {
        BlockEntry& block = add(Kind::entries);
        block.title = list.kind;
        for (const Entry& one : list.entries) {
            block.ids.push_back(one.id);
            entry_.entries.push_back({list.kind, one});
        }
    }

private:
    SectionEntry& entry_;
    const DrawnFigures& drawn_;

    BlockEntry& add(Kind kind, const std::string& id = "") {
        BlockEntry& block = entry_.blocks.emplace_back();
        block.kind = kind;
        block.id = id;
        return block;
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
        require_used("figures", figures_, entry_.figures.size());
        require_used("entries", entries_, entry_.entries.size());
        return blocks;
    }

private:
    SectionEntry& entry_;
    DrawnFigures& drawn_;
    const JsonPlace& place_;
    std::size_t tables_ = 0, plots_ = 0, maps_ = 0, figures_ = 0, entries_ = 0;

    Block block_of(BlockEntry& block, const JsonPlace& place) {
        switch (block.kind) {
            case Kind::heading:
                return Heading{std::move(block.title)};
            case Kind::paragraph:
                return Paragraph{std::move(block.text)};
            case Kind::list:
                return BulletList{std::move(block.items)};
            case Kind::formula:
                return Formula{std::move(block.name), std::move(block.id)};
            case Kind::table:
                return next(entry_.tables, tables_, block.id, place);
            case Kind::plot:
                return next(entry_.plots, plots_, block.id, place);
            case Kind::map:
                return next(entry_.maps, maps_, block.id, place);
            case Kind::figure:
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

}   // namespace

FigureEntry entry_of(const Figure& figure, const DrawnFigures& drawn) {
    const auto it = drawn.find(figure.id);
    FigureEntry entry{figure, it != drawn.end(), {}};
    if (!entry.is_drawn) return entry;
    // Names alone: pictures and models are files of their own.
    entry.drawn.sheet = it->second.sheet;
    entry.drawn.views = it->second.views;
    for (const DrawnPanel& panel : it->second.comparison) entry.drawn.comparison.push_back({panel.label, panel.file, {}, 0, 0});
    for (const DrawnModel& model : it->second.models) entry.drawn.models.push_back({model.label, model.file, {}, model.quantity});
    return entry;
}

SectionEntry entry_of(const Section& section, const DrawnFigures& drawn, bool with_timings) {
    SectionEntry entry;
    Sorter sorter(entry, drawn);
    for (const Block& block : section.blocks) std::visit(sorter, block);
    entry.section = section;
    entry.section.blocks.clear();
    entry.with_timings = with_timings;
    return entry;
}

Section section_of(SectionEntry entry, DrawnFigures& drawn, const JsonPlace& place) {
    Section section = std::move(entry.section);
    section.blocks = Joiner(entry, drawn, place).blocks();
    return section;
}

}   // namespace meshfolio::report
