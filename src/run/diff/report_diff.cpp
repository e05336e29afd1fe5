#include "run/diff/report_diff.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/number_text.h"
#include "mesh/io/mesh_files.h"
#include "mesh/mesh_checks.h"
#include "output/publish/file_sums.h"
#include "png/png.h"
#include "run/one_mesh/difference_lines.h"
#include "run/stored_report.h"

namespace meshfolio::run {

namespace fs = std::filesystem;
using report::Change;

namespace {

constexpr const char* batch_file = "batch.json";
constexpr int jpeg_quality = 85;

bool has_file(const fs::path& folder, const char* name) {
    std::error_code error;
    return fs::is_regular_file(folder / name, error);
}

/// Returns the largest distance between two meshes over the box diagonal of the first, and the words for it.
std::pair<double, std::string> distance_between(const std::string& before, const std::string& after, const std::string& path) {
    const PreparedMesh a = prepare_mesh(parse_mesh(before, path)), b = prepare_mesh(parse_mesh(after, path));
    const Difference difference = difference_of(a.mesh, b.mesh);
    const auto value = [&](std::string_view key) { return std::ranges::find(difference.lines, key, &DifferenceLine::key)->value; };
    const double share = value("max") / value("box_diagonal");
    return {share, "largest distance " + readable(value("max")) + ", " + readable_percent(share) + " of the box diagonal" +
                       (difference.same_triangles ? "" : ", other triangles")};
}

/// Compares the files of two folders and adds what differs to a diff.
class FilesComparison {
public:
    FilesComparison(const fs::path& before, const fs::path& after, bool with_pictures, ReportDiff& diff)
        : before_(before), after_(after), with_pictures_(with_pictures), diff_(diff) {}

    void compare(const std::set<std::string>& paths) {
        for (const std::string& path : paths) {
            std::error_code error;
            if (!fs::exists(before_ / path, error) || !fs::exists(after_ / path, error)) continue;
            const std::string a = read_file(before_ / path), b = read_file(after_ / path);
            const bool is_picture = path.ends_with(".png");
            ++(is_picture ? diff_.compared.pictures : diff_.compared.meshes);
            if (a == b) continue;
            if (is_picture) pictures(path, a, b);
            else meshes(path, a, b);
        }
    }

private:
    const fs::path &before_, &after_;
    bool with_pictures_;
    ReportDiff& diff_;

    void add(Change::Kind kind, const std::string& path, const std::string& words, double size) {
        const std::string name = fs::path(path).filename().string();
        diff_.changes.push_back({kind, name.substr(0, name.find('_')), path, "", "", "", words, size});
    }

    void meshes(const std::string& path, const std::string& a, const std::string& b) try {
        const auto [share, words] = distance_between(a, b, path);
        add(Change::Kind::mesh, path, words, share);
    } catch (const Error& error) {
        add(Change::Kind::mesh, path, error.what(), infinity);
    }

    void pictures(const std::string& path, const std::string& a, const std::string& b) {
        const auto before = render::decode_png(a), after = render::decode_png(b);
        if (!before || !after) return add(Change::Kind::picture, path, "cannot be read", infinity);
        if (before->width != after->width || before->height != after->height) {
            const auto size_of = [](const render::Image& image) {
                return std::to_string(image.width) + " × " + std::to_string(image.height);
            };
            add(Change::Kind::picture, path, size_of(*after) + " pixels, and not " + size_of(*before), infinity);
        } else {
            std::size_t differ = 0;
            int largest = 0;
            for (std::size_t i = 0; i < after->pixels.size(); ++i) {
                const render::Rgba &old = before->pixels[i], &now = after->pixels[i];
                const int here =
                    std::max({std::abs(old.r - now.r), std::abs(old.g - now.g), std::abs(old.b - now.b), std::abs(old.a - now.a)});
                differ += here > 0 ? 1 : 0;
                largest = std::max(largest, here);
            }
            if (differ == 0) return;   // the same picture in other bytes
            const double share = static_cast<double>(differ) / static_cast<double>(after->pixels.size());
            add(Change::Kind::picture, path,
                readable_percent(share) + " of the pixels differ, by " + std::to_string(largest) + " of 255 at most", share);
        }
        if (with_pictures_ && diff_.pictures.size() < most_pictures)
            diff_.pictures.push_back(
                {path, render::encode_jpeg(*before, jpeg_quality), render::encode_jpeg(*after, jpeg_quality), after->width, after->height});
    }
};

/// Adds what changed between two reports. @param prefix  of sections, such as the name of the mesh in a batch: "bunny/"
void add_reports(const fs::path& before, const fs::path& after, double tolerance, bool with_pictures, const std::string& prefix,
                 ReportDiff& diff) {
    const report::ReadReport a = read_report(before), b = read_report(after);
    ReportDiff one;
    one.changes = changes_between(a.document, b.document, tolerance, diff.compared);
    std::error_code error;
    if (fs::is_directory(before, error) && fs::is_directory(after, error)) {
        std::set<std::string> paths;
        for (const report::Section& section : b.document.sections) paths.insert(section.output_meshes.begin(), section.output_meshes.end());
        for (const std::string& path : output::files_below(after))
            if (path.starts_with("images/") && path.ends_with(".png")) paths.insert(path);
        one.compared = diff.compared;
        FilesComparison(before, after, with_pictures, one).compare(paths);
        diff.compared = one.compared;
    }
    for (Change& change : one.changes) {
        change.section = prefix + change.section;
        diff.changes.push_back(std::move(change));
    }
    for (PicturePair& picture : one.pictures) {
        picture.path = prefix + picture.path;
        if (diff.pictures.size() < most_pictures) diff.pictures.push_back(std::move(picture));
    }
    for (report::Section section : b.document.sections) {
        section.id = prefix + section.id;
        diff.sections.push_back(std::move(section));
    }
}

/// Returns the names of the folders of a batch that hold a report.
std::set<std::string> meshes_of_batch(const fs::path& folder) {
    std::set<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (has_file(entry.path(), results_file)) names.insert(entry.path().filename().string());
    return names;
}

}   // namespace

ReportDiff diff_of(const fs::path& before, const fs::path& after, double tolerance, bool with_pictures) {
    ReportDiff diff{.before = before.string(), .after = after.string()};
    const bool is_batch = has_file(before, batch_file);
    if (is_batch != has_file(after, batch_file))
        throw InputError({(is_batch ? after : before).string()}, "is no batch, but " + (is_batch ? before : after).string() + " is one",
                         "name two reports or two batches");
    if (!is_batch) {
        add_reports(before, after, tolerance, with_pictures, "", diff);
        return diff;
    }
    const std::set<std::string> old = meshes_of_batch(before), now = meshes_of_batch(after);
    for (const std::string& name : old)
        if (!now.contains(name)) diff.changes.push_back({Change::Kind::presence, name, name, "", "report", "there", ""});
    for (const std::string& name : now) {
        if (old.contains(name)) add_reports(before / name, after / name, tolerance, with_pictures, name + "/", diff);
        else diff.changes.push_back({Change::Kind::presence, name, name, "", "report", "", "there"});
    }
    sort_changes(diff.changes);
    return diff;
}

}   // namespace meshfolio::run
