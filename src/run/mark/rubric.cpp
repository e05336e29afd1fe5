#include "run/mark/rubric.h"

#include <algorithm>
#include <array>
#include <set>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/number_text.h"
#include "output/publish/folder_system.h"
#include "run/arguments.h"
#include "run/mark/conventions.h"
#include "run/one_mesh/fields.h"
#include "run/settings/settings_reader.h"
#include "submission/source_listing.h"

namespace meshfolio::run {

namespace {

using Keys = std::vector<std::string>;

/// The name of an answer in a rubric, and the keys of the settings on which it depends.
struct ThingEntry {
    MarkedThing what;
    std::string_view name;
    Keys settings;
};
const std::array<ThingEntry, 7>& things() {
    static const std::array<ThingEntry, 7> list{
        {{MarkedThing::H, "H", {"operator", "area"}},
         {MarkedThing::H_uniform, "H_uniform", {}},
         {MarkedThing::K, "K", {"area"}},
         {MarkedThing::eigenvalues, "eigenvalues", {"operator", "area", "k"}},
         {MarkedThing::reconstruction, "reconstruction", {"operator", "area", "k"}},
         {MarkedThing::smoothed, "smoothed", {"operator", "area", "scheme", "lambda", "unit", "iterations", "rebuild"}},
         {MarkedThing::number, "number", {}}}};
    return list;
}
const ThingEntry& entry_of(MarkedThing what) { return *std::ranges::find(things(), what, &ThingEntry::what); }

constexpr long long most_modes = 500, most_steps = 1000;
constexpr int most_chosen = 100;   // modes or steps that a student may choose, unless the rubric has more
constexpr double largest_points = 1e6;

const Keys schemes{"explicit", "implicit", "taubin"}, units{"raw", "tau", "h2"};   // in the order of their enumerators

void read_settings_of_answer(const TableReader& reader, AnswerSettings& settings) {
    if (const auto word = reader.word("operator", operator_choices())) settings.laplacian = operator_named(*word);
    if (const auto word = reader.word("area", area_choices())) settings.area = area_form_named(*word);
    if (const auto word = reader.word("scheme", schemes)) settings.scheme = smoothing_scheme_named(*word);
    if (const auto word = reader.word("unit", units)) settings.unit = step_unit_named(*word);
    if (const auto k = reader.integer("k", 1, most_modes)) settings.k = static_cast<int>(*k);
    if (const auto steps = reader.integer("iterations", 1, most_steps)) settings.iterations = static_cast<int>(*steps);
    settings.lambda = reader.number("lambda", 0, limits::largest_lambda, true, settings.lambda);
    settings.rebuild = reader.truth("rebuild").value_or(settings.rebuild);
}

/// @param ids  of the items before
RubricItem item_of(const toml::table& table, std::set<std::string>& ids, Problems& problems) {
    static const Keys known{"id",     "title", "what",       "mesh",    "file", "column", "operator", "area",      "k",      "scheme",
                            "lambda", "unit",  "iterations", "rebuild", "free", "accept", "value",    "tolerance", "points", "recognised"};
    const TableReader reader(table, "[[item]]", known, problems);
    RubricItem item;
    item.id = reader.text("id").value_or("");
    if (!output::is_safe_name(item.id) || !ids.insert(item.id).second)
        problems.add(table, "[[item]] has no id of its own", "add id = \"q3-h\", say: letters, digits, '_', '-' and '.'");
    item.title = reader.text("title").value_or(item.id);
    Keys things_known;
    for (const ThingEntry& thing : things()) things_known.emplace_back(thing.name);
    if (const auto word = reader.word("what", things_known)) item.what = std::ranges::find(things(), *word, &ThingEntry::name)->what;
    item.mesh = reader.text("mesh").value_or("");
    item.file = reader.text("file").value_or("");
    item.columns = reader.texts("column");
    read_settings_of_answer(reader, item.settings);
    item.free = reader.words("free", entry_of(item.what).settings);
    item.accept = reader.words("accept", convention_keys());
    item.value = reader.number("value", -1e100, 1e100, false, item.value);
    item.tolerance = reader.number("tolerance", 0, 1, true, item.tolerance);
    item.points = reader.number("points", 0, largest_points, false, item.points);
    item.recognised = reader.number("recognised", 0, 1, false, item.recognised);
    Keys must{"id", "what", "points"};
    if (item.what == MarkedThing::number) {
        must.emplace_back("value");
    } else {
        must.insert(must.end(), {"mesh", "file"});
        if (!is_of_mesh(item.what)) must.emplace_back("column");
    }
    for (const std::string& key : must)
        if (reader.node(key) == nullptr) problems.add(table, "[[item]] has no " + key, "data/rubric.toml shows one");
    return item;
}

StudentAnswer answer_of(const toml::table& table, const RubricItem& item, Problems& problems) {
    Keys known = item.free;
    if (item.what == MarkedThing::number || known.empty()) known.emplace_back("value");
    const TableReader reader(table, "[" + item.id + "]", known, problems);
    StudentAnswer answer{item.settings, {}};
    AnswerSettings chosen = item.settings;
    read_settings_of_answer(reader, chosen);
    const auto limit = [&](const char* key, int& value, int own) {
        const int most = std::max(own, most_chosen);
        if (value <= most) return;
        problems.add(table, reader.called(key) + " is above " + std::to_string(most), "the value of the rubric is taken");
        value = own;
    };
    limit("k", chosen.k, item.settings.k);
    limit("iterations", chosen.iterations, item.settings.iterations);
    const auto is_free = [&](const char* key) { return contains(item.free, key); };
    if (is_free("operator")) answer.settings.laplacian = chosen.laplacian;
    if (is_free("area")) answer.settings.area = chosen.area;
    if (is_free("k")) answer.settings.k = chosen.k;
    if (is_free("scheme")) answer.settings.scheme = chosen.scheme;
    if (is_free("lambda")) answer.settings.lambda = chosen.lambda;
    if (is_free("unit")) answer.settings.unit = chosen.unit;
    if (is_free("iterations")) answer.settings.iterations = chosen.iterations;
    if (is_free("rebuild")) answer.settings.rebuild = chosen.rebuild;
    if (const auto value = reader.numbers("value", -1e100, 1e100, false); !value.empty()) answer.value = value.front();
    return answer;
}

}   // namespace

double Rubric::points() const {
    double sum = 0;
    for (const RubricItem& item : items) sum += item.points;
    return sum;
}

Rubric parse_rubric(std::string_view text, const std::string& file) {
    Problems problems(file);
    Rubric rubric;
    rubric.base = std::filesystem::path(file).parent_path();
    if (const auto root = parsed_toml(text, file, problems)) {
        problems.collect([&] { rubric.title = parse_settings(text, file).title; });   // the sheet in the same file, if any
        if (const toml::node* title = root->get("title")) rubric.title = title->value_or("");
        if (rubric.title.empty()) rubric.title = "Coursework";
        std::set<std::string> ids;
        const auto read = [&](const toml::table& table) { rubric.items.push_back(item_of(table, ids, problems)); };
        if (const toml::node* node = root->get("item")) for_each_table(*node, "item", problems, read);
        else problems.add(*root, "the rubric has no item", "write [[item]] above each");
    }
    problems.raise();
    return rubric;
}

Rubric read_rubric(const std::string& file) {
    if (const std::string_view bundled = bundled_report_text(file); !bundled.empty() && !may_be_there(file))
        return parse_rubric(bundled, file + ".toml");
    if (!file.empty()) return parse_rubric(read_file(file, limits::largest_settings), file);
    for (const submission::SourceFile& source : submission::source_tree())
        if (source.path == "data/rubric.toml") return parse_rubric(source.bytes, "rubric.toml");
    throw InputError({"rubric.toml"}, "is not among the bundled files of this build", "name one with --rubric");
}

std::string described(const RubricItem& item, const AnswerSettings& settings) {
    const std::map<std::string, std::string> values{{"operator", std::string(operator_entry(settings.laplacian).name)},
                                                    {"area", std::string(name_of(settings.area))},
                                                    {"k", std::to_string(settings.k)},
                                                    {"scheme", schemes.at(static_cast<std::size_t>(settings.scheme))},
                                                    {"lambda", plain_text(settings.lambda)},
                                                    {"unit", units.at(static_cast<std::size_t>(settings.unit))},
                                                    {"iterations", std::to_string(settings.iterations)},
                                                    {"rebuild", settings.rebuild ? "true" : "false"}};
    std::string text;
    for (const std::string& key : entry_of(item.what).settings) text += (text.empty() ? "" : ", ") + key + " = " + values.at(key);
    return text;
}

std::map<std::string, StudentAnswer> parse_answers(std::string_view text, const Rubric& rubric, std::vector<std::string>& problems) {
    std::map<std::string, StudentAnswer> answers;
    Keys ids;
    for (const RubricItem& item : rubric.items) {
        answers[item.id].settings = item.settings;
        ids.push_back(item.id);
    }
    Problems found(answers_file);
    if (const auto root = text.size() <= limits::largest_settings ? parsed_toml(text, answers_file, found) : std::nullopt) {
        const TableReader known(*root, "", {"name"}, found, ids);
        for (const RubricItem& item : rubric.items) {
            const toml::node* node = root->get(item.id);
            if (node != nullptr && node->is_table()) {
                answers[item.id] = answer_of(*node->as_table(), item, found);
            } else if (const auto value = known.numbers(item.id, -1e100, 1e100, false); !value.empty()) {   // q2-kappa = 0.5
                answers[item.id].value = value.front();
            }
        }
    }
    try {
        found.raise();
    } catch (const SettingsErrors& errors) {
        constexpr std::size_t most = 20;   // they share one cell of class.csv
        const auto& all = errors.problems();
        for (std::size_t i = 0; i < std::min(all.size(), most); ++i) problems.emplace_back(all[i].what());
        if (all.size() > most) problems.push_back("… and " + std::to_string(all.size() - most) + " more");
    }
    return answers;
}

}   // namespace meshfolio::run
