// results.json of earlier versions, brought to the present one before it is read.
#include "base/in_quotes.h"
#include "report/json/json_reader.h"

namespace meshfolio::report {

namespace {

/// Every object in the list of that name, where there is one.
template <class Change>
void for_each_in(Json& object, const char* key, const Change& change) {
    const auto list = object.find(key);
    if (list == object.end() || !list->is_array()) return;
    for (Json& one : *list)
        if (one.is_object()) change(one);
}

template <class Change>
void for_each_section(Json& results, const Change& change) {
    for (const char* key : {"questions", "supporting"}) for_each_in(results, key, change);
}

/// 3: a check may be undecided, and has a status.
void give_status(Json& results) {
    for_each_section(results, [](Json& section) {
        for_each_in(section, "checks", [](Json& check) {
            const auto passed = check.find("passed");
            if (passed != check.end() && passed->is_boolean()) check["status"] = passed->get<bool>() ? "passed" : "failed";
        });
    });
}

/// 4: a section has an answer in place of its findings; the one of most weight is it. Pictures are cut out of the sheet, each from its
/// place; without these, and the names of single views, a figure is its whole sheet.
void give_answer(Json& results) {
    for_each_section(results, [](Json& section) {
        double most = 0;
        Json answer;
        for_each_in(section, "findings", [&](const Json& finding) {
            const auto runs = finding.find("runs"), weight = finding.find("weight");
            if (runs == finding.end() || weight == finding.end() || !weight->is_number()) return;
            if (!answer.is_null() && weight->get<double>() <= most) return;
            most = weight->get<double>();
            answer = *runs;
        });
        if (!answer.is_null()) section["answer"] = answer;
    });
}

constexpr int oldest_version = 2;   // the first, which knew no text, held the numbers alone
constexpr void (*upgrades[])(Json&) = {give_status, give_answer};
static_assert(oldest_version + std::size(upgrades) == schema_version, "an upgrade a version");

}   // namespace

void upgrade_json(Json& results) {
    const JsonPlace root;
    const auto version = results.is_object() ? results.find("schema_version") : results.end();
    if (!results.is_object() || version == results.end())
        throw JsonProblem(root, "is no results.json", "name the results.json of a report");
    for (int known = oldest_version; known <= schema_version; ++known) {
        if (*version != known) continue;
        for (int i = known - oldest_version; i < static_cast<int>(std::size(upgrades)); ++i) upgrades[i](results);
        results["schema_version"] = schema_version;
        return;
    }
    const std::string words = "is " + in_quotes(version->dump(-1, ' ', true, Json::error_handler_t::replace)) + ", not " +
                              std::to_string(oldest_version) + " to " + std::to_string(schema_version);
    throw JsonProblem({&root, "schema_version"}, *version == 1 ? words + ": it holds no text" : words,
                      "make the report anew, or take the meshfolio that made it");
}

}   // namespace meshfolio::report
