#pragma once

#include "base/errors.h"

namespace meshfolio::submission {

inline constexpr const char* renew = "make the report again with meshfolio report";

/// A report that is not fit to be handed in: a question or a citation is missing.
class SubmissionError : public Error {
public:
    explicit SubmissionError(const std::string& file, const std::string& problem, const std::string& remedy)
        : Error(ExitCode::failed, {file, 0}, problem, remedy) {}
};

}   // namespace meshfolio::submission
