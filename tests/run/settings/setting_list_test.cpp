// Every listed setting is documented: keys and variables in data/report.toml, flags in the help of `meshfolio report`.
#include "run/settings/setting_list.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "base/file_bytes.h"
#include "source_dir.h"

using namespace meshfolio;
using namespace meshfolio::run;

namespace {

std::string source(const char* file) { return read_file(std::filesystem::path(MESHFOLIO_SOURCE_DIR) / file); }

template <class Settings> void expect_documented() {
    const std::string toml = source("data/report.toml"),
                      command = source("src/cli/report_command.cpp") + source("src/cli/report_options.cpp");
    Settings settings;
    for_each_setting(settings, [&](const Setting& setting, const auto&) {
        const std::string key = setting.key, flag = setting.flag, variable = setting.variable;
        EXPECT_TRUE(key.empty() || std::regex_search(toml, std::regex("(^|\n)(# )?" + key + " = "))) << key;
        EXPECT_NE(toml.find(variable), std::string::npos) << variable;
        EXPECT_TRUE(flag.empty() || command.find("\"" + flag + "\"") != std::string::npos ||
                    command.find("\"" + flag + " ") != std::string::npos)
            << flag;
        EXPECT_FALSE(key.empty() && flag.empty());
    });
}

template <class Settings> std::multiset<std::string> names_of() {
    std::multiset<std::string> names;
    Settings settings;
    for_each_setting(settings, [&](const Setting& setting, const auto&) {
        if (*setting.key != '\0') names.insert(std::string(setting.table) + setting.key);
        if (*setting.flag != '\0') names.insert(setting.flag);
        if (*setting.variable != '\0') names.insert(setting.variable);
    });
    return names;
}

}   // namespace

TEST(SettingList, EverySettingIsDocumented) {
    expect_documented<ReportSettings>();
    expect_documented<QuestionTable>();
    expect_documented<report::OwnPage>();
}

TEST(SettingList, NoTwoSettingsShareAName) {
    for (const auto& names : {names_of<ReportSettings>(), names_of<QuestionTable>()}) {
        for (const std::string& name : names) EXPECT_EQ(names.count(name), 1u) << name;
    }
}

TEST(SettingList, TheKeyOfAnAnswerHasAllSettingsThatShapeIt) {
    const ReportSettings before = report_settings({});
    const auto identity = identity_of(before, "q4");
    const std::string q4 = "[[question]]\nid = \"q4\"\n";
    for (const std::string& text :
         {std::string("seed = 2"), std::string("laboratory = true"), std::string("[render]\nsize = 64"),
          std::string("[render]\nview_files = true"), std::string("[render]\ncamera = [35, 22]"), std::string("[render]\nup = \"y\""),
          std::string("[render]\nzoom = 1.5"), q4 + "k = 5", q4 + "mesh = \"torus\"", q4 + "output = \"x\"", q4 + "seed = 1"})
        EXPECT_NE(identity_of(parse_settings(text, "my.toml", before), "q4"), identity) << text;
    ReportFlags in_time;
    in_time.time = "60";
    EXPECT_NE(identity_of(report_settings(in_time), "q4"), identity);
    for (const std::string& text : {std::string("threads = 2"), std::string("[report]\ntitle = \"x\""), q4 + "threads = 3",
                                    std::string("[[question]]\nid = \"q5\"\nlambda = 1")})
        EXPECT_EQ(identity_of(parse_settings(text, "my.toml", before), "q4"), identity) << text;
}
