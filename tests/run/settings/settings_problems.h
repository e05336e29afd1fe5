/// @file
/// Problems of the text of a settings file.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "run/settings/report_settings.h"

namespace meshfolio::testing_tools {

/// Returns the messages about a text, in order; empty if it is valid.
inline std::vector<std::string> problems_of(const std::string& text, const std::string& file = "my.toml") {
    try {
        run::parse_settings(text, file);
        return {};
    } catch (const run::SettingsErrors& errors) {
        EXPECT_EQ(errors.exit_code(), ExitCode::usage);
        std::vector<std::string> messages;
        for (const UsageError& error : errors.problems()) messages.emplace_back(error.what());
        return messages;
    }
}

/// Expects exactly one problem, at this line, with all these words in its message.
inline void expect_problem(const std::string& text, long line, const std::vector<std::string>& words) {
    const std::vector<std::string> problems = problems_of(text);
    ASSERT_EQ(problems.size(), 1u) << text << (problems.size() > 1 ? problems[1] : "");
    EXPECT_TRUE(problems[0].starts_with("my.toml:" + std::to_string(line) + ": ")) << problems[0];
    for (const std::string& word : words) EXPECT_NE(problems[0].find(word), std::string::npos) << problems[0] << " lacks " << word;
}

}   // namespace meshfolio::testing_tools
