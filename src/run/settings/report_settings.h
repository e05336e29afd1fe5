/// @file
/// What `meshfolio report` was asked for: flags over settings file over environment over defaults. Settings files are TOML. Strict: every
/// key is known, of its type and within its limits, or the file is refused with everything that is wrong in it at once.
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

namespace meshfolio::run {

/// Everything wrong in settings, whether from a file, the command line or the environment; what() is the first.
class SettingsErrors : public UsageError {
public:
    /// @param problems  at least one
    explicit SettingsErrors(std::vector<UsageError> problems) : UsageError(problems.front()), problems_(std::move(problems)) {}
    const std::vector<UsageError>& problems() const { return problems_; }

private:
    std::vector<UsageError> problems_;
};

/// As given on the command line; what is empty was not.
struct ReportFlags {
    std::vector<std::string> meshes, data;
    std::string only, out, config, threads, size, templates, pdf, pdf_browser, author, from, part, junit, time;
    std::vector<std::string> parts;   // of `merge`
    bool quick = false, fail_fast = false, no_timings = false, no_cache = false, view_files = false, sheets_only = false, alone = false,
         plan = false, json = false;
};

/// Those of them that are one word each, by their names.
inline constexpr std::pair<const char*, std::string ReportFlags::*> word_flags[] = {
    {"--only", &ReportFlags::only},       {"--config", &ReportFlags::config},
    {"--author", &ReportFlags::author},   {"--size", &ReportFlags::size},
    {"--time", &ReportFlags::time},       {"--templates", &ReportFlags::templates},
    {"--pdf", &ReportFlags::pdf},         {"--pdf-browser", &ReportFlags::pdf_browser},
    {"--threads", &ReportFlags::threads}, {"--out", &ReportFlags::out}};

struct ViewSize {
    int width = 0, height = 0;   // of one view [pixels]
};

struct PageTemplate {
    std::string design = "report";               // a bundled one
    std::optional<std::filesystem::path> file;   // in place of it, absolute or relative to where the program runs
};

/// [[question]]: what was given is set, the rest stays with the question.
struct QuestionTable {
    std::vector<std::string> meshes;
    std::vector<int> k, iterations;
    std::vector<double> lambda, noise;
    std::optional<std::uint64_t> seed;
    std::optional<int> threads;
    std::optional<std::string> output;   // folder of the output meshes
};

/// How much of a section is done: run/plan decides.
struct Effort {
    bool small = false;      // the settings of --quick
    int most_vertices = 0;   // larger meshes are decimated to this; 0: no limit
    bool left_out = false;
    double cpu_seconds = 0;   // estimated
};

/// setting_list.h says of each where it is given and what depends on it.
struct ReportSettings {
    std::vector<std::filesystem::path> meshes, data;
    std::filesystem::path out = "out", templates;
    PageTemplate page;
    std::string pdf = "auto", pdf_browser;   // auto, require or off; the browser by name or path, empty: the first that is found
    std::string title, author, course, colormap;
    ViewSize size;
    int threads = 0;   // 0: all
    std::uint64_t seed = 0;
    bool view_files = false;    // every view of every figure is a file of its own as well
    bool sheets_only = false;   // unless so, not even those that the assignment asks for
    bool quick = false, laboratory = false, fail_fast = false, timings = true;
    bool earlier = false;                             // also the chapters on request
    std::optional<double> time;                       // seconds on two cores that the report is to fit into; none: as promised
    std::map<std::string, Effort> efforts;            // by id; none: everything as `quick` says
    std::vector<std::string> only;                    // ids; empty: all, those on request only as chapters_of() says
    std::map<std::string, QuestionTable> questions;   // by id
    std::vector<Experiment> experiments;              // of earlier reports; empty: the brief ones of the bundled files
    std::string experiments_digest;                   // SHA-256 of the file they come from
    std::filesystem::path base;                       // folder of that file: what the meshes of `questions` are relative to
};

/// Those of a file over `before`. A file's questions, experiments and sections take the place of others, also where it has none.
/// @param file  what messages call it; paths are relative to its folder
/// @throws SettingsErrors
ReportSettings parse_settings(std::string_view text, const std::string& file, ReportSettings before = {});

/// The same from the file of that name, else, also where a folder has it, from the bundled one of data/reports. @throws SettingsErrors,
/// also for one that cannot be read
ReportSettings read_settings(const std::string& config, ReportSettings before = {});

/// @throws SettingsErrors, UsageError
ReportSettings report_settings(const ReportFlags& flags);

/// For as long as it lives, no more threads work than are asked for; null where all may.
std::unique_ptr<tbb::global_control> limited_threads(const ReportSettings& settings);

/// Behind the section's id: the name of what is planned for it, among what is described.
inline constexpr const char* effort_suffix = " effort";

/// What is planned for one section.
Effort effort_of(const ReportSettings& settings, const std::string& id);

/// Those of one question.
QuestionSettings question_settings(const ReportSettings& settings, const std::string& id);

/// The meshes of all questions, in order: their names must not depend on which question reads first.
std::vector<std::filesystem::path> listed_meshes(const ReportSettings& settings);

/// Returns true if the settings ask for the chapters on request, by `earlier` or by experiments of their own.
bool wants_earlier(const ReportSettings& settings);

/// Returns the chapters of the report, in their order. Those on request are among them if the settings name experiments, or `only` names
/// the chapter. All other functions that choose sections use this one.
std::vector<const Chapter*> chapters_of(const ReportSettings& settings);

/// Returns true if the report has the chapter and `only` does not leave it out.
bool is_asked_for(const ReportSettings& settings, std::string_view id);

/// For the provenance: everything that shapes the results, without threads and paths.
std::map<std::string, std::string> described(const ReportSettings& settings);

/// Returns these sections in the order of the report; nothing, which means all, where they are all.
/// @param with_earlier  whether all includes the chapters on request
std::vector<std::string> sections_in_order(const std::vector<std::string>& ids, bool with_earlier);

/// Returns every setting that the answer to a question depends on, for the key of the cache. Meshes have a part of their own in it.
std::vector<std::string> identity_of(const ReportSettings& settings, const std::string& question);

}   // namespace meshfolio::run
