// The schema of results.json, from the descriptions of json_fields.h.
#include <typeindex>

#include "report/json/json_fields.h"
#include "report/json/json_writer.h"
#include "report/writers.h"

namespace meshfolio::report {

namespace {

/// The place where a type is described; later places refer to it.
using KnownTypes = std::map<std::type_index, std::string>;

/// The type of the lists of numbers that are not finite.
struct NotFinite {};

/// Returns rules that the keys alone do not express.
Json rules_of(const CheckEntry&) {
    return Json::parse(R"({"oneOf": [
        {"properties": {"status": {"const": "passed"}, "passed": {"const": true}}},
        {"properties": {"status": {"const": "failed"}, "passed": {"const": false}}},
        {"properties": {"status": {"const": "undecided"}, "passed": {"const": null}}, "required": ["note"]}]})");
}
Json rules_of(const Series&) { return Json::parse(R"({"dependencies": {"y_low": ["y_high"], "y_high": ["y_low"]}})"); }
Json rules_of(const SectionEntry&) {
    return Json::parse(R"({"if": {"properties": {"status": {"const": "failed"}}}, "then": {"required": ["failure"]}})");
}
template <class Part> Json rules_of(const Part&) { return Json::object(); }

class FieldSchema {
public:
    FieldSchema(Json& schema, std::string pointer, KnownTypes& known) : schema_(schema), pointer_(std::move(pointer)), known_(known) {
        schema_ = {{"type", "object"}, {"required", Json::array()}, {"properties", Json::object()}};
    }

    template <class Value> void operator()(const char* key, const Value& value, const Note& note = {}) {
        optional(key, value, value, note);
        require(key);
    }
    template <class Value> void optional(const char* key, const Value& value, const std::type_identity_t<Value>&, const Note& note = {}) {
        Json schema = schema_of(value, place(key));
        if (std::string_view(key) == "id") schema = identifier;
        if (note.is_file) schema = std::is_same_v<Value, std::string> ? inner_file : list_of(inner_file);
        if (note.least > std::numeric_limits<int>::min()) schema["minimum"] = note.least;
        if (note.most < std::numeric_limits<int>::max()) schema["maximum"] = note.most;
        add(key, std::move(schema), note, holds_numbers<Value>);
    }
    template <class Value> void optional(const char* key, const std::optional<Value>&, const Note& note = {}) {
        add(key, schema_of(Value(), place(key)), note, false);
    }
    template <class Value> void only_if(bool, const char* key, const Value& value, const Note& note = {}) {
        optional(key, value, value, note);
    }
    template <class Derive> void derived(const char* key, Derive derive, const Note& note = {}) {
        const auto value = derive();
        if constexpr (std::is_same_v<decltype(value), const char* const>) add(key, {{"const", value}}, note, false);
        else add(key, schema_of(value, place(key)), note, false);
        require(key);
    }
    void file_or_null(const char* key, const std::string&, bool, const Note& note = {}) {
        add(key, {{"type", {"string", "null"}}}, note, false);
        require(key);
    }
    template <class Part> static Json schema_of_part(const Part& part, const std::string& pointer, KnownTypes& known) {
        Json schema;
        FieldSchema fields(schema, pointer, known);
        describe(fields, part);
        schema.update(rules_of(part));
        return schema;
    }

private:
    static inline const Json identifier = {{"description", "unique in the document"}, {"type", "string"}, {"minLength", 1}};
    static inline const Json inner_file = {
        {"description", "relative to the folder of results.json"}, {"type", "string"}, {"pattern", "^[^/]"}};
    template <class Value>
    static constexpr bool holds_numbers =
        std::is_same_v<Value, double> || std::is_same_v<Value, std::vector<double>> || std::is_same_v<Value, decltype(Parameter::value)> ||
        std::is_same_v<Value, std::vector<std::vector<double>>> || std::is_same_v<Value, std::vector<std::vector<Cell>>>;
    Json& schema_;
    std::string pointer_;
    KnownTypes& known_;

    std::string place(const std::string& key) const { return pointer_ + "/properties/" + key; }
    void require(const char* key) { schema_["required"].push_back(key); }
    static Json list_of(Json item) { return {{"type", "array"}, {"items", std::move(item)}}; }

    void add(const std::string& key, Json schema, const Note& note, bool may_be_infinite) {
        if (*note.meaning != '\0') schema["description"] = note.meaning;
        schema_["properties"][key] = std::move(schema);
        if (may_be_infinite) schema_["properties"][key + not_finite] = schema_of(NotFinite(), place(key + not_finite));
    }

    static Json schema_of(bool, const std::string&) { return {{"type", "boolean"}}; }
    static Json schema_of(int, const std::string&) { return {{"type", "integer"}}; }
    static Json schema_of(std::uint64_t, const std::string&) { return {{"type", "integer"}}; }
    static Json schema_of(double, const std::string&) { return {{"type", {"number", "null"}}}; }   // null: undefined or not finite
    static Json schema_of(const std::string&, const std::string&) { return {{"type", "string"}}; }
    static Json schema_of(const std::optional<bool>&, const std::string&) { return {{"type", {"boolean", "null"}}}; }
    static Json schema_of(const Cell&, const std::string&) { return {{"type", {"number", "string", "null"}}}; }
    static Json schema_of(const decltype(Parameter::value)&, const std::string&) {
        return {{"type", {"number", "null", "string", "array"}}, {"items", {{"type", {"number", "null"}}}}};
    }
    static Json schema_of(const std::map<std::string, std::string>&, const std::string&) {
        return {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}};
    }
    template <class Item> Json schema_of(const std::vector<Item>&, const std::string& pointer) {
        return list_of(schema_of(Item(), pointer + "/items"));
    }
    template <class Value> Json schema_of(const Value& value, const std::string& pointer) {
        if constexpr (std::is_enum_v<Value>) {
            return {{"enum", names_of(value)}};
        } else {
            const auto [known, is_new] = known_.emplace(typeid(Value), pointer);
            if (is_new) return schema_of_new(value, pointer);
            return {{"$ref", "#" + known->second}};
        }
    }

    template <class Part> Json schema_of_new(const Part& part, const std::string& pointer) { return schema_of_part(part, pointer, known_); }
    Json schema_of_new(const NotFinite&, const std::string&) {
        return Json::parse(R"({"description": "the numbers of the value of that name that are not finite: [place in reading order, )"
                           R"(1: infinite, -1: minus infinite, 0: a cell that is NaN]; other NaN are null alone", "type": "array",)"
                           R"("items": {"type": "array", "items": {"type": "integer"}, "minItems": 2, "maxItems": 2}})");
    }
    Json schema_of_new(const Run&, const std::string&) {
        Json kinds = Json::object();
        for (const char* name : names_of(Run::Kind())) kinds[name] = {{"type", "string"}};
        kinds.erase(names_of(Run::Kind())[static_cast<std::size_t>(Run::Kind::plain)]);
        return {
            {"description", "a piece of text: plain, or one of the others"},
            {"oneOf",
             {{{"type", "string"}},
              {{"type", "object"}, {"minProperties", 1}, {"maxProperties", 1}, {"additionalProperties", false}, {"properties", kinds}}}}};
    }
    /// Describes each kind of block with its own keys.
    Json schema_of_new(const BlockEntry&, const std::string& pointer) {
        Json kinds = Json::array();
        for (const char* name : names_of(BlockEntry::Kind())) {
            BlockEntry block;
            block.kind = static_cast<BlockEntry::Kind>(kinds.size());
            Json one = schema_of_part(block, pointer + "/oneOf/" + std::to_string(kinds.size()), known_);
            one["properties"]["kind"] = {{"const", name}};
            kinds.push_back(std::move(one));
        }
        return {{"oneOf", std::move(kinds)}};
    }
};

}   // namespace

const std::string& results_schema() {
    static const std::string text = [] {
        KnownTypes known;
        Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                       {"$id", "urn:meshfolio:results:" + std::to_string(schema_version)},
                       {"title", "results.json of meshfolio"},
                       {"description", "later versions may add keys: readers ignore unknown ones"}};
        schema.update(FieldSchema::schema_of_part(ReportEntry(), "", known));
        return schema.dump(1) + "\n";
    }();
    return text;
}

}   // namespace meshfolio::report
