// Right answers get all points. Each known convention, applied to the right answer, is recognised and named.
#include "run/mark/marking.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <iomanip>
#include <sstream>
#include <string>

#include "base/number_text.h"
#include "mesh/io/mesh_files.h"
#include "run/mark/mark_pages.h"
#include "run/settings/report_settings.h"

using namespace meshfolio;
using namespace meshfolio::run;

namespace {

/// Returns a rubric of one item on a bundled mesh with an irregular surface and a boundary.
Rubric rubric_of(const std::string& keys, const std::string& mesh = "lily.obj") {
    return parse_rubric("[[item]]\nid = \"a\"\npoints = 8\nmesh = \"" + mesh + "\"\ncolumn = \"v\"\nvalue = 3\ntolerance = 1e-6\n" +
                            std::string(keys.find("file = ") == std::string::npos ? "file = \"*\"\n" : "") + keys,
                        "r.toml");
}

const std::vector<std::string> marked_things{"what = \"H\"",
                                             "what = \"H_uniform\"",
                                             "what = \"K\"",
                                             "what = \"K\"\narea = \"mixed\"",
                                             "what = \"eigenvalues\"\nk = 7",
                                             "what = \"reconstruction\"\nk = 6",
                                             "what = \"smoothed\"\nlambda = 0.5\niterations = 4",
                                             "what = \"smoothed\"\nscheme = \"implicit\"\nlambda = 3\niterations = 3",
                                             "what = \"H\"\noperator = \"uniform\"",
                                             "what = \"eigenvalues\"\noperator = \"uniform\"\nk = 7",
                                             "what = \"smoothed\"\noperator = \"uniform\"\nunit = \"raw\"\nlambda = 0.25\niterations = 4",
                                             "what = \"smoothed\"\nrebuild = true\nlambda = 0.5\niterations = 3",
                                             "what = \"smoothed\"\nscheme = \"taubin\"\nlambda = 0.3\niterations = 3"};

bool names(const std::vector<ConventionKeys>& found, const ConventionKeys& keys) { return std::ranges::find(found, keys) != found.end(); }

/// Returns a student's files with these values.
submission::HandedIn files_with(const Vector& values, const Reference& reference, MarkedThing what) {
    if (is_of_mesh(what)) {
        const Positions X = Eigen::Map<const Positions>(values.data(), values.size() / 3, 3);
        return {{"a.ply", encode_mesh(moved_to(reference.mesh->mesh(), X), "a.ply")}};
    }
    std::string csv = "v,w\n";
    for (const double value : values) csv += exact_text(value) + ",0\n";
    return {{"a.csv", csv}};
}

/// A rubric of one item with its right answer, and the marks of students.
struct OneItem {
    explicit OneItem(const std::string& keys, const std::string& mesh = "lily.obj") : rubric(rubric_of(keys, mesh)), references(rubric) {}
    const Rubric rubric;
    References references;
    const RubricItem& item = rubric.items.front();
    const Reference& reference = references.of(item, item.settings);
    const Vector& right = reference.right.values;

    StudentMarks marks(const Vector& values) { return marks_of(files_with(values, reference, item.what), rubric, references); }
    ItemMark mark(const submission::HandedIn& files) { return marks_of(files, rubric, references).items.front(); }
    ItemMark mark(const Vector& values) { return marks(values).items.front(); }
};

}   // namespace

TEST(Marking, RightAnswersHaveAllPoints) {
    for (const std::string& thing : marked_things) {
        OneItem one(thing);
        for (const double noise : {0.0, 1e-7}) {
            const ItemMark mark = one.mark((1 + noise) * one.right);
            EXPECT_EQ(mark.verdict, Verdict::right) << thing << ": " << explanation_of(mark);
            EXPECT_EQ(mark.score, 8) << thing;
        }
    }
}

TEST(Marking, EveryPossibleConventionIsRecognised) {
    for (const std::string& thing : marked_things) {
        OneItem one(thing);
        const RubricItem& item = one.item;
        const std::vector<Variant>& variants = one.references.variants_of(item, item.settings);
        const auto can_be_made = [&](const std::string& key) { return std::ranges::find(variants, key, &Variant::key) != variants.end(); };
        const bool is_smoothed = item.what == MarkedThing::smoothed, is_uniform = item.settings.laplacian == OperatorKind::uniform;
        const bool has_operator = is_smoothed || item.what == MarkedThing::H || item.what == MarkedThing::eigenvalues;
        EXPECT_EQ(can_be_made("lambda_negated"), is_smoothed) << thing;
        EXPECT_EQ(can_be_made("valence_sum"), item.what == MarkedThing::H_uniform || (has_operator && is_uniform)) << thing;
        if (has_operator && !is_uniform) {
            for (const char* key : {"half_kept", "unclamped", "operator_edge-normalised", "area_voronoi", "without_area"})
                EXPECT_TRUE(can_be_made(key)) << thing << ": " << key;
        }
        const auto expect_named = [&](const Vector& values, const ConventionKeys& keys) {
            if (agreement_of({values}, one.reference.right, item.tolerance).worst <= 2 * item.tolerance)
                return;   // no difference on this mesh
            const ItemMark mark = one.mark(values);
            EXPECT_EQ(mark.verdict, Verdict::recognised) << thing << ": " << keys.front();
            EXPECT_TRUE(names(mark.conventions, keys)) << thing << ": " << keys.front() << ": " << explanation_of(mark);
            EXPECT_EQ(mark.score, 4);
        };
        for (const ValueConvention& convention : value_conventions(item.what))
            if (convention.keys.size() == 1) expect_named(convention.apply(one.right), convention.keys);
        EXPECT_FALSE(variants.empty()) << thing;
        for (const Variant& variant : variants)
            if (variant.values.allFinite() || item.what != MarkedThing::smoothed) expect_named(variant.values, {variant.key});
    }
}

TEST(Marking, AWrongSignOfAnImplicitStepIsRecognised) {
    OneItem one("what = \"smoothed\"\nscheme = \"implicit\"\nlambda = 5\niterations = 3");
    const TriangleMesh& mesh = one.reference.mesh->mesh();
    const LaplaceBeltrami L = laplace_operator(mesh, OperatorKind::cotan);
    const double lambda = 5 * largest_stable_step(largest_eigenvalue(L));
    const Eigen::MatrixXd system = Eigen::MatrixXd(L.M.asDiagonal()) + lambda * Eigen::MatrixXd(L.C);   // dense, with pivots
    const Eigen::PartialPivLU<Eigen::MatrixXd> factor(system);
    Eigen::MatrixXd X = mesh.X;
    for (int i = 0; i < 3; ++i) X = factor.solve((L.M.asDiagonal() * X).eval()).eval();
    EXPECT_TRUE(names(one.mark(flat(X)).conventions, {"lambda_negated"}));
}

TEST(Marking, RoundedDigitsCostNoPoints) {
    OneItem one("what = \"H_uniform\"\naccept = \"negated\"");
    const auto mark_with = [&](double factor, int decimals) {
        std::ostringstream csv;
        csv << "v\n" << std::fixed << std::setprecision(decimals);
        for (const double value : one.right) csv << factor * value << "\n";
        return one.mark({{"a.csv", csv.str()}});
    };
    for (const int decimals : {6, 9, 17}) {
        EXPECT_EQ(mark_with(1, decimals).verdict, Verdict::right) << decimals << ": " << explanation_of(mark_with(1, decimals));
        EXPECT_EQ(mark_with(-1, decimals).verdict, Verdict::accepted) << decimals;
        EXPECT_TRUE(names(mark_with(2, decimals).conventions, {"doubled"})) << decimals;
        EXPECT_EQ(mark_with(1.02, decimals).verdict, Verdict::wrong) << decimals;
    }
    EXPECT_EQ(mark_with(1, 1).verdict, Verdict::wrong) << "0.0 for all says nothing";
}

TEST(Marking, FilesAreFoundInAnyCaseAndTooLargeOnesAreUnusable) {
    OneItem one("what = \"H\"\nfile = \"q1_*.csv\"");
    const std::string table = files_with(one.right, one.reference, one.item.what).at("a.csv");
    EXPECT_EQ(one.mark({{"Q1_LILY.CSV", table}}).verdict, Verdict::right);
    EXPECT_EQ(one.mark({{"Q1_OLD.CSV", "H\n"}, {"q1_lily.csv", table}}).verdict, Verdict::right) << "as it is asked for comes first";
    EXPECT_EQ(one.mark({{"q1_lily.csv", table + std::string(std::size_t{1} << 23, '\n')}}).verdict, Verdict::unusable);
}

TEST(Marking, AnotherChoiceOfEqualModesIsRight) {
    for (const int k : {2, 3}) {   // of three modes with equal eigenvalues, which are nearly the coordinates
        OneItem one("what = \"reconstruction\"\narea = \"voronoi\"\nk = " + std::to_string(k) + "\n", "cube8.obj");
        ASSERT_TRUE(one.reference.equal.has_value());
        const EqualModes& equal = *one.reference.equal;
        ASSERT_EQ(equal.modes.cols(), 3);
        const Eigen::Matrix3d some = (Eigen::Matrix3d() << 1, 2, 3, -1, 1, 4, 2, 0, 1).finished(),
                              turn = some.householderQr().householderQ();
        const DenseMatrix modes = equal.modes * turn;
        const auto verdict_of = [&](Eigen::Index taken) {
            const DenseMatrix chosen = modes.leftCols(taken);
            return one.mark(flat(equal.below + chosen * (chosen.transpose() * equal.M.asDiagonal() * equal.X))).verdict;
        };
        for (const int taken : {0, 1, 2, 3}) EXPECT_EQ(verdict_of(taken) == Verdict::right, taken == equal.taken) << k << ": " << taken;
    }
}

TEST(Marking, RowsWithVertexNumbersMayComeInAnyOrder) {
    OneItem one("what = \"K\"");
    const auto verdict_with = [&](int first, bool twice) {
        std::string csv = "vertex,v\n";
        for (Eigen::Index i = one.right.size() - 1; i >= 0; --i)
            csv += std::to_string(twice ? i / 2 : i + first) + "," + exact_text(one.right[i]) + "\n";
        return one.mark({{"a.csv", csv}}).verdict;
    };
    EXPECT_EQ(verdict_with(0, false), Verdict::right);
    EXPECT_EQ(verdict_with(1, false), Verdict::right);
    EXPECT_EQ(verdict_with(0, true), Verdict::wrong);
}

TEST(Marking, WrongAnswersAreNotRecognised) {
    for (const std::string& thing : marked_things) {
        OneItem one(thing);
        Vector values = one.right;
        for (Eigen::Index i = 0; i < values.size(); ++i) values[i] *= 1 + 0.1 * (i % 7);
        const ItemMark mark = one.mark(values);
        EXPECT_EQ(mark.verdict, Verdict::wrong) << thing << ": " << explanation_of(mark);
        EXPECT_EQ(mark.score, 0) << thing;
    }
}

TEST(Marking, ReversedTrianglesAreRecognised) {
    OneItem one("what = \"reconstruction\"\nk = 6");
    if (one.reference.mesh->prepared->preflight.flipped_faces > 0) GTEST_SKIP() << "the file itself is turned";
    TriangleMesh turned = one.reference.mesh->mesh();
    turned.X = Eigen::Map<const Positions>(one.right.data(), turned.X.rows(), 3);
    turned.F.col(1).swap(turned.F.col(2));
    const ItemMark mark = one.mark({{"a.ply", encode_mesh(turned, "a.ply")}});
    EXPECT_TRUE(names(mark.conventions, {"reversed_faces"})) << explanation_of(mark);
}

TEST(Marking, UnusableFilesAreReportedWithTheirItem) {
    OneItem one("what = \"H\""), of_mesh("what = \"smoothed\"");
    const auto verdict = [&](const submission::HandedIn& files) { return one.mark(files).verdict; };
    EXPECT_EQ(verdict({}), Verdict::missing);
    EXPECT_EQ(verdict({{"a.csv", ""}}), Verdict::unusable);
    EXPECT_EQ(verdict({{"a.csv", "w\n1\n"}}), Verdict::unusable);
    EXPECT_EQ(verdict({{"a.csv", "v\n1\n"}}), Verdict::unusable) << "too few rows";
    EXPECT_EQ(of_mesh.mark({{"a.ply", "ply\nformat ascii 1.0\nelement vertex 999999999\n"}}).verdict, Verdict::unusable);
}

TEST(Marking, NumbersAreReadFromTheAnswersFile) {
    OneItem one("what = \"number\"\naccept = \"negated\"");
    const auto mark_for = [&](const std::string& answers) { return one.mark({{answers_file, answers}}); };
    EXPECT_EQ(mark_for("a = 3").score, 8);
    EXPECT_EQ(mark_for("[a]\nvalue = -3.0").verdict, Verdict::accepted);
    EXPECT_EQ(mark_for("a = 6").conventions, std::vector<ConventionKeys>{{"doubled"}});
    EXPECT_EQ(mark_for("a = 4").score, 0);
    EXPECT_EQ(mark_for("no TOML").verdict, Verdict::missing);
}

TEST(Marking, EveryConventionHasItsSentence) {
    const Reference reference;
    const Rubric rubric = rubric_of("what = \"H\"");
    for (const std::string& key : convention_keys()) {
        ItemMark mark;
        mark.item = &rubric.items.front();
        mark.reference = &reference;
        mark.verdict = Verdict::recognised;
        mark.conventions = {{key}};
        EXPECT_NO_THROW(EXPECT_GT(explanation_of(mark).size(), 60u)) << key;
    }
}

TEST(Marking, PagesAndTablesShowTheMarks) {
    OneItem one("what = \"K\"");
    const Rubric& rubric = one.rubric;
    StudentMarks wrong = one.marks(3 * one.right), right = one.marks(one.right), refused;
    wrong.id = "eve", right.id = "ada", refused.id = "bob";
    right.source = "=ada<u>", refused.refused = "is a link";
    const report::Templates templates;
    const std::string page = student_page(wrong, rubric, templates);
    EXPECT_NE(page.find("data:image/jpeg;base64,/9j/"), std::string::npos);
    EXPECT_EQ(student_page(right, rubric, templates).find("<u>"), std::string::npos);
    EXPECT_NE(student_page(refused, rubric, templates).find("is a link"), std::string::npos);
    EXPECT_NE(student_json(right, rubric).find("\"status\": \"passed\""), std::string::npos);
    EXPECT_EQ(class_csv({wrong, right, refused}, rubric),
              "student,submission,score,max_score,a,a_verdict,remarks\n"
              "eve,,0,8,0,wrong,\nada,\"'=ada<u>\",8,8,8,right,\nbob,,0,8,0,refused,is a link\n");
}

TEST(Marking, AWrongNumberIsShownBesideTheRightOne) {
    OneItem one("what = \"number\"");   // its value is 3
    const auto said = [&](const std::string& answers) { return explanation_of(one.mark({{answers_file, answers}})); };
    EXPECT_EQ(said("a = 2.85"), "You wrote 2.85; right is 3 (5\u202f% off).");
    EXPECT_EQ(said("a = 4.5"), "You wrote 4.5; right is 3 (50\u202f% off).");
}

TEST(Marking, RightItemsAreFoldedAndWrongItemsOpen) {
    OneItem one("what = \"K\"");
    const std::string right = student_page(one.marks(one.right), one.rubric, report::Templates());
    const std::string wrong = student_page(one.marks(3 * one.right), one.rubric, report::Templates());
    EXPECT_NE(right.find("<details class=\"item-of-marks right\" id=\"a\">"), std::string::npos);
    EXPECT_EQ(right.find("open=\"open\""), std::string::npos);
    EXPECT_NE(wrong.find("<details class=\"item-of-marks lost\" id=\"a\" open=\"open\">"), std::string::npos);
}

TEST(Marking, TheClassPageHasACellPerItemAndNamesTheCommonMistake) {
    OneItem one("what = \"K\"");
    std::vector<StudentMarks> students{one.marks(2 * one.right), one.marks(one.right), one.marks(-one.right), one.marks(2 * one.right), {}};
    students.back().refused = "is a link";
    const std::string page = class_page(students, one.rubric, report::Templates());
    const auto count = [&](const std::string& part) {
        int found = 0;
        for (std::size_t at = page.find(part); at != std::string::npos; at = page.find(part, at + 1)) ++found;
        return found;
    };
    EXPECT_EQ(count("<td class=\"mark right\""), 1);
    EXPECT_EQ(count("<td class=\"mark partial\""), 3);
    EXPECT_EQ(count("is a link"), 1);
    EXPECT_EQ(count("2 of 5: all values are twice the right ones"), 1) << page;
}

TEST(Rubrics, TheBundledRubricIsValidAndItsMeshesExist) {
    const Rubric rubric = read_rubric("");
    EXPECT_GT(rubric.items.size(), 5u);
    EXPECT_NO_THROW(References{rubric});
}

TEST(Rubrics, EveryProblemIsReportedWithItsLine) {
    try {
        parse_rubric("[[item]]\nid = \"a\"\nwhat = \"Hx\"\npoints = -1\nacept = \"negated\"\n", "r.toml");
        FAIL();
    } catch (const SettingsErrors& errors) {
        EXPECT_GE(errors.problems().size(), 4u);
        EXPECT_TRUE(std::string(errors.what()).starts_with("r.toml:")) << errors.what();
    }
    EXPECT_THROW(parse_rubric("", "r.toml"), SettingsErrors);
}

TEST(Rubrics, StudentsChooseOnlyFreeSettings) {
    const Rubric rubric = rubric_of("what = \"smoothed\"\nfree = \"iterations\"");
    std::vector<std::string> problems;
    const auto answers = parse_answers("[a]\niterations = 7\nlambda = 9\n", rubric, problems);
    EXPECT_EQ(answers.at("a").settings.iterations, 7);
    EXPECT_EQ(answers.at("a").settings.lambda, rubric.items.front().settings.lambda);
    EXPECT_EQ(problems.size(), 1u);
    problems.clear();
    EXPECT_EQ(parse_answers("[a]\niterations = 1000\n", rubric, problems).at("a").settings.iterations, 1) << "would take too long";
    EXPECT_EQ(problems.size(), 1u);
}
