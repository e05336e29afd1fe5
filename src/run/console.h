/// @file
/// What goes to the terminal: results for programs on stdout, everything for people on stderr.
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

/// To stdout, checked. @throws OutputError when it is closed or full
void print(std::string_view text);

/// A path on a line of its own, to stdout: as it is for programs, harmless on a terminal. @throws OutputError as above
void print_path(const std::filesystem::path& path);

/// To be called last: closes standard output, where some file systems first say that a write has failed.
/// @return `exit_code`, or that of an output that cannot be written
int close_standard_output(int exit_code);

/// To a file, to be published with the others, or to stdout for "-". @throws OutputError
void print_to(output::FileGroup& files, const std::string& file, std::string_view text);

/// A mesh into a file, which is replaced as a whole, or to stdout for "-". Warns of what is lost. @throws OutputError, UsageError for an
/// ending that is not written
void write_mesh_to(const std::string& file, const TriangleMesh& mesh, const Attributes& attributes = {});

/// The same, to be published with others. @throws OutputError
void add_mesh(output::FileGroup& files, const std::filesystem::path& file, const TriangleMesh& mesh, const Attributes& attributes = {});

/// To be called before the work, of a file that an option names; empty: none. Devices and pipes need no ending where "-" is taken.
/// @param endings  of the formats it may be written in, "-" being standard output
/// @param made     folder that the command creates; the file may be inside
/// @throws UsageError for another ending; OutputError where no file can be made
void check_output(const std::string& option, const std::string& file, const std::vector<std::string>& endings,
                  const std::filesystem::path& made = {});

/// "-" and the endings of meshes.
std::vector<std::string> mesh_or_standard_output();

/// @throws UsageError where both are standard input, which can be read once
void check_read_once(const std::string& a, const std::string& b);

/// One line on stderr: "meshfolio: …", its first word in a colour on a terminal. Nothing is thrown when stderr is gone.
void complain(const std::string& message, Ink ink = Ink::dim);
/// What a long command ends with: "meshfolio: 7 of 7 questions answered, …", green or red on a terminal.
void conclude(const std::string& message, bool is_good);
/// One line on stderr: "meshfolio: warning: …".
void warn(const std::string& message);

/// Warns of what a publication warns of, and says which files of the user's it kept.
void tell_of(const output::Notes& notes);

/// What messages call an input: standard input for "-".
std::string shown(const std::string& file);

/// Keeps a file beside, and says so, that has the name of an output which the user did not choose, and is no output of that kind.
/// @param is_ours  of its bytes
/// @throws OutputError
void keep_others(const std::filesystem::path& file, const std::function<bool(const std::string&)>& is_ours);

/// Reads and prepares a mesh, that of standard input for "-", and prints its warnings, at most 20 lines of them.
/// @throws InputError
PreparedMesh load_mesh(const std::string& file, Checks checks = Checks::all, Keep keep = Keep::mesh);

/// What goes wrong while a mesh is worked on names its file. @throws InputError, SolverError
template <class Work>
auto about_mesh(const std::string& file, const Work& work) try {
    return work();
} catch (const MeshError& error) {
    throw InputError({shown(file), 0}, error.what());
} catch (const SolverError& error) {
    throw SolverError(shown(file) + ": " + error.what());
}

}   // namespace meshfolio::run
