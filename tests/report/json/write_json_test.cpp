#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "report/json/read_json.h"
#include "report/sample_document.h"
#include "report/writers.h"

namespace meshfolio::report {
namespace {

using nlohmann::json;

bool is_valid(const json& document) {
    static const json text = json::parse(Templates()["results.schema.json"]);
    valijson::Schema schema;
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(valijson::adapters::NlohmannJsonAdapter(text), schema);
    valijson::Validator validator;
    return validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(document), nullptr);
}

json written(const Document& document, const DrawnFigures& figures, const WriteOptions& options = {}) {
    return json::parse(write_json(document, figures, options));
}

json sample() { return written(sample_document(), sample_figures()); }

TEST(WriteJson, SampleFollowsTheSchema) { EXPECT_TRUE(is_valid(sample())); }

TEST(WriteJson, EmptyDocumentFollowsTheSchema) { EXPECT_TRUE(is_valid(written({}, {}))); }

TEST(WriteJson, HostileNamesFollowTheSchemaAndComeBack) {
    const json document = written(hostile_document(), hostile_figures());
    EXPECT_TRUE(is_valid(document));
    EXPECT_NE(document["title"].get<std::string>().find("<script>alert(1)</script>|\"'`*_x_*"), std::string::npos);
}

TEST(WriteJson, TheSchemaRefusesBrokenFiles) {
    const auto broken = [](auto change) {
        json document = sample();
        change(document);
        return document;
    };
    EXPECT_FALSE(is_valid(broken([](json& d) { d.erase("schema_version"); })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["schema_version"] = 2; })));
    EXPECT_TRUE(is_valid(broken([](json& d) { d["surplus"] = 1; }))) << "it may be added";
    EXPECT_FALSE(is_valid(broken([](json& d) { d["provenance"].erase("inputs"); })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["status"] = "fine"; })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["checks"][0]["expected"] = "2"; })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["checks"][0]["passed"] = 1; })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["checks"][0]["passed"] = nullptr; }))) << "it passed";
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["checks"][4]["passed"] = false; }))) << "it is undecided";
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["checks"][4].erase("note"); }))) << "why is not said";
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["tables"][0]["rows"][0][0] = true; })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["plots"][0]["series"][0].erase("y_high"); })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0].erase("maps"); })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["maps"][0]["panels"][0]["values"][0] = 1; })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["maps"][0]["panels"][1].erase("lines"); })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][0]["output_meshes"][0] = "/absolute.ply"; })));
    EXPECT_FALSE(is_valid(broken([](json& d) { d["questions"][1].erase("failure"); })));
}

TEST(WriteJson, ColumnsHaveIdsOfTheirOwnAndTheSchemaIsNamedByItsVersion) {
    std::set<std::string> ids;
    const json document = sample();
    for (const char* kind : {"questions", "supporting"})
        for (const json& section : document[kind])
            for (const json& table : section["tables"])
                for (const json& column : table["columns"]) {
                    const std::string id = column["id"];
                    EXPECT_TRUE(id.starts_with(table["id"].get<std::string>() + "-")) << id;
                    EXPECT_TRUE(ids.insert(id).second) << id;
                }
    EXPECT_FALSE(ids.empty());
    Table table{.id = "q5_limits", .columns = {{"mesh"}, {"λ_crit/h̄²"}, {"after"}, {"λ"}, {"After"}}};
    EXPECT_EQ(column_ids(table), (std::vector<std::string>{"q5_limits-mesh", "q5_limits-lambda-crit-h", "q5_limits-after",
                                                           "q5_limits-lambda", "q5_limits-after-2"}));
    const json schema = json::parse(results_schema());
    EXPECT_EQ(schema["$id"], "urn:meshfolio:results:" + schema["properties"]["schema_version"]["minimum"].dump());
}

TEST(WriteJson, ParametersAreNumbersWithUnitsBesideTheirText) {
    Document document = sample_document();
    document.sections[0].parameters = {{"area form", "barycentric"},
                                       {"iterations", 20},
                                       {"λ", {"0.1 and 0.25 h̄²", std::vector{0.1, 0.25}, "h̄²"}},
                                       {"λ_crit of cube", {"0.00123", 0.00123456789, "length²"}}};
    const json whole = written(document, {}), question = whole["questions"][0];
    EXPECT_TRUE(is_valid(whole));
    EXPECT_EQ(question["parameters"],
              json::parse(R"({"area form": "barycentric", "iterations": "20", "λ": "0.1 and 0.25 h̄²", "λ_crit of cube": "0.00123"})"));
    EXPECT_EQ(question["parameter_values"], json::parse(R"([
        {"id": "q1-parameter-area-form", "name": "area form", "value": "barycentric", "unit": ""},
        {"id": "q1-parameter-iterations", "name": "iterations", "value": 20.0, "unit": ""},
        {"id": "q1-parameter-lambda", "name": "λ", "value": [0.1, 0.25], "unit": "h̄²"},
        {"id": "q1-parameter-lambda-crit-of-cube", "name": "λ_crit of cube", "value": 0.00123456789, "unit": "length²"}])"));
    EXPECT_EQ(write_json(read_json(whole.dump(), "results.json").document, {}), write_json(document, {}));
    json broken = whole;
    broken["questions"][0]["parameter_values"][1]["value"] = true;
    EXPECT_FALSE(is_valid(broken));
}

TEST(WriteJson, QuestionsKeepTheirOrderAndStatus) {
    const json questions = sample()["questions"];
    ASSERT_EQ(questions.size(), 3u);
    ASSERT_EQ(sample()["supporting"].size(), 1u);
    EXPECT_EQ(sample()["supporting"][0]["id"], "ground_truth");
    EXPECT_EQ(questions[0]["id"], "q1");
    EXPECT_EQ(questions[0]["status"], "ok");
    EXPECT_EQ(questions[1]["status"], "failed");
    EXPECT_EQ(questions[1]["failure"], "ellipsoid.obj:3: not a number");
    EXPECT_EQ(questions[2]["status"], "skipped");
}

TEST(WriteJson, ColumnsOfReferencesHoldIds) { EXPECT_EQ(sample()["questions"][0]["tables"][2]["rows"][0][0], "q1_errors"); }

TEST(WriteJson, ChecksHoldNumbers) {
    const json check = sample()["questions"][0]["checks"][0];
    EXPECT_EQ(check["expected"].get<double>(), 2);
    EXPECT_EQ(check["measured"].get<double>(), 2 + 1e-13);   // every bit
    EXPECT_EQ(check["tolerance"].get<double>(), 1e-10);
    EXPECT_EQ(check["passed"], true);
}

TEST(WriteJson, NumbersThatAreNotFiniteAreNull) {
    const json question = sample()["questions"][0];
    EXPECT_TRUE(question["checks"][3]["measured"].is_null());
    const json rows = question["tables"][0]["rows"];
    EXPECT_TRUE(rows[3][2].is_null());   // NaN
    EXPECT_TRUE(rows[3][3].is_null());   // infinity
    EXPECT_TRUE(rows[2][3].is_null());   // no value
    EXPECT_TRUE(question["plots"][0]["series"][0]["y"][5].is_null());
}

TEST(WriteJson, MapsHaveARowForEachY) {
    const json map = sample()["questions"][0]["maps"][0];
    EXPECT_EQ(map["x"].size(), 3u);
    const json values = map["panels"][0]["values"];
    ASSERT_EQ(values.size(), map["y"].size());
    for (const json& row : values) EXPECT_EQ(row.size(), map["x"].size());
    EXPECT_EQ(values[1][0], 1.0);
    EXPECT_TRUE(values[1][2].is_null());
    EXPECT_EQ(map["panels"][0]["lines"][0]["name"], "λ_crit");
    EXPECT_EQ(map["panels"][0]["markers"][0]["label"], "a");
}

TEST(WriteJson, FiguresNameTheirPicturesOrNone) {
    const json figures = sample()["questions"][0]["figures"];
    EXPECT_EQ(figures[0]["sheet"], "images/q1_plane_h_sheet.png");
    EXPECT_EQ(figures[0]["panels"][1]["pictures"].size(), 7u);
    EXPECT_EQ(figures[0]["panels"][1]["pictures"][1]["file"], "images/q1_plane_k_+x.png");
    EXPECT_FALSE(figures[0]["panels"][1]["pictures"][0].contains("file"));
    EXPECT_TRUE(figures[1]["sheet"].is_null());
}

TEST(WriteJson, SeedKeepsAll64Bits) { EXPECT_EQ(sample()["provenance"]["seed"].get<std::uint64_t>(), 18446744073709551615ull); }

TEST(WriteJson, EveryInputMeshIsNamedOnceWithItsHash) {
    Document document = sample_document();
    document.sections[1].inputs = document.sections[0].inputs;
    EXPECT_EQ(written(document, {})["provenance"]["inputs"].size(), 2u);
}

// Only "timings" may differ from run to run.
TEST(WriteJson, TimingsCanBeLeftOut) {
    EXPECT_TRUE(sample().contains("timings"));
    EXPECT_TRUE(sample()["questions"][0].contains("timings"));
    const WriteOptions without{.timings = false};
    EXPECT_EQ(write_json(sample_document(), {}, without).find("timings"), std::string::npos);
    Document slower = sample_document();
    slower.timings = {{"everything", 99}};
    slower.sections[0].timings = {};
    EXPECT_EQ(write_json(sample_document(), {}, without), write_json(slower, {}, without));
    EXPECT_TRUE(is_valid(written(sample_document(), {}, without)));
}

}   // namespace
}   // namespace meshfolio::report
