#include "output/publish/folder_marks.h"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "output/publish/temporaries.h"

namespace meshfolio::output {

namespace fs = std::filesystem;

namespace {

/// True for $HOME and the home folder of the user's account.
bool is_home(const fs::path& folder) {
    const passwd* account = ::getpwuid(::geteuid());
    std::error_code error;
    for (const char* home :
         {static_cast<const char*>(std::getenv("HOME")), account == nullptr ? nullptr : static_cast<const char*>(account->pw_dir)})
        if (home != nullptr && *home != '\0' && fs::equivalent(folder, home, error)) return true;
    return false;
}

/// Returns words for contents of a folder without the marker of `kind` that would be lost; empty: none.
std::string foreign_contents(const fs::path& folder, const FolderKind& kind) {
    for (const FolderKind& other : {report_folder, marks_folder, batch_folder})
        if (has_mark(folder, other)) return other.words;
    std::error_code error;
    fs::directory_iterator it(folder, error);
    for (; !error && it != fs::directory_iterator(); it.increment(error)) {
        const std::string name = it->path().filename().string();
        const bool is_part = name.starts_with(".meshfolio.part-");   // of a run that goes on, or was killed
        if (name == ".gitignore" || is_part || process_in_name(name, ".meshfolio.tmp-") != 0) continue;
        if (kind.marker == batch_folder.marker && has_mark(it->path(), report_folder)) continue;   // parts that were merged
        return "files that meshfolio did not put there";
    }
    if (error)
        throw OutputError(folder.string(), "cannot be listed (" + error.message() + ")", "make it readable, or choose another with --out");
    return "";
}

}   // namespace

bool has_mark(const fs::path& folder, const FolderKind& kind) noexcept try {
    const fs::path mark = folder / kind.marker;
    const std::string_view contents = kind.contents;
    return fs::is_regular_file(fs::symlink_status(mark)) && read_file(mark, contents.size()) == contents;
} catch (const std::exception&) {   // not readable, or larger
    return false;
}

bool is_marked(const fs::path& folder) noexcept {
    return has_mark(folder, report_folder) || has_mark(folder, marks_folder) || has_mark(folder, batch_folder);
}

void require_ours(const fs::path& target, const FolderKind& kind) {
    const std::string remedy = "choose a new or empty folder with --out";
    std::error_code error;
    const fs::file_status status = fs::symlink_status(target, error);
    if (status.type() == fs::file_type::not_found) return;
    if (error) throw OutputError(target.string(), "cannot be examined (" + error.message() + ")", remedy);
    if (!fs::is_directory(status)) throw OutputError(target.string(), "is not a folder", "choose another with --out");
    if (is_home(target)) throw OutputError(target.string(), "is a home folder, which is never replaced", remedy);
    if (has_mark(target, kind)) return;
    const std::string what = foreign_contents(target, kind);
    if (!what.empty()) throw OutputError(target.string(), "holds " + what + ", and would be replaced", remedy);
}

}   // namespace meshfolio::output
