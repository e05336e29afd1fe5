#pragma once

#include <filesystem>
#include <string>

namespace meshfolio::output {

/// True when no process has this number (any more), or one that was killed and only waits to be collected.
bool is_dead(long pid);

/// The process number at the end of `name` when it reads `<stem><digits>`; else 0.
long process_in_name(const std::string& name, const std::string& stem);

/// Sees to what interrupted runs left beside `target`: `<target>.tmp-<pid>` folders of dead runs are removed; `<target>.old-<pid>`
/// becomes `target` again when that is missing, and is removed otherwise. Folders without our marker and anything else are left alone,
/// and nothing that cannot be removed is an error.
void sweep_leftovers(const std::filesystem::path& target) noexcept;

/// The same for the temporary files of a FileGroup in `folder`.
void sweep_file_leftovers(const std::filesystem::path& folder) noexcept;

/// And for folders `<stem><pid>-…` of this user in `place`, which others may use as well.
void sweep_scratch_leftovers(const std::filesystem::path& place, const std::string& stem) noexcept;

}   // namespace meshfolio::output
