/// @file
/// What goes to the terminal: results for programs on stdout, everything for people on stderr.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/errors.h"
#include "mesh/mesh_checks.h"
#include "output/publish/file_group.h"

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

/// A mesh into a file, which is replaced as a whole, or to stdout for "-". @throws OutputError, UsageError for an ending that is not
/// written
void write_mesh_to(const std::string& file, const TriangleMesh& mesh, const Attributes& attributes = {});

/// Before the work, for a file that values of vertices are to go into; none of an empty name. @throws UsageError for another format
void check_holds_columns(const std::string& option, const std::string& file);

/// One line on stderr: "meshfolio: …". Nothing is thrown when stderr is gone.
void complain(const std::string& message);
/// One line on stderr: "meshfolio: warning: …".
void warn(const std::string& message);

/// Reads and prepares a mesh, that of standard input for "-", and prints its warnings, at most 20 lines of them.
/// @throws InputError
PreparedMesh load_mesh(const std::string& file, Checks checks = Checks::all, Keep keep = Keep::mesh);

/// What goes wrong while a mesh is worked on names its file. @throws InputError, SolverError
template <class Work>
auto about_mesh(const std::string& file, const Work& work) try {
    return work();
} catch (const MeshError& error) {
    throw InputError({file, 0}, error.what());
} catch (const SolverError& error) {
    throw SolverError(file + ": " + error.what());
}

}   // namespace meshfolio::run
