/// @file
/// What is wrong with settings, all of it at once.
#pragma once

#include <utility>
#include <vector>

#include "base/errors.h"

namespace meshfolio::run {

/// Everything wrong in settings, whether from a file, the command line or the environment; what() is the first.
class SettingsErrors : public UsageError {
public:
    /// @param problems  at least one
    explicit SettingsErrors(std::vector<UsageError> problems) : UsageError(problems.front()), problems_(std::move(problems)) {}
    const std::vector<UsageError>& problems() const { return problems_; }

private:
    std::vector<UsageError> problems_;
};

}   // namespace meshfolio::run
