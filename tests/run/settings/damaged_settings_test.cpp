// Settings files, damaged in every place.
#include <gtest/gtest.h>

#include "damaged_bytes.h"
#include "run/settings/report_settings.h"

using namespace meshfolio;
using namespace meshfolio::run;
using testing_tools::for_each_damage;
using testing_tools::is_one_line_about;

TEST(DamagedSettings, AreReadOrRefusedWithALine) {
    const std::string text = R"(seed = 3
threads = 1 # all
[report]
title = "T"
sections = [
  "q1", "q4"
]
[render]
size = [64, 32]
[[question]]
id = "q4"
mesh = ["torus"]
lambda = 1e-3
output = "modes"
)";
    EXPECT_NO_THROW(parse_settings(text, "s.toml"));
    int refused = 0;
    for_each_damage(text, [&](const std::string& damaged) {
        try {
            parse_settings(damaged, "s.toml");
        } catch (const SettingsErrors& errors) {
            ++refused;
            EXPECT_EQ(errors.exit_code(), ExitCode::usage);
            for (const UsageError& problem : errors.problems()) EXPECT_TRUE(is_one_line_about("s.toml:", problem.what()));
        }
    });
    EXPECT_GT(refused, static_cast<int>(text.size()));
}
