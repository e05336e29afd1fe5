#include "run/settings/report_settings.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <set>
#include <string_view>

#include "base/in_quotes.h"
#include "base/nearest_word.h"
#include "base/number_text.h"
#include "output/publish/folder_system.h"
#include "output/publish/publish.h"
#include "questions/core/chapter.h"
#include "questions/core/stand_ins.h"
#include "report/writers.h"
#include "run/arguments.h"
#include "run/settings/settings_reader.h"

namespace meshfolio::run {

namespace {

constexpr int quick_size = 400;   // pixels of one view when --quick and no size is given

template <class Value, class Given>
void take(Value& value, const std::optional<Given>& given) {
    if (given) value = *given;
}

void take_file(ReportSettings& settings, const SettingsFile& file) {
    take(settings.title, file.title);
    take(settings.author, file.author);
    take(settings.course, file.course);
    take(settings.colormap, file.colormap);
    take(settings.width, file.width);
    take(settings.height, file.height);
    take(settings.threads, file.threads);
    take(settings.seed, file.seed);
    take(settings.laboratory, file.laboratory);
    take(settings.page_template, file.page_template);
    take(settings.design, file.design);
    take(settings.printed, file.printed);
    settings.questions = file.questions;
    settings.experiments = file.experiments;
    settings.experiments_digest = file.digest;
    settings.only = file.sections;
    settings.base = file.folder;
}

void take_size(ReportSettings& settings, const std::string& name, const std::string& text) {
    if (!text.empty())
        settings.width = settings.height = static_cast<int>(integer_between(name, text, limits::smallest_size, limits::largest_size));
}

void take_threads(ReportSettings& settings, const std::string& name, const std::string& text) {
    if (!text.empty()) settings.threads = static_cast<int>(integer_between(name, text, 0, limits::largest_threads));
}

void take_pdf(ReportSettings& settings, const std::string& name, const std::string& text) {
    if (text.empty()) return;
    if (text != "auto" && text != "require" && text != "off")
        throw UsageError(name + " " + in_quotes(text) + " is none of auto, require and off");
    settings.pdf = text;
}

void take_data(ReportSettings& settings, const std::vector<std::string>& folders) {
    if (!folders.empty()) settings.data.assign(folders.begin(), folders.end());
}

void take_meshes(ReportSettings& settings, const std::vector<std::string>& meshes, Problems& problems) {
    for (const std::string& mesh : meshes) {
        if (std::ranges::find(settings.meshes, std::filesystem::path(mesh)) != settings.meshes.end()) {
            problems.add(0, in_quotes(mesh) + " is given twice; its outputs would collide", "name it once");
        } else {
            settings.meshes.emplace_back(mesh);
        }
    }
}

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

void take_environment(ReportSettings& settings, Problems& problems) {
    problems.collect([&] { take_size(settings, "MESHFOLIO_SIZE", environment("MESHFOLIO_SIZE")); });
    problems.collect([&] { take_threads(settings, "MESHFOLIO_THREADS", environment("MESHFOLIO_THREADS")); });
    problems.collect([&] { take_pdf(settings, "MESHFOLIO_PDF", environment("MESHFOLIO_PDF")); });
    std::vector<std::string> folders = split(environment("MESHFOLIO_DATA"), ':');
    std::erase(folders, "");   // as in other lists of folders
    take_data(settings, folders);
    if (const std::string out = environment("MESHFOLIO_OUT"); !out.empty()) settings.out = out;
}

/// Those of data/reports, each file read once.
const std::vector<Experiment>& bundled_experiments() {
    static const std::vector<Experiment> experiments = [] {
        std::vector<Experiment> all;
        for (const std::string& name : bundled_report_names()) {
            const std::vector<Experiment> some = parse_settings(bundled_report_text(name), name + ".toml").experiments;
            all.insert(all.end(), some.begin(), some.end());
        }
        return all;
    }();
    return experiments;
}

/// Meshes that settings and experiments name: looked for beside the settings file, then in the data folders.
std::vector<std::filesystem::path> named_meshes(const ReportSettings& settings) {
    std::vector<std::filesystem::path> files = listed_meshes(settings);
    for (const Experiment& experiment : settings.experiments.empty() ? bundled_experiments() : settings.experiments) {
        for (const OriginalMesh& mesh : experiment.meshes) {
            if (!mesh.file.empty()) files.emplace_back(mesh.file);
        }
    }
    return files;
}

/// Every file and folder that may be read.
std::set<std::filesystem::path> inputs_of(const ReportSettings& settings, const std::string& config) {
    std::set<std::filesystem::path> inputs = {config, settings.templates, settings.page_template.value_or("")};
    inputs.insert(settings.meshes.begin(), settings.meshes.end());
    inputs.insert(settings.data.begin(), settings.data.end());
    std::vector<std::filesystem::path> in_data = named_meshes(settings);
    for (const std::filesystem::path& mesh : in_data) inputs.insert(settings.base / mesh);
    for (const MeshRole& role : mesh_role_list()) in_data.emplace_back(role.asked);
    for (const StandIn& original : stand_in_list()) in_data.emplace_back(original.file);
    for (const std::filesystem::path& folder : settings.data) {
        for (const std::filesystem::path& mesh : in_data) {
            if (!mesh.empty()) inputs.insert({folder / mesh, folder / mesh.filename()});
        }
    }
    return inputs;
}

/// What is read must not lie in an earlier report, nor be linked to there: that is removed once the new one is in its place.
void require_inputs_outside(const ReportSettings& settings, const std::string& config, Problems& problems) {
    std::error_code error;
    const std::filesystem::path out = output::resolved(settings.out, error);
    if (!std::filesystem::exists(out / output::marker_file, error)) return;
    for (const std::filesystem::path& input : inputs_of(settings, config)) {
        if (input.empty() || !std::filesystem::exists(input, error)) continue;
        const std::filesystem::path inside = std::filesystem::canonical(input, error).lexically_relative(out);
        if (inside.empty() || *inside.begin() == "..") continue;
        problems.add(0,
                     in_quotes(input.string()) + " lies in " + in_quotes(settings.out.string()) + ", which the report replaces as a whole",
                     "move it, or choose another folder with --out");
    }
}

std::vector<std::string> chosen_questions(const std::string& text) {
    const std::vector<std::string> known = section_ids();
    std::vector<std::string> chosen;
    Problems problems("");
    for (const std::string& id : split(text, ',')) {
        if (id.empty()) {
            problems.add(0, "--only " + in_quotes(text) + " has a comma with nothing before or behind it", "write q1,q4");
        } else if (std::find(known.begin(), known.end(), id) == known.end()) {
            problems.add(0, "--only: no question " + in_quotes(id), "did you mean '" + nearest_word(id, known) + "'?");
        } else if (std::find(chosen.begin(), chosen.end(), id) != chosen.end()) {
            problems.add(0, "--only: '" + id + "' is given twice", "name each once; their order is fixed");
        } else {
            chosen.push_back(id);
        }
    }
    problems.raise();
    return chosen;
}

template <class Number>
std::string listed(const std::vector<Number>& values) {
    std::string text;
    for (const Number value : values) text += (text.empty() ? "" : ", ") + exact_text(static_cast<double>(value));
    return text;
}

void take_experiments(QuestionSettings& question, const ReportSettings& settings) {
    question.bundled_experiments = bundled_experiments();
    question.experiments = settings.experiments;
    question.own_experiments = !settings.experiments.empty();
    if (question.own_experiments) return;
    const auto is_brief = [](const Experiment& experiment) { return experiment.brief; };
    std::copy_if(question.bundled_experiments.begin(), question.bundled_experiments.end(), std::back_inserter(question.experiments),
                 is_brief);
    if (settings.quick && question.experiments.size() > 1) question.experiments.resize(1);
}

}   // namespace

SettingsFile named_settings(const std::string& config) {
    std::error_code error;
    const std::string_view bundled = bundled_report_text(config);
    if (!bundled.empty() && !std::filesystem::exists(config, error)) return parse_settings(bundled, config + ".toml");
    return read_settings(config);
}

ReportSettings report_settings(const ReportFlags& flags) {
    ReportSettings settings;
    Problems problems("");
    take_file(settings, parse_settings(default_settings_text(), "report.toml"));
    if (flags.quick) settings.width = settings.height = quick_size;
    take_environment(settings, problems);
    problems.collect([&] {
        if (!flags.config.empty()) take_file(settings, named_settings(flags.config));
    });
    problems.collect([&] { take_size(settings, "--size", flags.size); });
    problems.collect([&] { take_threads(settings, "--threads", flags.threads); });
    problems.collect([&] { take_pdf(settings, "--pdf", flags.pdf); });
    settings.pdf_browser = flags.pdf_browser;
    take_data(settings, flags.data);
    if (!flags.out.empty()) settings.out = flags.out;
    settings.templates = flags.templates;
    take_meshes(settings, flags.meshes, problems);
    problems.collect([&] {
        if (!flags.only.empty()) settings.only = chosen_questions(flags.only);
    });
    problems.collect([&] { report::Templates(settings.templates); });   // those of the folder, told with the other problems
    require_inputs_outside(settings, flags.config, problems);
    problems.raise();
    settings.quick = flags.quick;
    settings.fail_fast = flags.fail_fast;
    settings.timings = !flags.no_timings;
    return settings;
}

std::unique_ptr<tbb::global_control> limited_threads(const ReportSettings& settings) {
    if (settings.threads == 0) return nullptr;
    return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(settings.threads));
}

QuestionSettings question_settings(const ReportSettings& settings, const std::string& id) {
    QuestionSettings question;
    question.base = settings.base;
    question.seed = settings.seed;
    question.quick = settings.quick;
    question.laboratory = settings.laboratory;
    question.colormap = settings.colormap;
    if (id == "reproductions" || id == "claims") take_experiments(question, settings);
    const auto it = settings.questions.find(id);
    if (it == settings.questions.end()) return question;
    const QuestionTable& table = it->second;
    // Meshes on the command line take every role, also those of the file.
    if (settings.meshes.empty()) question.meshes = table.meshes;
    question.k = table.k;
    question.lambda = table.lambda;
    question.iterations = table.iterations;
    question.noise = table.noise;
    take(question.seed, table.seed);
    return question;
}

std::vector<std::filesystem::path> listed_meshes(const ReportSettings& settings) {
    std::vector<std::filesystem::path> meshes;
    for (const auto& [id, table] : settings.questions) meshes.insert(meshes.end(), table.meshes.begin(), table.meshes.end());
    return meshes;
}

std::map<std::string, std::string> described(const ReportSettings& settings) {
    const auto yes_or_no = [](bool flag) { return flag ? "yes" : "no"; };
    std::map<std::string, std::string> values{
        {"quick", yes_or_no(settings.quick)}, {"laboratory", yes_or_no(settings.laboratory)}, {"colormap", settings.colormap}};
    values["size"] = std::to_string(settings.width) + " × " + std::to_string(settings.height);
    for (const std::string& id : settings.only) values["only"] += (values["only"].empty() ? "" : ", ") + id;
    for (const auto& [id, table] : settings.questions) {
        const auto enter = [&values, &question = id](const std::string& key, const std::string& value) {
            if (!value.empty()) values[question + " " + key] = value;
        };
        enter("k", listed(table.k));
        enter("lambda", listed(table.lambda));
        enter("iterations", listed(table.iterations));
        enter("noise", listed(table.noise));
        if (table.seed) enter("seed", std::to_string(*table.seed));
    }
    return values;
}

}   // namespace meshfolio::run
