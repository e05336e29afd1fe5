/// @file
/// JSON to values, by the descriptions of json_fields.h. Every key must be there, every value of its type and within its limits. Unknown
/// keys are ignored, as a later version may have added them.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/in_quotes.h"
#include "report/json/json_fields.h"
#include "report/json/json_writer.h"

namespace meshfolio::report {

/// The place of a value in the JSON, formatted on demand.
struct JsonPlace {
    const JsonPlace* parent = nullptr;
    std::string_view key = {};   // empty: an element of a list
    std::size_t index = 0;

    std::string path() const;   // "questions[0].tables[2].id"; empty: the whole
};

/// The reader's exception for a wrong value; read_json() turns it into an InputError with the line.
struct JsonProblem : std::runtime_error {
    JsonProblem(const JsonPlace& place, const std::string& problem, std::string todo = "")
        : std::runtime_error(problem), path(place.path()), remedy(std::move(todo)) {}
    std::string path, remedy;
};

class FieldReader {
public:
    /// Reads the keys of `object`, which is at `place`. @throws JsonProblem unless it is a JSON object
    FieldReader(const Json& object, const JsonPlace& place);

    template <class Value> void operator()(const char* key, Value& value, const Note& note = {}) {
        const Json& json = required(key);
        const JsonPlace place{&place_, key};
        Odd odd = odd_of(key);
        read(json, value, place, odd);
        odd.require_used(place);
        if constexpr (std::is_same_v<Value, int>) require_between(value, note, place);
        if constexpr (std::is_same_v<Value, std::string>) {
            if (std::string_view(key) == "id") require_good_id(value, place);
            if (note.is_file) require_inner_path(value, place);
        }
        if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
            for (const std::string& path : value)
                if (note.is_file) require_inner_path(path, place);
        }
    }
    template <class Value>
    void optional(const char* key, Value& value, const std::type_identity_t<Value>& fallback, const Note& note = {}) {
        if (object_.contains(key)) (*this)(key, value, note);
        else value = fallback;
    }
    template <class Value> void optional(const char* key, std::optional<Value>& value, const Note& = {}) {
        if (object_.contains(key)) (*this)(key, value.emplace());
    }
    template <class Value> void only_if(bool condition, const char* key, Value& value, const Note& = {}) {
        if (condition) (*this)(key, value);
    }
    template <class Derive> void derived(const char* key, Derive derive, const Note& = {}) {
        if (required(key) != derived_json(derive()))
            throw JsonProblem({&place_, key}, "does not agree with the values that it follows from", "take an unchanged results.json");
    }
    void file_or_null(const char* key, std::string& path, bool& there, const Note& = {}) {
        there = !required(key).is_null();
        if (there) (*this)(key, path, file_note());
    }
    /// Throws a JsonProblem about the value of this key unless the condition holds.
    void require(bool condition, const char* key, const char* problem) {
        if (!condition) throw JsonProblem({&place_, key}, problem);
    }

private:
    const Json& object_;
    JsonPlace place_;

    /// The listed numbers of a value that are not finite, by their places in reading order.
    struct Odd {
        std::map<std::size_t, int> signs = {};   // 1: ∞, −1: −∞, 0: NaN
        std::size_t place = 0, used = 0;
        std::optional<int> next();                      // the sign at the next place, if listed
        void require_used(const JsonPlace& at) const;   // every listed number has been read
    };

    const Json& required(const char* key);                                   // throws if the object lacks it
    Odd odd_of(const char* key);                                             // from the key with the ending `not_finite`
    static const Json& list_in(const Json& value, const JsonPlace& place);   // throws unless it is a list
    static std::string type_in_words(const Json& value);                     // "a text", "a list", …
    [[noreturn]] static void refuse_type(const Json& json, const JsonPlace& place, const std::string& wanted);
    static void require_inner_path(const std::string& path, const JsonPlace& place);   // a path inside the report's folder
    static void require_between(int value, const Note& limits, const JsonPlace& place);
    static void require_good_id(const std::string& id, const JsonPlace& place);   // fit for the name of a file

    /// Takes a value that the JSON library converts, if it is of the right type.
    template <class Value> static void take(const Json& json, Value& value, const JsonPlace& place, bool is_right, const char* wanted) {
        if (!is_right) refuse_type(json, place, wanted);
        value = json.get<Value>();
    }
    static void read(const Json& json, bool& value, const JsonPlace& place, Odd&) {
        take(json, value, place, json.is_boolean(), "true or false");
    }
    static void read(const Json& json, std::uint64_t& value, const JsonPlace& place, Odd&) {
        take(json, value, place, json.is_number_unsigned(), "an integer from 0");
    }
    static void read(const Json& json, std::string& value, const JsonPlace& place, Odd&) {
        take(json, value, place, json.is_string(), "a text");
    }
    static void read(const Json& json, double& value, const JsonPlace& place, Odd& odd);
    static void read(const Json& json, Cell& value, const JsonPlace& place, Odd& odd);
    static void read(const Json& json, decltype(Parameter::value)& value, const JsonPlace& place, Odd& odd);
    static void read(const Json& json, int& value, const JsonPlace& place, Odd& odd);
    static void read(const Json& json, std::map<std::string, std::string>& value, const JsonPlace& place, Odd& odd);
    static void read(const Json& json, Run& value, const JsonPlace& place, Odd& odd);

    template <class Item> static void read(const Json& json, std::vector<Item>& items, const JsonPlace& place, Odd& odd) {
        const Json& list = list_in(json, place);
        items.clear();
        items.resize(list.size());
        for (std::size_t i = 0; i < list.size(); ++i) read(list[i], items[i], {&place, {}, i}, odd);
    }
    template <class Value> static void read(const Json& json, Value& value, const JsonPlace& place, Odd&) {
        if constexpr (std::is_enum_v<Value>) {
            value = static_cast<Value>(choice(json, place, names_of(value)));
        } else {
            FieldReader fields(json, place);
            describe(fields, value);
            require_sound(value, place);
        }
    }

    template <std::size_t Count>
    static std::size_t choice(const Json& json, const JsonPlace& place, const std::array<const char*, Count>& names) {
        std::string known;
        for (std::size_t i = 0; i < Count; ++i) {
            if (json == names[i]) return i;
            known += (i > 0 ? ", " : "") + std::string(names[i]);
        }
        throw JsonProblem(place, "is " + (json.is_string() ? in_quotes(json.get<std::string>()) : type_in_words(json)),
                          "it may be " + known);
    }

    // Conditions that a description cannot state, such as lists of equal length.
    static void require_sound(const ColumnEntry& entry, const JsonPlace& place);
    static void require_sound(const Table& table, const JsonPlace& place);
    static void require_sound(const Series& series, const JsonPlace& place);
    static void require_sound(const Diagram::Path& path, const JsonPlace& place);
    template <class Value> static void require_sound(const Value&, const JsonPlace&) {}
};

}   // namespace meshfolio::report
