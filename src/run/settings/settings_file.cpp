// Settings files: TOML to ReportSettings.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <iterator>

#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/lower_case.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "output/publish/folder_system.h"
#include "report/page/template_render.h"
#include "report/words.h"
#include "report/writers.h"
#include "run/settings/setting_list.h"
#include "run/settings/settings_reader.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

/// Names of files and folders of every report.
const std::vector<std::string> used_names{"images",    "tables",       "models",     "index.html",    "appendix.html",
                                          "report.md", "appendix.md",  "summary.md", "report.pdf",    "appendix.pdf",
                                          "src.txt",   "results.json", "SHA256SUMS", "submission.zip"};

template <class Settings> std::vector<std::string> keys_of(std::string_view table) {
    std::vector<std::string> keys;
    Settings settings;
    for_each_setting(settings, [&](const Setting& setting, const auto&) {
        if (*setting.key != '\0' && setting.table == table) keys.emplace_back(setting.key);
    });
    return keys;
}

class Reader {
public:
    Reader(const toml::table& root, ReportSettings& settings, Problems& problems) : root_(root), settings_(settings), problems_(problems) {}

    void read() {
        read_table("", root_, {"report", "render", "question", "page", "item"});   // items, like `title`, are of `mark`
        for (const std::string name : {"report", "render"}) {
            const toml::node* node = root_.get(name);
            if (node != nullptr && !node->is_table()) problems_.add(*node, name + " is not a table", "write [" + name + "]");
            if (node != nullptr && node->is_table()) read_table("[" + name + "]", *node->as_table());
        }
        const auto given = [&](const char* key) { return root_.at_path(key).node() != nullptr; };
        if (given("report.title") && !given("report.course")) settings_.course.clear();   // that of another report
        if (const toml::node* node = root_.get("question"))
            for_each_table(*node, "question", problems_, [&](const toml::table& table) { read_question(table); });
        if (const toml::node* node = root_.get("page"))
            for_each_table(*node, "page", problems_, [&](const toml::table& table) { read_page(table); });
    }

private:
    const toml::table& root_;
    ReportSettings& settings_;
    Problems& problems_;
    std::map<std::string, long> output_lines_, number_lines_;   // output name, number of a question → line

    void read_table(const std::string& name, const toml::table& table, const std::vector<std::string>& tables = {}) {
        std::vector<std::string> known = keys_of<ReportSettings>(name);
        if (name.empty()) known.emplace_back("title");
        const TableReader reader(table, name, known, problems_, tables);
        for_each_setting(settings_, [&](const Setting& setting, auto& value) {
            if (setting.table == name) take_if_given(reader, setting, value);
        });
    }

    void read_question(const toml::table& table) {
        std::vector<std::string> known = keys_of<QuestionTable>("");
        known.emplace_back("id");
        const TableReader reader(table, "[[question]]", known, problems_);
        QuestionTable question;
        for_each_setting(question, [&](const Setting& setting, auto& value) { take_if_given(reader, setting, value); });
        if (reader.node("id") == nullptr) problems_.add(table, "[[question]] has no id", "add id = \"q1\", say");
        const auto id = reader.word("id", section_ids());
        if (id && !settings_.questions.emplace(*id, std::move(question)).second)
            problems_.add(*reader.node("id"), "question '" + *id + "' is given twice", "merge the two tables");
    }

    void read_page(const toml::table& table) {
        report::OwnPage page;
        const TableReader reader(table, "[[page]]", keys_of<report::OwnPage>(""), problems_);
        for_each_setting(page, [&](const Setting& setting, auto& value) { take_if_given(reader, setting, value); });
        for (const char* key : {"title", "text"})
            if (reader.node(key) == nullptr) problems_.add(table, std::string("[[page]] has no ") + key, "add it");
        settings_.pages.push_back(std::move(page));
    }

    template <class Value> void take_if_given(const TableReader& reader, const Setting& setting, Value& value) {
        if constexpr (requires { take(reader, setting, value); }) {
            if (*setting.key != '\0' && reader.node(setting.key) != nullptr) take(reader, setting, value);
        }
    }

    // ---- a value that is given, by the type of the setting --------------------------------------------------------------

    void take(const TableReader& reader, const Setting& setting, std::same_as<bool> auto& value) {
        value = reader.truth(setting.key).value_or(value);
    }

    template <std::integral Value>
    requires(!std::same_as<Value, bool>) void take(const TableReader& reader, const Setting& setting, Value& value) {
        if (const auto number = reader.integer(setting.key, setting.least, setting.most)) value = static_cast<Value>(*number);
    }

    template <std::integral Value> void take(const TableReader& reader, const Setting& setting, std::optional<Value>& value) {
        take(reader, setting, value.emplace());
    }

    void take(const TableReader& reader, const Setting& setting, std::vector<int>& values) {
        values = reader.integers(setting.key, setting.least, setting.most);
    }

    void take(const TableReader& reader, const Setting& setting, std::vector<double>& values) {
        values = reader.numbers(setting.key, 0, setting.largest, setting.is_above_zero);
    }

    void take(const TableReader& reader, const Setting& setting, double& value) {
        value = reader.number(setting.key, setting.smallest, setting.largest, false, value);
    }

    void take(const TableReader& reader, const Setting& setting, std::optional<render::Up>& up) {
        if (const auto name = reader.word(setting.key, setting.choices())) up = sight_of({.up = *name}).up;
    }

    void take(const TableReader& reader, const Setting& setting, std::optional<render::Angles>& camera) {
        const toml::node& node = *reader.node(setting.key);
        const std::vector<double> angles = reader.numbers(setting.key, -largest_turn, largest_turn, false);
        const std::size_t given = reader.size(setting.key);
        if (angles.empty() || angles.size() != given) return;   // has a problem
        if (given < 2 || given > 3)
            problems_.add(node, reader.called(setting.key) + " has " + std::to_string(given) + (given == 1 ? " value" : " values"),
                          "write [azimuth, elevation] or [azimuth, elevation, roll]");
        else if (std::abs(angles[1]) > largest_elevation)
            problems_.add(node, reader.called(setting.key) + "[1] = " + plain_text(angles[1]) + " is out of range",
                          "an elevation may be from -90 to 90");
        else camera = {angles[0], angles[1], given == 3 ? angles[2] : 0};
    }

    void take(const TableReader& reader, const Setting& setting, ViewSize& size) {
        const toml::node& node = *reader.node(setting.key);
        const std::string called = reader.called(setting.key);
        const std::vector<int> sides = reader.integers(setting.key, setting.least, setting.most);
        if (const std::size_t given = reader.size(setting.key); given > 2 && given <= static_cast<std::size_t>(limits::largest_list))
            problems_.add(node, called + " has " + std::to_string(given) + " values", "write N or [W, H]");
        if (reader.size(setting.key) == 1 && node.is_array()) problems_.add(node, called + " has one value in a list", "write N or [W, H]");
        if (!sides.empty()) size = {sides.front(), sides.back()};
    }

    /// Takes one of the choices, if the setting has any, or a text on one line.
    void take(const TableReader& reader, const Setting& setting, std::string& value) {
        if (setting.choices != nullptr) {
            value = reader.word(setting.key, setting.choices()).value_or("");
            return;
        }
        if (setting.text == Setting::Text::number) return take_number(reader, setting, value);
        if (setting.text == Setting::Text::markdown) return take_markdown(reader, setting, value);
        const auto text = reader.text(setting.key, limits::longest_text);
        value = text.value_or(value);
        if (setting.text == Setting::Text::title && text && text->find_first_not_of(' ') == std::string::npos)
            problems_.add(*reader.node(setting.key), reader.called(setting.key) + " is blank", "write a title, or leave the key out");
        const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
        if (std::ranges::any_of(value, is_control))
            problems_.add(*reader.node(setting.key), reader.called(setting.key) + " has a control character",
                          "write it on one line, with spaces for tabs");
    }

    /// Takes the number of a question, which begins with a digit: supporting sections have letters.
    void take_number(const TableReader& reader, const Setting& setting, std::string& value) {
        const toml::node& node = *reader.node(setting.key);
        value = node.is_integer() ? std::to_string(node.as_integer()->get()) : reader.text(setting.key).value_or("");
        const auto is_sign = [](unsigned char c) { return !is_alphanumeric(static_cast<char>(c)); };
        if (value.empty() || value.size() > 4 || value[0] < '1' || value[0] > '9' || std::ranges::any_of(value, is_sign)) {
            problems_.add(node, reader.called(setting.key) + " " + in_quotes(value) + " is no number of a question", "write 3, or \"3b\"");
            return;
        }
        const auto line = static_cast<long>(node.source().begin.line);
        if (const auto [first, is_new] = number_lines_.emplace(value, line); !is_new)
            problems_.add(node, reader.called(setting.key) + " '" + value + "' is that of line " + std::to_string(first->second),
                          "give each question its own");
    }

    void take_markdown(const TableReader& reader, const Setting& setting, std::string& value) {
        value = reader.text(setting.key, limits::longest_page).value_or("");
        try {
            report::own_blocks(value);
        } catch (const std::logic_error& problem) {
            problems_.add(*reader.node(setting.key), reader.called(setting.key) + ": " + problem.what(),
                          "close every mark on its paragraph, or put a backslash before it");
        }
    }

    /// Takes the name of a bundled design, or a file.
    void take(const TableReader& reader, const Setting& setting, PageTemplate& page) {
        const auto name = reader.text(setting.key);
        if (!name) return;
        if (std::ranges::find(report::page_designs, *name) != std::end(report::page_designs)) {
            page.design = *name;
            return;
        }
        page.file = settings_.base / *name;
        try {
            if (name->empty()) throw UsageError("it is an empty path; name a file, or leave the key out");
            if (name->find('\0') != std::string::npos) throw UsageError("it contains a NUL; name a file");
            read_file(*page.file, report::template_limits::largest_file);
        } catch (const Error& error) {
            problems_.add(*reader.node(setting.key), reader.called(setting.key) + " cannot be read: " + std::string(error.what()));
        }
    }

    /// Takes some of the choices, if the setting has any, or paths.
    void take(const TableReader& reader, const Setting& setting, std::vector<std::string>& values) {
        if (setting.choices != nullptr) {
            values = reader.words(setting.key, setting.choices());
            return;
        }
        const std::string called = reader.called(setting.key);
        std::map<std::string, int> times;
        values = reader.texts(setting.key, [&](const std::string& path, const toml::node& where) {
            if (path.empty()) problems_.add(where, called + " is an empty path", "name a file");
            if (path.find('\0') != std::string::npos) problems_.add(where, called + " contains a NUL", "name a file");
            if (++times[path] == 2)
                problems_.add(where, called + " " + in_quotes(path) + " is given twice", "name it once, as its outputs would collide");
        });
    }

    /// Takes a plain file name that no part of the report uses.
    void take(const TableReader& reader, const Setting& setting, std::optional<std::string>& value) {
        value = reader.text(setting.key);
        if (!value) return;
        const toml::node& node = *reader.node(setting.key);
        const auto line = static_cast<long>(node.source().begin.line);
        const std::string called = reader.called(setting.key);
        if (!output::is_safe_name(*value)) {
            problems_.add(node, called + " " + in_quotes(*value) + " is not a plain name inside the output folder",
                          "use letters, digits, '_', '-' and '.', at most 120 of them");
        } else if (contains(used_names, *value)) {
            problems_.add(node, called + " '" + *value + "' collides with a part of the report", "choose another name");
        } else if (const auto [first, is_new] = output_lines_.emplace(*value, line); !is_new) {
            problems_.add(node, called + " '" + *value + "' collides with that of line " + std::to_string(first->second),
                          "choose another name");
        }
    }
};

}   // namespace

ReportSettings parse_settings(std::string_view text, const std::string& file, ReportSettings settings) {
    Problems problems(file);
    settings.questions.clear();
    settings.pages.clear();
    settings.only.clear();
    settings.base = fs::path(file).parent_path();
    if (const auto root = parsed_toml(text, file, problems)) Reader(*root, settings, problems).read();
    problems.raise();
    return settings;
}

ReportSettings read_settings(const std::string& config, ReportSettings before) {
    std::error_code error;
    const std::string_view bundled = bundled_report_text(config);
    const bool is_file = fs::exists(config, error) && !fs::is_directory(config, error);
    if (!bundled.empty() && !is_file) return parse_settings(bundled, config + ".toml", std::move(before));
    std::string text;
    try {
        text = read_file(config, limits::largest_settings);
    } catch (const InputError& unreadable) {
        const std::string meant = suggestion(config, bundled_report_names());
        throw SettingsErrors({meant.empty() ? UsageError(unreadable.what())
                                            : UsageError(in_quotes(config) + " is neither a file nor bundled settings",
                                                         meant + "bundled are " + meshfolio::joined(bundled_report_names(), ", "))});
    }
    return parse_settings(text, config, std::move(before));
}

}   // namespace meshfolio::run
