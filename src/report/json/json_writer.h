/// @file
/// Values to JSON, by the descriptions of json_fields.h and in their order.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/json/json_fields.h"

namespace meshfolio::report {

using Json = nlohmann::ordered_json;

/// The ending of the key that lists the numbers of a value that are not finite, as JSON cannot hold them: [place in reading order, 1 for ∞,
/// −1 for −∞, 0 for NaN]. All become null; a NaN outside a cell is not listed.
inline constexpr const char* not_finite = "_not_finite";

/// Return a derived value as JSON; null for an empty optional.
inline Json derived_json(const auto& value) { return value; }
inline Json derived_json(const std::optional<bool>& value) { return value ? Json(*value) : Json(); }

/// Returns a part of a report as a JSON object, with the fields that describe() names.
Json json_of(const auto& part);

class FieldWriter {
public:
    explicit FieldWriter(Json& object) : object_(object) { object_ = Json::object(); }

    template <class Value> void operator()(const char* key, const Value& value, const Note& = {}) {
        Odd odd;
        object_[key] = json_of(value, odd);
        odd.enter(object_, key);
    }
    template <class Value>
    void optional(const char* key, const Value& value, const std::type_identity_t<Value>& fallback, const Note& = {}) {
        if (!is_same(value, fallback)) (*this)(key, value);
    }
    template <class Value> void optional(const char* key, const std::optional<Value>& value, const Note& = {}) {
        if (value) (*this)(key, *value);
    }
    template <class Value> void only_if(bool condition, const char* key, const Value& value, const Note& = {}) {
        if (condition) (*this)(key, value);
    }
    template <class Derive> void derived(const char* key, Derive derive, const Note& = {}) { object_[key] = derived_json(derive()); }
    void file_or_null(const char* key, const std::string& path, bool there, const Note& = {}) {
        object_[key] = there ? Json(path) : Json();
    }

private:
    Json& object_;

    /// Lists the numbers of one value that are not finite.
    struct Odd {
        std::size_t place = 0;
        Json list = Json::array();
        void enter(Json& object, const char* key) {
            if (!list.empty()) object[std::string(key) + not_finite] = std::move(list);
        }
    };

    static bool is_same(const auto& value, const auto& fallback) { return value == fallback; }
    template <class Item> static bool is_same(const std::vector<Item>& items, const std::vector<Item>& fallback) {
        return items.empty() && fallback.empty();
    }

    static Json json_of(double x, Odd& odd) {
        const std::size_t place = odd.place++;
        if (std::isinf(x)) odd.list.push_back(Json::array({place, x > 0 ? 1 : -1}));
        return std::isfinite(x) ? Json(x) : Json();
    }
    static Json json_of(const Cell& cell, Odd& odd) {
        if (const auto* x = std::get_if<double>(&cell)) {
            if (std::isnan(*x)) odd.list.push_back(Json::array({odd.place, 0}));
            return json_of(*x, odd);
        }
        ++odd.place;
        if (const auto* words = std::get_if<std::string>(&cell)) return *words;
        return {};
    }
    static Json json_of(const decltype(Parameter::value)& value, Odd& odd) {
        return std::visit([&](const auto& one) { return json_of(one, odd); }, value);
    }
    static Json json_of(bool value, Odd&) { return value; }
    static Json json_of(int value, Odd&) { return value; }
    static Json json_of(std::uint64_t value, Odd&) { return value; }
    static Json json_of(const std::string& value, Odd&) { return value; }
    static Json json_of(const std::map<std::string, std::string>& values, Odd&) { return values; }
    static Json json_of(const Run& run, Odd&) {
        if (run.kind == Run::Kind::plain) return run.content;
        return {{names_of(run.kind)[static_cast<std::size_t>(run.kind)], run.content}};
    }
    template <class Item> static Json json_of(const std::vector<Item>& items, Odd& odd) {
        Json list = Json::array();
        for (const Item& item : items) list.push_back(json_of(item, odd));
        return list;
    }
    template <class Value> static Json json_of(const Value& value, Odd&) {
        if constexpr (std::is_enum_v<Value>) {
            return names_of(value)[static_cast<std::size_t>(value)];
        } else {
            return report::json_of(value);
        }
    }
};

Json json_of(const auto& part) {
    Json object;
    FieldWriter fields(object);
    describe(fields, part);
    return object;
}

}   // namespace meshfolio::report
