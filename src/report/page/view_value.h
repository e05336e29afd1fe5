/// @file
/// Builds objects of the view model. Each value has a meaning, which `meshfolio templates --tags` prints.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

namespace meshfolio::report {

struct ViewValue {
    const char* tag;
    const char* meaning;
    mutable nlohmann::json value;   // moved into the object that it is entered into
};

/// While an object of this class exists, views of this thread also store the meaning of each tag, under `key`.
struct KeptMeanings {
    static constexpr const char* key = "#meanings";
    static inline thread_local bool are_kept = false;
    KeptMeanings() { are_kept = true; }
    ~KeptMeanings() { are_kept = false; }
    KeptMeanings(const KeptMeanings&) = delete;
    KeptMeanings& operator=(const KeptMeanings&) = delete;
};

/// Enters each value into an object of the view model, under its tag.
inline void enter(nlohmann::json& view, std::initializer_list<ViewValue> values) {
    for (const ViewValue& one : values) {
        view[one.tag] = std::move(one.value);
        if (KeptMeanings::are_kept) view[KeptMeanings::key][one.tag] = one.meaning;
    }
}

/// Returns an object of these values.
inline nlohmann::json view_of(std::initializer_list<ViewValue> values) {
    nlohmann::json view = nlohmann::json::object();
    enter(view, values);
    return view;
}

/// Adds a list under `tag`, and under "has_" + tag whether it has entries.
inline void enter_list(nlohmann::json& view, const char* tag, const char* meaning, nlohmann::json list) {
    const std::string condition = "has_" + std::string(tag);
    enter(view, {{condition.c_str(), "there are any", !list.empty()}, {tag, meaning, std::move(list)}});
}

/// Returns the list of view(item) for each item.
template <class Items, class View> nlohmann::json list_of(const Items& items, View view) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& item : items) list.push_back(view(item));
    return list;
}

}   // namespace meshfolio::report
