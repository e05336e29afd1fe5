#include "run/batch/mesh_list.h"

#include <glob.h>

#include <algorithm>
#include <set>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/lower_case.h"
#include "mesh/io/mesh_files.h"
#include "output/publish/folder_system.h"
#include "output/publish/publish.h"
#include "run/arguments.h"

namespace meshfolio::run {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largest_list = std::uintmax_t{16} << 20;

/// Returns the meshes below a folder, sorted by path, without hidden files, unreadable folders and outputs of this program.
std::vector<std::string> meshes_below(const fs::path& folder) {
    std::vector<std::string> files;
    std::error_code error;
    fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
        const bool is_hidden = it->path().filename().string().starts_with('.');
        std::error_code ignored;
        if (it->is_directory(ignored)) {
            if (is_hidden || output::is_marked(it->path())) it.disable_recursion_pending();
        } else if (!is_hidden && is_mesh_file(it->path().string())) {
            files.push_back(it->path().string());
        }
    }
    if (error) throw InputError({folder.string()}, "cannot be listed (" + error.message() + ")", "check its rights");
    std::ranges::sort(files);
    return files;
}

/// Returns the files that match a pattern, sorted.
std::vector<std::string> matches_of(const std::string& pattern) {
    std::vector<std::string> files;
    glob_t found{};
    if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    ::globfree(&found);
    std::ranges::sort(files);
    return files;
}

class MeshList {
public:
    void add(const std::string& named, const Location& where) {
        std::error_code error;
        if (fs::is_directory(named, error))
            return add_all(meshes_below(named), {named}, "has no mesh that ends in " + meshfolio::joined(mesh_endings(), ", "));
        if (may_be_there(named)) return add_file(named);
        if (named.find_first_of("*?[") == std::string::npos)
            throw InputError(where, (where.file == named ? "" : in_quotes(named) + " ") + "is not there", near_names(named));
        std::vector<std::string> matches = matches_of(named);
        std::erase_if(matches, [](const std::string& file) { return !is_mesh_file(file); });
        add_all(matches, where, in_quotes(named) + " matches no mesh");
    }

    void add_list(const std::string& list) {
        long number = 0;
        for (std::string line : split(read_file(list, largest_list), '\n')) {
            ++number;
            line.erase(line.find_last_not_of(" \t\r") + 1);
            line.erase(0, line.find_first_not_of(" \t"));
            if (!line.empty() && !line.starts_with('#')) add((fs::path(list).parent_path() / line).string(), {list, number});
        }
    }

    std::vector<std::string> files;

private:
    std::set<fs::path> seen_;

    void add_file(const std::string& file) {
        std::error_code error;
        if (seen_.insert(output::resolved(file, error)).second) files.push_back(file);
    }
    void add_all(const std::vector<std::string>& some, const Location& where, const std::string& problem) {
        if (some.empty()) throw InputError(where, problem);
        for (const std::string& file : some) add_file(file);
    }
};

void require_outside(const std::string& file, const fs::path& out) {
    if (output::path_inside(file, out).empty()) return;
    throw UsageError(in_quotes(file) + " lies in " + in_quotes(out.string()) + ", where the reports go",
                     "move it, or choose another folder with --out");
}

std::string safe_stem(const std::string& file) {
    constexpr std::size_t longest = 60;
    std::string name = mesh_name(file).substr(0, longest);
    for (char& c : name)
        if (!is_alphanumeric(c) && c != '+' && c != '-') c = '_';
    if (name.empty()) return "mesh";
    if (name.front() == '-') name.front() = '_';
    return name;
}

}   // namespace

std::vector<std::string> folder_names(const std::vector<std::string>& files) {
    std::set<std::string> taken;
    std::vector<std::string> names;
    for (const std::string& file : files) {
        const std::string stem = safe_stem(file);
        std::string name = stem;
        for (int number = 2; !taken.insert(lower_case(name)).second; ++number) name = stem + "-" + std::to_string(number);
        names.push_back(name);
    }
    return names;
}

std::vector<BatchMesh> batch_meshes(const std::vector<std::string>& named, const std::vector<std::string>& lists, const fs::path& out) {
    MeshList list;
    for (const std::string& one : named) {
        if (one.starts_with('@') && !may_be_there(one)) list.add_list(one.substr(1));
        else list.add(one, {one});
    }
    for (const std::string& one : lists) list.add_list(one);
    if (list.files.empty()) throw UsageError("no mesh is named", "name files, folders or a list: meshfolio batch meshes --out reports");
    for (const std::string& file : list.files) require_outside(file, out);
    const std::vector<std::string> names = folder_names(list.files);
    std::vector<BatchMesh> meshes;
    for (std::size_t i = 0; i < names.size(); ++i) meshes.push_back({list.files[i], names[i]});
    return meshes;
}

}   // namespace meshfolio::run
