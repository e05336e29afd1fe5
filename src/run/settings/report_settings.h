/// @file
/// The settings of `meshfolio report`: flags over settings file over environment over defaults. Settings files are TOML and read strictly:
/// a file with any unknown key, wrong type or value beyond a limit is refused, with all its problems at once.
#pragma once

#include <tbb/global_control.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/errors.h"
#include "questions/core/chapter.h"
#include "questions/core/settings.h"
#include "run/arguments.h"

namespace meshfolio::run {

/// All problems of settings, whether from a file, the command line or the environment; what() is the first.
class SettingsErrors : public UsageError {
public:
    /// @param problems  at least one
    explicit SettingsErrors(std::vector<UsageError> problems) : UsageError(problems.front()), problems_(std::move(problems)) {}
    const std::vector<UsageError>& problems() const { return problems_; }

private:
    std::vector<UsageError> problems_;
};

/// The options of the command line; empty: not given.
struct ReportFlags : SightFlags {
    std::vector<std::string> meshes, data;
    std::string only, out, config, threads, size, templates, pdf, pdf_browser, title, author, course, from, part, junit, time;
    std::vector<std::string> parts;   // of `merge`
    bool quick = false, fail_fast = false, no_timings = false, no_cache = false, view_files = false, sheets_only = false, alone = false,
         plan = false, json = false, no_source = false;
};

/// The options that take one word.
inline constexpr std::pair<const char*, std::string ReportFlags::*> word_flags[] = {
    {"--only", &ReportFlags::only},       {"--config", &ReportFlags::config},
    {"--title", &ReportFlags::title},     {"--course", &ReportFlags::course},
    {"--author", &ReportFlags::author},   {"--size", &ReportFlags::size},
    {"--time", &ReportFlags::time},       {"--templates", &ReportFlags::templates},
    {"--pdf", &ReportFlags::pdf},         {"--pdf-browser", &ReportFlags::pdf_browser},
    {"--threads", &ReportFlags::threads}, {"--out", &ReportFlags::out},
    {"--camera", &ReportFlags::camera},   {"--up", &ReportFlags::up},
    {"--zoom", &ReportFlags::zoom}};

struct ViewSize {
    int width = 0, height = 0;   // of one view [pixels]
};

struct PageTemplate {
    std::string design = "report";               // name of a bundled design
    std::optional<std::filesystem::path> file;   // instead, absolute or relative to the working directory
};

/// A [[question]] table of a settings file. For a key that is not given, the question takes its own default.
struct QuestionTable {
    std::string title, number, intro;   // as in report::Section; empty: the question's own
    double points = 0;
    std::vector<std::string> meshes;
    std::vector<int> k, iterations;
    std::vector<double> lambda, noise;
    std::optional<std::uint64_t> seed;
    std::optional<int> threads;
    std::optional<std::string> output;   // folder of the output meshes
};

/// The effort spent on a section, as run/plan decides.
struct Effort {
    bool small = false;      // the settings of --quick
    int most_vertices = 0;   // larger meshes are decimated to this; 0: no limit
    bool left_out = false;
    double cpu_seconds = 0;   // estimated
};

/// The settings of a report. setting_list.h says where each is given and what depends on it.
struct ReportSettings {
    std::vector<std::filesystem::path> meshes, data;
    std::filesystem::path out = "out", templates;
    PageTemplate page;
    std::string pdf = "auto", pdf_browser;         // auto, require or off; name or path of the browser, empty: the first that is found
    std::string title, author, course, colormap;   // an empty title names the user's own meshes
    std::optional<bool> source;                    // write src.txt; none: unless the user gives own meshes
    ViewSize size;
    render::Sight sight;   // of the pictures, models and laboratories
    int threads = 0;       // 0: all
    std::uint64_t seed = 0;
    bool view_files = false;    // also write every view of every figure as a file
    bool sheets_only = false;   // write no view as a file, even if the assignment asks for it
    bool quick = false, laboratory = false, fail_fast = false, timings = true;
    std::optional<double> time;                       // seconds on two cores for the report; none: the default
    std::map<std::string, Effort> efforts;            // by id; none: `quick` decides
    std::vector<std::string> only;                    // ids; empty: all
    std::map<std::string, QuestionTable> questions;   // by id
    std::vector<report::OwnPage> pages;               // [[page]] tables
    std::filesystem::path base;                       // folder of the settings file, to which its meshes are relative
};

/// Parses a settings file over `before`. Its questions, pages and sections replace the earlier ones, even by none.
/// @param file  its name in messages; paths are relative to its folder
/// @throws SettingsErrors
ReportSettings parse_settings(std::string_view text, const std::string& file, ReportSettings before = {});

/// Parses the settings file of this name, or else the bundled one of data/reports. @throws SettingsErrors, also if there is neither
ReportSettings read_settings(const std::string& config, ReportSettings before = {});

/// Returns the settings of a run: defaults, environment, settings file, flags, each over the ones before. A report on own meshes has
/// neither the title nor the course of the defaults. @param own_meshes  true: also if the flags name none
/// @throws SettingsErrors, UsageError
ReportSettings report_settings(const ReportFlags& flags, bool own_meshes = false);

/// Returns title, author, course and pages of the report.
report::Document head_of(const ReportSettings& settings);

/// Puts title, number, points and introduction of the [[question]] tables in place of those of the sections, and sorts these by number.
/// @param keep  what a table does not give is left as it is; false: it becomes that of the chapter
void enter_words(report::Document& document, const ReportSettings& settings, bool keep);

/// True if the report has src.txt.
bool has_source(const ReportSettings& settings);

/// Limits the threads of the process to settings.threads while the result lives. Returns null for 0, no limit.
std::unique_ptr<tbb::global_control> limited_threads(const ReportSettings& settings);

/// The key of a section's effort in described() is its id with this suffix.
inline constexpr const char* effort_suffix = " effort";

/// Returns the planned effort of one section; without a plan, small settings if `quick`, else full ones.
Effort effort_of(const ReportSettings& settings, const std::string& id);

/// Returns the [[question]] table of one section; an empty one if the settings have none.
const QuestionTable& table_of(const ReportSettings& settings, std::string_view id);

/// Returns the settings of one section, from its [[question]] table and from the settings of the report.
QuestionSettings question_settings(const ReportSettings& settings, const std::string& id);

/// Returns the meshes that [[question]] tables name, sorted by the id of the table; a mesh named twice is listed twice.
std::vector<std::filesystem::path> listed_meshes(const ReportSettings& settings);

/// True if `only` does not leave the chapter out.
bool is_asked_for(const ReportSettings& settings, std::string_view id);

/// Returns name → value of every setting that shapes the results, without threads and paths, for the provenance.
std::map<std::string, std::string> described(const ReportSettings& settings);

/// Returns `ids` in the order of the report, unknown ones left out; nothing if they are all sections.
std::vector<std::string> sections_in_order(const std::vector<std::string>& ids);

/// Returns the values, as texts, of every setting that the answer to a question depends on, each after the number of its texts, for the key
/// of the cache. The meshes are identified elsewhere in the key.
std::vector<std::string> identity_of(const ReportSettings& settings, const std::string& question);

}   // namespace meshfolio::run
