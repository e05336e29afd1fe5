/// @file
/// Output to the terminal: results for programs on stdout, messages for people on stderr.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.h"
#include "base/terminal.h"
#include "mesh/mesh_checks.h"
#include "output/publish/file_group.h"
#include "output/publish/publish.h"

namespace meshfolio::run {

/// Prints to stdout. @throws OutputError if it is closed or full
void print(std::string_view text);

/// Prints a path on a line of its own to stdout: unchanged for programs, escaped on a terminal. @throws OutputError if it is closed or full
void print_path(const std::filesystem::path& path);

/// Closes standard output at the end of the program: some file systems report a failed write only then.
/// @return `exit_code`, or ExitCode::output instead of 0 if the write has failed
int close_standard_output(int exit_code);

/// Adds `text` to the group as the file `file`, or prints it to stdout for "-". @throws OutputError
void print_to(output::FileGroup& files, const std::string& file, std::string_view text);

/// Writes a mesh to a file, or to stdout for "-". Warns of data that the format cannot hold.
/// @throws OutputError; UsageError for an ending that cannot be written
void write_mesh_to(const std::string& file, const TriangleMesh& mesh, const Attributes& attributes = {});

/// Adds a mesh to the group of files, or prints it to stdout for "-". Warns of data that the format cannot hold. @throws OutputError
void add_mesh(output::FileGroup& files, const std::filesystem::path& file, const TriangleMesh& mesh, const Attributes& attributes = {});

/// Checks an output file before the work begins. Devices and pipes need no ending if "-" is among the endings.
/// @param file     as the option names it; empty: none
/// @param endings  of the formats that can be written; "-" is standard output
/// @param made     folder that the command creates; the file may be inside
/// @throws UsageError for another ending; OutputError if the file cannot be created
void check_output(const std::string& option, const std::string& file, const std::vector<std::string>& endings,
                  const std::filesystem::path& made = {});

/// Returns "-" and the endings of mesh files.
std::vector<std::string> mesh_or_standard_output();

/// Requires that at most one of two inputs is "-". @throws UsageError otherwise, as standard input can be read once
void check_read_once(const std::string& a, const std::string& b);

/// Prints "meshfolio: …" on stderr, its first word in colour on a terminal. Does not throw if stderr is closed.
void complain(const std::string& message, Ink ink = Ink::dim);
/// Prints the last line of a long command, "meshfolio: 7 of 7 questions answered, …", in green or red on a terminal.
void conclude(const std::string& message, bool is_good);
/// Prints "meshfolio: warning: …" on stderr.
void warn(const std::string& message);

/// Prints the warning of a publication, and a line for the files of the user that it kept.
void tell_of(const output::Notes& notes);

/// Returns the name of an input in messages: "standard input" for "-".
std::string shown(const std::string& file);

/// Moves a file out of the way of an output whose name the user did not choose, to output::name_beside(), and prints its new name. Leaves
/// an earlier output.
/// @param is_ours  true if bytes are an earlier output
/// @throws OutputError
void keep_others(const std::filesystem::path& file, const std::function<bool(const std::string&)>& is_ours);

/// Reads and prepares a mesh, that of standard input for "-", and prints its warnings, at most 20 lines of them.
/// @throws InputError
PreparedMesh load_mesh(const std::string& file, Checks checks = Checks::all, Keep keep = Keep::mesh);

/// Returns work(). Names the file in a MeshError, which becomes an InputError, and in a SolverError; other errors pass unchanged.
template <class Work> auto about_mesh(const std::string& file, const Work& work) try { return work(); } catch (const MeshError& error) {
    throw InputError({shown(file), 0}, error.what());
} catch (const SolverError& error) {
    throw SolverError(shown(file) + ": " + error.what());
}

}   // namespace meshfolio::run
