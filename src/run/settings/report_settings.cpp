#include "run/settings/report_settings.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <type_traits>

#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "output/publish/folder_system.h"
#include "output/publish/publish.h"
#include "questions/core/mesh_roles.h"
#include "questions/core/section_tools.h"
#include "report/numbering.h"
#include "report/words.h"
#include "report/writers.h"
#include "run/arguments.h"
#include "run/settings/setting_list.h"
#include "run/settings/settings_reader.h"

namespace meshfolio::run {

namespace {

constexpr int quick_size = 400;   // pixels of one view when --quick and no size is given

void take(ViewSize& size, const Setting& setting, const std::string& name, const std::string& text) {
    size.width = size.height = static_cast<int>(integer_between(name, text, setting.least, setting.most));
}

void take(int& value, const Setting& setting, const std::string& name, const std::string& text) {
    value = static_cast<int>(integer_between(name, text, setting.least, setting.most));
}

void take(std::optional<double>& value, const Setting& setting, const std::string& name, const std::string& text) {
    value = number_above_zero(name, text);
    if (*value > setting.largest)
        throw UsageError(name + " " + in_quotes(text) + " is more than " + plain_text(setting.largest), "take that at most");
}

void take(std::optional<render::Angles>& camera, const Setting&, const std::string&, const std::string& text) {
    camera = sight_of({.camera = text}).camera;
}

void take(std::optional<render::Up>& up, const Setting&, const std::string&, const std::string& text) { up = sight_of({.up = text}).up; }

void take(double& zoom, const Setting&, const std::string&, const std::string& text) { zoom = sight_of({.zoom = text}).zoom; }

void take(std::string& value, const Setting& setting, const std::string& name, const std::string& text) {
    if (setting.choices != nullptr) require_choice(name, text, setting.choices());
    if (setting.text == Setting::Text::title && text.find_first_not_of(' ') == std::string::npos)
        throw UsageError(name + " is blank", "write a title, or leave it out");
    const bool is_printed = *setting.table != '\0';   // in the report
    if (is_printed && (text.size() > limits::longest_text || printable(text) != text))
        throw UsageError(name + " is not at most " + std::to_string(limits::longest_text) + " bytes on one line", "write it shorter");
    value = text;
}

void take(std::filesystem::path& value, const Setting&, const std::string&, const std::string& text) { value = text; }

void take(std::vector<std::filesystem::path>& folders, const Setting&, const std::string&, const std::string& text) {
    std::vector<std::string> given = split(text, ':');
    std::erase(given, "");   // like other lists of folders
    if (!given.empty()) folders.assign(given.begin(), given.end());
}

/// Returns the ids that a word names: q1 for "Q1" and "1", three ids for "1-3" and "q1-q3"; any other word unchanged.
std::vector<std::string> ids_named_by(const std::string& word) {
    const auto number_of = [](std::string_view text) {
        if (text.starts_with('q') || text.starts_with('Q')) text.remove_prefix(1);
        const bool is_number = !text.empty() && text.size() <= 2 && text.find_first_not_of("0123456789") == std::string_view::npos;
        return is_number ? parse_integer(text) : std::nullopt;
    };
    const std::size_t dash = word.find('-');
    const auto first = number_of(std::string_view(word).substr(0, dash));
    const auto last = dash == std::string::npos ? first : number_of(std::string_view(word).substr(dash + 1));
    if (!first || !last || *first > *last) return {word};
    std::vector<std::string> ids;
    for (long long number = *first; number <= *last; ++number) ids.push_back("q" + std::to_string(number));
    return ids;
}

void take(std::vector<std::string>& chosen, const Setting& setting, const std::string& name, const std::string& text) {
    const std::vector<std::string> known = setting.choices();
    std::vector<std::string> ids, given;
    for (const std::string& word : split(text, ',')) {
        const std::vector<std::string> named = ids_named_by(word);
        given.insert(given.end(), named.begin(), named.end());
    }
    Problems problems("");
    for (const std::string& id : given) {
        if (id.empty()) {
            problems.add(0, name + " " + in_quotes(text) + " has a comma with nothing before or after it", "write q1,q4");
        } else if (!contains(known, id)) {
            problems.add(0, name + ": " + in_quotes(id) + " is unknown", "did you mean '" + nearest_word(id, known) + "'?");
        } else if (contains(ids, id)) {
            problems.add(0, name + ": '" + id + "' is given twice", "name it once");
        } else {
            ids.push_back(id);
        }
    }
    problems.raise();
    chosen = ids;
}

/// Sets every setting for which text_of(name) is not empty to that text; errors become problems.
/// @param name_of  the member of Setting with the name
template <class TextOf> void take_texts(ReportSettings& settings, const char* Setting::*name_of, TextOf text_of, Problems& problems) {
    for_each_setting(settings, [&](const Setting& setting, auto& value) {
        const std::string name = setting.*name_of, text = name.empty() ? "" : text_of(name);
        if constexpr (requires { take(value, setting, name, text); }) {
            if (!text.empty()) problems.collect([&] { take(value, setting, name, text); });
        }
    });
}

void take_flags(ReportSettings& settings, const ReportFlags& flags, Problems& problems) {
    const auto word_of = [&](const std::string& name) {
        const auto flag = std::ranges::find(word_flags, name, [](const auto& one) { return one.first; });
        return flag != std::end(word_flags) ? flags.*flag->second : "";
    };
    take_texts(settings, &Setting::flag, word_of, problems);
    if (!flags.data.empty()) settings.data.assign(flags.data.begin(), flags.data.end());
    settings.quick = flags.quick;
    settings.view_files = settings.view_files || flags.view_files;
    settings.sheets_only = flags.sheets_only;
    settings.fail_fast = flags.fail_fast;
    settings.timings = !flags.no_timings;
    if (flags.no_source) settings.source = false;
    if (flags.alone && flags.only.empty()) problems.add(0, "--alone is about --only", "name the sections with --only q1,q4");
    if (flags.part.empty()) return;
    if (!flags.out.empty()) problems.add(0, "--part and --out name two folders", "leave one of them out");
    settings.out = flags.part;   // to be merged: it has neither timings, which differ from run to run, nor a PDF
    settings.timings = false;
    settings.pdf = "off";
}

/// Returns every file and folder that the report may read.
std::set<std::filesystem::path> inputs_of(const ReportSettings& settings, const std::string& config) {
    std::set<std::filesystem::path> inputs = {config, settings.templates, settings.page.file.value_or("")};
    inputs.insert(settings.meshes.begin(), settings.meshes.end());
    inputs.insert(settings.data.begin(), settings.data.end());
    std::vector<std::filesystem::path> meshes = listed_meshes(settings);   // beside the settings file, or in a data folder
    for (const std::filesystem::path& mesh : meshes)
        if (!mesh.empty()) inputs.insert(settings.base / mesh);
    for (const MeshRole& role : mesh_role_list()) meshes.emplace_back(role.asked);
    for (const std::filesystem::path& folder : settings.data) {
        for (const std::filesystem::path& mesh : meshes)
            if (!mesh.empty()) inputs.insert({folder / mesh, folder / mesh.filename()});
    }
    return inputs;
}

/// Refuses inputs inside an earlier report, also through links: publishing the new report removes them.
void require_inputs_outside(const ReportSettings& settings, const std::string& config, Problems& problems) {
    std::error_code error;
    if (!std::filesystem::exists(output::resolved(settings.out, error) / output::marker_file, error)) return;
    for (const std::filesystem::path& input : inputs_of(settings, config)) {
        if (input.empty() || !std::filesystem::exists(input, error) || output::path_inside(input, settings.out).empty()) continue;
        problems.add(0,
                     in_quotes(input.string()) + " lies in " + in_quotes(settings.out.string()) + ", which the report replaces as a whole",
                     "move it, or choose another folder with --out");
    }
}

/// Refuses two questions of the report with one number, such as q3 with number = 4 beside q4 without any.
void require_own_numbers(const ReportSettings& settings, Problems& problems) {
    std::map<std::string, std::string> ids;   // by number
    for (const std::string& id : question_ids()) {
        if (!is_asked_for(settings, id)) continue;
        const std::string number = report::question_number(id, table_of(settings, id).number);
        if (const auto [first, is_new] = ids.emplace(number, id); !is_new)
            problems.add(0, "the questions " + first->second + " and " + id + " both have the number " + number,
                         "give each its own, or name the questions of the report in [report] sections");
    }
}

}   // namespace

report::Document head_of(const ReportSettings& settings) {
    report::Document head;
    head.title = settings.title;
    head.author = settings.author;
    head.course = settings.course;
    head.pages = settings.pages;
    if (!head.title.empty()) return head;
    constexpr std::size_t most_named = 3;
    Names names;
    for (const std::filesystem::path& mesh : settings.meshes) names.push_back(printable(mesh.stem().string()));
    if (names.size() > most_named + 1) {
        const std::size_t others = names.size() - most_named;
        names.resize(most_named);
        names.push_back(std::to_string(others) + " more");
    }
    head.title = report::Words("figures").line("own_title", "meshes"_a = listed(names));
    return head;
}

void enter_words(report::Document& document, const ReportSettings& settings, bool keep) {
    for (report::Section& section : document.sections) {
        if (!keep) section.title = chapter_of_id(section.id).title(), section.number = section.intro = "", section.points = 0;
        const QuestionTable& table = table_of(settings, section.id);
        if (!table.title.empty()) section.title = table.title;
        if (!table.number.empty()) section.number = table.number;
        if (!table.intro.empty()) section.intro = table.intro;
        if (table.points > 0) section.points = table.points;
    }
    report::sort_by_number(document);
}

bool has_source(const ReportSettings& settings) { return settings.source.value_or(settings.meshes.empty()); }

bool is_asked_for(const ReportSettings& settings, std::string_view id) {
    return settings.only.empty() || contains(settings.only, std::string(id));
}

ReportSettings report_settings(const ReportFlags& flags, bool own_meshes) {
    Problems problems("");
    ReportSettings settings = parse_settings(default_settings_text(), "report.toml");
    if (own_meshes || !flags.meshes.empty()) settings.title = settings.course = "";
    if (flags.quick) settings.size = {quick_size, quick_size};
    take_texts(settings, &Setting::variable, environment, problems);
    problems.collect([&] {
        if (!flags.config.empty()) settings = read_settings(flags.config, settings);
    });
    take_flags(settings, flags, problems);
    for (const std::string& mesh : flags.meshes) {
        if (std::ranges::find(settings.meshes, std::filesystem::path(mesh)) != settings.meshes.end())
            problems.add(0, in_quotes(mesh) + " is given twice; its outputs would collide", "name it once");
        else settings.meshes.emplace_back(mesh);
    }
    require_own_numbers(settings, problems);
    problems.collect([&] { report::Templates(settings.templates); });   // checks the folder
    require_inputs_outside(settings, flags.config, problems);
    problems.raise();
    settings.only = sections_in_order(settings.only);
    return settings;
}

std::unique_ptr<tbb::global_control> limited_threads(const ReportSettings& settings) {
    if (settings.threads == 0) return nullptr;
    return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(settings.threads));
}

Effort effort_of(const ReportSettings& settings, const std::string& id) {
    const auto planned = settings.efforts.find(id);
    return planned != settings.efforts.end() ? planned->second : Effort{.small = settings.quick};
}

const QuestionTable& table_of(const ReportSettings& settings, std::string_view id) {
    static const QuestionTable none;
    const auto table = settings.questions.find(std::string(id));
    return table != settings.questions.end() ? table->second : none;
}

QuestionSettings question_settings(const ReportSettings& settings, const std::string& id) {
    QuestionSettings question;
    const QuestionTable& table = table_of(settings, id);
    // Naming all members makes the compiler report a new one.
    auto& [meshes, base, k, lambda, iterations, noise, seed, quick, laboratory, colormap] = question;
    if (settings.meshes.empty()) meshes = table.meshes;   // meshes on the command line replace those of the file
    base = settings.base;
    k = table.k;
    lambda = table.lambda;
    iterations = table.iterations;
    noise = table.noise;
    seed = table.seed.value_or(settings.seed);
    quick = effort_of(settings, id).small;
    laboratory = settings.laboratory;
    colormap = settings.colormap;
    return question;
}

std::vector<std::filesystem::path> listed_meshes(const ReportSettings& settings) {
    std::vector<std::filesystem::path> meshes;
    for (const auto& [id, table] : settings.questions) meshes.insert(meshes.end(), table.meshes.begin(), table.meshes.end());
    return meshes;
}

std::vector<std::string> sections_in_order(const std::vector<std::string>& ids) {
    std::vector<std::string> all = section_ids(), some;
    std::ranges::copy_if(all, std::back_inserter(some), [&](const std::string& id) { return contains(ids, id); });
    return some == all ? std::vector<std::string>() : some;
}

}   // namespace meshfolio::run
