#include "run/settings/report_settings.h"

#include <gtest/gtest.h>

#include <regex>

#include "base/file_bytes.h"
#include "run/settings/settings_problems.h"
#include "source_dir.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::run;
using testing_tools::problems_of;
using testing_tools::TemporaryFolder;

namespace {

std::string question(const std::string& keys) { return "[[question]]\nid = \"q4\"\n" + keys + "\n"; }

}   // namespace

TEST(SettingsFile, AnEmptyFileIsValidAndSetsNothing) {
    const ReportSettings settings = parse_settings("# nothing\n", "my.toml");
    EXPECT_EQ(described(settings), described({}));
    EXPECT_TRUE(settings.title.empty() && settings.seed == 0 && settings.threads == 0 && settings.questions.empty());
}

TEST(SettingsFile, MissingKeysKeepTheirValueButQuestionsSectionsAndExperimentsAreReplaced) {
    const ReportSettings before = parse_settings("seed = 7\n[report]\nsections = \"q4\"\n" + question("k = 5"), "my.toml");
    const ReportSettings after = parse_settings("threads = 2", "other.toml", before);
    EXPECT_EQ(after.seed, 7u);
    EXPECT_EQ(after.threads, 2);
    EXPECT_TRUE(after.only.empty() && after.questions.empty());
}

TEST(SettingsFile, ASheetHasItsOwnWords) {
    const ReportSettings settings = parse_settings(R"(
[report]
title = "Sheet"
source = false
[[question]]
id = "q4"
title = "Waves"
number = 1
points = 7.5
intro = """
Compute $λ_crit$.
"""
[[question]]
id = "q3"
number = "2b"
[[page]]
title = "Before"
text = "See [[q4]]."
before = "q4"
[[page]]
title = "Last"
text = ""
[[item]]
id = "of mark"
)",
                                                   "my.toml", parse_settings("[report]\ncourse = \"C\"", "first.toml"));
    const QuestionTable& waves = settings.questions.at("q4");
    EXPECT_EQ(waves.title, "Waves");
    EXPECT_EQ(waves.number, "1");
    EXPECT_EQ(waves.points, 7.5);
    EXPECT_EQ(waves.intro, "Compute $λ_crit$.\n");
    EXPECT_EQ(settings.questions.at("q3").number, "2b");
    EXPECT_EQ(settings.pages, (std::vector<report::OwnPage>{{"Before", "See [[q4]].", "q4"}, {"Last", "", ""}}));
    EXPECT_EQ(settings.source, false);
    EXPECT_EQ(settings.course, "") << "that of a report with another title";
    EXPECT_TRUE(parse_settings("", "other.toml", settings).pages.empty());
    EXPECT_EQ(described(settings), described(parse_settings("[[question]]\nid = \"q4\"\n[[question]]\nid = \"q3\"", "my.toml")))
        << "words do not shape the results";
}

TEST(SettingsFile, WordsOfASheetThatCannotBePrintedAreRefused) {
    using testing_tools::expect_problem;
    expect_problem(question("title = \"  \""), 3, {"title is blank"});
    expect_problem(question("title = \"" + std::string(201, 'a') + "\""), 3, {"201 bytes", "at most 200"});
    expect_problem(question("title = \"a\\nb\""), 3, {"control character"});
    expect_problem(question("tittle = \"a\""), 3, {"'tittle'", "'title'"});
    for (const char* number : {"\"A\"", "\"\"", "0", "-1", "12345", "\"1.2\"", "\"<b>\"", "\" 1\""})
        expect_problem(question(std::string("number = ") + number), 3, {"is no number of a question", "write 3"});
    expect_problem(question("number = 2") + "[[question]]\nid = \"q5\"\nnumber = \"2\"", 6, {"that of line 3"});
    expect_problem(question("points = -1"), 3, {"out of range"});
    expect_problem(question("points = [1, 2]"), 3, {"is a list"});
    expect_problem(question("intro = \"**open\""), 3, {"intro: '**open' lacks **", "backslash"});
    expect_problem(question("intro = \"{{title}}\""), 3, {"lacks the fact title"});
    expect_problem(question("intro = \"[[q5_limits]]\""), 3, {"[[q5_limits]] is no question"});
    expect_problem(question("intro = \"" + std::string(20'001, 'a') + "\""), 3, {"20001 bytes", "at most 20000"});
    expect_problem("[[page]]\ntext = \"\"", 1, {"[[page]] has no title"});
    expect_problem("[[page]]\ntitle = \"T\"", 1, {"[[page]] has no text"});
    expect_problem("[[page]]\ntitle = \"T\"\ntext = \"\"\nbefore = \"q44\"", 4, {"'q44' is unknown", "'q4'"});
    expect_problem("[[page]]\ntitle = \"T\"\ntext = \"\"\nbefore = \"truth\"", 4, {"'truth' is unknown"});
    expect_problem("page = 1", 1, {"page is not a list of tables", "[[page]]"});
    expect_problem("[report]\ntitle = \" \"", 2, {"title is blank"});
}

TEST(SettingsFile, EveryKeyIsRead) {
    const ReportSettings settings = parse_settings(R"(
seed = 9
threads = 2
laboratory = true
[report]
title = "T"
author = "A"
course = "C"
[render]
size = [300, 200]
colormap = "viridis"
view_files = true
camera = [-35, 22.5]
up = "z"
zoom = 2
[[question]]
id = "q4"
mesh = ["a.obj", "b/c.ply"]
k = [5, 15]
output = "modes"
seed = 3
threads = 1
[[question]]
id = "q6"
mesh = "torus"
lambda = 1
iterations = 10
[[question]]
id = "q7"
noise = [0, 0.5]
)",
                                                   "folder/my.toml");
    EXPECT_EQ(settings.seed, 9u);
    EXPECT_EQ(settings.threads, 2);
    EXPECT_EQ(settings.laboratory, true);
    EXPECT_EQ(settings.title, "T");
    EXPECT_EQ(settings.author, "A");
    EXPECT_EQ(settings.course, "C");
    EXPECT_EQ(settings.size.width, 300);
    EXPECT_EQ(settings.size.height, 200);
    EXPECT_EQ(settings.colormap, "viridis");
    EXPECT_TRUE(settings.view_files);
    EXPECT_EQ(settings.sight, (render::Sight{render::Angles{-35, 22.5, 0}, render::Up::z, 2}));
    EXPECT_EQ(settings.base, "folder");
    const QuestionTable& q4 = settings.questions.at("q4");
    EXPECT_EQ(q4.meshes, (std::vector<std::string>{"a.obj", "b/c.ply"}));
    EXPECT_EQ(q4.k, (std::vector{5, 15}));
    EXPECT_EQ(q4.output, "modes");
    EXPECT_EQ(q4.seed, 3u);
    EXPECT_EQ(q4.threads, 1);
    EXPECT_EQ(settings.questions.at("q6").lambda, std::vector{1.0});
    EXPECT_EQ(settings.questions.at("q6").iterations, std::vector{10});
    EXPECT_EQ(settings.questions.at("q7").noise, (std::vector{0.0, 0.5}));
}

TEST(SettingsFile, OneNumberIsWidthAndHeight) {
    const ReportSettings settings = parse_settings("[render]\nsize = 640\n", "my.toml");
    EXPECT_EQ(settings.size.width, 640);
    EXPECT_EQ(settings.size.height, 640);
}

TEST(SettingsFile, SectionsMayBeAListOrOneName) {
    EXPECT_EQ(parse_settings("[report]\nsections = [\"q1\", \"truth\"]\n", "my.toml").only, (std::vector<std::string>{"q1", "truth"}));
    EXPECT_EQ(parse_settings("[report]\nsections = \"q4\"\n", "my.toml").only, std::vector<std::string>{"q4"});
}

TEST(SettingsFile, TemplateMustBeReadable) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "my.toml").string();
    const auto missing = problems_of("[report]\ntemplate = \"page.html\"", file);
    ASSERT_EQ(missing.size(), 1u);
    EXPECT_NE(missing[0].find("my.toml:2: "), std::string::npos) << missing[0];
    write_file(folder.path() / "page.html", "<p>{{title}}</p>");
    EXPECT_EQ(parse_settings("[report]\ntemplate = \"page.html\"", file).page.file, folder.path() / "page.html");
}

TEST(SettingsFile, TheDesignIsChosenByItsName) {
    const ReportSettings file = parse_settings("[report]\ntemplate = \"print\"", "my.toml");
    EXPECT_EQ(file.page.design, "print");
    EXPECT_FALSE(file.page.file);
}

TEST(SettingsFile, AllProblemsAreReportedInTheOrderOfTheirLines) {
    const auto problems = problems_of(R"(seed = -1
sead = 2
[render]
size = 1
colormap = "viridsi"
[[question]]
id = "q9"
lambda = nan
[[question]]
id = "q4"
k = "five"
output = "../x"
)");
    const std::vector<long> lines{1, 2, 4, 5, 7, 8, 11, 12};
    ASSERT_EQ(problems.size(), lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_TRUE(problems[i].starts_with("my.toml:" + std::to_string(lines[i]) + ": ")) << problems[i];
        EXPECT_EQ(problems[i].find('\n'), std::string::npos);
    }
    EXPECT_NE(problems[3].find("'viridis'"), std::string::npos);
}

TEST(SettingsFile, AFileThatCannotBeReadIsAUsageError) {
    const TemporaryFolder folder;
    for (const auto& path : {folder.path() / "none.toml", folder.path()}) {
        try {
            read_settings(path.string());
            FAIL() << path;
        } catch (const UsageError& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::usage);
            EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
        }
    }
}

TEST(SettingsFile, AFolderNamedAsBundledSettingsDoesNotHideThem) {
    const TemporaryFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    EXPECT_TRUE(read_settings("laboratory").laboratory);
    std::filesystem::create_directory("laboratory");
    EXPECT_TRUE(read_settings("laboratory").laboratory);
    std::filesystem::remove("laboratory");
    folder.write("laboratory", "seed = 7\n");
    EXPECT_EQ(read_settings("laboratory").seed, 7u) << "a file comes first";
    std::filesystem::current_path(before);
}

// The program accepts everything that data/report.toml documents.
TEST(DefaultSettings, AndTheirCommentedExamplesAreValid) {
    const std::string text = read_file(std::filesystem::path(MESHFOLIO_SOURCE_DIR) / "data" / "report.toml");
    const ReportSettings plain = parse_settings(text, "report.toml");
    EXPECT_FALSE(plain.title.empty() || plain.course.empty() || plain.colormap.empty() || plain.size.width == 0 || plain.seed == 0);

    const std::regex commented("^# (\\[+[a-z]+\\]+.*|[a-z_]+ = .*)$", std::regex::multiline);
    std::string uncommented = std::regex_replace(text, commented, "$1");
    const TemporaryFolder folder;
    const ReportSettings full = parse_settings(uncommented, (folder.path() / "report.toml").string());
    EXPECT_EQ(full.page.design, "print");
    for (const char* id : {"q4", "q6", "q7"}) EXPECT_TRUE(full.questions.contains(id)) << id;
    const QuestionTable& q4 = full.questions.at("q4");
    EXPECT_TRUE(q4.output && q4.seed && q4.threads && !q4.k.empty() && !q4.meshes.empty());
    EXPECT_FALSE(full.questions.at("q6").lambda.empty() || full.questions.at("q6").iterations.empty());
    EXPECT_FALSE(full.questions.at("q7").noise.empty());
}
