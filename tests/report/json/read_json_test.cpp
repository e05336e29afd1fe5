#include "report/json/read_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "base/errors.h"
#include "base/file_bytes.h"
#include "report/sample_document.h"
#include "report/writers.h"
#include "source_dir.h"

namespace meshfolio::report {
namespace {

using Json = nlohmann::ordered_json;

/// Replaces NaN, which is not equal to itself, by a number that nothing else has.
void replace_nan(double& x) {
    if (std::isnan(x)) x = -12345.678e200;
}
void replace_nan(std::vector<double>& values) {
    for (double& x : values) replace_nan(x);
}
void replace_nan(Series& series) {
    for (auto* values : {&series.x, &series.y, &series.y_low, &series.y_high}) replace_nan(*values);
}
void replace_nan(Block& block) {
    if (auto* table = std::get_if<Table>(&block)) {
        for (auto& row : table->rows) {
            for (Cell& cell : row) {
                if (auto* x = std::get_if<double>(&cell)) replace_nan(*x);
            }
        }
    }
    if (auto* plot = std::get_if<Plot>(&block)) {
        for (Series& series : plot->series) replace_nan(series);
    }
    if (auto* map = std::get_if<Map>(&block)) {
        for (Map::Panel& panel : map->panels) replace_nan(panel.values);
    }
    if (auto* diagram = std::get_if<Diagram>(&block)) {
        for (Diagram::Panel& panel : diagram->panels) {
            for (Diagram::Path& path : panel.paths) {
                replace_nan(path.x);
                replace_nan(path.y);
            }
        }
    }
}
Document without_nan(Document document) {
    for (Section& section : document.sections) {
        for (Block& block : section.blocks) replace_nan(block);
        for (Check& check : section.checks) {
            for (double* x : {&check.expected, &check.measured, &check.tolerance}) replace_nan(*x);
        }
    }
    return document;
}

/// The sample document with other values than the defaults.
Document rich_document() {
    Document document = sample_document();
    Section& section = document.sections[0];
    section.code[0].line = 420;
    for (Block& block : section.blocks) {
        if (auto* table = std::get_if<Table>(&block)) {
            table->columns[0].rounding = Column::Rounding::down;
            table->columns[1].rounding = Column::Rounding::up;
        }
        if (auto* map = std::get_if<Map>(&block)) {
            map->colours = Map::Colours::diverging;
            map->middle = 1.5;
            map->range = Map::Range{0.25, 8};
            map->panels[0].values[0] = INFINITY;
            map->panels[0].values[1] = -INFINITY;
        }
        if (auto* diagram = std::get_if<Diagram>(&block)) {
            diagram->panels[0].paths[0].x[1] = NAN;
            diagram->panels[0].paths[0].y[2] = -INFINITY;
        }
        if (auto* plot = std::get_if<Plot>(&block)) {
            plot->series[0].style = Series::Style::points;
            plot->series[0].y[1] = -INFINITY;
            plot->markers[0].y = INFINITY;
            plot->series[1].panel = plot->markers[0].panel = "sphere";
        }
    }
    section.checks[0].measured = -INFINITY;
    return document;
}

DrawnFigures rich_figures() {
    DrawnFigures figures = sample_layouts();
    figures["q1_plane_h"].models = {{"", "models/a.glb", "", "H [1/length]"}, {"after", "models/b.glb", "", ""}};
    return figures;
}

DrawnFigures names_only(DrawnFigures figures) {
    for (auto& [id, figure] : figures) {
        for (DrawnPanel& panel : figure.panels)
            for (DrawnPicture& picture : panel.pictures) picture.jpeg.clear();
        for (DrawnModel& model : figure.models) model.glb.clear();
    }
    return figures;
}

ReadReport read(const std::string& text) { return read_json(text, "results.json"); }

/// Returns the message with which a changed sample is refused; empty if it is read.
std::string refusal(const std::function<void(Json&)>& change) {
    Json json = Json::parse(write_json(rich_document(), rich_figures()));
    change(json);
    try {
        read(json.dump(1) + "\n");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool says(const std::string& message, const std::string& words) { return message.find(words) != std::string::npos; }

// ---- laws ---------------------------------------------------------------------------------------------------------------

TEST(ReadJson, ReadsBackTheDocumentThatWasWritten) {
    for (const Document& document : {sample_document(), rich_document(), Document{}}) {
        const ReadReport back = read(write_json(document, rich_figures()));
        EXPECT_EQ(without_nan(back.document), without_nan(document));
        EXPECT_TRUE(back.timings);
    }
    EXPECT_EQ(read(write_json(rich_document(), rich_figures())).figures, names_only(rich_figures()));
}

TEST(ReadJson, ReadsBackTheWordsOfASheet) {
    Document document = sample_document();
    document.sections[0].number = "3b";
    document.sections[0].points = 7.5;
    document.sections[0].intro = "Compute *it*.";
    document.pages = {{"Page", "Text", "q1"}, {"", "", ""}};
    EXPECT_EQ(without_nan(read(write_json(document, rich_figures())).document), without_nan(document));
    EXPECT_TRUE(
        says(refusal([](Json& json) { json["questions"][0]["intro"] = "**open"; }), "questions[0].intro has a text that cannot be read"));
    EXPECT_TRUE(says(refusal([](Json& json) {
                         json["pages"] = {{{"title", ""}, {"text", "{{x}}"}, {"before", ""}}};
                     }),
                     "pages has a text"));
}

TEST(ReadJson, WritesTheSameBytesAgain) {
    for (const Document& document : {sample_document(), rich_document(), hostile_document(), Document{}}) {
        for (const bool timings : {true, false}) {
            const std::string text = write_json(document, rich_figures(), {.timings = timings});
            const ReadReport back = read(text);
            EXPECT_EQ(back.timings, timings);
            EXPECT_EQ(write_json(back.document, back.figures, {.timings = timings}), text);
        }
    }
}

TEST(ReadJson, PagesOfTheReadReportAreTheSame) {
    const DrawnFigures figures = names_only(rich_figures());
    const ReadReport back = read(write_json(rich_document(), figures));
    EXPECT_EQ(write_html(back.document, back.figures, Templates()), write_html(rich_document(), figures, Templates()));
    EXPECT_EQ(write_markdown(back.document, back.figures, Templates()), write_markdown(rich_document(), figures, Templates()));
}

TEST(ReadJson, EmptyCellsNanAndInfinitiesStayApart) {
    Document document = sample_document();
    const ReadReport back = read(write_json(document, {}));
    const auto& rows = std::get<Table>(back.document.sections[0].blocks[8]).rows;
    EXPECT_TRUE(std::holds_alternative<std::monostate>(rows[2][3]));
    EXPECT_TRUE(std::isnan(std::get<double>(rows[3][2])));
    EXPECT_EQ(std::get<double>(rows[3][3]), INFINITY);
}

// ---- refusals -----------------------------------------------------------------------------------------------------------

TEST(ReadJson, NamesPlaceAndLineOfAProblem) {
    const std::string message = refusal([](Json& d) { d["questions"][0]["tables"][0]["rows"][1][2] = true; });
    EXPECT_TRUE(says(message, "questions[0].tables[0].rows[1][2] is a truth value, not a number")) << message;
    const std::string text = write_json(sample_document(), {});
    std::string broken = text;
    broken.replace(broken.find("\"A. Student\""), 12, "17");
    const long line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(text.find("\"A. Student\"")), '\n');
    try {
        read(broken);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("results.json:" + std::to_string(line) + ": author is the integer 17, not a text", 0), 0u)
            << error.what();
    }
}

TEST(ReadJson, IgnoresUnknownKeys) {
    Json json = Json::parse(write_json(sample_document(), sample_figures()));
    json["surplus"] = 1;
    json["provenance"]["surplus"] = {{"a", 1}};
    json["questions"][0]["tables"][0]["columns"][0]["surplus"] = "x";
    json["questions"][0]["blocks"][0]["surplus"] = nullptr;
    const ReadReport read = read_json(json.dump(), "results.json");
    EXPECT_EQ(write_json(read.document, read.figures), write_json(sample_document(), sample_figures()));
}

/// Changes bytes at random and expects a report that can be written again, or a refusal.
void expect_read_or_refused(const std::string& whole, int changes) {
    std::mt19937 random(7);
    for (int round = 0; round < 400; ++round) {
        std::string damaged = whole;
        for (int i = 0; i < changes; ++i) damaged[random() % damaged.size()] = "0{}[]\",:-1ae\\\x80"[random() % 15];
        try {
            const ReadReport back = read(damaged);
            EXPECT_FALSE(write_json(back.document, back.figures).empty());
        } catch (const InputError&) {
        }
    }
}

TEST(ReadJson, RefusesMissingAndUnknownValues) {
    EXPECT_TRUE(says(refusal([](Json& d) { d.erase("author"); }), "has no 'author'"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["tables"][0]["columns"][0].erase("digits"); }), "columns[0] has no 'digits'"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["tables"][0]["columns"][0].erase("id"); }), "columns[0] has no 'id'"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][1].erase("failure"); }), "questions[1] has no 'failure'"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["checks"][0]["kind"] = "nearly"; }), "it may be near, at_most, at_least"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["blocks"][1]["text"][1] = {{"bold", "x"}}; }), "'bold'"));
}

TEST(ReadJson, RefusesOtherVersions) {
    EXPECT_TRUE(says(refusal([](Json& d) { d["schema_version"] = 2; }), "schema_version is '2', not 1"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["schema_version"] = 0; }), "schema_version is '0', not 1"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["schema_version"] = "1"; }), "schema_version"));
    EXPECT_TRUE(says(refusal([](Json& d) { d.erase("schema_version"); }), "is no results.json"));
    EXPECT_TRUE(says(refusal([](Json& d) { d = Json::array(); }), "is no results.json"));
}

TEST(ReadJson, RefusesDuplicateIdsAndDanglingReferences) {
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][1]["id"] = "q1"; }), "uses the id 'q1' a second time"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["blocks"].push_back({{"kind", "table"}, {"id", "q1_none"}}); }), "'q1_none'"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["blocks"].erase(6); }), "not the next"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["blocks"].erase(14); }), "has more entries than the section's `blocks` name"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["tables"][0]["id"] = "../../etc/passwd"; }), "is no id"));
}

TEST(ReadJson, RefusesInconsistentValues) {
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["tables"][0]["rows"][3].push_back(1); }), "has 6 cells"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["tables"][0]["columns"][0]["digits"] = 100000; }), "it may be 1 to 17"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["plots"][0]["series"][0]["x"].push_back(1); }), "different lengths"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["maps"][0]["x"].push_back(100); }), "a number for each x"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["checks"][0]["passed"] = false; }), "does not agree with the values"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["provenance"]["inputs"][0]["sha256"] = "0"; }), "does not list the inputs"));
    EXPECT_TRUE(
        says(refusal([](Json& d) { d["questions"][0]["diagrams"][0]["panels"][0]["paths"][0]["x"].push_back(1); }), "different lengths"));
    EXPECT_TRUE(
        says(refusal([](Json& d) { d["questions"][0]["maps"][0]["panels"][0]["values_not_finite"][0][0] = 4; }), "listed as not finite"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["tables"][0]["rows_not_finite"] = 4; }),
                     "broken list of numbers that are not finite"));
    EXPECT_TRUE(says(refusal([](Json& d) { d["questions"][0]["parameter_values"][0]["name"] = "x"; }), "'x', which is no parameter"));
}

TEST(ReadJson, RefusesPathsThatLeaveTheReport) {
    for (const char* path : {"/etc/passwd", "../secret.png", "images/../../secret.png", "", "images//a.png"}) {
        EXPECT_TRUE(says(refusal([&](Json& d) { d["questions"][0]["figures"][0]["sheet"] = path; }), "inside the report")) << path;
        EXPECT_TRUE(says(refusal([&](Json& d) { d["questions"][0]["figures"][0]["panels"][0]["pictures"][1]["file"] = path; }),
                         "inside the report"))
            << path;
        EXPECT_TRUE(says(refusal([&](Json& d) { d["questions"][0]["output_meshes"][0] = path; }), "inside the report")) << path;
    }
}

TEST(ReadJson, RefusesHostileBytes) {
    const auto refuses = [](const std::string& text) { EXPECT_THROW(read(text), InputError); };
    for (const char* text : {"", "{", "null", "[]", "{}", "\xff\xfe", "{\"schema_version\": 1e999}"}) refuses(text);
    refuses(std::string(1 << 20, '['));
    refuses("{\"schema_version\":" + std::string(1 << 20, '{'));
    std::string nested = "{\"schema_version\":2,\"title\":";
    refuses(nested + std::string(100000, '[') + std::string(100000, ']') + "}");
    const std::string whole = write_json(rich_document(), rich_figures());
    for (std::size_t size = 0; size + 2 < whole.size(); size += 997) refuses(whole.substr(0, size));
}

// If a seed is refused, the fuzzer never reaches the rest of the reader.
TEST(ReadJson, ReadsTheSeedsOfTheFuzzer) {
    for (const char* name : {"no_questions", "sample"}) {
        const std::string file = std::string(MESHFOLIO_SOURCE_DIR "/tests/fuzz/seeds/results/") + name + ".json";
        EXPECT_NO_THROW((void)read_json(read_file(file), file));
    }
}

TEST(ReadJson, RefusesDamageOrReadsAWholeReport) { expect_read_or_refused(write_json(rich_document(), rich_figures()), 3); }

}   // namespace
}   // namespace meshfolio::report
