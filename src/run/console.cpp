#include "run/console.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/file_bytes.h"
#include "base/in_quotes.h"
#include "base/joined.h"
#include "base/lower_case.h"
#include "base/terminal.h"
#include "mesh/io/mesh_files.h"
#include "output/publish/folder_system.h"
#include "output/publish/user_files.h"
#include "run/arguments.h"
#include "run/progress.h"

namespace meshfolio::run {

void print(std::string_view text) {
    make_room_on_terminal();
    write_all(STDOUT_FILENO, text, "standard output");
}

void print_path(const std::filesystem::path& path) {
    const bool is_seen = ::isatty(STDOUT_FILENO) == 1;
    print((is_seen ? inked(Ink::dim, printable(path.string())) : path.string()) + "\n");
}

void print_to(output::FileGroup& files, const std::string& file, std::string_view text) {
    if (file == "-") {
        print(text);
    } else {
        files.add(file, text);
    }
}

void write_mesh_to(const std::string& file, const TriangleMesh& mesh, const Attributes& attributes) {
    output::FileGroup files;
    add_mesh(files, file, mesh, attributes);
    files.publish();
}

void add_mesh(output::FileGroup& files, const std::filesystem::path& file, const TriangleMesh& mesh, const Attributes& attributes) {
    const std::string name = !file.has_extension() && output::is_stream(file) ? "-" : file.string();   // OBJ
    const std::string bytes = encode_mesh(mesh, name, attributes);
    for (const std::string& loss : losses(mesh, name, attributes)) warn(file.string() + ": " + loss);
    print_to(files, file.string(), bytes);
}

void check_output(const std::string& option, const std::string& file, const std::vector<std::string>& endings,
                  const std::filesystem::path& made) {
    const bool takes_streams = contains(endings, "-");
    const std::string ending = lower_case_ending(file);
    if (file.empty() || (takes_streams && file == "-")) return;
    if (!contains(endings, ending) && !(takes_streams && ending.empty() && output::is_stream(file))) {
        std::vector<std::string> known = endings;
        std::erase(known, "-");
        throw UsageError(
            option + " " + in_quotes(file) + (ending.empty() ? " does not say its format" : " cannot be written as '" + ending + "'"),
            "let its name end in " + meshfolio::joined(known, ", ") + (takes_streams ? ", or take - for standard output" : ""));
    }
    if (made.empty() || output::path_inside(file, made).empty()) output::place_of_file(file);
}

std::vector<std::string> mesh_or_standard_output() {
    std::vector<std::string> endings = mesh_endings();
    endings.emplace_back("-");
    return endings;
}

void check_read_once(const std::string& a, const std::string& b) {
    if (a == "-" && b == "-") throw UsageError("standard input can be read once", "name a file for one of them");
}

namespace {

/// Prints one line with its first word in colour, wrapped on a terminal.
void print_line(const std::string& line, Ink ink, bool with_numbers) {
    constexpr std::string_view program = "meshfolio:";
    // A filter of Pandoc reads only standard output.
    const int to = ink == Ink::red && environment("MESHFOLIO_ERRORS") == "stdout" ? STDOUT_FILENO : STDERR_FILENO;
    make_room_on_terminal();
    const std::string rest = for_terminal(std::string(program) + " " + printable(line), to).substr(program.size());
    try {
        write_all(to, inked(ink, std::string(program), to) + (with_numbers ? with_bold_numbers(rest, to) : rest) + "\n", "messages");
    } catch (const OutputError&) {
        // Standard error is gone: there is nowhere to report it.
    }
}

}   // namespace

void complain(const std::string& message, Ink ink) { print_line(message, ink, false); }

void conclude(const std::string& message, bool is_good) { print_line(message, is_good ? Ink::green : Ink::red, true); }

int close_standard_output(int exit_code) {
    if (::close(STDOUT_FILENO) == 0 || errno == EBADF) return exit_code;
    const std::string reason = std::strerror(errno);
    complain("standard output: may be incomplete, it cannot be closed (" + reason + "); check the free space there and run again");
    return exit_code == 0 ? static_cast<int>(ExitCode::output) : exit_code;
}

void warn(const std::string& message) { complain("warning: " + message, Ink::yellow); }

void tell_of(const output::Notes& notes) {
    if (!notes.warning.empty()) warn(notes.warning);
    for (const std::string& line : notes.kept) complain(line);
}

void keep_others(const std::filesystem::path& file, const std::function<bool(const std::string&)>& is_ours) {
    if (!may_be_there(file) || output::is_stream(file) || std::filesystem::is_directory(file)) return;   // those are refused
    try {
        if (is_ours(read_file(file))) return;
    } catch (const InputError&) {   // no file that can be read, and so none of ours
    }
    const std::string kept = output::keep_beside(file, !std::filesystem::is_symlink(file));
    complain(file.string() + ": was not made by meshfolio, and is kept as " + kept);
}

std::string shown(const std::string& file) { return file == "-" ? standard_input : file; }

PreparedMesh load_mesh(const std::string& file, Checks checks, Keep keep) {
    constexpr std::size_t most = 20;
    const std::string name = shown(file);
    const Stage stage("reading " + name);
    LoadedMesh loaded = file == "-" ? parse_mesh(read_standard_input(standard_input), standard_input, keep) : read_mesh(file, keep);
    PreparedMesh prepared = prepare_mesh(std::move(loaded), checks);
    for (std::size_t i = 0; i < std::min(most, prepared.warnings.size()); ++i) {
        const MeshWarning& warning = prepared.warnings[i];
        warn(name + (warning.line > 0 ? ":" + std::to_string(warning.line) : "") + ": " + warning.message);
    }
    if (prepared.warnings.size() > most) warn(name + ": " + std::to_string(prepared.warnings.size() - most) + " more warnings");
    return prepared;
}

}   // namespace meshfolio::run
