#include "run/settings/report_settings.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/file_bytes.h"
#include "source_dir.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::run;
using testing_tools::TemporaryFolder;

namespace {

/// Sets an environment variable during its lifetime.
class Environment {
public:
    Environment(const char* name, const char* value) : name_(name) { ::setenv(name, value, 1); }
    ~Environment() { ::unsetenv(name_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
};

std::string settings_in(const TemporaryFolder& folder, const std::string& text) {
    const auto path = folder.path() / "my.toml";
    write_file(path, text);
    return path.string();
}

}   // namespace

TEST(ReportSettings, DefaultsAreThoseOfTheBundledFile) {
    const ReportSettings file = read_settings(MESHFOLIO_SOURCE_DIR "/data/report.toml");
    const ReportSettings settings = report_settings({});
    EXPECT_EQ(settings.title, file.title);
    EXPECT_EQ(settings.size.width, file.size.width);
    EXPECT_EQ(settings.seed, file.seed);
    EXPECT_EQ(settings.out, "out");
    EXPECT_TRUE(settings.timings);
    EXPECT_FALSE(settings.quick);
}

TEST(ReportSettings, FlagsOverFileOverEnvironmentOverDefaults) {
    const TemporaryFolder folder;
    ReportFlags flags;
    EXPECT_EQ(report_settings(flags).size.width, 800);
    flags.quick = true;
    EXPECT_EQ(report_settings(flags).size.width, 400);
    const Environment size("MESHFOLIO_SIZE", "100"), threads("MESHFOLIO_THREADS", "3"), out("MESHFOLIO_OUT", "elsewhere");
    EXPECT_EQ(report_settings(flags).size.width, 100);
    EXPECT_EQ(report_settings(flags).threads, 3);
    EXPECT_EQ(report_settings(flags).out, "elsewhere");
    flags.config = settings_in(folder, "threads = 4\nlaboratory = true\n[render]\nsize = 200\n");
    EXPECT_TRUE(question_settings(report_settings(flags), "q7").laboratory);
    EXPECT_EQ(report_settings(flags).size.width, 200);
    EXPECT_EQ(report_settings(flags).threads, 4);
    flags.size = "300";
    flags.threads = "5";
    flags.out = "here";
    const ReportSettings settings = report_settings(flags);
    EXPECT_EQ(settings.size.width, 300);
    EXPECT_EQ(settings.size.height, 300);
    EXPECT_EQ(settings.threads, 5);
    EXPECT_EQ(settings.out, "here");
}

TEST(ReportSettings, AReportOnOwnMeshesIsNamedAfterThemAndHasNoCourse) {
    ReportFlags flags;
    EXPECT_TRUE(has_source(report_settings(flags)));
    EXPECT_NE(head_of(report_settings(flags)).course, "");
    EXPECT_EQ(head_of(report_settings(flags, true)).course, "");
    flags.meshes = {"a/spot.obj", "Bunny<b>.ply"};
    const ReportSettings own = report_settings(flags);
    EXPECT_EQ(head_of(own).title, "Curvature and Laplacian smoothing of spot and Bunny<b>");
    EXPECT_EQ(head_of(own).course, "");
    EXPECT_FALSE(has_source(own));
    flags.meshes = {"a.obj", "b.obj", "c.obj", "d.obj", "e.obj"};
    EXPECT_EQ(head_of(report_settings(flags)).title, "Curvature and Laplacian smoothing of a, b, c and 2 more");
    const TemporaryFolder folder;
    flags.config = settings_in(folder, "[report]\ntitle = \"Mine\"\ncourse = \"Yours\"\nsource = true\n");
    EXPECT_EQ(head_of(report_settings(flags)).title, "Mine");
    EXPECT_EQ(head_of(report_settings(flags)).course, "Yours");
    EXPECT_TRUE(has_source(report_settings(flags)));
    flags.title = "Other";
    flags.course = "Ours";
    flags.no_source = true;
    EXPECT_EQ(head_of(report_settings(flags)).title, "Other");
    EXPECT_EQ(head_of(report_settings(flags)).course, "Ours");
    EXPECT_FALSE(has_source(report_settings(flags)));
    for (const std::string& title : {std::string("  "), std::string(201, 'a'), std::string("a\nb")}) {
        flags.title = title;
        EXPECT_THROW(report_settings(flags), SettingsErrors) << title;
    }
}

TEST(ReportSettings, TwoQuestionsOfAReportHaveTwoNumbers) {
    const TemporaryFolder folder;
    ReportFlags flags;
    flags.config = settings_in(folder, "[[question]]\nid = \"q3\"\nnumber = 4\n");
    EXPECT_THROW(report_settings(flags), SettingsErrors) << "q4 has it, too";
    flags.only = "q3,q5";
    EXPECT_NO_THROW(report_settings(flags));
    flags.only = "q3,q4";
    EXPECT_THROW(report_settings(flags), SettingsErrors);
}

TEST(ReportSettings, DataFoldersOfTheEnvironmentAreSeparatedByColons) {
    const Environment data("MESHFOLIO_DATA", "a:b");
    EXPECT_EQ(report_settings({}).data, (std::vector<std::filesystem::path>{"a", "b"}));
}

// A flag replaces its own key alone; what is not given is neither in the provenance nor a difference between parts of a report.
TEST(ReportSettings, TheSightIsThatOfTheFileUnderTheFlags) {
    const TemporaryFolder folder;
    ReportFlags flags;
    for (const char* name : {"camera", "up", "zoom"}) EXPECT_FALSE(described(report_settings(flags)).contains(name)) << name;
    flags.config = settings_in(folder, "[render]\ncamera = [10, 20, 30]\nzoom = 3\n");
    flags.camera = "-5,6.5";
    flags.up = "x";
    const ReportSettings settings = report_settings(flags);
    EXPECT_EQ(settings.sight, (render::Sight{render::Angles{-5, 6.5, 0}, render::Up::x, 3}));
    const auto values = described(settings);
    EXPECT_EQ(values.at("camera"), "-5, 6.5, 0");
    EXPECT_EQ(values.at("up"), "x");
    EXPECT_EQ(values.at("zoom"), "3");
}

TEST(ReportSettings, WrongFlagsAndEnvironmentAreUsageErrors) {
    for (const char* camera : {"35", "1,2,3,4", "1,", "0,91", "361,0", "a,b", "nan,0"}) {
        ReportFlags flags;
        flags.camera = camera;
        EXPECT_THROW(report_settings(flags), UsageError) << camera;
    }
    for (const char* size : {"0", "15", "4097", "-1", "1e3", "100x100", "x", "99999999999999999999"}) {
        ReportFlags flags;
        flags.size = size;
        EXPECT_THROW(report_settings(flags), UsageError) << size;
    }
    ReportFlags flags;
    flags.threads = "two";
    EXPECT_THROW(report_settings(flags), UsageError);
    flags = {};
    flags.only = "q1,q8";
    EXPECT_THROW(report_settings(flags), UsageError);
    flags = {};
    flags.pdf = "always";
    EXPECT_THROW(report_settings(flags), UsageError);
    const Environment threads("MESHFOLIO_THREADS", "many");
    EXPECT_THROW(report_settings({}), UsageError);
}

TEST(ReportSettings, AllProblemsAreReportedAtOnce) {
    const TemporaryFolder folder;
    const Environment pdf("MESHFOLIO_PDF", "bogus"), threads("MESHFOLIO_THREADS", "x");
    ReportFlags flags;
    flags.config = settings_in(folder, "[report]\nwidht = 5\n");
    flags.size = "1";
    flags.camera = "x";
    flags.up = "w";
    flags.zoom = "0";
    flags.only = "q99";
    std::string told;
    try {
        report_settings(flags);
    } catch (const SettingsErrors& errors) {
        for (const UsageError& error : errors.problems()) told += std::string(error.what()) + "\n";
    }
    for (const char* name :
         {"MESHFOLIO_PDF 'bogus'", "MESHFOLIO_THREADS 'x'", "my.toml:2", "--size '1'", "--camera 'x'", "--up 'w'", "--zoom '0'", "q99"})
        EXPECT_NE(told.find(name), std::string::npos) << name << " in\n" << told;
}

// Publishing a report removes the earlier one, and with it inputs in its folder.
TEST(ReportSettings, InputsInTheFolderThatIsReplacedAreRefused) {
    const TemporaryFolder folder;
    const auto out = folder.path() / "out";
    std::filesystem::create_directories(out / "data");
    std::filesystem::create_directory_symlink(out, folder.path() / "link");
    write_file(out / "my.obj", "");
    write_file(folder.path() / "out.obj", "");
    ReportFlags flags;
    flags.out = out.string();
    flags.meshes = {(out / "my.obj").string()};
    EXPECT_NO_THROW(report_settings(flags)) << "no report of ours: Publication refuses what is not";
    write_file(out / ".meshfolio", "");
    EXPECT_THROW(report_settings(flags), UsageError);
    flags.meshes = {(folder.path() / "link" / "my.obj").string()};
    EXPECT_THROW(report_settings(flags), UsageError);
    flags.out = (folder.path() / "nowhere" / ".." / "out").string();
    EXPECT_THROW(report_settings(flags), UsageError) << "where the report goes, spelt by way of a folder that is not there";
    flags.out = out.string();
    flags.meshes = {(folder.path() / "out.obj").string()};
    EXPECT_NO_THROW(report_settings(flags));
    flags.data = {(out / "data").string()};
    EXPECT_THROW(report_settings(flags), UsageError);
    const auto outside = folder.path() / "meshes";
    std::filesystem::create_directory(outside);
    flags.data = {outside.string()};
    EXPECT_NO_THROW(report_settings(flags));
    std::filesystem::create_symlink(out / "my.obj", outside / "unused.obj");
    EXPECT_NO_THROW(report_settings(flags)) << "nobody reads that link";
    std::filesystem::create_directory(outside / "curvatures");
    std::filesystem::create_symlink(out / "my.obj", outside / "curvatures" / "plane.obj");
    EXPECT_THROW(report_settings(flags), UsageError) << "a folder beside the report with a link into it";
    std::filesystem::remove(outside / "curvatures" / "plane.obj");
    flags.data = {folder.path().string()};
    EXPECT_NO_THROW(report_settings(flags)) << "the report lies beside the meshes";
    flags.data = {};
    flags.templates = (out / "data").string();
    EXPECT_THROW(report_settings(flags), UsageError);
}

TEST(ReportSettings, InputsOfSettingsInTheFolderThatIsReplacedAreRefused) {
    const TemporaryFolder folder;
    const auto out = folder.path() / "out";
    std::filesystem::create_directories(out);
    for (const char* name : {".meshfolio", "my.obj", "page.html"}) write_file(out / name, "");
    ReportFlags flags;
    flags.out = out.string();
    const auto refused = [&](const std::string& text) {
        flags.config = settings_in(folder, text);
        try {
            report_settings(flags);
        } catch (const UsageError& error) {
            return std::string(error.what()).find("replaces as a whole") != std::string::npos;
        }
        return false;
    };
    EXPECT_FALSE(refused("[[question]]\nid = \"q5\"\nmesh = \"my.obj\""));
    EXPECT_TRUE(refused("[[question]]\nid = \"q5\"\nmesh = \"out/my.obj\""));
    EXPECT_TRUE(refused("[report]\ntemplate = \"out/page.html\""));
    flags.config = (out / "my.toml").string();
    write_file(flags.config, "");
    EXPECT_THROW(report_settings(flags), UsageError);
}

TEST(ReportSettings, OnlyListsQuestions) {
    ReportFlags flags;
    flags.only = "q1,q4";
    const auto asked = [&](const std::string& only) {
        flags.only = only;
        return report_settings(flags).only;
    };
    EXPECT_EQ(report_settings(flags).only, (std::vector<std::string>{"q1", "q4"}));
    EXPECT_EQ(asked("Q1,4"), asked("q1,q4"));
    EXPECT_EQ(asked("1-3,Q5-q6"), asked("q1,q2,q3,q5,q6"));
    EXPECT_EQ(asked("truth,2-2"), asked("q2,truth"));
    for (const char* none : {"0-1", "3-1", "1-", "-3", "6-8", "1-3,2", "qq1", "1-2-3", "123"})
        EXPECT_THROW(asked(none), UsageError) << none;
}

TEST(ReportSettings, AQuestionGetsItsTableAndTheGeneralSettings) {
    const TemporaryFolder folder;
    ReportFlags flags;
    flags.config = settings_in(folder, "seed = 5\n[[question]]\nid = \"q4\"\nmesh = \"torus\"\nk = 7\nseed = 6\n");
    ReportSettings settings = report_settings(flags);
    const QuestionSettings q4 = question_settings(settings, "q4"), q5 = question_settings(settings, "q5");
    EXPECT_EQ(q4.k, std::vector{7});
    EXPECT_EQ(q4.meshes, std::vector<std::string>{"torus"});
    EXPECT_EQ(q4.base, folder.path());
    EXPECT_EQ(q4.seed, 6u);
    EXPECT_EQ(q5.seed, 5u);
    EXPECT_TRUE(q5.k.empty() && q5.meshes.empty());
    settings.meshes = {"mine.obj"};
    EXPECT_TRUE(question_settings(settings, "q4").meshes.empty()) << "meshes on the command line take every role";
}

TEST(ReportSettings, ProvenanceHasNeitherThreadsNorPaths) {
    const TemporaryFolder folder;
    ReportFlags flags;
    flags.config =
        settings_in(folder, "threads = 2\n[[question]]\nid = \"q4\"\nmesh = \"" + folder.path().string() + "/a.obj\"\nk = [3, 4]\n");
    flags.out = folder.path().string();
    flags.threads = "1";
    const auto values = described(report_settings(flags));
    for (const auto& [key, value] : values) {
        EXPECT_EQ(key.find("threads"), std::string::npos);
        EXPECT_EQ(value.find(folder.path().string()), std::string::npos) << key;
    }
    EXPECT_EQ(values.at("q4 k"), "3, 4");
}

TEST(ReportSettings, OnlyReplacesTheSectionsOfTheFile) {
    const TemporaryFolder folder;
    ReportFlags flags;
    flags.config = settings_in(folder, "[report]\nsections = [\"q2\", \"truth\"]\n");
    EXPECT_EQ(report_settings(flags).only, (std::vector<std::string>{"q2", "truth"}));
    flags.only = "q5";
    EXPECT_EQ(report_settings(flags).only, std::vector<std::string>{"q5"});
}
