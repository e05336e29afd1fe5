#include "submission/suspicious_file.h"

#include <algorithm>
#include <array>

namespace meshfolio::submission {

namespace {

using namespace std::string_view_literals;

struct Beginning {
    std::string_view bytes, kind;
};

constexpr std::array beginnings{
    Beginning{"\177ELF"sv, "an ELF program or library"},
    Beginning{"MZ"sv, "a Windows program"},
    Beginning{"\xfe\xed\xfa\xce"sv, "a Mach-O program"},
    Beginning{"\xfe\xed\xfa\xcf"sv, "a Mach-O program"},
    Beginning{"\xce\xfa\xed\xfe"sv, "a Mach-O program"},
    Beginning{"\xcf\xfa\xed\xfe"sv, "a Mach-O program"},
    Beginning{"\xca\xfe\xba\xbe"sv, "a Mach-O program or a Java class"},
    Beginning{"\0asm"sv, "a WebAssembly program"},
    Beginning{"!<arch>\n"sv, "a library"},
};

constexpr std::array build_folders{"build"sv, "CMakeFiles"sv, "node_modules"sv, "__pycache__"sv, ".git"sv};
constexpr std::array build_files{"CMakeCache.txt"sv, "build.ninja"sv, "Makefile"sv};
constexpr std::array build_endings{".o"sv, ".a"sv, ".so"sv, ".exe"sv, ".dll"sv, ".pyc"sv};

}   // namespace

bool is_script(std::string_view bytes) { return bytes.starts_with("#!"); }

std::string program_kind(std::string_view bytes) {
    if (is_script(bytes)) return "a script";
    const auto found = std::ranges::find_if(beginnings, [&](const Beginning& b) { return bytes.starts_with(b.bytes); });
    return found == beginnings.end() ? "" : std::string(found->kind);
}

std::string path_problem(std::string_view path) {
    const auto is_plain = [](char c) { return c >= ' ' && c <= '~' && c != '\\'; };
    if (path.empty() || path.front() == '/' || !std::ranges::all_of(path, is_plain)) return "is no plain relative path";
    for (std::string_view rest = path; !rest.empty();) {
        const std::size_t end = std::min(rest.find('/'), rest.size());
        const std::string_view name = rest.substr(0, end);
        const bool last = end == rest.size();
        if (name.empty() || name == "." || name == "..") return "leads outside its folder";
        const auto is_name = [&](std::string_view word) { return name == word; };
        const auto ends = [&](std::string_view ending) { return name.ends_with(ending); };
        if (!last && std::ranges::any_of(build_folders, is_name)) return "lies in a build folder";
        if (last && (std::ranges::any_of(build_files, is_name) || std::ranges::any_of(build_endings, ends)))
            return "is what a build leaves";
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return "";
}

}   // namespace meshfolio::submission
