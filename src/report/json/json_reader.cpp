#include "report/json/json_reader.h"

#include <algorithm>

#include "base/lower_case.h"

namespace meshfolio::report {

std::string JsonPlace::path() const {
    if (parent == nullptr) return "";
    const std::string before = parent->path();
    if (key.empty()) return before + "[" + std::to_string(index) + "]";
    return before + (before.empty() ? "" : ".") + std::string(key);
}

FieldReader::FieldReader(const Json& object, const JsonPlace& place) : object_(object), place_(place) {
    if (!object.is_object()) refuse_type(object, place, "an object");
}

std::string FieldReader::type_in_words(const Json& value) {
    if (value.is_null()) return "null";
    if (value.is_boolean()) return "a truth value";
    if (value.is_number()) return value.is_number_float() ? "a number" : "the integer " + value.dump();
    if (value.is_string()) return "a text";
    return value.is_array() ? "a list" : "an object";
}

void FieldReader::refuse_type(const Json& json, const JsonPlace& place, const std::string& wanted) {
    throw JsonProblem(place, "is " + type_in_words(json) + ", not " + wanted, "take an unchanged results.json");
}

void FieldReader::require_inner_path(const std::string& path, const JsonPlace& place) {
    bool inside = !path.empty() && path.front() != '/' && path.find('\0') == std::string::npos;
    for (std::size_t begin = 0; inside && begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        const std::string part = path.substr(begin, end - begin);
        inside = !part.empty() && part != "." && part != "..";
        begin = end + 1;
    }
    if (!inside) throw JsonProblem(place, "is no path of a file inside the report", "write it relative to the folder of results.json");
}

void FieldReader::require_between(int value, const Note& limits, const JsonPlace& place) {
    if (value >= limits.least && value <= limits.most) return;
    throw JsonProblem(place, "is " + std::to_string(value),
                      "it may be " + std::to_string(limits.least) + " to " + std::to_string(limits.most));
}

void FieldReader::require_good_id(const std::string& id, const JsonPlace& place) {
    constexpr std::size_t longest_id = 200;
    const auto is_allowed = [](char c) { return is_alphanumeric(c) || c == '_' || c == '-' || c == '.' || c == '+'; };
    if (id.empty() || id.size() > longest_id || id.front() == '.' || !std::ranges::all_of(id, is_allowed))
        throw JsonProblem(place, "is no id", "use letters, digits and '_', at most " + std::to_string(longest_id));
}

const Json& FieldReader::required(const char* key) {
    const auto it = object_.find(key);
    if (it == object_.end()) throw JsonProblem(place_, std::string("has no '") + key + "'", "take a whole results.json");
    return *it;
}

const Json& FieldReader::list_in(const Json& value, const JsonPlace& place) {
    if (!value.is_array()) refuse_type(value, place, "a list");
    return value;
}

FieldReader::Odd FieldReader::odd_of(const char* key) {
    Odd odd;
    const auto it = object_.find(std::string(key) + not_finite);
    if (it == object_.end()) return odd;
    const JsonPlace place{&place_, key};
    const auto refuse = [&] {
        throw JsonProblem(place, "has a broken list of numbers that are not finite", "write [[place, 1, −1 or 0], …]");
    };
    if (!it->is_array()) refuse();
    for (const Json& pair : *it) {
        if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number_unsigned() || !pair[1].is_number_integer()) refuse();
        const auto sign = pair[1].get<std::int64_t>();
        if (sign < -1 || sign > 1 || !odd.signs.emplace(pair[0].get<std::size_t>(), static_cast<int>(sign)).second) refuse();
    }
    return odd;
}

std::optional<int> FieldReader::Odd::next() {
    const auto it = signs.find(place++);
    if (it == signs.end()) return {};
    ++used;
    return it->second;
}

void FieldReader::Odd::require_used(const JsonPlace& at) const {
    if (used != signs.size()) throw JsonProblem(at, "lacks numbers that are listed as not finite", "take a whole results.json");
}

// ---- values -------------------------------------------------------------------------------------------------------------

void FieldReader::read(const Json& json, double& value, const JsonPlace& place, Odd& odd) {
    constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const std::optional<int> sign = odd.next();
    if (sign && !json.is_null()) refuse_type(json, place, "null, as it is listed as not finite");
    if (json.is_null()) {
        value = sign.value_or(0) == 0 ? nan : *sign * infinity;
    } else if (json.is_number()) {
        value = json.get<double>();
    } else {
        refuse_type(json, place, "a number");
    }
}

void FieldReader::read(const Json& json, Cell& value, const JsonPlace& place, Odd& odd) {
    if (json.is_string()) {
        ++odd.place;
        value = json.get<std::string>();
    } else if (json.is_null() && !odd.signs.contains(odd.place)) {
        ++odd.place;
        value = std::monostate();
    } else {
        read(json, value.emplace<double>(), place, odd);
    }
}

void FieldReader::read(const Json& json, decltype(Parameter::value)& value, const JsonPlace& place, Odd& odd) {
    if (json.is_string()) value = json.get<std::string>();
    else if (json.is_array()) read(json, value.emplace<std::vector<double>>(), place, odd);
    else read(json, value.emplace<double>(), place, odd);
}

void FieldReader::read(const Json& json, int& value, const JsonPlace& place, Odd&) {
    if (!json.is_number_integer()) refuse_type(json, place, "an integer");
    const bool fits = json.is_number_unsigned() ? json.get<std::uint64_t>() <= std::uint64_t{std::numeric_limits<int>::max()}
                                                : json.get<std::int64_t>() >= std::numeric_limits<int>::min();
    if (!fits) throw JsonProblem(place, "is the integer " + json.dump(), "it may be -2147483648 to 2147483647");
    value = json.get<int>();
}

void FieldReader::read(const Json& json, std::map<std::string, std::string>& value, const JsonPlace& place, Odd&) {
    if (!json.is_object()) refuse_type(json, place, "an object of texts");
    for (const auto& [key, words] : json.items()) take(words, value[key], {&place, key}, words.is_string(), "a text");
}

void FieldReader::read(const Json& json, Run& value, const JsonPlace& place, Odd&) {
    value.kind = Run::Kind::plain;
    if (json.is_string()) {
        value.content = json.get<std::string>();
        return;
    }
    if (!json.is_object() || json.size() != 1 || !json.begin()->is_string()) refuse_type(json, place, "a text or one of a kind");
    value.kind = static_cast<Run::Kind>(choice(Json(json.begin().key()), place, names_of(Run::Kind())));
    if (value.kind == Run::Kind::plain) throw JsonProblem(place, "is an object, though its text is plain", "write the text alone");
    value.content = json.begin()->get<std::string>();
}

// ---- consistency --------------------------------------------------------------------------------------------------------

void FieldReader::require_sound(const ColumnEntry& entry, const JsonPlace& place) {
    const auto& heat = entry.column.heat;
    if (heat && !(heat->low > 0 && heat->low < heat->high))
        throw JsonProblem({&place, "heat"}, "is no range with 0 < low < high", "take an unchanged results.json");
}

void FieldReader::require_sound(const Table& table, const JsonPlace& place) {
    const JsonPlace rows{&place, "rows"};
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        if (table.rows[r].size() != table.columns.size())
            throw JsonProblem({&rows, {}, r}, "has " + std::to_string(table.rows[r].size()) + " cells",
                              "the table has " + std::to_string(table.columns.size()) + " columns");
    }
}

void FieldReader::require_sound(const Series& series, const JsonPlace& place) {
    const std::size_t size = series.x.size();
    const auto is_band = [&](const std::vector<double>& values) { return values.empty() || values.size() == size; };
    if (series.y.size() != size || !is_band(series.y_low) || !is_band(series.y_high) || series.y_low.size() != series.y_high.size())
        throw JsonProblem(place, "has lists of different lengths", "take an unchanged results.json");
}

void FieldReader::require_sound(const Diagram::Path& path, const JsonPlace& place) {
    if (path.x.size() != path.y.size()) throw JsonProblem(place, "has lists of different lengths", "take an unchanged results.json");
}

}   // namespace meshfolio::report
