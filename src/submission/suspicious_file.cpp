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

template <class List>
bool holds(const List& list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

}   // namespace

bool is_script(std::string_view bytes) { return bytes.starts_with("#!"); }

std::string program_kind(std::string_view bytes) {
    if (is_script(bytes)) return "a script";
    const auto found = std::find_if(beginnings.begin(), beginnings.end(), [&](const Beginning& b) { return bytes.starts_with(b.bytes); });
    return found == beginnings.end() ? "" : std::string(found->kind);
}

std::string path_problem(std::string_view path) {
    const auto is_plain = [](char c) { return c >= ' ' && c <= '~' && c != '\\'; };
    if (path.empty() || path.front() == '/' || !std::all_of(path.begin(), path.end(), is_plain)) return "is no plain relative path";
    for (std::string_view rest = path; !rest.empty();) {
        const std::size_t end = std::min(rest.find('/'), rest.size());
        const std::string_view name = rest.substr(0, end);
        const bool last = end == rest.size();
        if (name.empty() || name == "." || name == "..") return "leads outside its folder";
        if (!last && holds(build_folders, name)) return "lies in a build folder";
        const auto ends = [&](std::string_view ending) { return name.ends_with(ending); };
        if (last && (holds(build_files, name) || std::any_of(build_endings.begin(), build_endings.end(), ends)))
            return "is what a build leaves";
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return "";
}

}   // namespace meshfolio::submission
