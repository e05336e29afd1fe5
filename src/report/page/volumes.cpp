#include "report/page/volumes.h"

#include <algorithm>

namespace meshfolio::report {

std::span<const Block> blocks_in(const Section& section, Volume volume) {
    const std::span<const Block> all(section.blocks);
    if (!is_question(section.id)) return volume == Volume::appendix ? all : all.first(0);
    const std::size_t own = section.appendix_from < 0 ? all.size() : std::min(all.size(), static_cast<std::size_t>(section.appendix_from));
    return volume == Volume::report ? all.first(own) : all.subspan(own);
}

bool has_section(const Section& section, Volume volume) {
    const bool in_report = is_question(section.id);
    return volume == Volume::report ? in_report : !in_report || !blocks_in(section, volume).empty();
}

std::string further_id(const Section& section) { return section.id + "-further"; }

std::set<std::string> figures_in(const Document& document, Volume volume) {
    std::set<std::string> ids;
    for (const Section& section : document.sections) {
        for (const Block& block : blocks_in(section, volume))
            if (const auto* figure = std::get_if<Figure>(&block)) ids.insert(figure->id);
    }
    return ids;
}

const Figure* cover_figure(const Document& document, const DrawnFigures& figures) {
    for (const Section& section : document.sections) {
        for (const Block& block : blocks_in(section, Volume::report)) {
            const auto* figure = std::get_if<Figure>(&block);
            const auto drawn = figure == nullptr ? figures.end() : figures.find(figure->id);
            if (drawn == figures.end() || drawn->second.panels.empty()) continue;
            const DrawnPanel& panel = drawn->second.panels.front();
            const bool has_values = panel.legend || drawn->second.legend;
            if (has_values && !panel.pictures.empty() && panel.pictures.front().view.empty()) return figure;
        }
    }
    return nullptr;
}

void mark_elsewhere(const Document& document, Volume volume, const std::string& page, Numbering& numbering) {
    const Volume other = other_of(volume);
    for (const Section& section : document.sections) {
        if (is_question(section.id) == (other == Volume::report)) numbering.place_elsewhere(section.id, page);
        for (const Block& block : blocks_in(section, other)) {
            const auto place = [&](const auto& one) {
                if constexpr (requires { one.id; }) numbering.place_elsewhere(one.id, page);
            };
            std::visit(place, block);
        }
    }
}

std::set<std::string> works_cited_in(const Document& document, Volume volume, const std::vector<CitedWork>& works) {
    std::set<std::string> cited;
    const auto look_through = [&](const Text& text) {
        for (const Run& run : text)
            if (run.kind == Run::Kind::reference && std::ranges::find(works, run.content, &CitedWork::id) != works.end())
                cited.insert(run.content);
    };
    for (const Section& section : document.sections) {
        if (has_section(section, volume)) look_through(section.answer);
        for (const Block& block : blocks_in(section, volume)) {
            if (const auto* paragraph = std::get_if<Paragraph>(&block)) look_through(paragraph->text);
            if (const auto* bullets = std::get_if<BulletList>(&block)) std::ranges::for_each(bullets->items, look_through);
        }
    }
    return cited;
}

}   // namespace meshfolio::report
