/// @file
/// The temporary files and folders of this process, so that a signal can have them removed at any moment.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>

namespace meshfolio::output {

/// A path that is removed with everything in it when this goes, or earlier by remove_all_temporaries().
class Temporary {
public:
    explicit Temporary(std::filesystem::path path);
    ~Temporary();
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Held around each rename that publishes something: after remove_all_temporaries() it is never given again.
std::unique_lock<std::mutex> permission_to_publish();

/// Takes the permission for good and removes what is registered, also while other threads still write there.
void remove_all_temporaries() noexcept;

/// Ends the names of what is temporary: the number of this process.
std::string process_number();

}   // namespace meshfolio::output
