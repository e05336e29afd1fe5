#include "output/publish/file_sums.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <string_view>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "base/linux_only.h"
#include "base/sha256.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_sums = std::uintmax_t{256} << 20;   // bytes

namespace {

/// Calls visit(path, sum) for each line of a list. @throws InputError like parse_sums()
template <class Visit> void for_each_sum(const std::string& text, const fs::path& file, const Visit& visit) {
    constexpr std::size_t digits = 64, gap = 2;
    const auto is_digest = [](std::string_view word) { return word.find_first_not_of("0123456789abcdef") == std::string_view::npos; };
    long number = 0;
    for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
        end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        ++number;
        if (line.size() <= digits + gap || line.compare(digits, gap, "  ") != 0 || !is_digest(std::string_view(line).substr(0, digits)))
            throw InputError({file.string(), number}, "is no line of sha256sum", "make the report again with meshfolio report");
        visit(line.substr(digits + gap), FileSum{line.substr(0, digits), number});
    }
}

}   // namespace

std::map<std::string, FileSum> parse_sums(const std::string& text, const std::filesystem::path& file) {
    std::map<std::string, FileSum> sums;
    for_each_sum(text, file, [&](const std::string& path, const FileSum& sum) { sums[path] = sum; });
    return sums;
}

std::vector<std::string> files_below(const fs::path& folder) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder).generic_string());
    std::sort(files.begin(), files.end());
    return files;
}

std::string sums_text(const Digests& digests) {
    std::string sums;
    for (const auto& [path, digest] : digests) sums += digest + "  " + path + "\n";
    return sums;
}

void write_sums(const fs::path& folder, const Digests& known) {
    std::vector<std::string> files = files_below(folder);
    std::erase(files, sums_file);
    std::vector<std::string> digests(files.size());
    tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
        const auto it = known.find(files[i]);
        digests[i] = it != known.end() ? it->second : sha256_of_file(folder / files[i]);
    });
    Digests listed;
    for (std::size_t i = 0; i < files.size(); ++i) listed[files[i]] = digests[i];
    const fs::path part = folder / (std::string(sums_file) + ".part");
    write_file(part, sums_text(listed));
    if (const int error = rename_with(part, folder / sums_file, Taken::replaced); error != 0)
        throw OutputError((folder / sums_file).string(), std::string("cannot be put in place (") + std::strerror(error) + ")",
                          "check the rights and the free space there");
}

SumsList sums_of(const fs::path& folder) try {
    const fs::path file = folder / sums_file;
    std::error_code error;
    if (!fs::is_regular_file(fs::symlink_status(file, error))) return {};
    SumsList list{true, {}, {}};
    for_each_sum(read_file(file, largest_sums), file, [&](const std::string& path, const FileSum& sum) {
        list.paths.insert(path);
        list.lines.insert(sum.digest + "  " + path);
    });
    return list;
} catch (const InputError&) {
    return {};
}

std::string first_changed(const fs::path& folder) {
    const fs::path file = folder / sums_file;
    const auto sums = parse_sums(read_file(file, largest_sums), file);
    const std::vector<std::pair<std::string, FileSum>> listed(sums.begin(), sums.end());
    std::vector<char> is_whole(listed.size());
    tbb::parallel_for(std::size_t{0}, listed.size(), [&](std::size_t i) {
        try {
            const fs::path path = listed[i].first;
            const bool is_inside = path.is_relative() && std::find(path.begin(), path.end(), "..") == path.end();
            is_whole[i] = path == ".gitignore" ||   // the user's; earlier versions listed it
                          (is_inside && sha256_of_file(folder / path) == listed[i].second.digest);
        } catch (const InputError&) {   // missing, or not readable
        }
    });
    const auto changed = std::find(is_whole.begin(), is_whole.end(), '\0');
    return changed == is_whole.end() ? "" : listed[static_cast<std::size_t>(changed - is_whole.begin())].first;
}

}   // namespace meshfolio::output
