#include "run/console.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "mesh/io/mesh_files.h"
#include "run/progress.h"

namespace meshfolio::run {

void print(std::string_view text) {
    make_room_on_terminal();
    write_all(STDOUT_FILENO, text, "standard output");
}

void print_path(const std::filesystem::path& path) {
    print((::isatty(STDOUT_FILENO) == 1 ? printable(path.string()) : path.string()) + "\n");
}

void print_to(output::FileGroup& files, const std::string& file, std::string_view text) {
    if (file == "-") {
        print(text);
    } else {
        files.add(file, text);
    }
}

void write_mesh_to(const std::string& file, const TriangleMesh& mesh, const Attributes& attributes) {
    const std::string bytes = encode_mesh(mesh, file, attributes);
    if (file == "-") return print(bytes);
    output::replace_file(file, bytes);
}

void check_holds_columns(const std::string& option, const std::string& file) {
    if (!file.empty() && !holds_columns(file)) throw UsageError(option + " " + file + " holds no values", "name it .ply, .vtp or .glb");
}

void complain(const std::string& message) {
    make_room_on_terminal();
    try {
        write_all(STDERR_FILENO, "meshfolio: " + printable(message) + "\n", "standard error");
    } catch (const OutputError&) {
        // Standard error is gone: there is nowhere to report it.
    }
}

int close_standard_output(int exit_code) {
    if (::close(STDOUT_FILENO) == 0 || errno == EBADF) return exit_code;
    const std::string reason = std::strerror(errno);
    complain("standard output: cannot close (" + reason + ")");
    return exit_code == 0 ? static_cast<int>(ExitCode::output) : exit_code;
}

void warn(const std::string& message) { complain("warning: " + message); }

PreparedMesh load_mesh(const std::string& file, Checks checks, Keep keep) {
    constexpr std::size_t most = 20;
    const Stage stage("reading " + file);
    LoadedMesh loaded = file == "-" ? parse_mesh(read_standard_input(standard_input), standard_input, keep) : read_mesh(file, keep);
    PreparedMesh prepared = prepare_mesh(std::move(loaded), checks);
    for (std::size_t i = 0; i < std::min(most, prepared.warnings.size()); ++i) {
        const MeshWarning& warning = prepared.warnings[i];
        warn(file + (warning.line > 0 ? ":" + std::to_string(warning.line) : "") + ": " + warning.message);
    }
    if (prepared.warnings.size() > most) warn(file + ": " + std::to_string(prepared.warnings.size() - most) + " more warnings");
    return prepared;
}

}   // namespace meshfolio::run
