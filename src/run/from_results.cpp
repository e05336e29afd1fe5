#include "run/from_results.h"

#include <map>
#include <set>

#include "base/file_bytes.h"
#include "base/parallel_tasks.h"
#include "base/sha256.h"
#include "output/draw/finished_picture.h"
#include "output/publish/file_sums.h"
#include "output/publish/folder_system.h"
#include "output/publish/publish.h"
#include "png/png.h"
#include "report/json/read_json.h"
#include "report/page/labs.h"
#include "report/writers.h"
#include "run/console.h"
#include "run/paper_copy.h"
#include "run/report_files.h"
#include "run/stored_results.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largest_results = std::uintmax_t{256} << 20;
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;
constexpr std::size_t most_named = 8;

/// What is taken over as it is; the rest is written anew.
bool is_taken_over(const std::string& file) {
    if (file == "src.txt") return true;
    const bool in_folder = file.find('/') != std::string::npos;
    return in_folder && !file.starts_with("tables/") && !(file.starts_with("images/") && file.ends_with(".svg"));
}

/// Files of the earlier report, read once and checked.
class EarlierFiles {
public:
    explicit EarlierFiles(fs::path folder)
        : folder_(std::move(folder)),
          sums_(output::parse_sums(read_file(folder_ / output::sums_file, largest_results), folder_ / output::sums_file)) {}

    /// @throws InputError for a file that is there and not what it was
    std::optional<std::string> bytes_of(const std::string& file) const {
        std::error_code error;
        if (!fs::exists(folder_ / file, error)) return {};
        std::string bytes = read_file(folder_ / file, largest_file);
        const auto sum = sums_.find(file);
        if (sum == sums_.end() || sum->second.digest != sha256(bytes))
            throw InputError({(folder_ / file).string()}, "is not the file that SHA256SUMS tells of",
                             "restore it, or make the report anew");
        return bytes;
    }

    /// Every file that is taken over, into the new report. @return the names of those that are missing
    std::vector<std::string> copy_to(const fs::path& target, output::Publication::Digests& digests) const {
        std::vector<std::string> files, missing;
        for (const auto& [file, sum] : sums_) {
            if (is_taken_over(file)) files.push_back(file);
        }
        for (const std::string& file : files) output::make_folder(inside(target, file).parent_path());
        std::vector<char> is_there(files.size());
        for_each_task(files.size(), [&](std::size_t i) {
            const auto bytes = bytes_of(files[i]);
            is_there[i] = bytes.has_value();
            if (bytes) write_file(target / files[i], *bytes);
        });
        for (std::size_t i = 0; i < files.size(); ++i) {
            if (is_there[i])
                digests[files[i]] = sums_.at(files[i]).digest;
            else
                missing.push_back(files[i]);
        }
        return missing;
    }

private:
    fs::path folder_;
    std::map<std::string, output::FileSum> sums_;

    /// SHA256SUMS comes from outside as well.
    static fs::path inside(const fs::path& target, const std::string& file) {
        const fs::path path = fs::path(file).lexically_normal();
        if (path.is_absolute() || *path.begin() == ".." || path != fs::path(file))
            throw InputError({output::sums_file}, "names '" + file + "', which is no file inside the report");
        return target / path;
    }
};

/// What the page needs of a figure besides the names of its files: its pictures, cut out of the sheet. @return false where that is not
/// there
bool restore(const EarlierFiles& files, report::DrawnFigure& figure) {
    const auto bytes = files.bytes_of(figure.sheet);
    if (!bytes) return false;
    const auto sheet = render::decode_png(*bytes);
    if (!sheet) throw InputError({figure.sheet}, "is not a PNG that can be read", "make the report anew");
    if (!output::cut_pictures(*sheet, figure))
        throw InputError({figure.sheet}, "is smaller than results.json says", "make the report anew");
    for (report::DrawnModel& model : figure.models) {
        auto glb = files.bytes_of(model.file);
        if (glb) model.glb = std::move(*glb);
    }
    std::erase_if(figure.models, [](const report::DrawnModel& model) { return model.glb.empty(); });
    return true;
}

/// Those without a picture are left out, so that the page shows a box in their place.
void restore_all(const EarlierFiles& files, report::DrawnFigures& figures) {
    std::vector<std::string> ids;
    for (const auto& [id, figure] : figures) ids.push_back(id);
    std::vector<char> is_whole(ids.size());
    for_each_task(ids.size(), [&](std::size_t i) { is_whole[i] = restore(files, figures.at(ids[i])); });
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (!is_whole[i]) figures.erase(ids[i]);
    }
}

/// results.json does not hold the laboratory, the earlier page does; one that has been changed since is not asked.
std::vector<report::Lab> earlier_labs(const EarlierFiles& files) try {
    const auto page = files.bytes_of(report::page_file(report::Volume::report));
    return page ? report::labs_in(*page) : std::vector<report::Lab>();
} catch (const InputError& error) {
    warn(std::string(error.what()) + ": the page is without its live laboratory");
    return {};
}

void refuse_computing_options(const ReportFlags& flags) {
    const std::pair<const char*, bool> options[] = {{"MESH", !flags.meshes.empty()}, {"--only", !flags.only.empty()},
                                                    {"--data", !flags.data.empty()}, {"--size", !flags.size.empty()},
                                                    {"--quick", flags.quick},        {"--fail-fast", flags.fail_fast},
                                                    {"--time", !flags.time.empty()}, {"--plan", flags.plan || flags.json}};
    for (const auto& [name, is_given] : options) {
        if (is_given) throw UsageError(std::string(name) + " cannot be given with --from", "nothing is computed; leave one of them out");
    }
}

/// What a settings file says of the report itself; the rest of it has no use here.
ReportSettings words_of_file(const std::string& config, report::Document& document, report::Templates& templates) {
    ReportSettings words;
    if (config.empty()) return words;
    words.title = document.title;
    words.author = document.author;
    words.course = document.course;
    words = read_settings(config, words);
    document.title = words.title;
    document.author = words.author;
    document.course = words.course;
    if (words.page.file) templates.replace("report.html", *words.page.file);
    return words;
}

void warn_of_missing(const std::vector<std::string>& missing) {
    for (std::size_t i = 0; i < missing.size() && i < most_named; ++i) warn(missing[i] + " is missing from the earlier report");
    if (missing.size() > most_named) warn("… and " + std::to_string(missing.size() - most_named) + " files more");
}

}   // namespace

ExitCode report_from_results(const ReportFlags& flags) {
    refuse_computing_options(flags);
    const ReportSettings settings = report_settings(flags);
    const auto threads = limited_threads(settings);
    const fs::path source = flags.from, folder = source.has_parent_path() ? source.parent_path() : fs::path(".");
    report::ReadReport earlier = report::read_json(read_file(source, largest_results), source.string());
    report::Templates templates(settings.templates);
    const ReportSettings words = words_of_file(flags.config, earlier.document, templates);
    PaperCopy paper(settings, templates);
    const auto store = flags.no_cache ? nullptr : cache_for_report();
    const EarlierFiles files(folder);
    output::Publication publication(settings.out);
    output::Publication::Digests digests;
    const std::vector<std::string> missing = files.copy_to(publication.folder(), digests);
    restore_all(files, earlier.figures);
    const report::WriteOptions options{
        .timings = earlier.timings && !flags.no_timings, .plot_files = true, .design = words.page.design, .labs = earlier_labs(files)};
    try {
        write_report_files(earlier.document, earlier.figures, templates, options, {}, {}, publication.folder());
    } catch (const std::logic_error& error) {   // a text refers to what is not there
        throw InputError({source.string()}, error.what(), "take a whole results.json");
    }
    paper.look_up(earlier.document, earlier.figures, store.get(), publication.folder());
    const std::string pdf_note = paper.write(earlier.document, earlier.figures, store.get(), publication.folder());
    const std::string note = publication.publish(digests);
    for (const std::string& remark : {note, pdf_note}) {
        if (!remark.empty()) warn(remark);
    }
    warn_of_missing(missing);
    const ExitCode result = summarise(earlier.document);
    print_path(settings.out / "index.html");
    return result;
}

}   // namespace meshfolio::run
