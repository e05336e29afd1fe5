#include "run/settings/settings_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/file_bytes.h"
#include "questions/reproductions/study.h"
#include "run/settings/report_settings.h"
#include "run/settings/settings_problems.h"
#include "source_dir.h"
#include "temporary_folder.h"

using namespace meshfolio;
using namespace meshfolio::run;
using reproductions::uncovered_rows;
using testing_tools::expect_problem;
using testing_tools::problems_of;
using testing_tools::TemporaryFolder;

namespace {

const std::string originals = "[original]\nbunny = { file = \"bunny.off\", stand_in = \"creature.obj\", lambda_crit = 1e-7 }\n";

/// The first line of the experiment is line 3 of the file; `keys` begin on line 7.
std::string experiment(const std::string& keys, const std::string& kind = "smoothing") {
    return originals + "[[experiment]]\nrow = 20\nfrom = \"S0\"\nname = \"x\"\nkind = \"" + kind + "\"\n" + keys + "\n";
}
const std::string smoothing = "mesh = \"bunny\"\nlambda = 1e-7\niterations = 10\n";

std::string bundled_path(const std::string& name) { return std::string(MESHFOLIO_SOURCE_DIR) + "/data/reports/" + name + ".toml"; }

}   // namespace

TEST(Experiments, EveryKeyIsRead) {
    const std::string text = originals + R"([[experiment]]
row = [29, 30]
from = "S9"
name = "n"
kind = "error-curve"
mesh = "bunny"
scheme = ["implicit", "implicit-rebuilt", "taubin"]
operator = ["uniform", "cotan-no-half"]
area = ["mixed", "voronoi"]
lambda = [2, 1]
unit = "tau"
iterations = [7, 3]
noise = [0.1, 0.2]
noise_unit = "box"
minimum = [0, 3]
seed = 5
colour = "gauss"
colormap = "parula-like"
said = "s"
lost = "l"
brief = true
)";
    const ReportSettings settings = parse_settings(text, "my.toml");
    ASSERT_EQ(settings.experiments.size(), 1u);
    const Experiment& e = settings.experiments.front();
    EXPECT_EQ(e.rows, (std::vector{29, 30}));
    EXPECT_EQ(e.from, "S9");
    EXPECT_EQ(e.name, "n");
    EXPECT_EQ(e.kind, ExperimentKind::error_curve);
    ASSERT_EQ(e.meshes.size(), 1u);
    EXPECT_EQ(e.meshes[0].name, "bunny");
    EXPECT_EQ(e.meshes[0].file, "bunny.off");
    EXPECT_EQ(e.meshes[0].stand_in, "creature.obj");
    EXPECT_EQ(e.meshes[0].lambda_crit, 1e-7);
    EXPECT_EQ(e.methods,
              (std::vector<SmoothingMethod>{
                  {SmoothingScheme::implicit_euler, false}, {SmoothingScheme::implicit_euler, true}, {SmoothingScheme::taubin, false}}));
    EXPECT_EQ(e.operators, (std::vector{OperatorKind::uniform, OperatorKind::cotan_no_half}));
    EXPECT_EQ(e.areas, (std::vector{AreaForm::mixed, AreaForm::voronoi}));
    EXPECT_EQ(e.lambda, (std::vector{2.0, 1.0}));
    EXPECT_EQ(e.lambda_unit, StepUnit::tau);
    EXPECT_EQ(e.iterations, (std::vector{3, 7})) << "ascending";
    EXPECT_EQ(e.noise, (std::vector{0.1, 0.2}));
    EXPECT_EQ(e.noise_unit, NoiseUnit::box);
    EXPECT_EQ(e.minimum, (std::vector{0, 3}));
    EXPECT_EQ(e.seed, 5u);
    EXPECT_EQ(e.colours, std::vector{ExperimentColour::gauss});
    EXPECT_EQ(e.colormap, "parula-like");
    EXPECT_EQ(e.said, "s");
    EXPECT_EQ(e.lost, "l");
    EXPECT_TRUE(e.brief);
    EXPECT_TRUE(parse_settings(experiment(smoothing + "search = true"), "my.toml").experiments.front().search);
}

TEST(Experiments, MissingKeysKeepTheirDefault) {
    const Experiment e = parse_settings(experiment(smoothing), "my.toml").experiments.at(0);
    EXPECT_EQ(e.methods, std::vector<SmoothingMethod>(1));
    EXPECT_EQ(e.operators, std::vector{OperatorKind::cotan});
    EXPECT_EQ(e.lambda_unit, StepUnit::raw);
    EXPECT_FALSE(e.brief || e.search);
}

TEST(Experiments, UnknownWordsNameTheNearest) {
    expect_problem(experiment(smoothing + "iteration = 4"), 11, {"'iteration'", "'iterations'", "[[experiment]]"});
    expect_problem(experiment("mesh = \"buny\"\nlambda = 1\niterations = 1"), 8, {"'buny'", "'bunny'"});
    expect_problem(experiment(smoothing + "scheme = \"explizit\""), 11, {"'explizit'", "'explicit'"});
    expect_problem(experiment(smoothing + "operator = [\"cotan\", \"unifrom\"]"), 11, {"'unifrom'", "'uniform'"});
    expect_problem(experiment(smoothing + "area = \"baricentric\""), 11, {"'baricentric'", "'barycentric'"});
    expect_problem(experiment(smoothing + "unit = \"rav\""), 11, {"'rav'", "'raw'"});
    expect_problem(experiment(smoothing + "colour = \"gaus\""), 11, {"'gaus'", "'gauss'"});
    expect_problem(experiment(smoothing + "colormap = \"virids\""), 11, {"'virids'", "'viridis'"});
    expect_problem(experiment("mesh = \"bunny\"", "curvatur"), 7, {"'curvatur'", "'curvature'"});
    expect_problem(originals + "[[experiments]]\nrow = 7", 3, {"'experiments'", "'experiment'"});
    expect_problem("[original]\nb = { stand_in = \"creatur.obj\" }", 2, {"'creatur.obj'", "'creature.obj'"});
    expect_problem("[original]\nb = { stand_in = \"cube.obj\", lambdacrit = 1 }", 2, {"'lambdacrit'", "'lambda_crit'"});
}

TEST(Experiments, WrongTypesAndRangesAreRefused) {
    expect_problem("experiment = 1", 1, {"[[experiment]]"});
    expect_problem("original = 1", 1, {"[original]"});
    expect_problem("[original]\nbunny = 1", 2, {"bunny", "stand_in"});
    expect_problem("[original]\nbunny = { file = \"bunny.off\" }", 2, {"stand_in"});
    expect_problem("[original]\nb = { stand_in = \"cube.obj\", lambda_crit = [1, 2] }", 2, {"lambda_crit", "one number"});
    expect_problem("[original]\nb = { stand_in = \"cube.obj\", lambda_crit = 0 }", 2, {"lambda_crit", "above 0"});
    expect_problem(experiment("mesh = \"bunny\"\nlambda = 0\niterations = 1"), 9, {"lambda", "above 0"});
    expect_problem(experiment("mesh = \"bunny\"\nlambda = 1\niterations = 0"), 10, {"iterations", "from 1 to 100000"});
    expect_problem(experiment(smoothing + "search = 1"), 11, {"search", "true or false"});
    expect_problem(experiment(smoothing + "operator = [\"cotan\", \"cotan\"]"), 11, {"twice"});
    expect_problem(experiment(smoothing + "said = \"" + std::string(1001, 'x') + "\""), 11, {"1001", "1000"});
    expect_problem(originals + "[[experiment]]\nrow = 6\nfrom = \"S0\"\nname = \"x\"\nkind = \"forms\"", 4, {"from 7 to 34"});
    expect_problem(experiment(smoothing + "noise = [0.1]\nminimum = [1, 2]", "error-curve"), 12, {"2 values for 1"});
    expect_problem(experiment(smoothing + "operator = \"uniform\"\nunit = \"h2\""), 12, {"uniform", "h2"});
}

TEST(Experiments, EachKindHasItsKeys) {
    expect_problem(experiment(smoothing + "k = 5"), 11, {"k", "'smoothing'"});
    expect_problem(experiment("mesh = \"bunny\"\nlambda = 1", "curvature"), 9, {"lambda", "'curvature'"});
    expect_problem(experiment("mesh = \"bunny\"", "reconstruction"), 3, {"no k"});
    expect_problem(experiment("", "curvature"), 3, {"no mesh"});
    expect_problem(originals + "[[experiment]]\nfrom = \"S0\"\nname = \"x\"\nkind = \"forms\"", 3, {"no row"});
    EXPECT_TRUE(problems_of(experiment("", "forms")).empty());
    EXPECT_EQ(problems_of(experiment("", "denoising")).size(), 4u) << "mesh, lambda, iterations, noise: all at once";
}

TEST(BundledReports, ParseAndCoverEveryRow) {
    std::vector<Experiment> all;
    for (const std::string name : {"s0", "s1", "s2", "s3"}) {
        const ReportSettings file = read_settings(bundled_path(name));
        EXPECT_FALSE(file.experiments.empty()) << name;
        EXPECT_EQ(bundled_report_text(name), read_file(bundled_path(name))) << "as compiled in";
        for (const Experiment& e : file.experiments) {
            EXPECT_EQ(e.from, "S" + name.substr(1)) << e.name;
            for (const OriginalMesh& mesh : e.meshes) EXPECT_FALSE(mesh.stand_in.empty());
        }
        all.insert(all.end(), file.experiments.begin(), file.experiments.end());
    }
    EXPECT_EQ(uncovered_rows(all), std::vector<int>{});
    EXPECT_NE(uncovered_rows({}), std::vector<int>{}) << "sections alone do not cover all rows";
    // Rows 19 and 24 belong to the assignment and are answered by questions; every other row has an experiment of its report.
    const std::map<std::string, std::vector<int>> own{
        {"S0", {8, 20, 25, 29}}, {"S1", {14, 21, 26, 30, 31, 32}}, {"S2", {22, 27, 33}}, {"S3", {11, 12, 15, 17, 23, 28, 34}}};
    for (const auto& [report, rows] : own) {
        for (const int row : rows) {
            EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                                    [&, &from = report](const Experiment& e) {
                                        return e.from == from && std::find(e.rows.begin(), e.rows.end(), row) != e.rows.end();
                                    }))
                << report << " row " << row;
        }
    }
}

TEST(BundledReports, HaveTheParametersOfTheReport) {
    const auto of_row = [](const std::string& name, int row, std::size_t index) {
        std::vector<Experiment> found;
        for (const Experiment& e : read_settings(bundled_path(name)).experiments) {
            if (std::find(e.rows.begin(), e.rows.end(), row) != e.rows.end()) found.push_back(e);
        }
        return found.at(index);
    };
    EXPECT_EQ(of_row("s0", 20, 1).lambda, (std::vector{8e-7, 3e-6, 1e-5, 1e-4}));
    EXPECT_EQ(of_row("s0", 20, 2).lambda, (std::vector{1e-3, 1e-2, 3e-2, 5e-2}));
    EXPECT_EQ(of_row("s0", 29, 0).noise, (std::vector{0.0011, 0.0013, 0.0015}));
    EXPECT_EQ(of_row("s0", 29, 0).lambda, std::vector{5e-7});
    EXPECT_EQ(of_row("s2", 22, 0).lambda, std::vector{1.5});
    EXPECT_EQ(of_row("s2", 27, 0).iterations, (std::vector{50, 500, 5000}));
    EXPECT_EQ(of_row("s1", 32, 0).noise, std::vector{0.2});
    EXPECT_FALSE(of_row("s1", 21, 0).lost.empty()) << "lost parameters are said to be so";
}

TEST(BundledReports, TheLaboratoryFileTurnsItOn) { EXPECT_EQ(read_settings(bundled_path("laboratory")).laboratory, true); }

std::vector<std::string> ids_of(const std::vector<const Chapter*>& chapters) {
    std::vector<std::string> ids;
    for (const Chapter* chapter : chapters) ids.emplace_back(chapter->id);
    return ids;
}

// Chapters about earlier reports are included only by their settings, by experiments, or by name.
TEST(BundledReports, ChaptersOnRequestAreLeftOutByDefault) {
    const auto with = [](const std::string& config, const std::string& only) {
        ReportFlags flags;
        flags.config = config;
        flags.only = only;
        return report_settings(flags);
    };
    const auto has = [](const ReportSettings& settings, const char* id) { return std::ranges::count(ids_of(chapters_of(settings)), id); };
    for (const auto& settings : {with("", ""), with("laboratory", ""), with("", "q1,truth")}) {
        EXPECT_EQ(has(settings, "reproductions") + has(settings, "claims"), 0);
        EXPECT_EQ(has(settings, "truth"), 1);
        EXPECT_FALSE(is_asked_for(settings, "claims"));
    }
    for (const char* config : {"s0", "s3", "earlier"}) {
        EXPECT_EQ(ids_of(chapters_of(with(config, ""))), section_ids()) << config;
        EXPECT_TRUE(is_asked_for(with(config, ""), "reproductions")) << config;
        EXPECT_FALSE(is_asked_for(with(config, "q1"), "reproductions")) << config;
        EXPECT_EQ(has(with(config, "q1"), "claims"), 1) << config << ": parts of one report have the same sections";
    }
    const ReportSettings named = with("", "claims,q2");
    EXPECT_EQ(has(named, "claims"), 1);
    EXPECT_EQ(has(named, "reproductions"), 0);
    EXPECT_TRUE(is_asked_for(named, "claims") && is_asked_for(named, "q2") && !is_asked_for(named, "q1"));
}

TEST(BundledReports, NamingAllSectionsMeansAll) {
    std::vector<std::string> all = section_ids(), default_ones = ids_of(chapters_of({}));
    EXPECT_TRUE(sections_in_order(all, true).empty());
    EXPECT_TRUE(sections_in_order(default_ones, false).empty());
    EXPECT_EQ(sections_in_order(all, false), all);
    EXPECT_EQ(sections_in_order(default_ones, true), default_ones);
}

TEST(BundledReports, AreFoundByName) {
    ReportFlags flags;
    flags.config = "s2";
    const ReportSettings settings = report_settings(flags);
    ASSERT_FALSE(settings.experiments.empty());
    EXPECT_EQ(settings.experiments.front().from, "S2");
    flags.config = "s9";
    EXPECT_THROW(report_settings(flags), UsageError);
}

TEST(BundledReports, BriefExperimentsAreTheDefault) {
    const QuestionSettings brief = question_settings(report_settings({}), "reproductions");
    EXPECT_FALSE(brief.own_experiments);
    ASSERT_FALSE(brief.experiments.empty());
    EXPECT_LT(brief.experiments.size(), brief.bundled_experiments.size());
    for (const Experiment& e : brief.experiments) EXPECT_TRUE(e.brief);
    EXPECT_TRUE(question_settings(report_settings({}), "q5").experiments.empty());
    ReportFlags quick;
    quick.quick = true;
    EXPECT_EQ(question_settings(report_settings(quick), "reproductions").experiments.size(), 1u);

    const TemporaryFolder folder;
    write_file(folder.path() / "my.toml", experiment(smoothing));
    ReportFlags flags;
    flags.config = (folder.path() / "my.toml").string();
    const QuestionSettings own = question_settings(report_settings(flags), "reproductions");
    EXPECT_TRUE(own.own_experiments);
    EXPECT_EQ(own.experiments.size(), 1u);
    EXPECT_EQ(own.bundled_experiments.size(), brief.bundled_experiments.size());
}
