#include "run/settings/settings_file.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "base/nearest_word.h"
#include "base/sha256.h"
#include "color/colormap.h"
#include "output/publish/safe_name.h"
#include "questions/core/chapter.h"
#include "report/page/template_render.h"
#include "report/writers.h"
#include "run/settings/experiment_reader.h"
#include "run/settings/settings_reader.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

constexpr long long largest_seed = std::numeric_limits<std::int64_t>::max();   // TOML's integers

/// Names in the report's folder that a question's output may not take.
const std::vector<std::string> taken_names{"images",  "tables",       "index.html", "report.md",     "report.pdf",
                                           "src.txt", "results.json", "SHA256SUMS", "submission.zip"};

/// Reads one settings file.
class Reader {
public:
    Reader(const toml::table& root, const std::string& file, Problems& problems) : root_(root), file_(file), problems_(problems) {}

    SettingsFile read() {
        settings_.folder = fs::path(file_).parent_path();
        const TableReader top(root_, "", {"seed", "threads", "laboratory"}, problems_,
                              {"report", "render", "question", "original", "experiment"});
        settings_.seed = seed_of(top);
        settings_.threads = threads_of(top);
        settings_.laboratory = top.truth("laboratory");
        if (const toml::table* table = table_named("report")) read_report(*table);
        if (const toml::table* table = table_named("render")) read_render(*table);
        read_questions();
        settings_.experiments = read_experiments(root_, problems_);
        return std::move(settings_);
    }

private:
    const toml::table& root_;
    const std::string& file_;
    Problems& problems_;
    SettingsFile settings_;
    std::map<std::string, long> output_lines_;   // where each output name was given

    const toml::table* table_named(std::string_view name) {
        const toml::node* node = root_.get(name);
        if (node != nullptr && !node->is_table())
            problems_.add(*node, std::string(name) + " is not a table", "write [" + std::string(name) + "]");
        return node != nullptr ? node->as_table() : nullptr;
    }

    static std::optional<std::uint64_t> seed_of(const TableReader& table) {
        const auto seed = table.integer("seed", 0, largest_seed);
        return seed ? std::optional(static_cast<std::uint64_t>(*seed)) : std::nullopt;
    }

    static std::optional<int> threads_of(const TableReader& table) {
        const auto threads = table.integer("threads", 0, limits::largest_threads);
        return threads ? std::optional(static_cast<int>(*threads)) : std::nullopt;
    }

    std::optional<std::string> short_text(const TableReader& table, std::string_view key) {
        auto text = table.text(key);
        if (text && text->size() > static_cast<std::size_t>(limits::longest_text)) {
            problems_.add(*table.node(key), table.called(key) + " has " + std::to_string(text->size()) + " bytes",
                          "at most " + std::to_string(limits::longest_text) + " are allowed");
        }
        const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
        if (text && std::any_of(text->begin(), text->end(), is_control))
            problems_.add(*table.node(key), table.called(key) + " has a control character", "write it on one line, with spaces for tabs");
        return text;
    }

    void read_report(const toml::table& table) {
        const TableReader report(table, "[report]", {"title", "author", "course", "template", "pdf", "sections"}, problems_);
        settings_.title = short_text(report, "title");
        settings_.author = short_text(report, "author");
        settings_.course = short_text(report, "course");
        settings_.sections = sections_of(report);
        read_template(report);
        read_printed(report);
    }

    /// One of the bundled designs by its name, else a file.
    void read_template(const TableReader& report) {
        const auto name = report.text("template");
        if (!name) return;
        if (std::find(std::begin(report::page_designs), std::end(report::page_designs), *name) != std::end(report::page_designs)) {
            settings_.design = *name;
            return;
        }
        settings_.page_template = settings_.folder / *name;
        try {
            if (name->find('\0') != std::string::npos) throw UsageError("it contains a NUL");
            read_file(*settings_.page_template, report::template_limits::largest_file);
        } catch (const Error& error) {
            problems_.add(*report.node("template"), "[report] template cannot be read: " + std::string(error.what()));
        }
    }

    void read_printed(const TableReader& report) {
        const auto extent = report.text("pdf");
        if (!extent) return;
        if (*extent != "brief" && *extent != "full") {
            problems_.add(*report.node("pdf"), "[report] pdf is " + in_quotes(*extent), "write \"brief\" or \"full\"");
        } else {
            settings_.printed = *extent == "full" ? report::Extent::whole : report::Extent::brief;
        }
    }

    std::vector<std::string> sections_of(const TableReader& report) {
        const std::vector<std::string> known = section_ids();
        std::map<std::string, int> times;
        return report.texts("sections", [&](const std::string& id, const toml::node& where) {
            if (!contains(known, id)) {
                problems_.add(where, "[report] sections: no question " + in_quotes(id), "did you mean '" + nearest_word(id, known) + "'?");
            } else if (++times[id] == 2) {
                problems_.add(where, "[report] sections: '" + id + "' is given twice", "name each once; their order is fixed");
            }
        });
    }

    void read_render(const toml::table& table) {
        const TableReader render(table, "[render]", {"size", "colormap"}, problems_);
        const std::vector<int> size = render.integers("size", limits::smallest_size, limits::largest_size);
        if (const std::size_t given = render.size("size"); given > 2 && given <= static_cast<std::size_t>(limits::largest_list))
            problems_.add(*render.node("size"), "[render] size has " + std::to_string(given) + " values", "write N or [W, H]");
        if (render.size("size") == 1 && render.node("size")->is_array())
            problems_.add(*render.node("size"), "[render] size has one value in a list", "write N or [W, H]");
        if (!size.empty()) {
            settings_.width = size.front();
            settings_.height = size.back();
        }
        settings_.colormap = render.text("colormap");
        if (settings_.colormap && !contains(colormap_names(), *settings_.colormap)) {
            problems_.add(*render.node("colormap"), "unknown colour map " + in_quotes(*settings_.colormap),
                          "did you mean '" + nearest_word(*settings_.colormap, colormap_names()) + "'?");
        }
    }

    void read_questions() {
        const toml::node* node = root_.get("question");
        if (node == nullptr) return;
        for_each_table(*node, "question", problems_, [&](const toml::table& table) { read_question(table); });
    }

    void read_question(const toml::table& table) {
        const TableReader question(table, "[[question]]", {"id", "mesh", "k", "lambda", "iterations", "noise", "output", "seed", "threads"},
                                   problems_);
        QuestionTable read;
        read.meshes = meshes_of(question);
        read.k = question.integers("k", 1, limits::largest_k);
        read.lambda = question.numbers("lambda", 0, limits::largest_lambda, true);
        read.iterations = question.integers("iterations", 1, limits::largest_iterations);
        read.noise = question.numbers("noise", 0, limits::largest_noise, false);
        read.seed = seed_of(question);
        read.threads = threads_of(question);
        read.output = output_of(question);
        enter(table, question, std::move(read));
    }

    std::vector<std::string> meshes_of(const TableReader& question) {
        std::map<std::string, int> times;
        return question.texts("mesh", [&](const std::string& mesh, const toml::node& where) {
            if (mesh.empty()) problems_.add(where, "[[question]] mesh is an empty path", "name a file");
            if (mesh.find('\0') != std::string::npos) problems_.add(where, "[[question]] mesh contains a NUL", "name a file");
            if (++times[mesh] == 2)
                problems_.add(where, "[[question]] mesh " + in_quotes(mesh) + " is given twice", "its outputs would collide");
        });
    }

    /// A plain name that neither leaves the report's folder nor is taken there.
    std::optional<std::string> output_of(const TableReader& question) {
        auto name = question.text("output");
        if (!name) return {};
        const toml::node& node = *question.node("output");
        const auto line = static_cast<long>(node.source().begin.line);
        if (!output::is_safe_name(*name)) {
            problems_.add(node, "[[question]] output " + in_quotes(*name) + " is not a plain name inside the output folder",
                          "use letters, digits, '_', '-' and '.', at most 120 of them");
        } else if (contains(taken_names, *name)) {
            problems_.add(node, "[[question]] output '" + *name + "' collides with a part of the report", "choose another name");
        } else if (const auto [first, fresh] = output_lines_.emplace(*name, line); !fresh) {
            problems_.add(node, "[[question]] output '" + *name + "' collides with that of line " + std::to_string(first->second),
                          "choose another name");
        }
        return name;
    }

    void enter(const toml::table& table, const TableReader& question, QuestionTable read) {
        if (question.node("id") == nullptr) problems_.add(table, "[[question]] has no id", "add id = \"q1\" … \"q7\"");
        const auto id = question.text("id");
        if (!id) return;
        const std::vector<std::string> known = section_ids();
        if (!contains(known, *id)) {
            problems_.add(*question.node("id"), "unknown question " + in_quotes(*id), "did you mean '" + nearest_word(*id, known) + "'?");
        } else if (!settings_.questions.emplace(*id, std::move(read)).second) {
            problems_.add(*question.node("id"), "question '" + *id + "' is given twice", "merge the two tables");
        }
    }
};

}   // namespace

SettingsFile parse_settings(std::string_view text, const std::string& file) {
    Problems problems(file);
    if (const long line = line_of_long_key(text); line > 0) {
        problems.add(line, "a key has more than " + std::to_string(limits::longest_key) + " parts between dots",
                     "none that is known has more than two");
        problems.raise();
    }
    try {
        const toml::table root = toml::parse(text, file);
        SettingsFile settings = Reader(root, file, problems).read();
        settings.digest = sha256(text);
        problems.raise();
        return settings;
    } catch (const toml::parse_error& error) {
        problems.add(static_cast<long>(error.source().begin.line), std::string(error.description()), "correct the TOML");
        problems.raise();
        throw;   // not reached: there is a problem
    }
}

SettingsFile read_settings(const fs::path& path) {
    std::string text;
    try {
        text = read_file(path, limits::largest_settings);
    } catch (const InputError& error) {
        throw SettingsErrors({UsageError(error.what())});
    }
    return parse_settings(text, path.string());
}

}   // namespace meshfolio::run
