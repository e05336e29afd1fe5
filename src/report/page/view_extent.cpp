#include "report/page/view_extent.h"

#include <algorithm>
#include <cctype>
#include <functional>

namespace meshfolio::report {

namespace {

constexpr std::size_t widest_brief_table = 9;   // columns; wider ones need the page of their own that a brief section has not

/// The first block for which `is_one` holds; null: none.
template <class Condition>
const Block* first_block(const Section& section, Condition is_one) {
    const auto it = std::find_if(section.blocks.begin(), section.blocks.end(), is_one);
    return it != section.blocks.end() ? &*it : nullptr;
}

bool is_picture(const Block& block) {
    return std::holds_alternative<Figure>(block) || std::holds_alternative<Plot>(block) || std::holds_alternative<Map>(block);
}

bool is_narrow_table(const Block& block) {
    const auto* table = std::get_if<Table>(&block);
    return table != nullptr && table->columns.size() <= widest_brief_table;
}

/// Whether the text stops in the middle of a sentence.
bool stops_midway(const Text& text) {
    const std::string words = plain(text);
    const std::size_t end = words.find_last_not_of(" )");
    return end != std::string::npos && std::string_view(".!?").find(words[end]) == std::string_view::npos;
}

/// Whether the block is a paragraph that begins in the middle of a sentence.
bool begins_midway(const Block& block) {
    const auto* paragraph = std::get_if<Paragraph>(&block);
    const std::string words = paragraph != nullptr ? plain(paragraph->text) : "";
    return !words.empty() && (words.front() == ',' || std::islower(static_cast<unsigned char>(words.front())) != 0);
}

/// Whether a sentence in `block` goes on in `next`. Formulas and lists are parts of sentences.
bool goes_on_in(const Block& block, const Block& next) {
    const auto is_part = [](const Block& b) { return std::holds_alternative<Formula>(b) || std::holds_alternative<BulletList>(b); };
    if (std::holds_alternative<Heading>(next)) return false;
    if (const auto* paragraph = std::get_if<Paragraph>(&block)) return stops_midway(paragraph->text);
    return is_part(block) && (is_part(next) || begins_midway(next));
}

/// The first paragraph and what it introduces: a reader must not be left in the middle of a sentence.
std::set<const Block*> first_passage(const Section& section) {
    const auto is_paragraph = [](const Block& block) { return std::holds_alternative<Paragraph>(block); };
    const auto begin = std::find_if(section.blocks.begin(), section.blocks.end(), is_paragraph);
    const auto last = std::adjacent_find(begin, section.blocks.end(), std::not_fn(goes_on_in));
    std::set<const Block*> passage;
    for (auto block = begin; block != section.blocks.end() && block <= last; ++block) passage.insert(&*block);
    return passage;
}

/// What can be referred to in a block.
std::vector<std::string> ids_in(const Block& block) {
    if (const auto* table = std::get_if<Table>(&block)) return {table->id};
    if (const auto* plot = std::get_if<Plot>(&block)) return {plot->id};
    if (const auto* map = std::get_if<Map>(&block)) return {map->id};
    if (const auto* figure = std::get_if<Figure>(&block)) return {figure->id};
    if (const auto* formula = std::get_if<Formula>(&block)) return {formula->id};
    std::vector<std::string> ids;
    if (const auto* list = std::get_if<EntryList>(&block)) {
        for (const Entry& entry : list->entries) ids.push_back(entry.id);
    }
    return ids;
}

}   // namespace

bool is_brief(const Section& section, Extent extent) { return extent == Extent::brief && !is_question(section.id); }

std::set<const Block*> blocks_shown(const Section& section, Extent extent) {
    std::set<const Block*> shown;
    if (!is_brief(section, extent)) {
        for (const Block& block : section.blocks) shown.insert(&block);
        return shown;
    }
    shown = first_passage(section);
    shown.insert({first_block(section, is_picture), first_block(section, is_narrow_table)});
    shown.erase(nullptr);
    return shown;
}

void leave_out_hidden(const Document& document, Extent extent, Numbering& numbering) {
    for (const Section& section : document.sections) {
        const std::set<const Block*> shown = blocks_shown(section, extent);
        for (const Block& block : section.blocks) {
            if (shown.contains(&block)) continue;
            for (const std::string& id : ids_in(block)) numbering.leave_out(id);
        }
    }
}

std::set<std::string> figures_shown(const Document& document, Extent extent) {
    std::set<std::string> ids;
    if (document.cover) ids.insert(document.cover->id);
    for (const Section& section : document.sections) {
        for (const Block* block : blocks_shown(section, extent)) {
            if (const auto* figure = std::get_if<Figure>(block)) ids.insert(figure->id);
        }
    }
    return ids;
}

std::string print_file(const std::string& figure, std::size_t panel, std::size_t picture) {
    return "figures/" + figure + "_" + std::to_string(panel) + "_" + std::to_string(picture) + ".jpg";
}

}   // namespace meshfolio::report
