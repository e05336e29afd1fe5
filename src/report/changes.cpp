#include "report/changes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "base/number_text.h"
#include "report/json/json_entries.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

using Kind = Change::Kind;
using Texts = std::map<std::string, std::string>;

std::string words_of(const Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell)) return exact_text(*number);
    const auto* words = std::get_if<std::string>(&cell);
    return words != nullptr ? *words : "";
}

/// Returns the relative difference of two cells: 0 for equal ones, ∞ if one is no number.
double difference_of(const Cell& a, const Cell& b) {
    const auto number_in = [](const Cell& cell) {
        const auto* number = std::get_if<double>(&cell);
        return number != nullptr && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
    };
    const std::optional<double> x = number_in(a), y = number_in(b);
    if (!x || !y) return words_of(a) == words_of(b) ? 0 : std::numeric_limits<double>::infinity();
    return *x == *y ? 0 : std::abs(*x - *y) / std::max(std::abs(*x), std::abs(*y));
}

std::string head_of(const Column& column) { return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]"; }

/// Returns the heads of the columns; a head that stands twice gets a number, "σ (2)".
std::vector<std::string> heads_of(const Table& table) {
    std::vector<std::string> heads;
    std::map<std::string, int> times;
    for (const Column& column : table.columns) {
        const std::string head = head_of(column);
        const int time = ++times[head];
        heads.push_back(time == 1 ? head : head + " (" + std::to_string(time) + ")");
    }
    return heads;
}

/// Returns the number of first columns that hold words, such as the series of a plot: its points are matched by their order.
std::size_t word_columns(const Table& table) {
    const auto is_word = [](const Cell& cell) { return std::holds_alternative<std::string>(cell); };
    return table.rows.empty() ? 0 : static_cast<std::size_t>(std::ranges::find_if_not(table.rows[0], is_word) - table.rows[0].begin());
}

/// Returns the least number of first columns that distinguish the rows; all columns if none does.
std::size_t key_columns(const Table& table) {
    for (std::size_t count = 1; count < table.columns.size(); ++count) {
        std::set<std::vector<Cell>> keys;
        for (const auto& row : table.rows) keys.emplace(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(count));
        if (keys.size() == table.rows.size()) return count;
    }
    return table.columns.size();
}

/// Returns the key of every row: its first cells with six digits, and a number if that does not distinguish it.
std::vector<std::string> row_keys(const Table& table, std::size_t columns) {
    std::vector<std::string> keys;
    std::map<std::string, int> times;
    for (const auto& row : table.rows) {
        std::string key;
        for (std::size_t c = 0; c < columns; ++c) {
            const auto* number = std::get_if<double>(&row[c]);
            key += (c > 0 ? ", " : "") + (number != nullptr ? plain_text(*number) : words_of(row[c]));
        }
        const int time = ++times[key];
        keys.push_back(time == 1 ? key : key + " (" + std::to_string(time) + ")");
    }
    return keys;
}

/// Returns the places of the texts that both lists have, as pairs, and adds the others by came_or_went(text, it is there before).
template <class CameOrWent>
std::vector<std::pair<std::size_t, std::size_t>> matched(const std::vector<std::string>& before, const std::vector<std::string>& after,
                                                         const CameOrWent& came_or_went) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::map<std::string_view, std::size_t> places;
    for (std::size_t i = 0; i < after.size(); ++i) places.emplace(after[i], i);
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (const auto place = places.find(before[i]); place == places.end()) came_or_went(before[i], true);
        else pairs.emplace_back(i, place->second);
    }
    const std::set<std::string_view> known(before.begin(), before.end());
    for (const std::string& text : after)
        if (!known.contains(text)) came_or_went(text, false);
    return pairs;
}

/// Collects the changes between two documents.
class Comparison {
public:
    Comparison(double tolerance, ComparedParts& compared) : tolerance_(tolerance), compared_(compared) {}

    void documents(const Document& a, const Document& b) {
        texts(Kind::setting, "", {{"title", a.title}, {"author", a.author}, {"course", a.course}},
              {{"title", b.title}, {"author", b.author}, {"course", b.course}});
        texts(Kind::program, "", program_of(a.provenance), program_of(b.provenance));
        texts(Kind::setting, "", a.provenance.settings, b.provenance.settings);
        texts(Kind::setting, "", {{"seed", std::to_string(a.provenance.seed)}}, {{"seed", std::to_string(b.provenance.seed)}});
        inputs(a, b);
        const auto ids = [](const Document& document) {
            std::vector<std::string> all;
            for (const Section& section : document.sections)
                if (section.status != Status::skipped) all.push_back(section.id);
            return all;
        };
        const auto find = [](const Document& document, const std::string& id) -> const Section& {
            return *std::ranges::find(document.sections, id, &Section::id);
        };
        const std::vector<std::string> before = ids(a);
        for (const auto& [i, j] :
             matched(before, ids(b), [&](const std::string&id, bool is_gone) { presence("", id, "section", is_gone); }))
            sections(find(a, before[i]), find(b, before[i]));
    }

    std::vector<Change> changes;

private:
    double tolerance_;
    ComparedParts& compared_;
    std::string section_ = {};

    void presence(const std::string& section, const std::string& id, const std::string& what, bool is_gone, const std::string& row = "") {
        changes.push_back({Kind::presence, section, id, row, what, is_gone ? "there" : "", is_gone ? "" : "there"});
    }

    static Texts program_of(const Provenance& provenance) {
        Texts words{{"version", provenance.version},
                    {"commit", provenance.commit},
                    {"compiler", provenance.compiler},
                    {"build type", provenance.build_type}};
        for (const auto& [name, version] : provenance.libraries) words.emplace("library " + name, version);
        return words;
    }

    void texts(Kind kind, const std::string& section, const Texts& a, const Texts& b) {
        Texts all = a;
        all.insert(b.begin(), b.end());
        const auto text_in = [](const Texts& texts, const std::string& name) {
            const auto it = texts.find(name);
            return it == texts.end() ? std::string() : it->second;
        };
        for (const auto& [name, ignored] : all)
            if (text_in(a, name) != text_in(b, name)) changes.push_back({kind, section, name, "", "", text_in(a, name), text_in(b, name)});
    }

    void inputs(const Document& a, const Document& b) {
        const auto digests = [](const Document& document) {
            Texts all;
            for (const MeshDigest& mesh : input_meshes(document.sections)) {
                std::string& text = all[mesh.file];
                text += (text.empty() ? "" : ", ") + mesh.sha256;
            }
            return all;
        };
        texts(Kind::input, "", digests(a), digests(b));
    }

    void sections(const Section& a, const Section& b) {
        section_ = a.id;
        const auto state = [](const Section& section) { return section.status == Status::ok ? "answered" : "failed: " + section.failure; };
        if (state(a) != state(b))
            changes.push_back({Kind::section, a.id, a.id, "", "", state(a), state(b), b.status == Status::ok ? 0. : 3.});
        texts(Kind::setting, a.id, texts_of(a.parameters), texts_of(b.parameters));
        checks(a, b);
        const std::map<std::string, Table> tables_a = tables_of(a), tables_b = tables_of(b);
        for (const auto& [id, table] : tables_a) {
            if (const auto other = tables_b.find(id); other != tables_b.end()) tables(table, other->second, table.caption.empty());
            else presence(section_, id, "table", true);
        }
        for (const auto& [id, table] : tables_b)
            if (!tables_a.contains(id)) presence(section_, id, "table", false);
        matched(a.output_meshes, b.output_meshes,
                [&](const std::string& path, bool is_gone) { presence(section_, path, "mesh", is_gone); });
        matched(figures_of(a), figures_of(b), [&](const std::string& id, bool is_gone) { presence(section_, id, "figure", is_gone); });
    }

    static std::vector<std::string> figures_of(const Section& section) {
        std::vector<std::string> ids;
        for (const Block& block : section.blocks)
            if (const auto* figure = std::get_if<Figure>(&block)) ids.push_back(figure->id);
        return ids;
    }

    /// Returns the tables of a section, and its plots and maps as tables, by their ids.
    static std::map<std::string, Table> tables_of(const Section& section) {
        std::map<std::string, Table> tables;
        for (const Block& block : section.blocks) {
            if (const auto* table = std::get_if<Table>(&block)) tables.emplace(table->id, *table);
            if (const auto* plot = std::get_if<Plot>(&block)) tables.emplace(plot->id, table_of(*plot));
            if (const auto* map = std::get_if<Map>(&block)) tables.emplace(map->id, table_of(*map));
        }
        return tables;
    }

    void checks(const Section& a, const Section& b) {
        const std::vector<std::string> before = check_ids(a), after = check_ids(b);
        const auto said = [](const Check& check) {
            const std::string state = check.passed() ? "passed" : check.failed() ? "failed" : "undecided";
            return state + ": " + report::words_of(check);
        };
        const auto rank = [](const Check& check) { return check.failed() ? 3. : check.passed() ? 0. : 1.; };
        const auto only = [&](const std::string& id, bool is_gone) {
            const auto& [ids, section] = is_gone ? std::tie(before, a) : std::tie(after, b);
            const Check& check = section.checks[static_cast<std::size_t>(std::ranges::find(ids, id) - ids.begin())];
            changes.push_back({Kind::check, section_, id, "", check.name, is_gone ? said(check) : "", is_gone ? "" : said(check),
                               is_gone ? 2. : rank(check)});
        };
        for (const auto& [i, j] : matched(before, after, only)) {
            const Check &old = a.checks[i], &now = b.checks[j];
            ++compared_.checks;
            if (old.status != now.status)
                changes.push_back({Kind::check, section_, before[i], "", now.name, said(old), said(now), rank(now)});
        }
    }

    void tables(const Table& a, const Table& b, bool is_drawing) {
        ++compared_.tables;
        const std::size_t keys = is_drawing ? word_columns(a) : std::max(key_columns(a), key_columns(b));
        const std::vector<std::string> heads = heads_of(a);
        const auto columns =
            matched(heads, heads_of(b), [&](const std::string& head, bool is_gone) { presence(section_, a.id, "column", is_gone, head); });
        if (keys > std::min(a.columns.size(), b.columns.size())) return;
        const std::vector<std::string> rows = row_keys(a, keys);
        for (const auto& [i, j] : matched(rows, row_keys(b, keys),
                                          [&](const std::string&key, bool is_gone) { presence(section_, a.id, "row", is_gone, key); })) {
            for (const auto& [c, d] : columns) {
                const Cell &old = a.rows[i][c], &now = b.rows[j][d];
                ++compared_.numbers;
                if (const double size = difference_of(old, now); size > tolerance_)
                    changes.push_back({Kind::number, section_, a.id, rows[i], heads[c], words_of(old), words_of(now), size});
            }
        }
    }
};

}   // namespace

const char* name_of(Change::Kind kind) {
    constexpr const char* names[] = {"program", "setting", "input", "section", "check", "number", "presence", "picture", "mesh"};
    return names[static_cast<std::size_t>(kind)];
}

void sort_changes(std::vector<Change>& changes) {
    std::ranges::stable_sort(changes, [](const Change& a, const Change& b) {
        if (a.kind != b.kind) return a.kind < b.kind;
        return std::isfinite(a.size) == std::isfinite(b.size) ? a.size > b.size : std::isfinite(a.size);
    });
}

std::vector<Change> changes_between(const Document& before, const Document& after, double tolerance, ComparedParts& compared) {
    Comparison comparison(tolerance, compared);
    comparison.documents(before, after);
    sort_changes(comparison.changes);
    return std::move(comparison.changes);
}

}   // namespace meshfolio::report
